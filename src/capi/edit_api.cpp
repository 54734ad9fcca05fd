// Implements the edits of hf/surface.h, and the functions that move solvers and poses to an edited surface.
#include "capi/objects.h"
#include "capi/pose_object.h"
#include "capi/vertex_writer.h"
#include "engine/surface_intake.h"
#include "hf/solver.h"

namespace hf_inner::capi {
namespace {

void require_same_origin(const Core& core, const Surface& surface, const char* noun) {
  if (!core.geometry->is_kin(surface.geometry()))
    fail(HF_ERROR_CONFLICT, HF_NO_INDEX,
         "the %s is on another surface: move it to one that hf_surface_edit or hf_surface_relink made from its own",
         noun);
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
    const std::shared_ptr<const Surface> before(object, &object->surface);
    hf_patch_desc patch{};
    if (desc.patch) patch = read_struct(desc.patch, "patch");
    SurfaceEdit edit = read_surface_edit(desc, desc.patch ? &patch : nullptr, *before, object->info);
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
      const Mesh::CutCorner& cut = cuts[i];
      out_cuts[i] = {static_cast<uint32_t>(cut.triangle), static_cast<uint32_t>(cut.corner),
                     static_cast<uint32_t>(cut.vertex), static_cast<uint32_t>(cut.copied)};
    }
  });
}

hf_result hf_surface_get_stiffness(hf_surface surface, uint32_t capacity, double* out_stiffness, uint32_t* out_count) {
  return guarded("hf_surface_get_stiffness", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_stiffness, out_count, "out_stiffness and out_count");
    const Mesh& mesh = object->surface.geometry().mesh;
    write_count(out_count, mesh.report.vertex_count);
    check_capacity(out_stiffness, capacity, mesh.report.vertex_count, "capacity");
    if (!out_stiffness) return;
    const Vector<double>* const stiffness = object->surface.stiffness();
    visit_given(mesh, [&](std::size_t v, std::int32_t inner) {
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
    pose->pose->move_to(object->surface.core(FieldKind::harmonic));
  });
}

}  // extern "C"
