// Implements hf/pose.h: poses.
#include <algorithm>

#include "capi/create.h"
#include "capi/pose_object.h"
#include "capi/skin_out.h"
#include "capi/vertex_writer.h"
#include "deform/intake.h"
#include "deform/skin.h"
#include "hf/pose.h"

namespace hf_inner::capi {
namespace {

static_assert(HF_HANDLE_LIMIT == deform::handle_limit && HF_LAYER_COUNT == deform::layer_limit,
              "hf/pose.h states other limits");

std::shared_ptr<PoseObject> make_object(std::shared_ptr<deform::PoseStack> pose) {
  const std::shared_ptr<Memory> memory = pose->core().memory;
  return make_owner_in<PoseObject>(memory, memory, std::move(pose));
}

void add_handles(hf_pose handle, const hf_handles_desc& desc, std::uint32_t* out_handles) {
  const auto pose = get<PoseObject>(handle, "pose");
  const Changing changing(*pose);
  const deform::HandleInput input = deform::read_handles(pose->pose->core(), desc, *pose->memory);
  Vector<std::uint32_t> numbers(desc.handle_count, pose->memory.get());
  with_progress(desc.progress, [&] { deform::add_handles(*pose->pose, input, numbers); });
  pose->handle_count = pose->pose->handle_count();
  if (out_handles) std::copy(numbers.begin(), numbers.end(), out_handles);
}

// read(stack, i) returns the transform of handle i of the list.
template <class Read>
void place_handles(hf_pose handle, std::uint32_t count, const std::uint32_t* handles, const void* places,
                   const char* name, Read&& read) {
  const auto pose = get<PoseObject>(handle, "pose");
  deform::check_handles(count, handles);
  require(places, name);
  const Changing changing(*pose);
  deform::HandleTransform placed[HF_HANDLE_LIMIT];
  for (std::uint32_t i = 0; i < count; ++i) placed[i] = read(*pose->pose, i);
  pose->pose->set_transforms({handles, count}, {placed, count});
}

template <class Real>
void negate(char* row) {
  Real normal[3];
  std::memcpy(normal, row, sizeof normal);
  for (Real& x : normal) x = -x;
  std::memcpy(row, normal, sizeof normal);
}

// Turns the normals of vertices on the second side of a two-sided sheet round.
void turn_normals(const mesh::Mesh& mesh, const deform::VertexRange& range, const Rows& normals) {
  if (!normals) return;
  for (const std::int32_t v : mesh.turned) {
    const std::size_t row = static_cast<std::size_t>(v) - range.first;
    if (static_cast<std::size_t>(v) < range.first || row >= range.count) continue;
    char* const place = normals.bytes() + row * normals.stride();
    if (normals.is_double())
      negate<double>(place);
    else
      negate<float>(place);
  }
}

// Rows that the pose can write itself: packed floats.
float* packed_floats(const Rows& rows) noexcept {
  const bool aligned = reinterpret_cast<std::uintptr_t>(rows.bytes()) % alignof(float) == 0;
  const bool plain = aligned && !rows.is_double() && rows.stride() == 3 * sizeof(float);
  return plain ? reinterpret_cast<float*>(rows.bytes()) : nullptr;
}

// Writes the vertices of `range`. straight_normals: the pose has written the normals.
void write_deformed(const PoseObject& object, const deform::VertexRange& range, const PointsOut& out, bool surface,
                    bool straight_normals, const deform::DeformReport& report) {
  const surface::Core& core = object.pose->core();
  if (!range.whole) {
    const auto put_position = [&](std::size_t v, double* values) {
      put(surface ? report.positions[v] : object.pose->base().blended(static_cast<std::int32_t>(v)), values);
    };
    const auto put_normal = [&](std::size_t v, double* values) { put(deform::to_vec3(report.normals[v]), values); };
    if (out.positions) write_range(core, range.first, range.count, 3, out.positions, put_rest, put_position);
    if (out.normals) write_range(core, range.first, range.count, 3, out.normals, put_up, put_normal);
    return;
  }
  if (out.positions && !report.packed_positions)
    write_points(core, object.keeps_order, report.positions, out.positions, put_rest);
  if (out.normals && !straight_normals) write_points(core, object.keeps_order, report.normals, out.normals, put_up);
}

void tell(PoseObject& object, const deform::DeformReport& report, hf_deform_info* out_info) {
  object.last.cluster_count = report.cluster_count;
  object.last.solve_ms = report.solve_ms;
  object.last.blend_ms = report.blend_ms;
  object.last.normal_ms = report.normal_ms;
  object.last.refine_ms = report.refine_ms;
  if (!out_info) return;
  hf_deform_info info{};
  info.iteration_count = report.iteration_count;
  info.unreached_vertex_count = report.unreached_vertex_count + object.pose->core().mesh.report.isolated_vertex_count;
  info.last_change = report.last_change;
  write_struct(out_info, info);
}

void deform_pose(hf_pose handle, const hf_deform_desc& desc, hf_deform_info* out_info) {
  const auto pose = get<PoseObject>(handle, "pose");
  if (out_info) check_struct(out_info, "out_info");
  deform::DeformRequest request = deform::read_request(desc);
  const Changing changing(*pose);
  const surface::Core& core = pose->pose->core();
  const deform::VertexRange range = deform::read_range(desc, core.mesh.report.vertex_count);
  const PointsOut out = read_points_out(desc, range.count);
  if (out.positions && !out.positions.is_double()) require_float_positions(core.mesh);
  request.surface = range.whole || request.normals || request.refine > 0 || pose->pose->needs_surface();
  // The library's and the caller's vertices have the same order.
  const bool straight = range.whole && pose->keeps_order;
  if (straight) {
    request.packed_positions = packed_floats(out.positions);
    request.packed_normals = reinterpret_cast<deform::Normal*>(packed_floats(out.normals));
  }
  const bool straight_normals = request.packed_normals != nullptr;
  const deform::DeformReport report = pose->pose->deform(request);
  write_deformed(*pose, range, out, request.surface, straight_normals, report);
  turn_normals(core.mesh, range, out.normals);
  tell(*pose, report, out_info);
}

}  // namespace

hf_result create_pose(const char* function, hf_surface surface, const hf_pose_desc* desc, deform::PoseOptions options,
                      hf_pose* out_pose) {
  return create(function, out_pose, "out_pose", [&] {
    const std::shared_ptr<const surface::Core> core = harmonic_core(surface, "a pose");
    const hf_pose_desc given = read_optional(desc, "desc");
    options.band_count = given.band_count;
    options.iteration_count = given.iteration_count;
    options.group_count = given.group_count;
    return make_object(deform::PoseStack::make(core, options));
  });
}

}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_pose_create(hf_surface surface, const hf_pose_desc* desc, hf_pose* out_pose) {
  return create_pose("hf_pose_create", surface, desc, {}, out_pose);
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
    const deform::PoseOptions& options = pose->pose->options();
    hf_pose_info info{};
    info.band_count = options.band_count;
    info.iteration_count = options.iteration_count;
    info.group_count = options.group_count;
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
    desc.handle_count = 1;
    desc.points = point;
    desc.radii = &radius;
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
                  [&](const deform::PoseStack&, std::uint32_t i) { return deform::read_transform(transforms[i]); });
  });
}

