// hf/analysis.h: levels, iso-lines, critical points, geodesic distance, extremities.
#include <algorithm>
#include <cmath>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/scalars.h"
#include "capi/scatter.h"
#include "field/critical_points.h"
#include "field/extremities.h"
#include "field/geodesics.h"
#include "field/isolines.h"
#include "field/levels.h"
#include "hf/analysis.h"

namespace hf_inner::capi {
namespace {

struct GeodesicsObject final : Object {
  GeodesicsObject(std::shared_ptr<const Core> core, double smoothing)
      : Object(Kind::geodesics), memory(core->memory), geodesics(std::move(core), smoothing) {}
  std::shared_ptr<Memory> memory;  // outlives what follows
  Geodesics geodesics;
};

std::uint32_t given_vertex(const Mesh& mesh, std::int32_t inner) {
  return static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(inner)]);
}

void write_isolines(const Mesh& mesh, const Isolines& lines, const hf_isolines& out) {
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    const Isolines::Point& point = lines.points[i];
    if (out.point_edges) {
      out.point_edges[2 * i] = given_vertex(mesh, point.a);
      out.point_edges[2 * i + 1] = given_vertex(mesh, point.b);
    }
    if (out.parameters) out.parameters[i] = point.t;
    if (out.positions) {
      const Vec3 p = (1 - point.t) * mesh.positions[static_cast<std::size_t>(point.a)] +
                     point.t * mesh.positions[static_cast<std::size_t>(point.b)];
      put(mesh.to_given(p), out.positions + 3 * i);
    }
  }
  for (std::size_t l = 0; l < lines.level.size(); ++l) {
    if (out.line_starts) out.line_starts[l] = lines.start[l];
    if (out.line_levels) out.line_levels[l] = lines.level[l];
    if (out.line_closed) out.line_closed[l] = lines.closed[l];
  }
  if (out.line_starts) out.line_starts[lines.level.size()] = lines.start.back();
}

void trace(hf_solver handle, const hf_scalars* given, std::uint32_t level_count, const double* levels,
           hf_isolines* out_lines) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  hf_isolines out = read_struct(out_lines, "out_lines");
  if (out.reserved != 0) fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "out_lines: reserved must be 0");
  if (level_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "level_count is 0");
  require(levels, "levels");
  const Reading reading(*solver);
  const Core& core = solver->field.core();
  const Vector<double> field = read_scalars(core, given);
  for (std::uint32_t k = 0; k < level_count; ++k) {
    if (!std::isfinite(levels[k])) fail(HF_ERROR_NON_FINITE, k, "levels[%u] is not finite", k);
  }
  const Isolines lines =
      trace_isolines(core.mesh, core.topology, field, Span<const double>(levels, level_count), *core.memory);
  out.point_count = static_cast<std::uint32_t>(lines.points.size()), out.line_count = lines.line_count();
  write_struct(out_lines, out);
  const bool points = out.point_edges || out.parameters || out.positions;
  const bool per_line = out.line_starts || out.line_levels || out.line_closed;
  if ((points && out.point_capacity < out.point_count) || (per_line && out.line_capacity < out.line_count)) {
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "the lines have %u points in %u lines; the arrays hold %u and %u",
         out.point_count, out.line_count, out.point_capacity, out.line_capacity);
  }
  write_isolines(core.mesh, lines, out);
}

void find_critical(hf_solver handle, const hf_scalars* given, std::uint32_t capacity, hf_critical_point* out_points,
                   hf_critical_info* out_info) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  if (!out_points && !out_info) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_points and out_info are both NULL");
  if (out_info) check_struct(out_info, "out_info");
  const Reading reading(*solver);
  const Core& core = solver->field.core();
  const Vector<double> field = read_scalars(core, given);
  const CriticalPoints found = find_critical_points(core.mesh, core.topology, field, *core.memory);
  hf_critical_info info{};
  info.point_count = static_cast<std::uint32_t>(found.points.size());
  info.minimum_count = found.minima, info.maximum_count = found.maxima, info.saddle_count = found.saddles;
  info.index_sum = found.index_sum, info.euler_characteristic = found.euler_characteristic;
  if (out_info) write_struct(out_info, info);
  if (!out_points) return;
  if (capacity < info.point_count)
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "capacity is %u; there are %u critical points", capacity, info.point_count);
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const CriticalPoint& point = found.points[i];
    const std::size_t v = static_cast<std::size_t>(point.vertex);
    out_points[i] = {given_vertex(core.mesh, point.vertex), static_cast<std::int32_t>(point.kind), point.index,
                     static_cast<std::uint32_t>(core.mesh.component[v]), field[v]};
  }
}

