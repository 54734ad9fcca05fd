// Geodesic distance by the heat method (Crane, Weischedel and Wardetzky 2013) on two factors of one ordering.
//
//     (M + t K) v = sources         the heat after a short time, t = smoothing h^2
//     X = -grad v / |grad v|        by triangle
//     K d = integral of X . grad    the distance, up to a constant by component
//
// h is the mean length of the edges. K's factor is the core's own; that of M + t K shares its ordering and analysis. t
// is at least (box diagonal / 250)^2, so that a double can hold the heat at the far end of a large mesh.
//
// The average over many sources needs one solve for d only, because X adds up. The heat of eight sources takes one
// backward sweep; their forward part is short paths.
#pragma once
#include <memory>

#include "base/progress.h"
#include "engine/core.h"
#include "field/directions.h"

namespace hf_inner {

// Throws HF_ERROR_UNSUPPORTED when the core does not hold the factor of a Laplacian (bi-harmonic ones do not).
void require_laplacian(const Core& core);

class Geodesics {
 public:
  // One numeric factorisation. Throws as require_laplacian.
  Geodesics(std::shared_ptr<const Core> core, double smoothing);

  // Distance to the nearest of the sources (inner vertices, at least one), in units of the inner mesh (diagonal 1): 0
  // at the sources, never negative; -1 in components without a source.
  void distance(Span<const std::int32_t> sources, double* out) const;

  // Mean over each component of the distance to its points, up to a constant by component. Takes `count` sources per
  // component by farthest point sampling, each weighted with the area nearest to it. progress: null, or told the share
  // done between `from` and `to`.
  void average(std::int32_t count, double* out) const;

  const Core& core() const noexcept { return *core_; }
  double time_step() const noexcept { return step_; }

 private:
  void make_frames();
  void add_directions(const double* heat, std::int32_t channels, const double* weights, Vector<double>& sums) const;
  void integrate(const Vector<double>& sums, double* out) const;

  std::shared_ptr<const Core> core_;
  Vector<TriangleFrame> frames_;  // of the triangles with area, neighbours in the factor near one another
  double step_ = 0;
  std::shared_ptr<const Factor> heat_;
};

}  // namespace hf_inner
