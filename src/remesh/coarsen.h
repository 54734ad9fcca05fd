// Collapses quads of a mesh: where it misses the surface, or where its edges are short.
//
// A quad (a, b, c, d) collapses along its diagonal: a and c become one vertex, and its sides coincide in pairs
// (diagonal collapse: Tarini, Pietroni, Cignoni, Panozzo and Puppo 2010). The result is again a mesh of quads with the
// same Euler characteristic under one condition. Only b and d are neighbours of both a and c, and only this face has
// both. Vertices b and d need four faces or more. Vertices a and c need three or more each, and together at most
// collapse_most_faces. Borders and their faces stay.
#pragma once
#include "remesh/quad_distance.h"

namespace hf_inner::remesh {

// Tells whether quad f may collapse along the diagonal of its corners k and k + 2.
bool can_collapse(const QuadMesh& mesh, const VertexFans& fans, std::int32_t f, std::int32_t k);

// Collapses quads that are too far from the surface, no two of them neighbours. Subdividing does not help a quad that
// lies across a fold, or among quads that overlap. Returns how many quads it collapsed. merged: by vertex of the new
// mesh, whether it was two vertices; unchanged if no quad collapsed.
std::int32_t collapse_misses(const FluxSurface& surface, QuadMesh& mesh, const Vector<QuadMiss>& misses,
                             Table<std::uint8_t>& merged, Memory& memory);

// Collapses quads, those with the shortest edges first, until at most `wanted` are left or none can collapse. The call
// does not check the distance to the surface. edge_length: inner units, at which the quads are relaxed.
void collapse_to_count(const FluxSurface& surface, QuadMesh& mesh, std::int32_t wanted, double edge_length,
                       Memory& memory);

}  // namespace hf_inner::remesh
