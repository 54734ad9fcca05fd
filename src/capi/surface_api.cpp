// Implements hf/surface.h: surfaces, saved factors, picking.
#include <algorithm>
#include <cmath>

#include "capi/boundary.h"
#include "capi/links_in.h"
#include "capi/objects.h"
#include "capi/surface_options.h"
#include "capi/vertex_writer.h"
#include "factor/factor_bytes.h"
#include "factor/ordering.h"
#include "hf/surface.h"
#include "mesh/face_intake.h"
#include "mesh/picking.h"

namespace hf_inner::capi {
namespace {

constexpr std::uint32_t most_threads = 256, default_vertex_limit = 20000000, triangles_per_vertex = 8;
constexpr std::uint32_t default_work_limit_gflop = 100000;

Ordering ordering_of(std::int32_t given) noexcept {
  return given == HF_ORDERING_METIS            ? Ordering::metis
         : given == HF_ORDERING_MINIMUM_DEGREE ? Ordering::minimum_degree
                                               : Ordering::nested_dissection;
}

}  // namespace

hf_surface_info read_info(const hf_surface_desc& desc) {
  hf_surface_info info{};
  check_choice(desc.weld, 3, "weld");
  check_choice(desc.operator_kind, 4, "operator_kind");
  check_choice(desc.field_kind, 3, "field_kind");
  check_choice(desc.ordering, 3, "ordering");
  require_ordering(ordering_of(desc.ordering));
  info.vertex_count = desc.vertex_count, info.triangle_count = desc.triangle_count;
  info.weld = desc.weld, info.weld_tolerance = desc.weld_tolerance;
  info.operator_kind = desc.operator_kind, info.field_kind = desc.field_kind, info.ordering = desc.ordering;
  info.thread_count = count_of(desc.thread_count, 1, 1, most_threads, "thread_count");
  info.vertex_limit = desc.vertex_limit ? desc.vertex_limit : default_vertex_limit;
  info.triangle_limit = desc.triangle_limit, info.memory_limit_mb = desc.memory_limit_mb;
  info.work_limit_gflop = desc.work_limit_gflop ? desc.work_limit_gflop : default_work_limit_gflop;
  info.face_count = desc.face_count, info.corner_count = desc.corner_count;
  require_zero(desc.reserved);
  return info;
}

namespace {

// The faces, or none where triangles are set.
FaceRows read_faces(const hf_surface_desc& desc) {
  FaceRows faces;
  if (desc.face_count == 0) {
    if (desc.face_starts || desc.face_sizes || desc.corners || desc.corner_count)
      fail(HF_ERROR_EMPTY, HF_NO_INDEX, "face_count is 0, but face_starts, face_sizes, corners or corner_count is set");
    return faces;
  }
  if (desc.triangles || desc.triangles_u16 || desc.triangle_count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "triangles and faces are both set; set one");
  require_either(desc.face_starts, desc.face_sizes, "face_starts and face_sizes");
  require(desc.corners, "corners");
  faces.face_count = desc.face_count, faces.corner_count = desc.corner_count;
  faces.starts = desc.face_starts, faces.sizes = desc.face_sizes, faces.corners = desc.corners;
  faces.face_stride = stride_of(desc.face_stride, sizeof(std::uint32_t), "face_stride");
  faces.corner_stride = stride_of(desc.corner_stride, sizeof(std::uint32_t), "corner_stride");
  return faces;
}

MeshInput read_mesh(const hf_surface_desc& desc, const FaceRows& faces) {
  check_one(desc.positions, desc.positions_f64, "positions");
  // An empty mesh is refused as such, by Mesh::make.
  if (desc.vertex_count > 0) require_either(desc.positions, desc.positions_f64, "positions and positions_f64");
  if (desc.triangles && desc.triangles_u16)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "triangles and triangles_u16 are both set; set one");
  if (desc.triangle_count > 0) require_either(desc.triangles, desc.triangles_u16, "triangles and triangles_u16");
  MeshInput input;
  input.faces = faces;
  input.vertex_count = desc.vertex_count, input.triangle_count = desc.triangle_count;
  input.positions = rows_of(desc.positions, desc.positions_f64, 3, desc.position_stride, "position_stride");
  if (desc.triangles)
    input.triangles = {desc.triangles, stride_of(desc.triangle_stride, 3 * sizeof(std::uint32_t), "triangle_stride")};
  else
    input.triangles = {desc.triangles_u16,
                       stride_of(desc.triangle_stride, 3 * sizeof(std::uint16_t), "triangle_stride")};
  input.weld = static_cast<Weld>(desc.weld);
  input.weld_tolerance = static_cast<double>(desc.weld_tolerance);
  return input;
}

}  // namespace

void read_saved_factor(const hf_surface_desc& desc, CoreOptions& options) {
  const hf_factor_desc saved = read_struct(desc.saved_factor, "saved_factor");
  require(saved.bytes, "saved_factor->bytes");
  check_flag(saved.borrow, "saved_factor->borrow");
  if (saved.byte_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "saved_factor->byte_count is 0");
  options.saved_factor = {static_cast<const std::uint8_t*>(saved.bytes), saved.byte_count};
  options.borrow_factor = saved.borrow != 0;
  const Ordering ordering = check_saved_factor(options.saved_factor);
  if (desc.ordering != 0 && options.ordering != ordering)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "ordering is %d, but the saved factor has ordering %d; set it to 0 to take the factor's", desc.ordering,
         static_cast<int>(ordering));
  options.ordering = ordering;
}

