// Takes quads out of a mesh where its edges are short.
//
// A quad (a, b, c, d) closes along its diagonal: a and c become one vertex, its sides fall together in pairs (diagonal
// collapse: Tarini, Pietroni, Cignoni, Panozzo and Puppo 2010). That keeps a mesh of quads with its Euler
// characteristic when a and c have no neighbours in common but b and d, and no face but this one; b and d need four
// faces or more, a and c three, and together no more than eight. Borders and their faces stay.
//
// coarsen_quads closes quads with an edge shorter than `shortest`, the shortest first, many at a time; the rest is
// relaxed and measured. Where more than `tolerance` is then missed around a quad that was not before, it stays.
#pragma once
#include "remesh/constants.h"
#include "remesh/quad_distance.h"

namespace hf_inner {

// Whether quad f may close along the diagonal of its corners k and k + 2.
bool can_close(const QuadMesh& mesh, const VertexFans& fans, std::int32_t f, std::int32_t k);

// Closes quads that are farther from the surface than they may be, no two of them neighbours: what lies across a fold,
// or in a tangle, is not mended by making it finer. Returns how many. merged: by vertex of the new mesh, whether it was
// two; left as it is where none closed.
std::int32_t close_misses(const FluxSurface& surface, QuadMesh& mesh, const Vector<QuadMiss>& misses,
                          Table<std::uint8_t>& merged, Memory& memory);

struct CoarsenOptions {
  double edge_length = 0, tolerance = 0;  // inner units
  double shortest = short_edge;           // edge lengths
  bool only_refined = false;              // quads with a corner whose scale is below 1
  std::int32_t rounds = collapse_rounds;
  Progress* progress = nullptr;
};

// Returns how far the mesh and the surface are from each other then: at most 1.1 tolerances, or what it was
// (`deviation`).
double coarsen_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, double deviation,
                     const CoarsenOptions& options, Memory& memory);

}  // namespace hf_inner
