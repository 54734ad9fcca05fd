// Fits a quad mesh to its surface where their distance exceeds a tolerance.
//
// The distance is measured both ways, from the surface to the quads and back (quad_distance.h). At every missed place,
// the farthest first, steps are tried in the order of this list.
//     release: Pinned corners of a quad that is off may move again.
//     snap: The nearest corner of the nearest quad moves to the place and is pinned there. A corner on a border moves
//         only to vertices of the surface's border.
//     split: The nearest vertex becomes two with a new quad between them, one of them at the place (refine.h).
//     widen: The same, but the new vertex moves half way to the place and is not pinned.
//     subdivide: The quads around the nearest vertex become three each (refine.h), then as snap.
//     collapse: The quad collapses along a diagonal (coarsen.h), because it lies across a fold or in a tangle.
// A step moves only vertices within a few quads of its place, so distant places are compared separately. A step stays
// if the misses around it shrink: the sum of d^2 - tolerance^2 over its samples. It may not turn corners over against
// the mean normal of the surface, except for the few that most_folds allows on crumpled surfaces. Otherwise it is taken
// back and the next step is tried.
// So the mesh never gets worse, and it stays a mesh of quads with its Euler characteristic.
// Cost: O(n + faces) for every round of steps, mostly one or two dozen of them.
#pragma once
#include "remesh/constants.h"
#include "remesh/quad_distance.h"

namespace hf_inner {

struct FitOptions {
  double edge_length = 0, tolerance = 0;  // inner units
  std::int32_t most_folds = 0;            // corners that a step may turn over (fit_folding_gain)
  std::int32_t relax_rings = fit_rings;   // rings of quads around a step that are relaxed
};

// Returns the distance of the fitted mesh and the surface.
double fit_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, const FitOptions& options,
                 Memory& memory);

}  // namespace hf_inner
