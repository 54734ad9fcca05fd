// Computes unit normals of a posed surface, weighted by area: n_v ~ sum over the triangles at v of (q - p) x (r - p).
//
// p, q and r are the corners of a triangle. The vertices are cut into pieces. Each piece goes through its triangles
// once, so that its sums stay in the cache. A triangle with corners in several pieces is computed for each of them.
// Where faces were given, the sum runs over them: the area vector of a face (Newell) does not depend on its cut.
// Cost: a cross product per triangle, about 10 ns per vertex. The limit is the memory: 70 bytes per vertex are read and
// written. Allocates nothing. Gives the same bits on every machine and number of threads.
#pragma once
#include "deform/rest.h"

namespace hf_inner::deform {

struct Normal {
  float x, y, z;
};
inline Vec3 to_vec3(const Normal& n) noexcept { return {n.x, n.y, n.z}; }

// A sum of triangle normals, each with the length of twice its area in the unit of the scaled mesh. Single precision is
// enough: positions are exact to 1e-16 of the box, so a triangle whose area leaves the range of a float has no
// direction anyway.
struct alignas(16) NormalSum {
  float component[4];  // the last is 0
};

// Computes all vertex normals. A vertex gets (0, 0, 1) if its triangles have no direction, or if their normals cancel.
// positions: in the unit of the caller's mesh. sums: scratch, one per vertex.
void vertex_normals(const mesh::Mesh& mesh, const Rest& rest, const Vec3* positions, NormalSum* sums, Normal* normals,
                    JobRunner& jobs);

}  // namespace hf_inner::deform
