#include "field/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.h"
#include "base/index.h"

namespace hf_inner::field {
namespace {

constexpr double full_turn = 6.28318530717958647692;

}  // namespace

Distances::Distances(const surface::Surface& surface, DistanceMethod method, double smoothing)
    : geometry_(surface.unlinked_geometry()) {
  const surface::Geometry& g = *geometry_;
  if (method == DistanceMethod::automatic)
    method = g.mesh.vertex_count() <= most_exact_vertices ? DistanceMethod::exact : DistanceMethod::front;
  if (method == DistanceMethod::heat) heat_.emplace(surface.unlinked_core(), smoothing);
  if (method == DistanceMethod::exact) sides_.emplace(g.mesh, g.topology(), *g.memory);
  if (method == DistanceMethod::front) front_.emplace(g.mesh, g.topology(), *g.memory, g.jobs.get());
}

void Distances::solve(Span<const Index> sources, double* out) const {
  if (heat_) return heat_->distance(sources, out);
  if (front_) {
    front_->distance(sources, out);
  } else {
    const mesh::ExactDistance exact = mesh::exact_distance(*sides_, sources, *geometry_->memory);
    std::copy(exact.distance.begin(), exact.distance.end(), out);
  }
  for (Index v = 0; v < geometry_->mesh.vertex_count(); ++v) {
    if (std::isinf(out[v])) out[v] = -1;
  }
}

void Distances::log_map(const mesh::TriangleSides& sides, const mesh::GeodesicPoint& from, double reach, double* out,
                        Vec3 frame[2]) const {
  const mesh::Mesh& mesh = geometry_->mesh;
  mesh::ExactTask task;
  task.from = &from;
  task.directions = true;
  task.reach = reach;
  const mesh::ExactDistance found = mesh::exact_distance(sides, task, *geometry_->memory);
  // Around a vertex that is no flat place the angles are scaled to 2 pi in all.
  const double scale = found.closed_fan && from.vertex >= 0 ? full_turn / found.fan_angle : 1.0;
  for (std::size_t v = 0; v < found.distance.size(); ++v) {
    const double d = found.distance[v], angle = scale * found.direction[v];
    const bool reached = !std::isinf(d);
    out[2 * v] = reached ? d * cosine(angle) : std::numeric_limits<double>::quiet_NaN();
    out[2 * v + 1] = reached ? d * sine(angle) : std::numeric_limits<double>::quiet_NaN();
  }
  const Index* corner = mesh.triangle(found.first_triangle);
  const bool at_vertex = from.vertex >= 0;
  const Vec3 origin = mesh.positions[at(at_vertex ? from.vertex : corner[0])];
  const Vec3 x = mesh.positions[at(at_vertex ? found.first_corner : corner[1])] - origin;
  Index third = corner[2];
  for (int k = 0; k < 3 && at_vertex; ++k) {
    if (corner[k] != from.vertex && corner[k] != found.first_corner) third = corner[k];
  }
  const Vec3 z = cross(x, mesh.positions[at(third)] - origin);
  frame[0] = unit_vector(x);
  frame[1] = unit_vector(cross(z, x));
}

}  // namespace hf_inner::field
