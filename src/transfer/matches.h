// Finds the point of a source surface that corresponds to each vertex of a target (HF_TRANSFER_STRETCH).
//
// A warp of space (warp.h) takes the target to the form of the source. First it fits the pairs alone. Then, in some
// rounds, it fits samples of the target to their nearest points. A vertex matches the source point with the nearest
// coordinates. These are its warped place, and the fields of all pairs with a small weight. The fields tell close parts
// apart, such as lips. Vertices of the target's border match the source's border, if it has one there. A surface
// matches itself exactly.
#pragma once
#include "deform/rotation.h"
#include "surface/core.h"
#include "transfer/openings.h"

namespace hf_inner::transfer {

// One surface: fields by vertex (width numbers each), and the means of the pairs' regions.
struct MatchSide {
  const surface::Core* core = nullptr;
  const double* field = nullptr;
  Span<const Vec3> means;
  Mat3 axes;        // rows right, up, forward
  double unit = 1;  // lengths of the target over lengths of this surface
};

struct Matches {
  explicit Matches(Memory& memory) : corner(&memory), share(&memory), on_border(&memory) {}
  Vector<std::int32_t> corner;  // three source vertices for each target vertex
  Vector<double> share;         // and their shares; where a source vertex is met exactly, its share is exactly 1
  Vector<std::uint8_t>
      on_border;  // by target vertex: it matches a place of the source's border, by the first two corners
};

void find_matches(const MatchSide& source, const MatchSide& target, const Border& source_border,
                  const Border& target_border, Memory& memory, Matches& out);

}  // namespace hf_inner::transfer
