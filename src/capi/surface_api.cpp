// Implements hf/surface.h: surfaces, saved factors, picking.
#include <algorithm>

#include "capi/surface_options.h"
#include "capi/vertex_writer.h"
#include "factor/factor_bytes.h"
#include "hf/surface.h"
#include "mesh/link_intake.h"
#include "mesh/mesh_intake.h"
#include "mesh/picking.h"

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_create(const hf_surface_desc* given, hf_surface* out_surface) {
  return create("hf_surface_create", out_surface, "out_surface", [&] {
    hf_surface_desc desc = read_struct(given, "desc");
    hf_faces_desc polygons{};
    if (desc.faces) {
      polygons = read_struct(desc.faces, "faces");
      desc.faces = &polygons;
    }
    hf_surface_info info = surface::read_info(desc);
    const mesh::FaceRows faces = mesh::read_faces(desc);
    info.face_count = faces.face_count;
    info.corner_count = faces.corner_count;
    if (faces.face_count > 0) info.triangle_count = mesh::cut_size(faces);
    surface::check_mesh_limits(info);
    const mesh::MeshInput input = mesh::read_mesh(desc, faces);
    return make_surface(desc, info, [&](const std::shared_ptr<Memory>& memory, std::shared_ptr<JobRunner> jobs) {
      auto geometry =
          surface::Geometry::make(input, static_cast<mesh::OperatorKind>(info.operator_kind), memory, std::move(jobs));
      mesh::LinksIn links(memory.get());
      if (desc.links) mesh::read_links(read_struct(desc.links, "links"), geometry->mesh, links);
      return links.options.mode == mesh::LinkMode::none ? geometry
                                                        : surface::Geometry::linked(std::move(geometry), links.options);
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
    const mesh::MeshReport& found = object->surface.geometry().mesh_report();
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
    report.bounding_box_diagonal = found.bounding_box_diagonal;
    const mesh::MeshReport& unlinked = object->surface.geometry().unlinked().mesh_report();
    report.inside_out_count = unlinked.inside_out_count;
    report.first_inside_out_vertex = mesh::given_vertex(object->surface.geometry().mesh, unlinked.first_inside_out);
    write_struct(out_report, report);
  });
}

hf_result hf_surface_get_mesh_statistics(hf_surface surface, hf_mesh_statistics* out_statistics) {
  return guarded("hf_surface_get_mesh_statistics", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    check_struct(out_statistics, "out_statistics");
    const surface::Core& core = object->surface.own();
    const mesh::MeshReport& found = object->surface.geometry().mesh_report();
    hf_mesh_statistics statistics{};
    statistics.polygon_count = core.mesh.faces.polygon_count;
    statistics.non_planar_count = core.mesh.faces.non_planar_count;
    statistics.largest_face = core.mesh.faces.largest_size;
    statistics.negative_edge_count = found.negative_edge_count;
    statistics.changed_vertex_count = core.changed_count;
    statistics.first_changed_vertex = mesh::given_vertex(core.mesh, core.first_changed);
    statistics.smallest_angle = found.smallest_angle;
    write_struct(out_statistics, statistics);
  });
}

hf_result hf_surface_get_links_info(hf_surface surface, hf_links_info* out_info) {
  return guarded("hf_surface_get_links_info", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    check_struct(out_info, "out_info");
    const surface::Geometry& geometry = object->surface.geometry();
    hf_links_info info{};
    info.piece_count = geometry.unlinked().mesh.report.component_count;
    if (const mesh::Links* links = geometry.links.get()) {
      info.link_count = static_cast<std::uint32_t>(links->links.size());
      info.light_piece_count = static_cast<std::uint32_t>(std::count(links->light.begin(), links->light.end(), 1));
      info.lone_piece_count = static_cast<std::uint32_t>(links->alone_count);
      info.contact_count = static_cast<std::uint32_t>(links->open.size());
      info.longest_tree_link = geometry.mesh.scale * links->longest_tree_link;
    } else {
      info.lone_piece_count = info.piece_count > 1 ? info.piece_count : 0;
    }
    write_struct(out_info, info);
  });
}

hf_result hf_surface_get_components(hf_surface surface, uint32_t capacity, uint32_t* out_components,
                                    uint32_t* out_count) {
  return guarded("hf_surface_get_components", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_components, out_count, "out_components and out_count");
    const mesh::Mesh& mesh = object->surface.geometry().mesh;
    write_count(out_count, mesh.report.vertex_count);
    check_capacity(out_components, capacity, mesh.report.vertex_count, "capacity");
    if (!out_components) return;
    mesh::visit_given(mesh,
                      [&](std::size_t v, std::int32_t inner) { out_components[v] = mesh::component_of(mesh, inner); });
  });
}

