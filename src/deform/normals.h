// Normals of the posed surface: at each vertex the unit vector along the sum of the cross products of the triangles
// around it, which weights them by area. Welded vertices have one normal, so seams stay smooth. Cost O(n); allocates
// nothing.
#pragma once
#include "deform/rest.h"

namespace hf {

// triangle_normals: scratch, one per triangle. A vertex whose triangles cancel out or have no area gets (0, 0, 1).
void vertex_normals(const Mesh& mesh, const Rest& rest, const Vec3* positions, Vec3* triangle_normals, Vec3* normals,
                    JobRunner& jobs);

}  // namespace hf
