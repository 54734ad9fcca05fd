#include "field/distances.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace hf_inner {

Distances::Distances(const Surface& surface, DistanceMethod method, double smoothing)
    : geometry_(surface.unlinked_geometry()) {
  const Geometry& g = *geometry_;
  if (method == DistanceMethod::automatic)
    method = g.mesh.vertex_count() <= most_exact_vertices ? DistanceMethod::exact : DistanceMethod::front;
  if (method == DistanceMethod::heat) heat_.emplace(surface.unlinked_core(), smoothing);
  if (method == DistanceMethod::exact) sides_.emplace(g.mesh, g.topology, *g.memory);
  if (method == DistanceMethod::front) front_.emplace(g.mesh, g.topology, *g.memory, g.jobs.get());
}

void Distances::solve(Span<const Index> sources, double* out) const {
  if (heat_) return heat_->distance(sources, out);
  if (front_) {
    front_->distance(sources, out);
  } else {
    const ExactDistance exact = exact_distance(*sides_, sources, *geometry_->memory);
    std::copy(exact.distance.begin(), exact.distance.end(), out);
  }
  for (Index v = 0; v < geometry_->mesh.vertex_count(); ++v) {
    if (std::isinf(out[v])) out[v] = -1;
  }
}

}  // namespace hf_inner
