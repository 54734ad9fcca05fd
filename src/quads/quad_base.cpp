#include <algorithm>
#include <cmath>

#include "quads/counted_quads.h"
#include "quads/feature_crosses.h"
#include "quads/field_quads.h"
#include "quads/opposite_pairs.h"

namespace hf_inner::quads {
namespace {

// field_quads.cpp names the runs of the other values below.

// For at least so many quads, pairs of opposite singularities are left out (opposite_pairs.h). Below, limbs and thin
// parts depend on them. At 500 quads aspects are a twentieth worse on 8 of 18 meshes and better on 2. A bunny of 1,800
// quads is 1.21 instead of 1.04 % of the box away. The crosses have at most 1.2 times the singularities of Instant
// Meshes on 37 instead of 30 of 40 meshes. Numbers between were not tried.
constexpr double paired_below = 3000;
// Radius over which crosses are evened out, in edge lengths of the quads, or of the surface where those are longer. The
// second number is for quads that leave pairs out. Less follows the principal directions, more has fewer singularities.
// First number: half changes means by at most 4 %; at twice the value aspects and angles fall by 5 %, and distances
// grow by 15 %. Second number: from 2.8 to 4 the crosses have at most 1.2 times the singularities of Instant Meshes on
// 36 or 37 of 40 meshes. They are at most 11 degrees off on 31 of 41 meshes, with 4 on 28.
constexpr double smooth_radius = 4, smooth_radius_fine = 3.4;
// Radius in edge lengths over which the curvature is evened out: trades details for calm crosses. Half changes 5 of 15
// runs; distances grow by 4 %. At twice the value irregular vertices fall by 4 % and aspects by 5 %.
constexpr double curvature_radius = 1;
// The limits of its rounds; one evens out over one edge of the surface. With at least 1 there are 7 % more
// singularities; with at least 4, distances grow by 8 %. On six coarse meshes, at most 10 gives 8 % more irregular
// vertices, and at most 40 gives 12 % fewer. Neither changes any of the 15 runs.
constexpr std::int32_t least_passes = 2, most_passes = 20;

}  // namespace

QuadBase::QuadBase(std::shared_ptr<const surface::Core> given)
    : core(std::move(given)),
      surface(remesh::FluxSurface::make(core->mesh, core->topology(), *core->memory)),
      apart(surface, *core->memory),
      area(area_of(surface)),
      curvature(core->memory.get()) {
  const mesh::Topology& topology = core->topology();
  for (Index e = 0; e < topology.edge_count(); ++e)
    mean_edge += norm(core->mesh.positions[at(topology.second(e))] - core->mesh.positions[at(topology.first(e))]);
  mean_edge /= std::max(topology.edge_count(), 1);
}

void QuadBase::prepare(double edge_length, double facet) {
  if (!system) system.emplace(core, 4);
  const bool fine = area >= paired_below * edge_length * edge_length;
  const double length = std::max({edge_length, mean_edge, facet}),
               radius = (fine ? smooth_radius_fine : smooth_radius) * length;
  if (!smoother || smoother->radius() != radius) {
    smoother.reset();
    passes = -1;
    smoother.emplace(*system, radius);
  }
  const double rings = curvature_radius * edge_length / mean_edge;
  const Index wanted = static_cast<Index>(std::min<double>(most_passes, std::max<double>(least_passes, rings * rings)));
  if (passes == wanted) return;
  passes = -1;
  curvature = curvature_crosses(*core, system->connection, wanted);
  if (fine) {
    const remesh::Table<std::uint8_t> borders = find_features(surface, HUGE_VAL, *core->memory);
    const SharpCorners corners = SharpCorners::find(surface, borders, edge_length, *core->memory);
    const Vector<HardCross> hard = feature_crosses(*core, surface, system->connection, borders, corners, wanted);
    leave_out_pairs(surface, *system, *smoother, hard, borders, corners, length, curvature);
  }
  passes = wanted;
}

const remesh::QuadDistance& QuadBase::distance(double spacing) {
  if (!distance_ || spacing_ != spacing) {
    distance_.reset();
    distance_.emplace(surface, spacing, *core->memory, core->jobs.get());
    spacing_ = spacing;
  }
  return *distance_;
}

}  // namespace hf_inner::quads
