// Which bones the islands of a surface hold: those whose places have the island all around.
#pragma once
#include "base/jobs.h"
#include "mesh/box_tree.h"
#include "weights/skeleton.h"

namespace hf_inner {

// What an island has of a bone.
struct HeldBone {
  Index bone;
  double share;   // of the bone, 0 to 1; of a joint with several segments the largest
  double length;  // of the part in the island
  bool has_head;
  Vec3 head;
};

struct PieceBones {
  explicit PieceBones(Memory& memory) : start(&memory), bones(&memory) {}
  Span<const HeldBone> of(Index island) const noexcept {
    return {bones.data() + start[at(island)], at(start[at(island) + 1] - start[at(island)])};
  }
  Vector<Index> start;  // by island, one more
  Vector<HeldBone> bones;
};

// Returns the box of every island.
Vector<ItemBox> island_boxes(const Mesh& mesh, Memory& memory);

// Finds the bones of every island, by number.
PieceBones find_piece_bones(const Mesh& mesh, const SkinShape& skin, const Vector<BoneSegment>& segments,
                            Memory& memory, JobRunner& jobs);

}  // namespace hf_inner