void distance(hf_geodesics handle, std::uint32_t count, const std::uint32_t* vertices, float* f32, double* f64,
              std::uint32_t value_stride) {
  const auto object = get<GeodesicsObject>(handle, Kind::geodesics, "geodesics");
  if (!f32 && !f64) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_distances is NULL");
  if (count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "source_count is 0");
  require(vertices, "sources");
  const Reading reading(*object);
  const Core& core = object->geodesics.core();
  if (count > core.mesh.report.vertex_count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u sources; the mesh has %u vertices", count, core.mesh.report.vertex_count);
  const Rows out = f64 ? Rows(f64, stride_of(value_stride, sizeof(double), "value_stride"))
                       : Rows(f32, stride_of(value_stride, sizeof(float), "value_stride"));
  Vector<std::int32_t> sources(core.memory.get());
  append_inner(core.mesh, count, vertices, "sources", sources);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (sources[i] == Mesh::none)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "entry %u of sources: vertex %u is in no usable triangle", i, vertices[i]);
  }
  std::sort(sources.begin(), sources.end());
  sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
  Workspace field(core.workspaces, static_cast<std::size_t>(core.size()));
  object->geodesics.distance(sources, field.data());
  const double scale = core.mesh.scale;
  scatter(
      core, 1, out, [](const Mesh::Isolated&, double* values) { values[0] = -1; },
      [&](std::size_t v, double* values) { values[0] = field[v] < 0 ? -1 : scale * field[v]; });
}

// A copy of the desc with the defaults filled in.
hf_extremities_desc read_extremities(const hf_extremities_desc* given) {
  hf_extremities_desc desc{};
  if (given) desc = read_struct(given, "desc");
  check_choice(desc.kind, 2, "kind");
  if (desc.least_length != 0 && !(desc.least_length > 0 && desc.least_length <= 10))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "least_length is %g; it is a share of the box diagonal above 0 and up to 10, or 0 for 0.05",
         static_cast<double>(desc.least_length));
  if (!(desc.least_length > 0)) desc.least_length = 0.05f;
  desc.source_count = count_of(desc.source_count, 40, 1, 1000, "source_count");
  return desc;
}

Extremities search(const std::shared_ptr<const Core>& core, const hf_extremities_desc& desc, Progress* progress) {
  const double least = static_cast<double>(desc.least_length);
  if (desc.kind == HF_EXTREMITIES_POISSON) return poisson_extremities(*core, least, progress);
  const std::int32_t sources = static_cast<std::int32_t>(desc.source_count);
  if (!desc.geodesics) {
    const Geodesics geodesics(core, 1.0);
    report(progress, 0.3f);
    return geodesic_extremities(geodesics, sources, least, progress);
  }
  const auto object = get<GeodesicsObject>(desc.geodesics, Kind::geodesics, "desc->geodesics");
  const Reading reading(*object);
  if (&object->geodesics.core() != core.get())
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "desc->geodesics belongs to another surface; make it from this solver or a clone of it");
  return geodesic_extremities(object->geodesics, sources, least, progress);
}

