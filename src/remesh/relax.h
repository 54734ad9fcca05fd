// Evens out a quad mesh by moving its vertices along the surface it lies on.
//
// Every quad proposes for its corners those of the square that fits it best: with the corners as complex numbers z_k
// about their centre in the plane of the mean normal (turned to the surface's), the square's first corner is
// r = 1/4 sum z_k i^-k; its size is kept, or drawn half way to edge_length times the mean scale of its corners. A
// vertex goes half way to the mean of its proposals (a local-global scheme as in Bouaziz, Deuss, Schwartzburg, Weise
// and Pauly 2012); those of quads that are turned over at a corner go to the mean of the centres around them, which
// untangles. They go by walking: straight in their triangle, unfolded over every edge they cross. So they never leave
// the surface, cannot jump between sheets, and stop at a border. Vertices that would turn a corner over stay where they
// were; sites, what was drawn out, and border vertices stay.
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
  Progress* progress = nullptr;
};

void relax_quads(const FluxSurface& surface, QuadMesh& mesh, const RelaxOptions& options, Memory& memory);

// The point reached by going `way` (its part in the plane of the triangle) from `from`.
SurfacePoint walk_surface(const FluxSurface& surface, SurfacePoint from, Vec3 way) noexcept;

}  // namespace hf_inner
