// Collapses quads of a mesh where its edges are short.
//
// A quad (a, b, c, d) collapses along its diagonal: a and c become one vertex and its sides coincide in pairs (diagonal
// collapse: Tarini, Pietroni, Cignoni, Panozzo and Puppo 2010). The result is a mesh of quads with the same Euler
// characteristic if a and c share no neighbours but b and d, and no face but this one. Vertices b and d need four
// faces or more, a and c three, and a and c together at most collapse_most_faces. Borders and their faces stay.
//
// coarsen_quads collapses quads with an edge shorter than `shortest`, the shortest first, many at a time. The vertices
// around them are relaxed and the mesh is measured. A collapse after which more is missed nearby is taken back.
#pragma once
#include "remesh/constants.h"
#include "remesh/quad_distance.h"

namespace hf_inner {

// Whether quad f may collapse along the diagonal of its corners k and k + 2.
bool can_collapse(const QuadMesh& mesh, const VertexFans& fans, std::int32_t f, std::int32_t k);

// Collapses quads that are too far from the surface, no two of them neighbours: subdividing does not help a quad that
// lies across a fold or in a tangle. Returns how many. merged: by vertex of the new mesh, whether it was two; unchanged
// if none collapsed.
std::int32_t collapse_misses(const FluxSurface& surface, QuadMesh& mesh, const Vector<QuadMiss>& misses,
                             Table<std::uint8_t>& merged, Memory& memory);

struct CoarsenOptions {
  double edge_length = 0, tolerance = 0;  // inner units
  double shortest = short_edge;           // edge lengths
  bool only_refined = false;              // quads with a corner whose scale is below 1
  std::int32_t rounds = collapse_rounds;
};

// Returns the distance of the new mesh and the surface: at most collapse_far tolerances, or `deviation` as it was.
double coarsen_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, double deviation,
                     const CoarsenOptions& options, Memory& memory);

}  // namespace hf_inner
