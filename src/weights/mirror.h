// Mirrors the weights of one side of a surface to the other, on meshes whose vertices do not mirror.
#pragma once
#include "weights/carry.h"
#include "weights/mirror_bones.h"

namespace hf_inner::weights {

enum class MirrorTo : std::int32_t {
  negative = 0,  // the side that the normal points to gives its weights
  positive = 1,
  both = 2,  // each side takes the mean
};

struct MirrorOptions {
  MirrorTo to = MirrorTo::negative;
  MatchOptions carry;
  bool has_plane = false;
  mesh::MirrorPlane plane;  // with has_plane
};

// The bones, in the inner unit of the mesh.
struct MirrorBones {
  explicit MirrorBones(Memory& memory) : heads(&memory), partner(&memory), given(&memory) {}
  Vector<Vec3> heads;
  Vector<Index> partner;       // by names or given, -1 where none is known
  Vector<std::uint8_t> given;  // 1 where the caller gave it
};

struct MirroredWeights {
  explicit MirroredWeights(Memory& memory) : filled(memory), pairs(memory) {}
  FilledWeights filled;
  mesh::MirrorPlane plane;
  BonePairs pairs;
  // Distances of the reflected vertices from the surface, inner unit.
  double mean_off = 0, worst_off = 0;
  Index worst = -1;  // inner vertex
};

// How far the reflections of bones are from their partners, in the unit of the mesh.
struct BoneMisses {
  double mean = 0, worst = 0;
  std::uint32_t worst_joint = HF_NO_INDEX;  // HF_NO_INDEX: none has a partner
  std::uint32_t by[5] = {};                 // bones, by PairedBy
};
BoneMisses bone_misses(const BonePairs& pairs, double scale) noexcept;

// whose: as in Fill. Throws HF_ERROR_EMPTY if no vertex of the side that gives has weights.
MirroredWeights mirror_weights(const SkinSurface& surface, const GivenWeights& given, const MirrorBones& bones,
                               const MirrorOptions& options, const surface::Surface* whose = nullptr);

}  // namespace hf_inner::weights