void find_extremities(hf_solver handle, const hf_extremities_desc* given, std::uint32_t capacity,
                      hf_extremity* out_extremities, std::uint32_t* out_count) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  const hf_extremities_desc desc = read_extremities(given);
  if (!out_extremities && !out_count)
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_extremities and out_count are both NULL");
  std::shared_ptr<ProgressObject> progress;
  if (desc.progress) progress = get<ProgressObject>(desc.progress, Kind::progress, "progress");
  const Reading reading(*solver);
  const std::shared_ptr<const Core>& shared = solver->field.shared_core();
  const Core& core = *shared;
  Extremities found(*core.memory);
  try {
    found = search(shared, desc, progress ? &progress->progress : nullptr);
  } catch (const Error& error) {
    if (error.code() == HF_ERROR_CANCELLED && progress) progress->progress.reset();  // one cancel stops one call
    throw;
  }
  const std::uint32_t count = static_cast<std::uint32_t>(found.points.size());
  if (out_count) *out_count = count;
  if (out_extremities && capacity < count)
    fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "capacity is %u; there are %u extremities", capacity, count);
  const double scale = core.mesh.scale;
  for (std::uint32_t i = 0; out_extremities && i < count; ++i) {
    const Extremity& point = found.points[i];
    hf_extremity& out = out_extremities[i];
    out.vertex = given_vertex(core.mesh, point.vertex), out.component = static_cast<std::uint32_t>(point.component);
    out.length = scale * point.length;
    put(core.mesh.to_given(core.mesh.positions[static_cast<std::size_t>(point.vertex)]), out.position);
  }
  if (desc.out_field) {
    const double unit = desc.kind == HF_EXTREMITIES_POISSON ? scale * scale : scale;
    scatter(core, 1, Rows(desc.out_field, sizeof(double)), nullptr,
            [&](std::size_t v, double* values) { values[0] = unit * found.field[v]; });
  }
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_space_levels(hf_solver handle, const hf_scalars* field, int32_t spacing, uint32_t level_count,
                          double* out_levels) {
  return guarded("hf_space_levels", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    check_choice(spacing, 3, "spacing");
    constexpr std::uint32_t most = 1000000;
    if (level_count < 1 || level_count > most)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "level_count is %u; it must be 1 to %u", level_count, most);
    require(out_levels, "out_levels");
    const Reading reading(*solver);
    const Core& core = solver->field.core();
    const Vector<double> values = read_scalars(core, field);
    Vector<double> levels(level_count, core.memory.get());
    space_levels(core.mesh, values, static_cast<LevelSpacing>(spacing), levels, *core.memory);
    std::copy(levels.begin(), levels.end(), out_levels);
  });
}

hf_result hf_trace_isolines(hf_solver solver, const hf_scalars* field, uint32_t level_count, const double* levels,
                            hf_isolines* out_lines) {
  return guarded("hf_trace_isolines", [&] { trace(solver, field, level_count, levels, out_lines); });
}

hf_result hf_find_critical_points(hf_solver solver, const hf_scalars* field, uint32_t capacity,
                                  hf_critical_point* out_points, hf_critical_info* out_info) {
  return guarded("hf_find_critical_points", [&] { find_critical(solver, field, capacity, out_points, out_info); });
}

hf_result hf_geodesics_create(hf_solver handle, const hf_geodesics_desc* given, hf_geodesics* out_geodesics) {
  return guarded("hf_geodesics_create", [&] {
    require(out_geodesics, "out_geodesics");
    *out_geodesics = nullptr;
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    hf_geodesics_desc desc{};
    if (given) desc = read_struct(given, "desc");
    const double smoothing = static_cast<double>(desc.smoothing);
    if (smoothing != 0 && !(smoothing >= 0.1 && smoothing <= 1e4))
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "smoothing is %g; it must be 0.1 to 10000, or 0 for 1", smoothing);
    const Reading reading(*solver);
    *out_geodesics = reinterpret_cast<hf_geodesics>(insert(
        make_owner_in<GeodesicsObject>(solver->memory, solver->field.shared_core(), smoothing > 0 ? smoothing : 1.0)));
  });
}

void hf_geodesics_destroy(hf_geodesics geodesics) {
  const FloatEnvironment environment;
  remove(reinterpret_cast<std::uintptr_t>(geodesics), Kind::geodesics);
}

hf_result hf_geodesics_distance(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources,
                                float* out_distances, uint32_t value_stride) {
  return guarded("hf_geodesics_distance",
                 [&] { distance(geodesics, source_count, sources, out_distances, nullptr, value_stride); });
}

hf_result hf_geodesics_distance_f64(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources,
                                    double* out_distances, uint32_t value_stride) {
  return guarded("hf_geodesics_distance_f64",
                 [&] { distance(geodesics, source_count, sources, nullptr, out_distances, value_stride); });
}

hf_result hf_find_extremities(hf_solver solver, const hf_extremities_desc* desc, uint32_t capacity,
                              hf_extremity* out_extremities, uint32_t* out_count) {
  return guarded("hf_find_extremities", [&] { find_extremities(solver, desc, capacity, out_extremities, out_count); });
}

}  // extern "C"
