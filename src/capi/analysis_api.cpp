// Implements hf/analysis.h: levels, iso-lines, critical points, geodesic distance, extremities.
#include <algorithm>
#include <limits>

#include "capi/objects.h"
#include "capi/vertex_writer.h"
#include "field/critical_points.h"
#include "field/distances.h"
#include "field/extremities.h"
#include "field/intake.h"
#include "field/isolines.h"
#include "field/scalars.h"
#include "hf/analysis.h"

namespace hf_inner::capi {
namespace {

struct GeodesicsObject final : Object {
  static constexpr Kind kind_of = Kind::geodesics;
  GeodesicsObject(const surface::Surface& surface, const field::DistanceOptions& options,
                  std::shared_ptr<ProgressObject> calls)
      : Object(kind_of, surface.geometry().memory),
        progress(std::move(calls)),
        distances(surface, options.method, options.smoothing) {}
  std::shared_ptr<ProgressObject> progress;  // of every call, or null
  field::Distances distances;
};

void distance(hf_geodesics handle, std::uint32_t count, const std::uint32_t* vertices,
              const hf_array_out* out_distances) {
  const auto object = get<GeodesicsObject>(handle, "geodesics");
  require(out_distances, "out_distances");
  require_list(count, vertices, "source_count", "sources");
  const Reading reading(*object);
  const surface::Geometry& shape = object->distances.geometry();
  const Rows out = need_reals(out_distances, 1, shape.mesh.report.vertex_count, "vertices", "out_distances");
  const Vector<std::int32_t> sources = field::read_source_vertices(shape.mesh, count, vertices, *shape.memory);
  surface::Workspace field(shape.workspaces, static_cast<std::size_t>(shape.mesh.vertex_count()));
  with_progress(object->progress, [&] { object->distances.solve(sources, field.data()); });
  const double scale = shape.mesh.scale;
  write_vertices(
      shape, 1, out, [](const mesh::Mesh::Isolated&, double* values) { values[0] = -1; },
      [&](std::size_t v, double* values) { values[0] = field[v] < 0 ? -1 : scale * field[v]; });
}

void find_path(const GeodesicsObject& object, const hf_place* from, const hf_place* to, hf_path* inout_path) {
  hf_path out = read_struct(inout_path, "inout_path");
  require_zero(out.reserved);
  const surface::Geometry& shape = object.distances.geometry();
  Memory& memory = *shape.memory;
  mesh::SurfacePlace first, last;
  const mesh::SurfacePath path = object.distances.with_sides([&](const mesh::TriangleSides& sides) {
    const field::PointOnSurface begin = field::point_on_surface(sides, from, "from", 0, memory);
    const field::PointOnSurface end = field::point_on_surface(sides, to, "to", 1, memory);
    first = begin.place;
    last = end.place;
    return with_progress(object.progress, [&] { return mesh::shortest_path(sides, begin.point, end.point, memory); });
  });
  out.point_count = static_cast<std::uint32_t>(path.points.size());
  out.length = path.points.empty() ? -1 : shape.mesh.scale * path.length;
  write_struct(inout_path, out);
  check_capacity(out.point_edges || out.parameters || out.positions, out.point_capacity, out.point_count,
                 "point_capacity");
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const mesh::PathPoint& point = path.points[i];
    if (out.point_edges) {
      out.point_edges[2 * i] = mesh::given_vertex(shape.mesh, point.a);
      out.point_edges[2 * i + 1] = mesh::given_vertex(shape.mesh, point.b);
    }
    if (out.parameters) out.parameters[i] = point.t;
    if (!out.positions) continue;
    const Vec3 p =
        point.a >= 0 ? mesh::position_of(shape.mesh, point) : mesh::position_of(shape.mesh, i == 0 ? first : last);
    put(p, out.positions + 3 * i);
  }
}

void log_map(const GeodesicsObject& object, const hf_place* centre, double radius, double* out_map, double* out_frame) {
  require(out_map, "out_map");
  const surface::Geometry& shape = object.distances.geometry();
  const double reach = field::read_map_radius(shape.mesh, radius);
  const double scale = shape.mesh.scale;
  surface::Workspace map(shape.workspaces, 2 * static_cast<std::size_t>(shape.mesh.vertex_count()));
  Vec3 frame[2];
  object.distances.with_sides([&](const mesh::TriangleSides& sides) {
    const field::PointOnSurface from = field::point_on_surface(sides, centre, "centre", 0, *shape.memory);
    with_progress(object.progress, [&] { object.distances.log_map(sides, from.point, reach, map.data(), frame); });
    return 0;
  });
  write_vertices(
      shape, 2, Rows(out_map, 2 * sizeof(double)),
      [](const mesh::Mesh::Isolated&, double* values) {
        values[0] = values[1] = std::numeric_limits<double>::quiet_NaN();
      },
      [&](std::size_t v, double* values) {
        values[0] = scale * map[2 * v];
        values[1] = scale * map[2 * v + 1];
      });
  if (out_frame) {
    put(frame[0], out_frame);
    put(frame[1], out_frame + 3);
  }
}

field::Extremities search(const std::shared_ptr<const surface::Core>& core, const hf_extremities_desc& desc) {
  const double least = desc.least_length_share;
  if (desc.kind == HF_EXTREMITIES_POISSON) return field::poisson_extremities(*core, least);
  const std::int32_t sources = static_cast<std::int32_t>(desc.source_count);
  if (!desc.geodesics) return field::geodesic_extremities(core, field::default_smoothing, sources, least);
  const auto object = get<GeodesicsObject>(desc.geodesics, "desc->geodesics");
  const Reading reading(*object);
  if (&object->distances.geometry() != core->geometry.get())
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "desc->geodesics belongs to another surface; make it on this surface");
  if (const field::Geodesics* heat = object->distances.heat())
    return field::geodesic_extremities(*heat, sources, least);
  return field::geodesic_extremities(core, field::default_smoothing, sources, least);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_space_levels(hf_surface handle, const hf_array* field, int32_t spacing, uint32_t level_count,
                                  double* out_levels) {
  return guarded("hf_surface_space_levels", [&] {
    const auto surface = mesh_surface(handle, "levels");
    const field::LevelSpacing steps = field::read_spacing(spacing, level_count);
    require(out_levels, "out_levels");
    const surface::Geometry& shape = surface->surface.geometry().unlinked();
    const Vector<double> values = field::read_scalars(shape, field);
    Vector<double> levels(level_count, shape.memory.get());
    field::space_levels(shape.mesh, values, steps, levels, *shape.memory);
    std::copy(levels.begin(), levels.end(), out_levels);
  });
}

hf_result hf_surface_trace_isolines(hf_surface handle, const hf_array* given, uint32_t level_count,
                                    const double* levels, hf_isolines* inout_lines) {
  return guarded("hf_surface_trace_isolines", [&] {
    const auto surface = mesh_surface(handle, "iso-lines");
    hf_isolines out = read_struct(inout_lines, "inout_lines");
    require_zero(out.reserved);
    require_list(level_count, levels, "level_count", "levels");
    const surface::Geometry& shape = surface->surface.geometry().unlinked();
    const Vector<double> field = field::read_scalars(shape, given);
    const field::Isolines lines = field::trace_isolines(shape.mesh, shape.topology(), field,
                                                        Span<const double>(levels, level_count), *shape.memory);
    out.point_count = static_cast<std::uint32_t>(lines.points.size());
    out.line_count = lines.line_count();
    write_struct(inout_lines, out);
    const bool points = out.point_edges || out.parameters || out.positions;
    const bool per_line = out.line_starts || out.line_levels || out.line_closed;
    check_capacity(points, out.point_capacity, out.point_count, "point_capacity");
    check_capacity(per_line, out.line_capacity, out.line_count, "line_capacity");
    for (std::size_t i = 0; i < lines.points.size(); ++i) {
      const field::Isolines::Point& point = lines.points[i];
      if (out.point_edges) {
        out.point_edges[2 * i] = mesh::given_vertex(shape.mesh, point.a);
        out.point_edges[2 * i + 1] = mesh::given_vertex(shape.mesh, point.b);
      }
      if (out.parameters) out.parameters[i] = point.t;
      if (out.positions) {
        put(field::position_of(shape.mesh, point), out.positions + 3 * i);
      }
    }
    for (std::size_t l = 0; l < lines.level.size(); ++l) {
      if (out.line_starts) out.line_starts[l] = lines.start[l];
      if (out.line_levels) out.line_levels[l] = lines.level[l];
      if (out.line_closed) out.line_closed[l] = lines.closed[l];
    }
    if (out.line_starts) out.line_starts[lines.level.size()] = lines.start.back();
  });
}

hf_result hf_surface_find_critical_points(hf_surface handle, const hf_array* given, uint32_t capacity,
                                          hf_critical_point* out_points, hf_critical_info* out_info) {
  return guarded("hf_surface_find_critical_points", [&] {
    const auto surface = mesh_surface(handle, "critical points");
    require_either(out_points, out_info, "out_points and out_info");
    if (out_info) check_struct(out_info, "out_info");
    const surface::Geometry& shape = surface->surface.geometry().unlinked();
    const Vector<double> field = field::read_scalars(shape, given);
    const field::CriticalPoints found = field::find_critical_points(shape.mesh, shape.topology(), field, *shape.memory);
    hf_critical_info info{};
    info.point_count = static_cast<std::uint32_t>(found.points.size());
    info.minimum_count = found.minima;
    info.maximum_count = found.maxima;
    info.saddle_count = found.saddles;
    info.index_sum = found.index_sum;
    info.euler_characteristic = found.euler_characteristic;
    if (out_info) write_struct(out_info, info);
    check_capacity(out_points, capacity, info.point_count, "capacity");
    for (std::size_t i = 0; out_points && i < found.points.size(); ++i) {
      const field::CriticalPoint& point = found.points[i];
      const std::size_t v = static_cast<std::size_t>(point.vertex);
      out_points[i] = {mesh::given_vertex(shape.mesh, point.vertex), static_cast<std::int32_t>(point.kind), point.index,
                       static_cast<std::uint32_t>(shape.mesh.component[v]), field[v]};
    }
  });
}

hf_result hf_geodesics_create(hf_surface surface, const hf_geodesics_desc* given, hf_geodesics* out_geodesics) {
  return create("hf_geodesics_create", out_geodesics, "out_geodesics", [&] {
    const auto object = mesh_surface(surface, "geodesic distances");
    const hf_geodesics_desc desc = read_optional(given, "desc");
    const field::DistanceOptions options = field::read_geodesics(desc);
    const std::shared_ptr<ProgressObject> progress = progress_of(desc.progress);
    return with_progress(progress, [&] {
      auto made = make_owner_in<GeodesicsObject>(object->memory, object->surface, options, progress);
      report(1);
      return made;
    });
  });
}

void hf_geodesics_destroy(hf_geodesics geodesics) { destroy<GeodesicsObject>(geodesics); }

hf_result hf_geodesics_solve(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources,
                             const hf_array_out* out_distances) {
  return guarded("hf_geodesics_solve", [&] { distance(geodesics, source_count, sources, out_distances); });
}

hf_result hf_geodesics_find_path(hf_geodesics geodesics, const hf_place* from, const hf_place* to,
                                 hf_path* inout_path) {
  return guarded("hf_geodesics_find_path", [&] {
    const auto object = get<GeodesicsObject>(geodesics, "geodesics");
    const Reading reading(*object);
    find_path(*object, from, to, inout_path);
  });
}

hf_result hf_geodesics_get_map(hf_geodesics geodesics, const hf_place* centre, double radius, double* out_map,
                               double* out_frame) {
  return guarded("hf_geodesics_get_map", [&] {
    const auto object = get<GeodesicsObject>(geodesics, "geodesics");
    const Reading reading(*object);
    log_map(*object, centre, radius, out_map, out_frame);
  });
}

hf_result hf_surface_find_extremities(hf_surface handle, const hf_extremities_desc* given, uint32_t capacity,
                                      hf_extremity* out_extremities, uint32_t* out_count) {
  return guarded("hf_surface_find_extremities", [&] {
    const std::shared_ptr<const surface::Core> shared = unlinked_core(handle, "extremities");
    const hf_extremities_desc desc = field::read_extremities(read_optional(given, "desc"));
    require_either(out_extremities, out_count, "out_extremities and out_count");
    const surface::Core& core = *shared;
    const field::Extremities found = with_progress(desc.progress, [&] { return search(shared, desc); });
    const std::uint32_t count = static_cast<std::uint32_t>(found.points.size());
    write_count(out_count, count);
    check_capacity(out_extremities, capacity, count, "capacity");
    const double scale = core.mesh.scale;
    for (std::uint32_t i = 0; out_extremities && i < count; ++i) {
      const field::Extremity& point = found.points[i];
      hf_extremity& out = out_extremities[i];
      out.vertex = mesh::given_vertex(core.mesh, point.vertex);
      out.component = static_cast<std::uint32_t>(point.component);
      out.length = scale * point.length;
      put(core.mesh.to_given(core.mesh.positions[static_cast<std::size_t>(point.vertex)]), out.position);
    }
    if (desc.out_field) {
      const double unit = desc.kind == HF_EXTREMITIES_POISSON ? scale * scale : scale;
      write_vertices(core, 1, Rows(desc.out_field, sizeof(double)), nullptr,
                     [&](std::size_t v, double* values) { values[0] = unit * found.field[v]; });
    }
  });
}

}  // extern "C"
