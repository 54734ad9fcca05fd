// Computes geodesic distances with the heat method (Crane, Weischedel and Wardetzky 2013). It uses two factors of one
// ordering.
//
//     (M + t K) v = sources         the heat after a short time, t = smoothing h^2
//     X = -grad v / |grad v|        by triangle
//     K d = integral of X . grad    the distance, up to a constant by component
//
// h is the mean edge length, M the vertex areas and K the Laplacian. The core has the factor of K. The factor of M + t
// K uses the same ordering and symbolic analysis. t is at least (box diagonal / 250)^2. With a smaller t the heat at
// the far end of a large mesh would be less than a double can hold.
//
// The average over many sources needs only one solve for d, because the sum of their X is enough. The heat of eight
// sources takes one backward sweep. Their forward part needs only the elimination paths of the sources.
#pragma once
#include <memory>

#include "base/progress.h"
#include "field/directions.h"
#include "surface/core.h"

namespace hf_inner::field {

// Smoothing of the authors of the heat method: one squared mean edge. hf/analysis.h states it.
constexpr double default_smoothing = 1;

class Geodesics {
 public:
  // core: harmonic, with its factor. Costs one numeric factorisation.
  Geodesics(std::shared_ptr<const surface::Core> core, double smoothing);

  // Computes the distance to the nearest source. The sources are at least one welded vertex. The unit is the box
  // diagonal. The distance is 0 at the sources, never negative, and -1 in components without a source.
  void distance(Span<const std::int32_t> sources, double* out) const;

  // Computes for each point its mean distance to all points of its component, up to a constant by component. It takes
  // `count` sources in each component by farthest point sampling. The weight of a source is the area nearest to it.
  void average(std::int32_t count, double* out) const;

  const surface::Core& core() const noexcept { return *core_; }

 private:
  void make_frames();
  void add_directions(const double* heat, std::int32_t channels, const double* weights, Vector<double>& sums) const;
  void integrate(const Vector<double>& sums, double* out) const;

  std::shared_ptr<const surface::Core> core_;
  Vector<TriangleFrame> frames_;  // triangles with area, in the order of their rows in the factor
  std::shared_ptr<const factor::Factor> heat_;
};

}  // namespace hf_inner::field
