// Fits a quad mesh to its surface where the distance exceeds a tolerance.
//
// The distance is measured both ways, from the surface to the quads and back (quad_distance.h). A place that is too far
// is a miss. At every miss, the farthest first, these steps are tried in this order:
// - release: Pinned corners of the missed quad may move again.
// - snap: The nearest corner of the nearest quad moves to the place and is pinned there. A corner on a border moves
//   only to vertices of the surface's border.
// - split: The nearest vertex becomes two vertices with a new quad between them; one of them moves to the place
//   (refine.h).
// - widen: The same, but the new vertex moves only half way to the place and is not pinned.
// - subdivide: Each quad around the nearest vertex becomes three (refine.h); then as snap.
// - collapse: The quad collapses along a diagonal (coarsen.h), because it lies across a fold or in a tangle.
//
// A step moves only vertices within a few quads of its place, so distant places can be judged separately. A step stays
// if the misses around it shrink; they are measured by the sum of d^2 - tolerance^2 over samples at distance d. Corners
// that it turned over are unfolded first (unfold.h). It may leave no more turned corners and no more quads that run
// through others than before (quad_faults.h). Otherwise it is undone, and the next step is tried. So the mesh never
// gets worse, and it stays a mesh of quads with its Euler characteristic. Cost: O(n + faces) for every round of steps,
// mostly one or two dozen rounds.
#pragma once
#include "remesh/quad_distance.h"

namespace hf_inner::remesh {

struct FitOptions {
  double edge_length = 0, tolerance = 0;  // in inner units
};

// Returns the distance between the fitted mesh and the surface.
double fit_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, const FitOptions& options,
                 Memory& memory);

}  // namespace hf_inner::remesh