namespace {

// The size of the cut, for the limits. Larger ones are refused as that, whatever the limit.
std::uint32_t triangles_of(const FaceRows& faces) {
  const std::uint64_t count = count_cut_triangles(faces);
  return count < HF_NO_INDEX ? static_cast<std::uint32_t>(count) : HF_NO_INDEX;
}

// ---- picking ----

Vec3 read_point(const double* p, const char* name) {
  require(p, name);
  if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "%s is not finite", name);
  return {p[0], p[1], p[2]};
}

PickTarget read_target(const Mesh& mesh, const hf_pick_desc* given) {
  const hf_pick_desc desc = read_optional(given, "desc");
  require_zero(desc.reserved);
  check_flag(desc.front_only, "front_only");
  check_one(desc.positions, desc.positions_f64, "positions");
  return {mesh, rows_of(desc.positions, desc.positions_f64, 3, desc.position_stride, "position_stride"),
          desc.front_only == 1};
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_create(const hf_surface_desc* given, hf_surface* out_surface) {
  return create("hf_surface_create", out_surface, "out_surface", [&] {
    const hf_surface_desc desc = read_struct(given, "desc");
    hf_surface_info info = read_info(desc);
    const FaceRows faces = read_faces(desc);
    if (faces.face_count > 0) info.triangle_count = triangles_of(faces);
    if (info.vertex_count > info.vertex_limit)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u vertices; the vertex_limit is %u", info.vertex_count,
           info.vertex_limit);
    if (info.triangle_limit != 0 && info.triangle_count > info.triangle_limit)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u triangles; the triangle_limit is %u", info.triangle_count,
           info.triangle_limit);
    if (info.triangle_limit == 0 && info.triangle_count / triangles_per_vertex > info.vertex_limit)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
           "%u triangles; without a triangle_limit at most eight per vertex of the vertex_limit %u are taken",
           info.triangle_count, info.vertex_limit);
    const MeshInput input = read_mesh(desc, faces);
    return make_surface(desc, info, [&](const std::shared_ptr<Memory>& memory, std::shared_ptr<JobRunner> jobs) {
      auto geometry = Geometry::make(input, static_cast<OperatorKind>(info.operator_kind), memory, std::move(jobs));
      LinksIn links(memory.get());
      read_links(desc.links, geometry->mesh, links);
      return links.options.mode == LinkMode::none ? geometry : Geometry::linked(std::move(geometry), links.options);
    });
  });
}

void hf_surface_destroy(hf_surface surface) { destroy<SurfaceObject>(surface); }

hf_result hf_surface_get_info(hf_surface surface, hf_surface_info* out_info) {
  return guarded("hf_surface_get_info", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    check_struct(out_info, "out_info");
    write_struct(out_info, object->info);
  });
}

hf_result hf_surface_get_report(hf_surface surface, hf_surface_report* out_report) {
  return guarded("hf_surface_get_report", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    check_struct(out_report, "out_report");
    const MeshReport& found = object->surface.geometry().mesh.report;
    hf_surface_report report{};
    report.vertex_count = found.vertex_count;
    report.triangle_count = found.triangle_count;
    report.welded_vertex_count = found.welded_vertex_count;
    report.component_count = found.component_count;
    report.isolated_vertex_count = found.isolated_vertex_count;
    report.degenerate_triangle_count = found.degenerate_triangle_count;
    report.collapsed_triangle_count = found.collapsed_triangle_count;
    report.duplicate_triangle_count = found.duplicate_triangle_count;
    report.non_manifold_edge_count = found.non_manifold_edge_count;
    report.flipped_edge_count = found.flipped_edge_count;
    report.boundary_edge_count = found.boundary_edge_count;
    report.negative_edge_count = found.negative_edge_count;
    report.smallest_angle = static_cast<float>(found.smallest_angle);
    report.bounding_box_diagonal = found.bounding_box_diagonal;
    const Core& core = object->surface.own();
    report.changed_vertex_count = core.changed_count;
    report.first_changed_vertex = given_vertex(core.mesh, core.first_changed);
    report.piece_count = object->surface.geometry().unlinked().mesh.report.component_count;
    if (const Links* links = object->surface.geometry().links.get()) {
      report.link_count = static_cast<std::uint32_t>(links->links.size());
      report.light_piece_count = static_cast<std::uint32_t>(std::count(links->light.begin(), links->light.end(), 1));
      report.lone_piece_count = static_cast<std::uint32_t>(links->alone_count);
      report.longest_tree_link = core.mesh.scale * links->longest_tree_link;
    } else {
      report.lone_piece_count = report.piece_count > 1 ? report.piece_count : 0;
    }
    const Faces& faces = core.mesh.faces;
    report.face_count = static_cast<std::uint32_t>(faces.given_size.size());
    report.polygon_count = faces.polygon_count, report.non_planar_count = faces.non_planar_count;
    report.largest_face = faces.largest_size;
    write_struct(out_report, report);
  });
}

