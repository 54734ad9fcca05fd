// Which bones inform which vertices: the nearest bone of each vertex, if the vertex sees it.
#pragma once
#include "base/jobs.h"
#include "weights/skeleton.h"

namespace hf_inner {

struct Informants {
  explicit Informants(Memory& memory) : start(&memory), bone(&memory), screening(&memory), by_piece(&memory) {}
  Span<const Index> of(Index v) const noexcept {
    return {bone.data() + start[at(v)], at(start[at(v) + 1] - start[at(v)])};
  }
  Vector<Index> start;              // by vertex, one more: where its bones begin
  Vector<Index> bone;               // bones of one vertex, ascending; each has the same share of p
  Vector<double> screening;         // H by vertex, 0 without a bone
  Vector<std::uint32_t> by_piece;  // vertices with information
  std::uint32_t informed = 0;       // of all
  bool blind = false;               // some piece sees none of its bones and asks for them unseen
};

// The nearest bone of all informs a vertex, and only if the vertex sees it. On a piece where no vertex sees its bone,
// all nearest bones inform, unless the piece is small and takes the weights of others. A bone in front of a vertex
// counts as far away, but for open pieces that face their bones.
Informants find_informants(const Mesh& mesh, const SkinShape& skin, const Vector<BoneSegment>& segments, Memory& memory,
                           JobRunner& jobs);

}  // namespace hf_inner
