// hf/deform.h: poses.
#include <algorithm>
#include <atomic>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/scatter.h"
#include "deform/pose.h"
#include "hf/deform.h"

namespace hf::capi {
namespace {

struct PoseObject final : Object {
  PoseObject(std::shared_ptr<Memory> owner, std::shared_ptr<Pose> given) : Object(Kind::pose), memory(std::move(owner)), pose(std::move(given)), handle_count(pose->handle_count()) {}
  std::shared_ptr<Memory> memory;  // outlives the pose
  std::shared_ptr<Pose> pose;
  std::atomic<std::uint32_t> handle_count;  // of the last finished change: may be read while another thread changes the pose
};

hf_pose publish(std::shared_ptr<Pose> pose) {
  const std::shared_ptr<Memory> memory = pose->core().memory;
  return reinterpret_cast<hf_pose>(insert(make_owner_in<PoseObject>(memory, memory, std::move(pose))));
}

PoseOptions read_options(const hf_pose_desc* given) {
  PoseOptions options;
  if (!given) return options;
  const hf_pose_desc desc = read_struct(given, "desc");
  check_choice(desc.mode, 2, "mode");
  options.mode = desc.mode == HF_DEFORM_PAPER ? DeformMode::paper : DeformMode::smooth;
  options.band_count = count_of(desc.band_count, 0, 2, 64, "band_count");
  options.iteration_count = count_of(desc.iteration_count, 0, 1, 1000, "iteration_count");
  options.samples_per_ring = desc.samples_per_ring;
  options.group_count = count_of(desc.group_count, 0, 1, 2000, "group_count");
  return options;
}

}  // namespace
}  // namespace hf::capi

using namespace hf;
using namespace hf::capi;

extern "C" {

hf_result hf_pose_create(hf_solver handle, const hf_pose_desc* desc, hf_pose* out_pose) {
  return guarded("hf_pose_create", [&] {
    require(out_pose, "out_pose");
    *out_pose = nullptr;
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    const PoseOptions options = read_options(desc);
    if (solver->field.engine().kind() != EngineKind::green) fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "poses need a solver with HF_ENGINE_GREEN");
    *out_pose = publish(Pose::make(solver->field.shared_core(), options));
  });
}

hf_result hf_pose_clone(hf_pose handle, hf_pose* out_pose) {
  return guarded("hf_pose_clone", [&] {
    require(out_pose, "out_pose");
    *out_pose = nullptr;
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    const Reading reading(*pose);
    *out_pose = publish(pose->pose->clone());
  });
}

void hf_pose_destroy(hf_pose pose) {
  const FloatEnvironment environment;
  remove(reinterpret_cast<std::uintptr_t>(pose), Kind::pose);
}

hf_result hf_pose_add_handles(hf_pose handle, const hf_handles_desc* given, uint32_t* out_handles) {
  return guarded("hf_pose_add_handles", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    const hf_handles_desc desc = read_struct(given, "handles");
    if (desc.handle_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "handle_count is 0");
    require(desc.region_counts, "region_counts"), require(desc.region_vertices, "region_vertices");
    if (desc.handle_count > 256) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles in one batch; a pose takes at most 256", desc.handle_count);
    const Changing changing(*pose);
    const Mesh& mesh = pose->pose->core().mesh;
    Vector<std::uint32_t> start(pose->memory.get());
    append_starts(desc.handle_count, desc.region_counts, mesh.report.vertex_count, "region_counts", start);
    Vector<std::int32_t> vertices(pose->memory.get());
    append_inner(mesh, start.back(), desc.region_vertices, "region_vertices", vertices);
    Vector<std::uint32_t> numbers(desc.handle_count, pose->memory.get());
    pose->pose->add_handles(start, vertices, numbers);
    pose->handle_count = pose->pose->handle_count();
    if (out_handles) std::copy(numbers.begin(), numbers.end(), out_handles);
  });
}

hf_result hf_pose_remove_handles(hf_pose handle, uint32_t handle_count, const uint32_t* handles) {
  return guarded("hf_pose_remove_handles", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    if (handle_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "handle_count is 0");
    require(handles, "handles");
    const Changing changing(*pose);
    pose->pose->remove_handles({handles, handle_count});
    pose->handle_count = pose->pose->handle_count();
  });
}

