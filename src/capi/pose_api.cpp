// Implements hf/pose.h: poses.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.h"
#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/skin_out.h"
#include "capi/vertex_lists.h"
#include "capi/vertex_writer.h"
#include "deform/constants.h"
#include "deform/pose_stack.h"
#include "deform/skin.h"
#include "hf/pose.h"

namespace hf_inner::capi {
namespace {

static_assert(HF_HANDLE_LIMIT == handle_limit && HF_LAYER_COUNT == layer_limit, "hf/pose.h states other limits");

struct PoseObject final : Object {
  static constexpr Kind kind_of = Kind::pose;
  PoseObject(std::shared_ptr<Memory> owner, std::shared_ptr<PoseStack> given)
      : Object(kind_of),
        memory(std::move(owner)),
        pose(std::move(given)),
        keeps_order(is_identity(pose->core().mesh)),
        handle_count(pose->handle_count()) {}
  static bool is_identity(const Mesh& mesh) {
    if (mesh.report.vertex_count != static_cast<std::uint32_t>(mesh.vertex_count())) return false;
    for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
      if (mesh.inner_of_given[v] != static_cast<std::int32_t>(v)) return false;
    }
    return true;
  }
  std::shared_ptr<Memory> memory;  // outlives the pose
  std::shared_ptr<PoseStack> pose;
  bool keeps_order;  // the library's vertices are the caller's: none welded, none isolated
  // The handle count after the last finished change. Another thread may read it while a change runs.
  std::atomic<std::uint32_t> handle_count;
};

std::shared_ptr<PoseObject> make_object(std::shared_ptr<PoseStack> pose) {
  const std::shared_ptr<Memory> memory = pose->core().memory;
  return make_owner_in<PoseObject>(memory, memory, std::move(pose));
}

// The range of vertices that hf_pose_deform writes.
struct Range {
  std::uint32_t first, count;
  bool whole;
};

Range read_range(const hf_deform_desc& desc, std::uint32_t vertex_count) {
  if (desc.first_vertex > vertex_count || desc.vertex_count > vertex_count - desc.first_vertex)
    fail(HF_ERROR_OUT_OF_RANGE, HF_NO_INDEX, "vertices %u to %llu are asked for; the mesh has %u", desc.first_vertex,
         static_cast<unsigned long long>(desc.first_vertex) + desc.vertex_count, vertex_count);
  const std::uint32_t count = desc.vertex_count ? desc.vertex_count : vertex_count - desc.first_vertex;
  return {desc.first_vertex, count, count == vertex_count};
}

void add_handles(hf_pose handle, const hf_handles_desc& desc, std::uint32_t* out_handles) {
  const auto pose = get<PoseObject>(handle, "pose");
  check_region_count(0, desc.handle_count, "handle");  // before lists of that length are read
  require_zero(desc.reserved);
  const bool near = desc.points || desc.radii;
  if (near) {
    if (desc.region_counts || desc.region_vertices)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "regions and points are both set; set one");
    require(desc.points, "points"), require(desc.radii, "radii");
  } else {
    require(desc.region_counts, "region_counts"), require(desc.region_vertices, "region_vertices");
  }
  const Changing changing(*pose);
  const Mesh& mesh = pose->pose->core().mesh;
  Vector<std::uint32_t> start(pose->memory.get());
  Vector<std::int32_t> vertices(pose->memory.get());
  if (near) {
    const std::size_t count = desc.handle_count;
    regions_near(pose->pose->core(), {desc.points, 3 * count}, {desc.radii, count}, start, vertices);
  } else {
    append_starts(desc.handle_count, desc.region_counts, mesh.report.vertex_count, start);
    append_inner(mesh, start.back(), desc.region_vertices, "region_vertices", vertices);
  }
  Vector<std::uint32_t> numbers(desc.handle_count, pose->memory.get());
  try {
    with_progress(desc.progress, [&] { pose->pose->add_handles(start, vertices, desc.layer, numbers); });
  } catch (const Error& error) {
    if (!near || error.code() != HF_ERROR_OVERLAP) throw;
    const std::uint32_t r =
        static_cast<std::uint32_t>(std::upper_bound(start.begin(), start.end(), error.index()) - start.begin() - 1);
    fail(HF_ERROR_OVERLAP, r, "the region of point %u overlaps another handle; make its radius smaller", r);
  }
  pose->handle_count = pose->pose->handle_count();
  if (out_handles) std::copy(numbers.begin(), numbers.end(), out_handles);
}

HandleTransform transform_of(const hf_transform& given) noexcept {
  HandleTransform out;
  const double* q = given.rotation;
  out.rotation = {{q[0], q[1], q[2]}, q[3]};
  out.translation = {given.translation[0], given.translation[1], given.translation[2]};
  return out;
}