hf_result hf_pose_set_transform(hf_pose pose, uint32_t handle, const hf_transform* transform) {
  return guarded("hf_pose_set_transform", [&] {
    place_handles(pose, 1, &handle, transform, "transform",
                  [&](const deform::PoseStack&, std::uint32_t) { return deform::read_transform(*transform); });
  });
}

hf_result hf_pose_set_matrices(hf_pose pose, uint32_t handle_count, const uint32_t* handles, const double* matrices) {
  return guarded("hf_pose_set_matrices", [&] {
    place_handles(
        pose, handle_count, handles, matrices, "matrices", [&](const deform::PoseStack& stack, std::uint32_t i) {
          return deform::rigid_transform(matrices + 16 * std::size_t{i}, stack.handle_at(handles[i], i).centroid, i);
        });
  });
}

hf_result hf_pose_set_free_rotations(hf_pose handle, uint32_t handle_count, const uint32_t* handles,
                                     int32_t free_rotation) {
  return guarded("hf_pose_set_free_rotations", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    deform::check_handles(handle_count, handles);
    check_flag(free_rotation, "free_rotation");
    const Changing changing(*pose);
    pose->pose->set_free_turns({handles, handle_count}, free_rotation != 0);
  });
}

hf_result hf_pose_set_following(hf_pose handle, uint32_t handle_count, const uint32_t* handles, double following) {
  return guarded("hf_pose_set_following", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    deform::check_handles(handle_count, handles);
    deform::check_following(following);
    const Changing changing(*pose);
    pose->pose->set_following({handles, handle_count}, following);
  });
}

