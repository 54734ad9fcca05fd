// Extremities of a surface: the tips of what protrudes, as proposals for sites and handles.
//
// Poisson: K u = M (1 - s). Every point is a source of its own area, and a ring s around the middle of the component
// takes it all in. The flow out of a limb makes u a maximum at its tip. Down a limb of any constant girth u falls by
// (length)^2 / 2, wherever the ring is. So sqrt(2 persistence) is the length of the limb, and numbering, remeshing and
// pose do not change the list. The ring is half way, in edges, from the vertex farthest from the centroid to the other
// end of the shape. A point instead of a ring would raise the field behind it and blur the lengths. Cost: one solve.
//
// Geodesic: the mean geodesic distance to the rest of the component (Hilaga, Shinagawa, Kohmura and Kunii 2001), by the
// heat method. A tip's persistence is the length of its limb times the share of the surface behind it, less the share
// at the tip.
//
// Persistence (peaks.h) is how far u falls before it rises to something higher. One finger of a hand counts as the arm,
// the others as fingers. Proposals are sorted by that length, the longest first. The highest point of a component falls
// to the mean level, or to the deepest saddle between proposals.
#pragma once
#include <memory>

#include "base/progress.h"
#include "field/geodesics.h"

namespace hf_inner {

struct Extremity {
  std::int32_t vertex;  // inner
  std::int32_t component;
  double length;  // of the protrusion, in units of the inner mesh (box diagonal 1)
};

struct Extremities {
  explicit Extremities(Memory& memory) : points(&memory), field(&memory) {}
  Vector<Extremity> points;
  Vector<double> field;  // of every inner vertex, what the points are the maxima of
};

// Throws HF_ERROR_UNSUPPORTED when the core's factor is not that of a Laplacian.
Extremities poisson_extremities(const Core& core, double least_length);
Extremities geodesic_extremities(const Geodesics& geodesics, std::int32_t source_count, double least_length);
// The same on distances that are made for it; smoothing: see Geodesics.
Extremities geodesic_extremities(std::shared_ptr<const Core> core, double smoothing, std::int32_t source_count,
                                 double least_length);

}  // namespace hf_inner
