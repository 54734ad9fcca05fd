// Evens out a quad mesh by moving its vertices along the surface.
//
// Every quad proposes the corners of the square that fits it best. In the plane of the mean normal, let z_k be its
// corners as complex numbers, relative to their centre. The square's first corner is then r = 1/4 sum z_k i^-k. The
// square keeps its size, or moves half way to edge_length times the mean scale of its corners. The mean normal is
// turned to the side of the surface's normal. A vertex moves half way to the mean of its proposals, a local-global
// scheme as in Bouaziz, Deuss, Schwartzburg, Weise and Pauly 2012. If a quad has a corner turned over, its vertices
// move to the mean of the centres around them instead, which untangles the quad. A vertex walks straight in its
// triangle, and unfolds the next triangle at every edge that it crosses. So it never leaves the surface, never jumps to
// another sheet, and stops at a border. A vertex that would turn a corner over stays. Vertices of
// features, snapped vertices and border vertices stay too.
//
// Cost: O(vertices that may move) per round, and O(vertices) once.
#pragma once
#include "base/progress.h"
#include "remesh/quad_mesh.h"

namespace hf_inner::remesh {

struct RelaxOptions {
  std::int32_t rounds = 0;
  double edge_length = 0;                       // inner units
  const Table<std::uint8_t>* moving = nullptr;  // by vertex: whether it may move; NULL: all may
};

void relax_quads(const FluxSurface& surface, QuadMesh& mesh, const RelaxOptions& options, Memory& memory);

// Returns the vector of length 1 in the direction of a, or 0 for 0.
inline Vec3 unit(Vec3 a) noexcept {
  const double length = norm(a);
  return length > 0 ? (1 / length) * a : Vec3{};
}

// Returns the point reached from `from` by walking along the vector `way`, projected to the triangle.
SurfacePoint walk_surface(const FluxSurface& surface, SurfacePoint from, Vec3 way) noexcept;

}  // namespace hf_inner::remesh
