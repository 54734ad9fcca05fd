// The plane of symmetry of a skeleton or a surface.
#pragma once
#include "engine/core.h"

namespace hf_inner {

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

// The plane that reflects heads on those of their partners: bones with another partner count. False, and nothing
// written: there are none, or no plane reflects them.
bool plane_of_bones(const Vector<Vec3>& heads, const Vector<Index>& partner, MirrorPlane& plane, Memory& memory);
// The plane that reflects the surface on itself best.
MirrorPlane plane_of_surface(const Core& core, Memory& memory);

}  // namespace hf_inner
