// Geodesic distances by the method of the caller's choice. hf/analysis.h states what each is for.
#pragma once
#include <memory>
#include <optional>

#include "field/geodesics.h"
#include "mesh/exact_path.h"
#include "mesh/front_distance.h"
#include "surface/surface.h"

namespace hf_inner::field {

enum class DistanceMethod : std::int32_t { automatic = 0, front = 1, exact = 2, heat = 3 };

// Up to this many vertices `automatic` is exact. It trades time, which grows as n^1.5, against the error of fronts on
// coarse technical shapes: up to 12 % of the diameter. Chosen on all shared meshes. Half the number leaves a shape with
// 133 holes to the fronts, whose mean error there is 1.8 %. Double takes no mesh below the bar of 1 %.
constexpr std::int32_t most_exact_vertices = 10000;

class Distances {
 public:
  // The heat method takes the harmonic factor of the surface and makes one of its own. The others need no factor.
  Distances(const surface::Surface& surface, DistanceMethod method, double smoothing);

  // Writes the distance to the nearest source by inner vertex, -1 where no source reaches. The unit is the box
  // diagonal. The sources are at least one vertex. Reports progress, except for heat.
  void solve(Span<const std::int32_t> sources, double* out) const;

  // The tables of exact paths: its own, or made for the call.
  template <class Work>
  auto with_sides(Work&& work) const {
    if (sides_) return work(*sides_);
    const mesh::TriangleSides made(geometry_->mesh, geometry_->topology(), *geometry_->memory);
    return work(made);
  }

  // Writes two coordinates by inner vertex: the length of the shortest path from a point, in its direction there. NaN
  // beyond `reach` (0: no bound) and where no path leads. frame: the directions of the two axes in space.
  void log_map(const mesh::TriangleSides& sides, const mesh::GeodesicPoint& from, double reach, double* out,
               Vec3 frame[2]) const;

  const surface::Geometry& geometry() const noexcept { return *geometry_; }
  // Returns the tables of the heat method, or null.
  const Geodesics* heat() const noexcept { return heat_ ? &*heat_ : nullptr; }

 private:
  std::shared_ptr<const surface::Geometry> geometry_;
  std::optional<Geodesics> heat_;
  std::optional<mesh::TriangleSides> sides_;
  std::optional<mesh::FrontDistance> front_;
};

}  // namespace hf_inner::field
