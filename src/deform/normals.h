// Unit normals of a posed surface, weighted by area: n_v ~ sum over the triangles at v of (q - p) x (r - p).
// The vertices are cut into pieces and each piece goes through its triangles once, so that the sums stay close; a
// triangle across a border is done for both. Cost: a cross product per triangle, about 10 ns a vertex; it is bound by
// the 70 bytes a vertex read and written. Allocates nothing; the same bits on every machine and number of threads.
#pragma once
#include "deform/rest.h"

namespace hf_inner {

struct Normal {
  float x, y, z;
};
inline Vec3 to_vec3(const Normal& n) noexcept { return {n.x, n.y, n.z}; }

// A sum of normals of triangles times twice their area, in the mesh's own unit, in single precision. Vertices are known
// to 1e-16 of the box, so a triangle whose area leaves the range of a float has no direction.
struct alignas(16) NormalSum {
  float component[4];  // the last is 0
};

// Vertices whose triangles have no direction, or directions that cancel, get (0, 0, 1). positions: in the unit of the
// mesh as given. sums: scratch, one per vertex.
void vertex_normals(const Mesh& mesh, const Rest& rest, const Vec3* positions, NormalSum* sums, Normal* normals,
                    JobRunner& jobs);

}  // namespace hf_inner