// read(stack, i) returns the transform of handle i of the list.
template <class Read>
void place_handles(hf_pose handle, std::uint32_t count, const std::uint32_t* handles, const void* places,
                   const char* name, Read&& read) {
  const auto pose = get<PoseObject>(handle, "pose");
  require_list(count, handles, "handle_count", "handles"), require(places, name);
  if (count > HF_HANDLE_LIMIT)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles; a pose has at most %d", count, HF_HANDLE_LIMIT);
  const Changing changing(*pose);
  HandleTransform placed[HF_HANDLE_LIMIT];
  for (std::uint32_t i = 0; i < count; ++i) placed[i] = read(*pose->pose, i);
  pose->pose->set_transforms({handles, count}, {placed, count});
}

void deform(hf_pose handle, const hf_deform_desc& desc, hf_deform_info* out_info) {
  const auto pose = get<PoseObject>(handle, "pose");
  if (out_info) check_struct(out_info, "out_info");
  check_flag(desc.restart, "restart"), check_flag(desc.refine, "refine");
  const PointsOut out = read_points_out(desc);
  DeformRequest request;
  request.normals = desc.normals != nullptr;
  request.iteration_count = desc.iteration_count;
  request.restart = desc.restart != 0, request.refine = desc.refine == 1;
  const Changing changing(*pose);
  const Core& core = pose->pose->core();
  const Range range = read_range(desc, core.mesh.report.vertex_count);
  request.surface = range.whole || request.normals || request.refine || pose->pose->has_layers();
  // The library's and the caller's vertices have the same order.
  const bool straight = range.whole && pose->keeps_order;
  const auto packed = [](std::uint32_t stride) { return stride == 0 || stride == 3 * sizeof(float); };
  if (straight && packed(desc.position_stride)) request.packed_positions = desc.positions;
  const bool straight_normals = straight && desc.normals && packed(desc.normal_stride);
  if (straight_normals) request.packed_normals = reinterpret_cast<Normal*>(desc.normals);
  const DeformReport report = pose->pose->deform(request);
  const auto put_position = [&](std::size_t v, double* values) {
    put(request.surface ? report.positions[v] : pose->pose->base().blended(static_cast<std::int32_t>(v)), values);
  };
  const auto put_normal = [&](std::size_t v, double* values) { put(to_vec3(report.normals[v]), values); };
  if (range.whole) {
    if (desc.positions && !report.packed_positions)
      write_points(core, pose->keeps_order, report.positions, desc.positions,
                   stride_of(desc.position_stride, 3 * sizeof(float), "position_stride"), put_rest);
    if (desc.positions_f64)
      write_points(core, pose->keeps_order, report.positions, desc.positions_f64,
                   stride_of(desc.position_stride, 3 * sizeof(double), "position_stride"), put_rest);
    if (desc.normals && !straight_normals)
      write_points(core, pose->keeps_order, report.normals, desc.normals,
                   stride_of(desc.normal_stride, 3 * sizeof(float), "normal_stride"), put_up);
  } else {
    if (out.positions) write_range(core, range.first, range.count, 3, out.positions, put_rest, put_position);
    if (out.normals) write_range(core, range.first, range.count, 3, out.normals, put_up, put_normal);
  }
  if (!out_info) return;
  hf_deform_info info{};
  info.iteration_count = report.iteration_count, info.cluster_count = report.cluster_count;
  info.unreached_vertex_count = report.unreached_vertex_count + core.mesh.report.isolated_vertex_count;
  info.last_change = report.last_change;
  info.solve_ms = report.solve_ms, info.blend_ms = report.blend_ms, info.normal_ms = report.normal_ms,
  info.refine_ms = report.refine_ms;
  write_struct(out_info, info);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_pose_create(hf_surface surface, const hf_pose_desc* given, hf_pose* out_pose) {
  return create("hf_pose_create", out_pose, "out_pose", [&] {
    const std::shared_ptr<const Core> core = harmonic_core(surface, "a pose");
    const hf_pose_desc desc = read_optional(given, "desc");
    PoseOptions options;
    options.mode = static_cast<DeformMode>(desc.mode), options.band_count = desc.band_count;
    options.iteration_count = desc.iteration_count, options.samples_per_ring = desc.samples_per_ring;
    options.group_count = desc.group_count;
    return make_object(PoseStack::make(core, options));
  });
}

hf_result hf_pose_clone(hf_pose handle, hf_pose* out_pose) {
  return create("hf_pose_clone", out_pose, "out_pose", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    const Reading reading(*pose);
    return make_object(pose->pose->clone());
  });
}

void hf_pose_destroy(hf_pose pose) { destroy<PoseObject>(pose); }

hf_result hf_pose_get_info(hf_pose handle, hf_pose_info* out_info) {
  return guarded("hf_pose_get_info", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(out_info, "out_info");
    const Reading reading(*pose);
    const PoseOptions& options = pose->pose->options();
    hf_pose_info info{};
    info.mode = options.mode == DeformMode::paper ? HF_DEFORM_PAPER : HF_DEFORM_SMOOTH;
    info.band_count = options.band_count, info.iteration_count = options.iteration_count;
    info.samples_per_ring = options.samples_per_ring, info.group_count = options.group_count;
    info.handle_count = pose->pose->handle_count();
    info.vertex_count = pose->pose->core().mesh.report.vertex_count;
    write_struct(out_info, info);
  });
}