hf_result hf_pose_set_transforms(hf_pose handle, uint32_t handle_count, const uint32_t* handles, const hf_transform* transforms) {
  return guarded("hf_pose_set_transforms", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    if (handle_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "handle_count is 0");
    require(handles, "handles"), require(transforms, "transforms");
    if (handle_count > 256) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles; a pose has at most 256", handle_count);
    const Changing changing(*pose);
    HandleTransform placed[256];
    for (std::uint32_t i = 0; i < handle_count; ++i) {
      const double* q = transforms[i].rotation;
      const double* t = transforms[i].translation;
      placed[i].rotation.x = q[0], placed[i].rotation.y = q[1], placed[i].rotation.z = q[2], placed[i].rotation.w = q[3];
      placed[i].translation = {t[0], t[1], t[2]};
    }
    pose->pose->set_transforms({handles, handle_count}, {placed, handle_count});
  });
}

hf_result hf_pose_get_handle(hf_pose handle, uint32_t number, hf_handle_info* out_info) {
  return guarded("hf_pose_get_handle", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    check_struct(out_info, "out_info");
    const Reading reading(*pose);
    const HandleReport report = pose->pose->handle(number);
    hf_handle_info info{};
    info.vertex_count = report.vertex_count, info.site_count = report.site_count, info.component = report.component;
    info.centroid[0] = report.centroid.x, info.centroid[1] = report.centroid.y, info.centroid[2] = report.centroid.z;
    info.leak = report.leak;
    write_struct(out_info, info);
  });
}

uint32_t hf_pose_get_handle_count(hf_pose pose) {
  const std::shared_ptr<Object> object = find(reinterpret_cast<std::uintptr_t>(pose), Kind::pose);
  return object ? static_cast<PoseObject&>(*object).handle_count.load() : 0;
}

hf_result hf_pose_get_field(hf_pose handle, uint32_t number, float* out_values, uint32_t value_stride) {
  return guarded("hf_pose_get_field", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    require(out_values, "out_values");
    const Rows out(out_values, stride_of(value_stride, sizeof(float), "value_stride"));
    const Reading reading(*pose);
    const Span<const double> field = pose->pose->field(number);
    scatter(pose->pose->core(), 1, out, nullptr, [&](std::size_t v, double* values) { values[0] = field[v]; });
  });
}

hf_result hf_deform(hf_pose handle, const hf_deform_desc* given, hf_deform_info* out_info) {
  return guarded("hf_deform", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    const hf_deform_desc desc = read_struct(given, "desc");
    if (out_info) check_struct(out_info, "out_info");
    if (desc.reserved != 0) fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "reserved is %d; it must be 0", desc.reserved);
    if (desc.positions && desc.positions_f64) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "positions and positions_f64 are both set; set one");
    if (!desc.positions && !desc.positions_f64 && !desc.normals) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "positions, positions_f64 and normals are all NULL; nothing to write");
    const Rows positions = rows_of(desc.positions, desc.positions_f64, desc.position_stride, "position_stride");
    const Rows normals = rows_of(desc.normals, static_cast<double*>(nullptr), desc.normal_stride, "normal_stride");
    DeformRequest request;
    request.normals = desc.normals != nullptr;
    request.iteration_count = count_of(desc.iteration_count, 0, 1, 1000, "iteration_count");
    request.restart = desc.restart != 0;
    const Changing changing(*pose);
    const DeformReport report = pose->pose->deform(request);
    const Core& core = pose->pose->core();
    if (positions) scatter(core, 3, positions, put_rest, [&](std::size_t v, double* values) { put(report.positions[v], values); });
    if (normals) scatter(core, 3, normals, put_up, [&](std::size_t v, double* values) { put(report.normals[v], values); });
    if (!out_info) return;
    hf_deform_info info{};
    info.iteration_count = report.iteration_count, info.cluster_count = report.cluster_count;
    info.unreached_vertex_count = report.unreached_vertex_count + core.mesh.report.isolated_vertex_count;
    info.last_change = report.last_change;
    info.solve_ms = report.solve_ms, info.blend_ms = report.blend_ms, info.normal_ms = report.normal_ms;
    write_struct(out_info, info);
  });
}

}  // extern "C"