hf_result hf_surface_get_statistics(hf_surface surface, hf_surface_statistics* out_statistics) {
  return guarded("hf_surface_get_statistics", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    check_struct(out_statistics, "out_statistics");
    const surface::Core& core = object->surface.own();
    const factor::FactorStatistics& factor = core.factor->statistics();
    hf_surface_statistics statistics{};
    statistics.unknown_count = static_cast<std::uint32_t>(core.size());
    statistics.weld_ms = core.times.weld_ms;
    statistics.operator_ms = core.times.operator_ms;
    statistics.ordering_ms = factor.ordering_ms;
    statistics.symbolic_ms = factor.symbolic_ms;
    statistics.numeric_ms = factor.numeric_ms;
    statistics.load_ms = factor.load_ms;
    statistics.factor_entries = factor.entries;
    statistics.factor_bytes = factor.bytes;
    statistics.factor_flops = factor.flops;
    statistics.memory_bytes = static_cast<double>(object->memory->live_bytes());
    statistics.peak_memory_bytes = static_cast<double>(object->memory->peak_bytes());
    statistics.factor_loaded = factor.loaded;
    statistics.factor_borrowed = factor.borrowed;
    statistics.links_ms = core.geometry->links_ms;
    write_struct(out_statistics, statistics);
  });
}

hf_result hf_surface_save(hf_surface handle, int32_t field_kind, hf_progress progress, size_t capacity, void* out_bytes,
                          size_t* out_size) {
  return guarded("hf_surface_save", [&] {
    const auto object = get<SurfaceObject>(handle, "surface");
    const mesh::FieldKind kind = surface::read_field_kind(field_kind);
    if (object->surface.is_edited())
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
           "the factor of an edited surface cannot be saved; save the factor of the surface before its edits, and edit "
           "again");
    with_progress(progress, [&] {
      const std::shared_ptr<const surface::Core> core = object->surface.core(kind);
      const std::size_t size = static_cast<std::size_t>(factor::saved_factor_size(*core->factor));
      if (out_size) *out_size = size;
      require_either(out_bytes, out_size, "out_bytes and out_size");
      if (!out_bytes) return;
      check_capacity(true, capacity, size, "capacity");
      factor::save_factor(*core->factor, surface::grounded_hash(*core), {static_cast<std::uint8_t*>(out_bytes), size},
                          *core->memory, *core->jobs);
    });
  });
}

hf_result hf_surface_cast_ray(hf_surface surface, const double* origin, const double* direction,
                              const hf_pick_desc* desc, hf_hit* out_hit) {
  return guarded("hf_surface_cast_ray", [&] {
    const auto object = mesh_surface(surface, "picking");
    const surface::Geometry& shape = object->surface.geometry();
    const Vec3 from = mesh::read_point(origin, "origin"), along = mesh::read_direction(direction);
    check_struct(out_hit, "out_hit");
    const mesh::PickTarget target = mesh::read_target(shape.mesh, read_optional(desc, "desc"));
    const mesh::RayHit found = mesh::cast_ray(target, from, along, *shape.jobs, *shape.memory);
    hf_hit hit{};
    hit.found = found.triangle != HF_NO_INDEX;
    hit.triangle = found.triangle;
    hit.vertex = mesh::given_vertex(shape.mesh, found.vertex);
    std::copy_n(found.weight, 3, hit.place.barycentrics);
    for (int k = 0; k < 3; ++k) hit.place.corners[k] = mesh::given_vertex(shape.mesh, found.corner[k]);
    if (hit.found) put(found.position, hit.position);
    hit.distance = found.distance;
    write_struct(out_hit, hit);
  });
}

hf_result hf_surface_find_vertex(hf_surface surface, const double* point, const hf_pick_desc* desc,
                                 uint32_t* out_vertex, double* out_distance) {
  return guarded("hf_surface_find_vertex", [&] {
    const auto object = mesh_surface(surface, "picking");
    const surface::Geometry& shape = object->surface.geometry();
    const Vec3 p = mesh::read_point(point, "point");
    require(out_vertex, "out_vertex");
    const mesh::NearestVertex found =
        mesh::nearest_vertex(mesh::read_target(shape.mesh, read_optional(desc, "desc")), p, *shape.jobs, *shape.memory);
    *out_vertex = mesh::given_vertex(shape.mesh, found.vertex);
    if (out_distance) *out_distance = found.distance;
  });
}

}  // extern "C"
