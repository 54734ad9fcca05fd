// Finds the bones that are the constraint of a vertex: its nearest bone, if the bone is in sight of the vertex.
#pragma once
#include "base/jobs.h"
#include "weights/skeleton.h"

namespace hf_inner::weights {

struct Informants {
  explicit Informants(Memory& memory) : start(&memory), bone(&memory), screening(&memory), by_piece(&memory) {}
  Span<const Index> of(Index v) const noexcept {
    return {bone.data() + start[at(v)], at(start[at(v) + 1] - start[at(v)])};
  }
  Vector<Index> start;             // by vertex, one more: where its bones begin
  Vector<Index> bone;              // bones of one vertex, ascending; each has the same share of p
  Vector<double> screening;        // H by vertex, 0 without a bone
  Vector<std::uint32_t> by_piece;  // vertices with information
  std::uint32_t informed = 0;      // of all
  bool blind = false;              // some piece has none of its bones in sight and uses them unseen
};

// A vertex has its nearest bone as its constraint, and only if the bone is in sight. If no vertex of a piece has its
// bone in sight, every vertex gets its nearest bone unseen. A small piece does not: it gets the weights of other
// pieces. A bone in front of a vertex counts as far away. Open pieces that face their bones are an exception.
Informants find_informants(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const Vector<BoneSegment>& segments,
                           Memory& memory, JobRunner& jobs);

}  // namespace hf_inner::weights