hf_result hf_pose_set_limb_refine(hf_pose handle, uint32_t handle_count, const uint32_t* handles, int32_t refine) {
  return guarded("hf_pose_set_limb_refine", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    deform::check_handles(handle_count, handles);
    const std::uint32_t steps = deform::read_refine(refine);
    const Changing changing(*pose);
    pose->pose->set_limb_steps({handles, handle_count}, steps);
  });
}

hf_result hf_pose_set_rigid_pieces(hf_pose handle, uint32_t vertex_count, const uint32_t* vertices) {
  return guarded("hf_pose_set_rigid_pieces", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    const Changing changing(*pose);
    pose->pose->set_rigid_pieces(deform::read_rigid_pieces(pose->pose->core(), vertex_count, vertices, *pose->memory));
  });
}

hf_result hf_pose_get_handle(hf_pose handle, uint32_t number, hf_handle_info* out_info) {
  return guarded("hf_pose_get_handle", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(out_info, "out_info");
    const Reading reading(*pose);
    const deform::HandleReport report = pose->pose->handle(number);
    hf_handle_info info{};
    info.vertex_count = report.vertex_count;
    info.site_count = report.site_count;
    info.component = report.component;
    put(report.centroid, info.centroid);
    info.leak = report.leak;
    const deform::HandleTransform placed = pose->pose->placed(number);
    std::copy_n(placed.rotation.coeffs().data(), 4, info.rotation);  // x y z w
    put(placed.translation, info.translation);
    info.layer = pose->pose->layer_of(number);
    info.free_rotation = pose->pose->free_turn(number);
    info.following = pose->pose->following(number);
    info.limb_refine = static_cast<int32_t>(pose->pose->limb_steps(number));
    write_struct(out_info, info);
  });
}

uint32_t hf_pose_get_handle_count(hf_pose pose) { return count_at(pose, &PoseObject::handle_count); }

hf_result hf_pose_get_field(hf_pose handle, uint32_t number, const hf_array_out* out_values) {
  return guarded("hf_pose_get_field", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    const std::uint32_t vertices = pose->pose->core().mesh.report.vertex_count;
    const Rows out = need_reals(out_values, 1, vertices, "vertices", "out_values");
    const Reading reading(*pose);
    const deform::FieldColumn<const double> field = pose->pose->field(number);
    write_vertices(pose->pose->core(), 1, out, nullptr,
                   [&](std::size_t v, double* values) { values[0] = field[static_cast<Index>(v)]; });
  });
}

hf_result hf_deform(hf_pose pose, float* out_positions, hf_deform_info* out_info) {
  return guarded("hf_deform", [&] {
    const auto object = get<PoseObject>(pose, "pose");
    require(out_positions, "out_positions");
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.positions = HF_ARRAY_OUT(out_positions, object->pose->core().mesh.report.vertex_count);
    deform_pose(pose, desc, out_info);
  });
}

hf_result hf_pose_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info) {
  return guarded("hf_pose_deform", [&] {
    get<PoseObject>(pose, "pose");
    deform_pose(pose, read_struct(desc, "desc"), out_info);
  });
}

hf_result hf_pose_solve(hf_pose handle, uint32_t iteration_count, int32_t restart, hf_deform_info* out_info) {
  return guarded("hf_pose_solve", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    if (out_info) check_struct(out_info, "out_info");
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.iteration_count = iteration_count;
    desc.restart = restart;
    deform::DeformRequest request = deform::read_request(desc);
    const Changing changing(*pose);
    request.surface = pose->pose->needs_surface();
    tell(*pose, pose->pose->deform(request), out_info);
  });
}

hf_result hf_pose_get_statistics(hf_pose handle, hf_pose_statistics* out_statistics) {
  return guarded("hf_pose_get_statistics", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*pose);
    write_struct(out_statistics, pose->last);
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
    const deform::Pose& base = pose->pose->base();
    if (base.handle_count() == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
    const mesh::Mesh& mesh = base.core().mesh;
    const deform::Skin skin = deform::make_skin(base, out.influence_count(), out.wants_scales(), *pose->memory);
    out.write_counts(skin.pivot.size(), mesh.report.vertex_count);
    for (std::size_t j = 0; j < skin.pivot.size(); ++j)
      out.write_joint(j, skin.pivot[j], skin.rotation[j], skin.place[j], skin.axes[j], skin.stretch[j]);
    out.write_vertices(mesh, [&](std::int32_t inner, std::uint32_t* joints, float* weights) {
      deform::skin_weights(base, inner == mesh::Mesh::none ? -1 : inner, out.influence_count(), joints, weights);
    });
  });
}

}  // extern "C"
