// Pairs the bones of the left side of a skeleton with the bones of the right side, by their names or their places.
#pragma once
#include "weights/mirror_plane.h"

namespace hf_inner::weights {

// How a bone found its partner.
enum class PairedBy : std::uint8_t {
  none = 0,    // it has none, and moves like itself on the other side
  name = 1,    // the names differ in the side alone
  place = 2,   // it lies where the reflection of the other lies
  centre = 3,  // it lies on the plane, and is its own partner
  given = 4,   // the caller named the partner
};

struct BonePairs {
  explicit BonePairs(Memory& memory) : partner(&memory), by(&memory), off(&memory) {}
  Vector<Index> partner;  // by bone; itself where it has none
  Vector<PairedBy> by;
  Vector<double> off;  // distance of the reflected bone from its partner, inner unit
};

// Partners by the names alone, -1 where no name fits. names: one line for each bone. Words that say a side are left,
// right, l and r in any case, where they stand alone: arm_L, L_arm, arm.l, LeftArm, armL.
Vector<Index> pair_names(Span<const char> names, std::size_t count, Memory& memory);

// named: what pair_names found, with partners that the caller gave. given: by bone, 1 where the caller gave it.
BonePairs pair_bones(const Vector<Vec3>& heads, const Vector<Index>& named, const Vector<std::uint8_t>& given,
                     const mesh::MirrorPlane& plane, Memory& memory);

}  // namespace hf_inner::weights
