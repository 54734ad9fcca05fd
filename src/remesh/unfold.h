// Unfolds quads: moves vertices along the surface until no corner of a quad is turned over.
//
// A corner is turned over if it faces away from the normal of its quad, the sum of the cross products of its corners.
// Evening out and fitting can leave such corners on thin and sharp parts. Every vertex of a quad with one tries places
// around it. It takes the one where
//
//     E = sum over the corners of its quads of max(0, unfold_margin - sin of the corner's angle)^2
//
// is least. Vertices on borders slide along them; those on other features stay. Cost: O(vertices + faces), and 9 places
// for each vertex of a quad with a turned corner.
#pragma once
#include "remesh/quad_distance.h"

namespace hf_inner::remesh {

// Unfolds. The mesh may then lie farther from the surface; the caller judges that.
void unfold_corners(const FluxSurface& surface, double edge_length, QuadMesh& mesh, Memory& memory);

// Unfolds, and where the mesh then lies farther from the surface than before, the moved vertices go back.
// away: the distance between the mesh and the surface. Returns the distance of the new mesh; it is at most `away`.
double unfold_quads(const FluxSurface& surface, const QuadDistance& distance, double edge_length, double away,
                    QuadMesh& mesh, Memory& memory);

}  // namespace hf_inner::remesh
