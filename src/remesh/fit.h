// Fits a quad mesh to its surface where they are farther from each other than they may be.
//
// Both ways: the surface from the quads and back (quad_distance.h). At every missed place the gentlest step that helps
// is taken, the farthest places first:
//     release the corners of a quad that is off may move again, if they were pinned;
//     draw    the nearest corner of the nearest quad goes to the place and is pinned there; one of a border only to
//             vertices of the surface's border;
//     open    the nearest vertex becomes two with a new quad between them, one of them at the place (refine.h);
//     widen   the same, but the new vertex goes half way from the old one and is not pinned;
//     divide  the quads around the nearest vertex become three each (refine.h), then as draw;
//     close   the quad closes along a diagonal (coarsen.h): it lies across a fold, or in a tangle.
// A step moves only vertices within a few quads of its place, so that places far from each other are judged apart: a
// step stays where the misses around it shrink (the sum of d^2 - tolerance^2 over its samples) and no corner turns
// over (against the mean normal of the surface there; on crumpled surfaces that cannot be had everywhere, see
// most_folds), otherwise it is taken back and the next one tried. So the mesh never gets worse, and it stays a mesh of
// quads with its Euler characteristic. Cost: O(n + faces) for every round of steps, mostly one or two dozen of them.
#pragma once
#include "remesh/constants.h"
#include "remesh/quad_distance.h"

namespace hf_inner {

struct FitOptions {
  double edge_length = 0, tolerance = 0;  // inner units
  std::int32_t most_folds = 0;            // corners that a step may turn over where it removes half of the miss or more
  std::int32_t relax_rings = fit_rings;   // rings of quads around a step that move with it
  Progress* progress = nullptr;
};

// Returns how far the mesh and the surface are from each other then.
double fit_quads(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh, const FitOptions& options,
                 Memory& memory);

}  // namespace hf_inner
