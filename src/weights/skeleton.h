// The bones of a skeleton as the library works on them: segments in the frame of the welded mesh.
#pragma once
#include "base/span.h"
#include "mesh/mesh.h"
#include "mesh/skin_shape.h"

namespace hf_inner::weights {

// A bone that deforms.
struct BoneSegment {
  Vec3 head, tail;  // inner unit
  Index bone;
};

// The bones of the caller, in the caller's unit. All arrays have the same length.
struct Bones {
  explicit Bones(Memory& memory) : head(&memory), tail(&memory), axis(&memory), parent(&memory), deforms(&memory) {}
  Bones(const Bones& other, Memory& memory)
      : head(other.head, &memory),
        tail(other.tail, &memory),
        axis(other.axis, &memory),
        parent(other.parent, &memory),
        deforms(other.deforms, &memory),
        has_tails(other.has_tails) {}
  Index count() const noexcept { return static_cast<Index>(head.size()); }
  Vector<Vec3> head, tail;       // tail: empty unless has_tails
  Vector<Vec3> axis;             // without tails: unit directions, zero where unknown; or empty
  Vector<Index> parent;          // -1: a root
  Vector<std::uint8_t> deforms;  // 0: the bone gets no weight
  bool has_tails = false;        // false: heads are joints, and the tails follow from the children
};

// Why a bone deserves a look. Bits.
enum BoneFault : std::uint32_t {
  bone_no_length = 1,   // a point
  bone_coincident = 2,  // lies on a bone of a lower number
  bone_informs_none = 4,
  bone_outside = 8,  // no part of it is inside the skin
};

// Makes the segments of the bones that deform, by number. Bones without tails get them from their children or the skin.
Vector<BoneSegment> bone_segments(const Bones& bones, const mesh::Mesh& mesh, const mesh::SkinShape& skin,
                                  Memory& memory);
// The faults that show without a solve: no length, coincident, outside.
Vector<std::uint32_t> bone_faults(Index count, const Vector<BoneSegment>& segments, const mesh::SkinShape& skin,
                                  Memory& memory);

}  // namespace hf_inner::weights
