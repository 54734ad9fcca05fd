// Finds the plane of symmetry of a skeleton or a surface.
#pragma once
#include "mesh/mirror_plane.h"
#include "surface/core.h"

namespace hf_inner::weights {

// The plane that reflects heads on the heads of their partners: bones with another partner count. False, and nothing
// written: there are none, or no plane reflects them.
bool plane_of_bones(const Vector<Vec3>& heads, const Vector<Index>& partner, mesh::MirrorPlane& plane, Memory& memory);
// The plane that reflects the surface on itself best.
mesh::MirrorPlane plane_of_surface(const surface::Core& core, Memory& memory);

}  // namespace hf_inner::weights