hf_result hf_surface_get_components(hf_surface surface, uint32_t capacity, uint32_t* out_components,
                                    uint32_t* out_count) {
  return guarded("hf_surface_get_components", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_components, out_count, "out_components and out_count");
    const Mesh& mesh = object->surface.geometry().mesh;
    write_count(out_count, mesh.report.vertex_count);
    check_capacity(out_components, capacity, mesh.report.vertex_count, "capacity");
    for (std::uint32_t v = 0; out_components && v < mesh.report.vertex_count; ++v) {
      const std::int32_t inner = mesh.inner_of_given[v];
      out_components[v] = inner == Mesh::none
                              ? HF_NO_INDEX
                              : static_cast<std::uint32_t>(mesh.component[static_cast<std::size_t>(inner)]);
    }
  });
}

hf_result hf_surface_get_statistics(hf_surface surface, hf_surface_statistics* out_statistics) {
  return guarded("hf_surface_get_statistics", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    check_struct(out_statistics, "out_statistics");
    const Core& core = object->surface.own();
    const FactorStatistics& factor = core.factor->statistics();
    hf_surface_statistics statistics{};
    statistics.unknown_count = static_cast<std::uint32_t>(core.size());
    statistics.weld_ms = core.times.weld_ms, statistics.operator_ms = core.times.operator_ms;
    statistics.ordering_ms = factor.ordering_ms, statistics.symbolic_ms = factor.symbolic_ms;
    statistics.numeric_ms = factor.numeric_ms, statistics.load_ms = factor.load_ms;
    statistics.factor_entries = factor.entries, statistics.factor_bytes = factor.bytes;
    statistics.factor_flops = factor.flops;
    statistics.memory_bytes = static_cast<double>(object->memory->live_bytes());
    statistics.peak_memory_bytes = static_cast<double>(object->memory->peak_bytes());
    statistics.factor_loaded = factor.loaded, statistics.factor_borrowed = factor.borrowed;
    statistics.links_ms = core.geometry->links_ms;
    write_struct(out_statistics, statistics);
  });
}

hf_result hf_surface_save(hf_surface handle, int32_t field_kind, hf_progress progress, size_t capacity, void* out_bytes,
                          size_t* out_size) {
  return guarded("hf_surface_save", [&] {
    const auto object = get<SurfaceObject>(handle, "surface");
    check_choice(field_kind, 3, "field_kind");
    with_progress(progress, [&] {
      const std::shared_ptr<const Core> core = object->surface.core(static_cast<FieldKind>(field_kind));
      const std::size_t size = static_cast<std::size_t>(saved_factor_size(*core->factor));
      if (out_size) *out_size = size;
      require_either(out_bytes, out_size, "out_bytes and out_size");
      if (!out_bytes) return;
      check_capacity(true, capacity, size, "capacity");
      save_factor(*core->factor, grounded_hash(*core), {static_cast<std::uint8_t*>(out_bytes), size}, *core->memory,
                  *core->jobs);
    });
  });
}

hf_result hf_surface_cast_ray(hf_surface surface, const double* origin, const double* direction,
                              const hf_pick_desc* desc, hf_hit* out_hit) {
  return guarded("hf_surface_cast_ray", [&] {
    const auto object = mesh_surface(surface, "picking");
    const Geometry& shape = object->surface.geometry();
    const Vec3 from = read_point(origin, "origin"), along = read_point(direction, "direction");
    if (along.x == 0 && along.y == 0 && along.z == 0)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "direction is 0; a ray needs one");
    check_struct(out_hit, "out_hit");
    const PickTarget target = read_target(shape.mesh, desc);
    const RayHit found = cast_ray(target, from, along, *shape.jobs, *shape.memory);
    hf_hit hit{};
    hit.found = found.triangle != HF_NO_INDEX;
    hit.triangle = found.triangle, hit.vertex = given_vertex(shape.mesh, found.vertex);
    std::copy_n(found.weight, 3, hit.barycentrics);
    for (int k = 0; k < 3; ++k) hit.corners[k] = given_vertex(shape.mesh, found.corner[k]);
    if (hit.found) put(found.position, hit.position);
    hit.distance = found.distance;
    write_struct(out_hit, hit);
  });
}

hf_result hf_surface_find_vertex(hf_surface surface, const double* point, const hf_pick_desc* desc,
                                 uint32_t* out_vertex, double* out_distance) {
  return guarded("hf_surface_find_vertex", [&] {
    const auto object = mesh_surface(surface, "picking");
    const Geometry& shape = object->surface.geometry();
    const Vec3 p = read_point(point, "point");
    require(out_vertex, "out_vertex");
    const NearestVertex found = nearest_vertex(read_target(shape.mesh, desc), p, *shape.jobs, *shape.memory);
    *out_vertex = given_vertex(shape.mesh, found.vertex);
    if (out_distance) *out_distance = found.distance;
  });
}

}  // extern "C"
