// A plane of symmetry.
#pragma once
#include "mesh/mesh.h"

namespace hf_inner::mesh {

enum class PlaneFrom : std::int32_t { given = 0, bones = 1, surface = 2 };

// The points p with normal . p = offset, in the inner unit of a mesh.
struct MirrorPlane {
  Vec3 normal{1, 0, 0};
  double offset = 0;
  PlaneFrom from = PlaneFrom::given;
  double side(const Vec3& p) const noexcept { return dot(normal, p) - offset; }
  Vec3 reflect(const Vec3& p) const noexcept { return p - (2 * side(p)) * normal; }
  Vec3 turn(const Vec3& direction) const noexcept { return direction - (2 * dot(normal, direction)) * normal; }
};

}  // namespace hf_inner::mesh
