// Makes a quad mesh finer where it misses the surface, and nowhere else.
//
// A marked vertex v turns every quad (v, a, b, c) around it into three, by the middles e_a, e_c of its edges at v and a
// point i half way to b:
//     (v, e_a, i, e_c)    (e_a, a, b, i)    (i, b, c, e_c)
// (the template of one node in Schneiders 1996, with halves for thirds). Only edges at v are split, so the quads beyond
// stay what they are: the mesh stays a mesh of quads with its Euler characteristic, whatever is marked, as long as no
// quad has two marked corners. Points are reached by walking along the surface from v, so none jumps to another sheet.
//
// refine_misses marks, where the surface and the quads are farther from each other than `tolerance`, the nearest corner
// of the quad, the farthest places first, refines, relaxes, draws out what is still missed, and begins again; where
// that makes it worse twice, it closes the quads that are off instead (coarsen.h). Vertices of borders and of polygons
// that are no quads are not marked, nor is one four times.
#pragma once
#include "remesh/quad_distance.h"

namespace hf {

// marked: by vertex; of inner vertices with nothing but quads around them, no two in one quad.
void refine_quads(const FluxSurface& surface, QuadMesh& mesh, const Table<std::uint8_t>& marked, Memory& memory);

struct RefineOptions {
  double edge_length = 0.02, tolerance = 0.008;  // inner units
  std::int32_t rounds = 16, relax_rounds = 12;
  double most_faces = 1.5;  // of those the mesh came with
  Progress* progress = nullptr;
};

// Leaves the nearest mesh it met. deviation: of the mesh; returns that of the new one.
double refine_misses(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, double deviation,
                     const RefineOptions& options, Memory& memory);

}  // namespace hf
