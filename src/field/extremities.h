// Finds the extremities of a surface: tips of protruding parts, which are proposals for sites and handles.
//
// The Poisson kind solves K u = M (1 - s), with M the vertex areas. Every vertex is a source of its own area. A ring of
// vertices around the middle of the component is the sink, which s describes: it takes in what all sources give. So u
// rises out along a limb and is largest at its tip. Along a limb of constant girth, u differs by (length)^2 / 2 between
// root and tip, wherever the ring is. So sqrt(2 persistence) is the length of the limb. Numbering, remeshing and pose
// do not change the list. The ring lies half way, in edges, from the vertex farthest from the centroid to the other end
// of the shape. A single vertex instead of the ring would raise the field behind it and blur the lengths. Cost: one
// solve.
//
// The geodesic kind uses the mean geodesic distance to the rest of the component (Hilaga, Shinagawa, Kohmura and Kunii
// 2001), which the heat method computes. The persistence of a tip is the length of its limb times a difference of two
// shares of the surface. The difference is the share behind the limb less the share at the tip.
//
// The persistence of a peak (peaks.h) is how far u falls on the way to a higher point. So one finger of a hand has the
// length of the arm, and the other fingers have their own lengths. The list is sorted by length, the longest first. For
// the highest point of a component, u falls to its mean, or to the deepest saddle between proposals.
#pragma once
#include <memory>

#include "base/progress.h"
#include "field/geodesics.h"

namespace hf_inner::field {

struct Extremity {
  std::int32_t vertex;  // inner
  std::int32_t component;
  double length;  // of the protrusion, in units of the inner mesh (box diagonal 1)
};

struct Extremities {
  explicit Extremities(Memory& memory) : points(&memory), field(&memory) {}
  Vector<Extremity> points;
  Vector<double> field;  // by inner vertex; the points are its maxima
};

// Find the tips by the Poisson field, or by mean geodesic distances. The core is harmonic and
// has its factor.
Extremities poisson_extremities(const surface::Core& core, double least_length_share);
Extremities geodesic_extremities(const Geodesics& geodesics, std::int32_t source_count, double least_length_share);
// The same, but makes the geodesics itself, with that smoothing.
Extremities geodesic_extremities(std::shared_ptr<const surface::Core> core, double smoothing, std::int32_t source_count,
                                 double least_length_share);

}  // namespace hf_inner::field
