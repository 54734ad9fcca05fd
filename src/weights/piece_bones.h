// Which bones the pieces of a surface hold: those whose places have the piece all around.
#pragma once
#include "base/jobs.h"
#include "mesh/box_tree.h"
#include "weights/skeleton.h"

namespace hf_inner::weights {

// A bone of which a piece holds a part.
struct HeldBone {
  Index bone;
  double share;   // of the bone, 0 to 1; of a joint with several segments the largest
  double length;  // of the part in the piece
  bool has_head;
  Vec3 head;
};

struct PieceBones {
  explicit PieceBones(Memory& memory) : start(&memory), bones(&memory) {}
  Span<const HeldBone> of(Index piece) const noexcept {
    return {bones.data() + start[at(piece)], at(start[at(piece) + 1] - start[at(piece)])};
  }
  Vector<Index> start;  // by piece, one more
  Vector<HeldBone> bones;
};

// Returns the box of every piece.
Vector<mesh::ItemBox> piece_boxes(const mesh::Mesh& mesh, Memory& memory);

// Finds the bones of every piece, by number.
PieceBones find_piece_bones(const mesh::Mesh& mesh, const mesh::SkinShape& skin, const Vector<BoneSegment>& segments,
                            Memory& memory, JobRunner& jobs);

}  // namespace hf_inner::weights
