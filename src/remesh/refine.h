// Makes a quad mesh finer where it misses the surface, and nowhere else.
//
// A marked vertex v turns every quad (v, a, b, c) around it into three, by the middles e_a, e_c of its edges at v and a
// point i half way to b:
//     (v, e_a, i, e_c)    (e_a, a, b, i)    (i, b, c, e_c)
// (the template of one node in Schneiders 1996, with halves for thirds). Only edges at v are split, so the quads beyond
// stay what they are: the mesh stays a mesh of quads with its Euler characteristic, whatever is marked, as long as no
// quad has two marked corners. Points are reached by walking along the surface from v, so none jumps to another sheet.
#pragma once
#include "remesh/quad_mesh.h"

namespace hf_inner {

// marked: by vertex; of inner vertices with nothing but quads around them, no two in one quad.
void refine_quads(const FluxSurface& surface, QuadMesh& mesh, const Table<std::uint8_t>& marked, Memory& memory);

// Makes v two vertices with a new quad between them (the inverse of closing one, Tarini et al. 2010): the quads on the
// side of `towards` go with the new vertex, whose number is returned; both stay where v is. v: inner, with nothing but
// quads around it, four or more.
std::int32_t open_vertex(QuadMesh& mesh, std::int32_t v, const Vec3& towards, Memory& memory);

}  // namespace hf_inner
