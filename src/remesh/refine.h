// Refines a quad mesh at the places where it misses the surface.
//
// Every quad (v, a, b, c) around a marked vertex v becomes three:
//     (v, e_a, i, e_c)    (e_a, a, b, i)    (i, b, c, e_c).
// The points e_a and e_c are the middles of the quad's edges at v, and i is half way from v to b. This is the template
// of one node in Schneiders 1996, with halves instead of thirds. Only edges at v are split, so other quads do not
// change. The mesh stays a mesh of quads with its Euler characteristic, as long as no quad has two marked corners. New
// points are reached by walking along the surface from v, so none jumps to another sheet.
#pragma once
#include "remesh/quad_mesh.h"

namespace hf_inner::remesh {

// Replaces each quad at a marked vertex by three. A marked vertex must not lie on a border. No
// quad may have two marked vertices.
void refine_quads(const FluxSurface& surface, QuadMesh& mesh, const Table<std::uint8_t>& marked, Memory& memory);

// Splits v into two vertices with a new quad between them, the inverse of a collapse (Tarini et al. 2010). The quads on
// the side of `towards` join the new vertex, whose number is returned. Both vertices stay at v's position. v must be an
// inner vertex with at least four quads.
std::int32_t split_vertex(QuadMesh& mesh, std::int32_t v, const Vec3& towards, Memory& memory);

}  // namespace hf_inner::remesh