hf_result hf_pose_add_handles(hf_pose pose, const hf_handles_desc* handles, uint32_t* out_handles) {
  return guarded("hf_pose_add_handles", [&] {
    get<PoseObject>(pose, "pose");
    add_handles(pose, read_struct(handles, "handles"), out_handles);
  });
}

hf_result hf_pose_add_handle_at(hf_pose pose, const double* point, double radius, uint32_t* out_handle) {
  return guarded("hf_pose_add_handle_at", [&] {
    get<PoseObject>(pose, "pose");
    require(point, "point");
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.handle_count = 1, desc.points = point, desc.radii = &radius;
    add_handles(pose, desc, out_handle);
  });
}

hf_result hf_pose_remove_handles(hf_pose handle, uint32_t handle_count, const uint32_t* handles) {
  return guarded("hf_pose_remove_handles", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    require_list(handle_count, handles, "handle_count", "handles");
    const Changing changing(*pose);
    pose->pose->remove_handles({handles, handle_count});
    pose->handle_count = pose->pose->handle_count();
  });
}

hf_result hf_pose_set_transforms(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                 const hf_transform* transforms) {
  return guarded("hf_pose_set_transforms", [&] {
    place_handles(pose, handle_count, handles, transforms, "transforms",
                  [&](const PoseStack&, std::uint32_t i) { return transform_of(transforms[i]); });
  });
}

hf_result hf_pose_set_transform(hf_pose pose, uint32_t handle, const hf_transform* transform) {
  return guarded("hf_pose_set_transform", [&] {
    place_handles(pose, 1, &handle, transform, "transform",
                  [&](const PoseStack&, std::uint32_t) { return transform_of(*transform); });
  });
}

hf_result hf_pose_set_matrices(hf_pose pose, uint32_t handle_count, const uint32_t* handles, const double* matrices) {
  return guarded("hf_pose_set_matrices", [&] {
    place_handles(pose, handle_count, handles, matrices, "matrices", [&](const PoseStack& stack, std::uint32_t i) {
      return rigid_transform(matrices + 16 * std::size_t{i}, stack.handle_at(handles[i], i).centroid, i);
    });
  });
}

hf_result hf_pose_get_handle(hf_pose handle, uint32_t number, hf_handle_info* out_info) {
  return guarded("hf_pose_get_handle", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(out_info, "out_info");
    const Reading reading(*pose);
    const HandleReport report = pose->pose->handle(number);
    hf_handle_info info{};
    info.vertex_count = report.vertex_count, info.site_count = report.site_count, info.component = report.component;
    put(report.centroid, info.centroid);
    info.leak = report.leak;
    const HandleTransform placed = pose->pose->placed(number);
    std::copy_n(placed.rotation.coeffs().data(), 4, info.rotation);  // x y z w
    put(placed.translation, info.translation);
    info.layer = pose->pose->layer_of(number);
    write_struct(out_info, info);
  });
}

uint32_t hf_pose_get_handle_count(hf_pose pose) { return count_at(pose, &PoseObject::handle_count); }

hf_result hf_pose_get_field(hf_pose handle, uint32_t number, float* out_values, uint32_t value_stride) {
  return guarded("hf_pose_get_field", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    require(out_values, "out_values");
    const Rows out(out_values, stride_of(value_stride, sizeof(float), "value_stride"));
    const Reading reading(*pose);
    const Span<const double> field = pose->pose->field(number);
    write_vertices(pose->pose->core(), 1, out, nullptr, [&](std::size_t v, double* values) { values[0] = field[v]; });
  });
}

hf_result hf_deform(hf_pose pose, float* out_positions, hf_deform_info* out_info) {
  return guarded("hf_deform", [&] {
    get<PoseObject>(pose, "pose");
    require(out_positions, "out_positions");
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.positions = out_positions;
    deform(pose, desc, out_info);
  });
}

hf_result hf_pose_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info) {
  return guarded("hf_pose_deform", [&] {
    get<PoseObject>(pose, "pose");
    deform(pose, read_struct(desc, "desc"), out_info);
  });
}

hf_result hf_pose_get_skin(hf_pose handle, hf_skin_info* inout_skin) {
  return guarded("hf_pose_get_skin", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    SkinOut out(inout_skin);
    const Reading reading(*pose);
    if (pose->pose->has_layers())
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
           "the pose has handles on higher layers; the surface they make is not a blend of clusters");
    const Pose& base = pose->pose->base();
    if (base.handle_count() == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
    const Mesh& mesh = base.core().mesh;
    const Skin skin = make_skin(base, out.weight_count(), out.wants_scales(), *pose->memory);
    out.write_counts(skin.pivot.size(), mesh.report.vertex_count);
    for (std::size_t j = 0; j < skin.pivot.size(); ++j)
      out.write_joint(j, skin.pivot[j], skin.rotation[j], skin.place[j], skin.axes[j], skin.stretch[j]);
    out.write_vertices(mesh, [&](std::int32_t inner, std::uint32_t* joints, float* weights) {
      skin_weights(base, inner == Mesh::none ? -1 : inner, out.weight_count(), joints, weights);
    });
  });
}

}  // extern "C"
