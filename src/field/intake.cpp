#include "field/intake.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "mesh/vertex_lists.h"
#include "surface/surface_intake.h"

namespace hf_inner::field {
namespace {

// Two corrections of a preview are enough for a well-posed system.
constexpr std::uint32_t most_corrections = 8;
// Most sites of a solver or a direction field unless the caller says so: bounds the memory of a runaway host.
constexpr std::uint32_t default_site_limit = 100000;
// Bounds the memory that a wrong count of levels could ask for.
constexpr std::uint32_t most_levels = 1000000;
// The accepted range of the smoothing catches wrong units. On a sphere of 20,000 vertices the mean error is 1.2 % of
// the longest distance at 0.1. At 1 it is 0.4 %, and from 100 on 0.1 %.
constexpr double least_smoothing = 0.1, most_smoothing = 1e4;
// Least length of extremities, as a share of the box diagonal: trades short limbs for bumps. The bound catches wrong
// units.
constexpr double default_least_length = 0.05, most_least_length = 10;
// Sources of the mean distance: more find tips more exactly and take longer. With 20 a cow has other tips, with 80 the
// same.
constexpr std::uint32_t default_sources = 40, most_sources = 1000;

mesh::Places read_places(const hf_sites_desc& desc) {
  if (desc.site_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "site_count is 0");
  return {desc.site_count, desc.vertices, desc.places, desc.points};
}

void check_vertex_value(double value, std::uint32_t vertex, const char* name) {
  if (!std::isfinite(value)) fail(HF_ERROR_NON_FINITE, vertex, "%s of vertex %u is not finite", name, vertex);
  if (std::fabs(value) > solve::largest_value)
    fail(HF_ERROR_TOO_LARGE, vertex, "%s of vertex %u is %g; the limit is %g", name, vertex, value,
         solve::largest_value);
}

}  // namespace

SolverOptions read_solver_options(const hf_solver_desc& desc) {
  SolverOptions options;
  options.field_kind = surface::read_field_kind(desc.field_kind);
  options.channels =
      static_cast<std::int32_t>(count_of(desc.channel_count, 1, 1, solve::most_channels, "channel_count"));
  options.site_limit = read_site_limit(desc.site_limit);
  return options;
}

void read_addition(const hf_sites_desc& desc, FieldEdit& edit) {
  edit.add = read_places(desc);
  edit.add_holds = {desc.values, desc.stiffness, desc.radii};
}

void read_move(std::uint32_t count, const std::uint32_t* sites, const hf_sites_desc& to, FieldEdit& edit) {
  require_list(count, sites, "site_count", "sites");
  if (to.values || to.stiffness || to.radii)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "moving keeps values, stiffness and radius: set them to NULL in the desc");
  edit.move_count = count;
  edit.move_sites = sites;
  edit.move_to = read_places(to);
  if (edit.move_to.count != count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%u sites to move, but %u places", count, edit.move_to.count);
}

ScreeningInput read_screening(const mesh::Mesh& mesh, std::int32_t channels, const double* screening,
                              const double* targets, Memory& memory) {
  for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
    check_vertex_value(screening[v], v, "screening");
    if (screening[v] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, v, "screening of vertex %u is %g; it must not be negative", v, screening[v]);
  }
  const std::size_t m = static_cast<std::size_t>(channels);
  for (std::uint32_t v = 0; targets && v < mesh.report.vertex_count; ++v) {
    for (std::size_t c = 0; c < m; ++c) check_vertex_value(targets[v * m + c], v, "the target");
  }
  ScreeningInput input(memory);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::size_t given = mesh::given_vertex(mesh, v);
    input.strength.push_back(screening[given] * mesh.scale * mesh.scale);
    for (std::size_t c = 0; targets && c < m; ++c) input.target.push_back(targets[given * m + c]);
  }
  return input;
}

std::int32_t read_correction_count(std::uint32_t given) {
  if (given > most_corrections)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "correction_count is %u; it must be 0 to %u", given, most_corrections);
  return static_cast<std::int32_t>(given);
}

std::int32_t read_degree(const hf_direction_desc& desc) {
  if (desc.degree != 0 && desc.degree != 1 && desc.degree != 2 && desc.degree != 4)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "degree is %u; it must be 1, 2 or 4", desc.degree);
  require_zero(desc.reserved);
  return desc.degree ? static_cast<std::int32_t>(desc.degree) : 1;
}

std::uint32_t read_site_limit(std::uint32_t given) noexcept { return given ? given : default_site_limit; }

LevelSpacing read_spacing(std::int32_t given, std::uint32_t level_count) {
  check_choice(given, 3, "spacing");
  if (level_count < 1 || level_count > most_levels)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "level_count is %u; it must be 1 to %u", level_count, most_levels);
  return static_cast<LevelSpacing>(given);
}

DistanceOptions read_geodesics(const hf_geodesics_desc& desc) {
  const double smoothing = desc.smoothing;
  if (smoothing != 0 && !(smoothing >= least_smoothing && smoothing <= most_smoothing))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "smoothing is %g; it must be %g to %g, or 0 for %g", smoothing,
         least_smoothing, most_smoothing, default_smoothing);
  check_choice(desc.method, 4, "method");
  return {static_cast<DistanceMethod>(desc.method), smoothing > 0 ? smoothing : default_smoothing};
}

Vector<std::int32_t> read_source_vertices(const mesh::Mesh& mesh, std::uint32_t count, const std::uint32_t* sources,
                                          Memory& memory) {
  mesh::check_vertex_count(mesh, count, "source_count");
  Vector<std::int32_t> inner(&memory);
  mesh::append_usable(mesh, count, sources, "sources", inner);
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  return inner;
}

PointOnSurface point_on_surface(const mesh::TriangleSides& sides, const hf_place* given, const char* name,
                                std::uint32_t index, Memory& memory) {
  require(given, name);
  const mesh::SurfacePlace place = mesh::read_place(sides.mesh, *given, index, name);
  mesh::GeodesicPoint point(sides, place.vertex, place.weight, memory);
  if (!point.found()) fail(HF_ERROR_INVALID_ARGUMENT, index, "%s: its corners do not belong to one triangle", name);
  return {place, std::move(point)};
}

double read_map_radius(const mesh::Mesh& mesh, double given) {
  if (!std::isfinite(given) || given < 0)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "radius is %g; it must be 0 or above", given);
  return given / mesh.scale;
}

double read_least_length(double given) {
  if (given != 0 && !(given > 0 && given <= most_least_length))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "least_length_share is %g; it is a share of the box diagonal above 0 and up to %g, or 0 for %g", given,
         most_least_length, default_least_length);
  return given > 0 ? given : default_least_length;
}

hf_extremities_desc read_extremities(hf_extremities_desc desc) {
  check_choice(desc.kind, 2, "kind");
  desc.least_length_share = read_least_length(desc.least_length_share);
  desc.source_count = count_of(desc.source_count, default_sources, 1, most_sources, "source_count");
  require_zero(desc.reserved);
  return desc;
}

}  // namespace hf_inner::field
