// Evens out a quad mesh by moving its vertices along the surface.
//
// Every quad proposes the corners of the square that fits it best. With its corners as complex numbers z_k about their
// centre, in the plane of the mean normal, the square's first corner is r = 1/4 sum z_k i^-k. Its size is kept, or
// moved half way to edge_length times the mean scale of its corners. The mean normal is turned to that of the surface.
// A vertex moves half way to the mean of its proposals, a local-global scheme as in Bouaziz, Deuss, Schwartzburg, Weise
// and Pauly 2012. Vertices of quads with a corner turned over move to the mean of the centres around them instead,
// which untangles. Vertices walk: straight in their triangle, unfolded over every edge they cross. So they never leave
// the surface, never jump between sheets, and stop at a border. A vertex that would turn a corner over stays. Sites,
// snapped vertices and border vertices stay.
//
// Cost: O(vertices that may move) a round, and once O(vertices).
#pragma once
#include "base/progress.h"
#include "remesh/quad_mesh.h"

namespace hf_inner {

struct RelaxOptions {
  std::int32_t rounds = 0;
  double edge_length = 0;                       // 0: quads keep their sizes
  const Table<std::uint8_t>* moving = nullptr;  // by vertex: whether it may move; NULL: all may
};

void relax_quads(const FluxSurface& surface, QuadMesh& mesh, const RelaxOptions& options, Memory& memory);

// The vector of length 1 in the direction of a; 0 for 0.
inline Vec3 unit(Vec3 a) noexcept {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Vec3{};
}

// The point reached by walking `way`, projected to the triangle, from `from`.
SurfacePoint walk_surface(const FluxSurface& surface, SurfacePoint from, Vec3 way) noexcept;

}  // namespace hf_inner
