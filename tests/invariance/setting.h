// A surface of a copy, and the way from the body to the copy and back. A noun asks for vertices, places and lengths of
// the body, and gives what it measured back in the body's frame.
#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "body.h"
#include "hf/hf.h"
#include "support/owned.h"

namespace invariance {

// A call was refused: the library's sentence.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline void ok(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw Refused(std::string(detail.function) + ": " + detail.message);
}

using hf_test::Owned;
using Surface = Owned<hf_surface, hf_surface_destroy>;
using Solver = Owned<hf_solver, hf_solver_destroy>;

// What one noun measured on one copy. Rows of two copies are compared entry by entry.
struct Measured {
  enum Kind { list, set };
  struct Row {
    std::string what;
    Kind kind;
    std::size_t width;  // of a set: numbers of each member; the order of the members does not count
    std::vector<double> values;
  };
  std::vector<Row> rows;

  // Values relative to `scale`: a difference of `scale` counts as 1.
  void add(const std::string& what, std::vector<double> values, double scale = 1);
  void add_set(const std::string& what, std::size_t width, std::vector<double> values);
  void count(const std::string& what, double value) { add(what, {value}); }
};

// The largest difference of two; `where` names the row. Infinity where lengths differ.
double difference(const Measured& a, const Measured& b, std::string& where);

class Setting {
 public:
  Setting(const Body& body, const Copy& copy);

  const Body& body;
  const Copy& copy;

  hf_surface surface() const { return surface_; }
  // A surface with other options.
  Surface make(const hf_surface_desc& options) const;
  hf_surface_desc desc() const;

  // ---- from the body to the copy ----
  std::uint32_t vertex(std::uint32_t v) const { return copy.first[v]; }
  std::vector<std::uint32_t> vertices(const std::vector<std::uint32_t>& list) const;
  std::uint32_t pick(std::size_t i) const { return vertex(body.picks[i]); }
  Vec place(const Vec& p) const;
  Vec turn(const Vec& direction) const;  // keeps its length
  double size(double length) const { return copy.scale * length; }
  // A rigid motion of the body's frame as one of the copy's: 16 numbers, column by column.
  std::array<double, 16> motion(const std::array<Vec, 3>& rotation, const Vec& shift) const;
  // One value for every vertex of the copy; `added` for vertices that are not the body's.
  std::vector<double> spread(const std::vector<double>& values, double added) const;
  // The corners and weights of a point of a triangle of the body.
  void point(std::uint32_t triangle, const Vec& weights, std::uint32_t* corners, double* barycentrics) const;

  // ---- from the copy to the body ----
  Vec back(const Vec& p) const;
  Vec back_turn(const Vec& direction) const;
  double back_size(double length) const { return length / copy.scale; }
  std::uint32_t origin(std::uint32_t v) const { return v == HF_NO_INDEX ? none : copy.origin[v]; }
  // Rows of a copy, as rows of the body; places are taken back to its frame.
  std::vector<double> gather(const std::vector<double>& values, std::size_t width = 1) const;
  std::vector<double> gather_places(const std::vector<double>& xyz) const;
  std::vector<double> gather_directions(const std::vector<double>& xyz) const;

 private:
  std::vector<float> floats_;
  std::vector<double> doubles_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint16_t> short_corners_;
  std::vector<std::uint32_t> sizes_;
  mutable hf_faces_desc faces_;
  Surface surface_;
};

// ---- the nouns ----

struct Noun {
  const char* name;
  const char* what;  // one line for the table
  Measured (*measure)(const Setting& setting);
  double tolerance;    // of a copy whose numbers are rounded in another way
  const char* reason;  // where the tolerance comes from
  bool slow;           // left out of the quick form but for the first bodies
};
const std::vector<Noun>& nouns();

// The functions of the list, by file.
Measured measure_report(const Setting&);
Measured measure_picking(const Setting&);
Measured measure_links(const Setting&);
Measured measure_quads(const Setting&);
Measured measure_graph(const Setting&);
Measured measure_harmonic(const Setting&);
Measured measure_places(const Setting&);
Measured measure_operators(const Setting&);
Measured measure_biharmonic(const Setting&);
Measured measure_screened(const Setting&);
Measured measure_preview(const Setting&);
Measured measure_vectors(const Setting&);
Measured measure_direction(const Setting&);
Measured measure_singularities(const Setting&);
Measured measure_isolines(const Setting&);
Measured measure_critical(const Setting&);
Measured measure_exact(const Setting&);
Measured measure_front(const Setting&);
Measured measure_heat(const Setting&);
Measured measure_paths(const Setting&);
Measured measure_map(const Setting&);
Measured measure_poisson_tips(const Setting&);
Measured measure_geodesic_tips(const Setting&);
Measured measure_flow(const Setting&);
Measured measure_pose(const Setting&);
Measured measure_refined_pose(const Setting&);
Measured measure_paper_pose(const Setting&);
Measured measure_layers(const Setting&);
Measured measure_proposals(const Setting&);
Measured measure_region(const Setting&);
Measured measure_detail(const Setting&);
Measured measure_weights(const Setting&);
Measured measure_carry_from(const Setting&);
Measured measure_carry_to(const Setting&);
Measured measure_mirror(const Setting&);
Measured measure_transfer_from(const Setting&);
Measured measure_transfer_to(const Setting&);
Measured measure_stretch(const Setting&);

}  // namespace invariance
