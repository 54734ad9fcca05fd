// Implements the edits of hf/surface.h, and the functions that move solvers and poses to an edited surface.
#include <algorithm>

#include "capi/objects.h"
#include "capi/pose_object.h"
#include "capi/vertex_writer.h"
#include "hf/solver.h"
#include "mesh/cut_intake.h"
#include "mesh/trace_cut.h"
#include "surface/surface_intake.h"

namespace hf_inner::capi {
namespace {

void require_same_origin(const surface::Core& core, const surface::Surface& surface, const char* noun) {
  if (!core.geometry->is_kin(surface.geometry()))
    fail(HF_ERROR_CONFLICT, HF_NO_INDEX,
         "the %s is on another surface: move it to one that hf_surface_edit or hf_surface_relink made from its own",
         noun);
}

template <class From, class To>
void copy(const From& from, To* to) {
  if (to) std::copy(from.begin(), from.end(), to);
}

void write_cut(const mesh::Mesh& mesh, const mesh::TracedCut& cut, hf_cut* inout_cut) {
  hf_cut out = read_struct(inout_cut, "inout_cut");
  out.removed_triangle_count = static_cast<std::uint32_t>(cut.removed.size());
  out.new_vertex_count = static_cast<std::uint32_t>(cut.vertices.size());
  out.new_triangle_count = static_cast<std::uint32_t>(cut.sources.size());
  out.rim_count = static_cast<std::uint32_t>(cut.rims.size() / 2);
  write_struct(inout_cut, out);
  check_capacity(out.removed_triangles, out.removed_triangle_capacity, out.removed_triangle_count,
                 "removed_triangle_capacity");
  check_capacity(out.new_positions || out.vertex_corners || out.vertex_barycentrics, out.new_vertex_capacity,
                 out.new_vertex_count, "new_vertex_capacity");
  check_capacity(out.new_triangles || out.source_triangles || out.corner_barycentrics, out.new_triangle_capacity,
                 out.new_triangle_count, "new_triangle_capacity");
  check_capacity(out.rim_vertices, out.rim_capacity, out.rim_count, "rim_capacity");
  copy(cut.removed, out.removed_triangles);
  copy(cut.triangles, out.new_triangles);
  copy(cut.sources, out.source_triangles);
  copy(cut.weights, out.corner_barycentrics);
  copy(cut.rims, out.rim_vertices);
  for (std::size_t v = 0; v < cut.vertices.size(); ++v) {
    const mesh::SurfacePlace& place = cut.vertices[v];
    if (out.new_positions) put(mesh::position_of(mesh, place), out.new_positions + 3 * v);
    for (std::size_t k = 0; k < 3; ++k) {
      if (out.vertex_corners) out.vertex_corners[3 * v + k] = mesh::given_vertex(mesh, place.vertex[k]);
      if (out.vertex_barycentrics) out.vertex_barycentrics[3 * v + k] = place.weight[k];
    }
  }
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_edit(hf_surface surface, const hf_surface_edit_desc* given, hf_surface* out_surface) {
  return create("hf_surface_edit", out_surface, "out_surface", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    const hf_surface_edit_desc desc = read_struct(given, "desc");
    const std::shared_ptr<const surface::Surface> before(object, &object->surface);
    hf_patch_desc patch{};
    if (desc.patch) patch = read_struct(desc.patch, "patch");
    surface::SurfaceEdit edit = surface::read_surface_edit(desc, desc.patch ? &patch : nullptr, *before, object->info);
    return with_progress(desc.progress, [&] {
      return make_owner_in<SurfaceObject>(object->memory, before, std::move(edit), object->info);
    });
  });
}

hf_result hf_surface_get_cuts(hf_surface surface, uint32_t capacity, hf_cut_corner* out_cuts, uint32_t* out_count) {
  return guarded("hf_surface_get_cuts", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_cuts, out_count, "out_cuts and out_count");
    const auto& cuts = object->surface.geometry().unlinked().mesh.cuts;
    write_count(out_count, cuts.size());
    check_capacity(out_cuts, capacity, cuts.size(), "capacity");
    for (std::size_t i = 0; out_cuts && i < cuts.size(); ++i) {
      const mesh::Mesh::CutCorner& cut = cuts[i];
      out_cuts[i] = {static_cast<uint32_t>(cut.triangle), static_cast<uint32_t>(cut.corner),
                     static_cast<uint32_t>(cut.vertex), static_cast<uint32_t>(cut.copied)};
    }
  });
}

hf_result hf_surface_trace_cut(hf_surface surface, const hf_cut_desc* given, hf_cut* inout_cut) {
  return guarded("hf_surface_trace_cut", [&] {
    const auto object = mesh_surface(surface, "a cut");
    const hf_cut_desc desc = read_struct(given, "desc");
    require_zero(read_struct(inout_cut, "inout_cut").reserved);
    const surface::Geometry& shape = object->surface.geometry().unlinked();
    if (!shape.mesh.faces.empty())
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a surface of polygons cannot be cut; make the surface of triangles");
    const mesh::CutOptions options = mesh::read_cut_options(desc);
    with_progress(desc.progress, [&] {
      const Vector<mesh::CurvePoint> points = mesh::read_cut_points(desc, shape.mesh, shape.topology(), *shape.memory);
      write_cut(shape.mesh, mesh::trace_cut(shape.mesh, shape.topology(), points, options, *shape.memory), inout_cut);
    });
  });
}

hf_result hf_surface_get_stiffness(hf_surface surface, uint32_t capacity, double* out_stiffness, uint32_t* out_count) {
  return guarded("hf_surface_get_stiffness", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_stiffness, out_count, "out_stiffness and out_count");
    const mesh::Mesh& mesh = object->surface.geometry().mesh;
    write_count(out_count, mesh.report.vertex_count);
    check_capacity(out_stiffness, capacity, mesh.report.vertex_count, "capacity");
    if (!out_stiffness) return;
    const Vector<double>* const stiffness = object->surface.stiffness();
    mesh::visit_given(mesh, [&](std::size_t v, std::int32_t inner) {
      out_stiffness[v] = stiffness && inner >= 0 ? (*stiffness)[static_cast<std::size_t>(inner)] : 1.0;
    });
  });
}

hf_result hf_solver_move_to(hf_solver handle, hf_surface surface) {
  return guarded("hf_solver_move_to", [&] {
    const auto solver = get<SolverObject>(handle, "solver");
    const auto object = get<SurfaceObject>(surface, "surface");
    const Changing changing(*solver);
    require_same_origin(solver->field.core(), object->surface, "solver");
    solver->field.move_to(object->surface.core(solver->field.core().field_kind));
  });
}

hf_result hf_pose_move_to(hf_pose handle, hf_surface surface) {
  return guarded("hf_pose_move_to", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    const auto object = get<SurfaceObject>(surface, "surface");
    const Changing changing(*pose);
    require_same_origin(pose->pose->core(), object->surface, "pose");
    if (&pose->pose->core().geometry->unlinked() != &object->surface.geometry().unlinked())
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
           "the surface has other triangles; make a pose on it with the handles of this one");
    pose->pose->move_to(object->surface.core(mesh::FieldKind::harmonic));
  });
}

}  // extern "C"
