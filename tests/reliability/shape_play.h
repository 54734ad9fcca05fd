// The player of shapes (shape_player.h). shape_player.cpp makes meshes and calls quads and regions, shape_motion.cpp
// calls transfers, weights and links.
#pragma once
#include <cmath>
#include <vector>

#include "play.h"
#include "shape_player.h"
#include "support/owned.h"
#include "surfaces.h"

namespace shapes {

using play::Bytes;
using play::expect;
using play::hold;
using reliability::Mesh;

using hf_test::Owned;
using Surface = Owned<hf_surface, hf_surface_destroy>;

inline bool finite(const std::vector<double>& values) {
  for (const double x : values)
    if (!std::isfinite(x)) return false;
  return true;
}

// A call that may refuse its arguments, and says so by one of the given codes. Returns whether it gave a result.
template <class... Codes>
bool done(const char* call, hf_result got, Codes... allowed) {
  if (got == HF_OK) return true;
  if (!(... || (got == allowed))) play::fail(std::string(call) + ": " + hf_result_get_name(got));
  return false;
}

class Player {
 public:
  Player(Bytes bytes, Outcome& outcome) : bytes_(bytes), outcome_(outcome) {}
  void run();

 private:
  Mesh take_mesh();
  std::uint32_t take_vertex() { return bytes_.take() % mesh_.vertex_count(); }
  std::vector<std::uint32_t> take_vertices(unsigned most);
  std::vector<double> posed() const;
  // Kinds of calls. Each returns whether there was a result.
  bool quads();
  bool region();
  bool transfer();
  bool weights();
  bool links();
  // Checks of results.
  void check_quads(hf_quads quads) const;
  void check_weights(const char* call, const hf_weights_out& out) const;

  Bytes bytes_;
  Outcome& outcome_;
  Mesh mesh_;
  double diagonal_ = 0;
  hf_surface surface_ = nullptr;
};

}  // namespace shapes
