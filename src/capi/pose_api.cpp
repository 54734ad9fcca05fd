// hf/deform.h: poses.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/scatter.h"
#include "deform/pose_stack.h"
#include "deform/skin.h"
#include "hf/deform.h"

namespace hf_inner::capi {
namespace {

struct PoseObject final : Object {
  PoseObject(std::shared_ptr<Memory> owner, std::shared_ptr<PoseStack> given)
      : Object(Kind::pose),
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
  bool keeps_order;  // inner vertices are those given, in their order: nothing welded, none isolated
  // of the last finished change: may be read while another thread changes the pose
  std::atomic<std::uint32_t> handle_count;
};

hf_pose publish(std::shared_ptr<PoseStack> pose) {
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

// Regions of points and radii, as regions of inner vertices.
void append_near(const Core& core, const hf_handles_desc& desc, Vector<std::uint32_t>& start,
                 Vector<std::int32_t>& vertices) {
  start.push_back(0);
  for (std::uint32_t r = 0; r < desc.handle_count; ++r) {
    const double* p = desc.points + 3 * std::size_t{r};
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      fail(HF_ERROR_NON_FINITE, r, "point %u is not finite", r);
    if (!std::isfinite(desc.radii[r])) fail(HF_ERROR_NON_FINITE, r, "radius %u is not finite", r);
    if (desc.radii[r] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, r, "radius %u is %g; it must not be negative", r, desc.radii[r]);
    const Vector<std::int32_t> region =
        region_near(core, core.mesh.to_inner({p[0], p[1], p[2]}), desc.radii[r] / core.mesh.scale, *core.memory);
    vertices.insert(vertices.end(), region.begin(), region.end());
    start.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
}

// p -> M p as a rotation about the centroid and a translation.
HandleTransform read_matrix(const double* m, std::uint32_t index, Vec3 centroid) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i])) fail(HF_ERROR_NON_FINITE, index, "matrix %u holds a number that is not finite", index);
  }
  Mat3 linear;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) linear(i, j) = m[4 * j + i];
  }
  const Quaternion rotation = best_rotation(linear, Quaternion());
  const Mat3 exact = rotation.toRotationMatrix();
  double off = std::fabs(m[3]) + std::fabs(m[7]) + std::fabs(m[11]) + std::fabs(m[15] - 1);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) off = std::max(off, std::fabs(linear(i, j) - exact(i, j)));
  }
  if (!(off <= 1e-4))
    fail(HF_ERROR_INVALID_ARGUMENT, index, "matrix %u is no rigid motion; scale and shear are not taken", index);
  return {rotation, rotate(rotation, centroid) + Vec3{m[12], m[13], m[14]} - centroid};
}

// The vertices hf_deform writes.
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

// All vertices, three numbers each: scatter() without a call per number, and a plain loop when nothing moves its place.
template <class Point, class Real>
void write_points(const Core& core, bool keeps_order, Span<const Point> points, Real* out, std::size_t stride,
                  IsolatedRow isolated) {
  const std::size_t count = core.mesh.report.vertex_count;
  constexpr std::size_t piece = 32768;
  char* bytes = reinterpret_cast<char*>(out);
  const bool plain = keeps_order && stride == 3 * sizeof(Real);
  core.jobs->for_each(static_cast<std::uint32_t>((count + piece - 1) / piece), [&](std::uint32_t p) {
    const std::size_t begin = p * piece, end = std::min(count, begin + piece);
    if (plain) {
      const auto* from = &points.data()->x;
      for (std::size_t i = 3 * begin; i < 3 * end; ++i) out[i] = static_cast<Real>(from[i]);
      return;
    }
    for (std::size_t v = begin; v < end; ++v) {
      const std::int32_t inner = core.mesh.inner_of_given[v];
      if (inner == Mesh::none) continue;
      const Point x = points[static_cast<std::size_t>(inner)];
      const Real row[3] = {static_cast<Real>(x.x), static_cast<Real>(x.y), static_cast<Real>(x.z)};
      std::memcpy(bytes + v * stride, row, sizeof row);
    }
  });
  for (const Mesh::Isolated& entry : core.mesh.isolated) {
    double values[3] = {0, 0, 0};
    isolated(entry, values);
    const Real row[3] = {static_cast<Real>(values[0]), static_cast<Real>(values[1]), static_cast<Real>(values[2])};
    std::memcpy(bytes + static_cast<std::size_t>(entry.given) * stride, row, sizeof row);
  }
}

// Rows of a range, one after the other: scatter() for a part.
template <class Row>
void scatter_range(const Core& core, const Range& range, const Rows& out, IsolatedRow isolated, Row&& row) {
  for (std::uint32_t i = 0; i < range.count; ++i) {
    const std::int32_t inner = core.mesh.inner_of_given[range.first + i];
    double values[3] = {0, 0, 0};
    if (inner != Mesh::none) {
      row(static_cast<std::size_t>(inner), values);
    } else {
      for (const Mesh::Isolated& entry : core.mesh.isolated) {
        if (static_cast<std::uint32_t>(entry.given) == range.first + i) isolated(entry, values);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) out.set(i, c, values[c]);
  }
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_pose_create(hf_solver handle, const hf_pose_desc* desc, hf_pose* out_pose) {
  return guarded("hf_pose_create", [&] {
    require(out_pose, "out_pose");
    *out_pose = nullptr;
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    const PoseOptions options = read_options(desc);
    if (solver->field.engine().kind() != EngineKind::green)
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "poses need a solver with HF_ENGINE_GREEN");
    *out_pose = publish(PoseStack::make(solver->field.shared_core(), options));
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
    if (desc.reserved != 0) fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "reserved is %u; it must be 0", desc.reserved);
    const bool near = desc.points || desc.radii;
    if (near) {
      if (desc.region_counts || desc.region_vertices)
        fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "regions and points are both set; set one");
      require(desc.points, "points"), require(desc.radii, "radii");
    } else {
      require(desc.region_counts, "region_counts"), require(desc.region_vertices, "region_vertices");
    }
    if (desc.layer >= HF_LAYER_COUNT)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "layer is %u; it must be 0 to %d", desc.layer, HF_LAYER_COUNT - 1);
    if (desc.handle_count > 256)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles in one batch; a pose takes at most 256", desc.handle_count);
    const Changing changing(*pose);
    const Mesh& mesh = pose->pose->core().mesh;
    Vector<std::uint32_t> start(pose->memory.get());
    Vector<std::int32_t> vertices(pose->memory.get());
    if (near) {
      append_near(pose->pose->core(), desc, start, vertices);
    } else {
      append_starts(desc.handle_count, desc.region_counts, mesh.report.vertex_count, "region_counts", start);
      append_inner(mesh, start.back(), desc.region_vertices, "region_vertices", vertices);
    }
    Vector<std::uint32_t> numbers(desc.handle_count, pose->memory.get());
    try {
      pose->pose->add_handles(start, vertices, desc.layer, numbers);
    } catch (const Error& error) {
      if (!near || error.code() != HF_ERROR_OVERLAP) throw;
      const std::uint32_t r =
          static_cast<std::uint32_t>(std::upper_bound(start.begin(), start.end(), error.index()) - start.begin() - 1);
      fail(HF_ERROR_OVERLAP, r, "the region of point %u overlaps another handle; make its radius smaller", r);
    }
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

hf_result hf_pose_set_transforms(hf_pose handle, uint32_t handle_count, const uint32_t* handles,
                                 const hf_transform* transforms) {
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
      placed[i].rotation = {{q[0], q[1], q[2]}, q[3]};
      placed[i].translation = {t[0], t[1], t[2]};
    }
    pose->pose->set_transforms({handles, handle_count}, {placed, handle_count});
  });
}

hf_result hf_pose_set_matrices(hf_pose handle, uint32_t handle_count, const uint32_t* handles, const double* matrices) {
  return guarded("hf_pose_set_matrices", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    if (handle_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "handle_count is 0");
    require(handles, "handles"), require(matrices, "matrices");
    if (handle_count > 256) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles; a pose has at most 256", handle_count);
    const Changing changing(*pose);
    HandleTransform placed[256];
    for (std::uint32_t i = 0; i < handle_count; ++i)
      placed[i] = read_matrix(matrices + 16 * std::size_t{i}, i, pose->pose->handle_at(handles[i], i).centroid);
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
    const HandleTransform placed = pose->pose->placed(number);
    std::copy_n(placed.rotation.coeffs().data(), 4, info.rotation);  // x y z w
    put(placed.translation, info.translation);
    info.layer = pose->pose->layer_of(number);
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
    check_choice(desc.refine, 2, "refine");
    if (desc.positions && desc.positions_f64)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "positions and positions_f64 are both set; set one");
    if (!desc.positions && !desc.positions_f64 && !desc.normals)
      fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "positions, positions_f64 and normals are all NULL; nothing to write");
    const Rows positions = rows_of(desc.positions, desc.positions_f64, desc.position_stride, "position_stride");
    const Rows normals = rows_of(desc.normals, static_cast<double*>(nullptr), desc.normal_stride, "normal_stride");
    DeformRequest request;
    request.normals = desc.normals != nullptr;
    request.iteration_count = count_of(desc.iteration_count, 0, 1, 1000, "iteration_count");
    request.restart = desc.restart != 0, request.refine = desc.refine == 1;
    const Changing changing(*pose);
    const Core& core = pose->pose->core();
    const Range range = read_range(desc, core.mesh.report.vertex_count);
    request.surface = range.whole || request.normals || request.refine || pose->pose->has_layers();
    const bool straight = range.whole && pose->keeps_order;  // no vertex moves its place between here and there
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
      if (positions) scatter_range(core, range, positions, put_rest, put_position);
      if (normals) scatter_range(core, range, normals, put_up, put_normal);
    }
    if (!out_info) return;
    hf_deform_info info{};
    info.iteration_count = report.iteration_count, info.cluster_count = report.cluster_count;
    info.unreached_vertex_count = report.unreached_vertex_count + core.mesh.report.isolated_vertex_count;
    info.last_change = report.last_change;
    info.solve_ms = report.solve_ms, info.blend_ms = report.blend_ms, info.normal_ms = report.normal_ms,
    info.refine_ms = report.refine_ms;
    write_struct(out_info, info);
  });
}

hf_result hf_pose_get_skin(hf_pose handle, hf_skin_info* info) {
  return guarded("hf_pose_get_skin", [&] {
    const auto pose = get<PoseObject>(handle, Kind::pose, "pose");
    hf_skin_info out = read_struct(info, "info");
    const std::uint32_t weight_count = out.weight_count == 0 ? 4 : out.weight_count;
    if (weight_count != 4 && weight_count != 8)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "weight_count is %u; it must be 4 or 8, or 0 for 4", weight_count);
    if (out.reserved != 0) fail(HF_ERROR_INVALID_DESC, HF_NO_INDEX, "reserved is %u; it must be 0", out.reserved);
    const Reading reading(*pose);
    if (pose->pose->has_layers())
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
           "the pose has handles on higher layers; the surface they make is no blend of clusters");
    const Pose& base = pose->pose->base();
    if (base.handle_count() == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
    const Skin skin = make_skin(base, weight_count, out.scales != nullptr, *pose->memory);
    const std::size_t joints = skin.pivot.size();
    for (std::size_t j = 0; j < joints; ++j) {
      if (out.pivots) put(skin.pivot[j], out.pivots + 3 * j);
      if (out.translations) put(skin.place[j], out.translations + 3 * j);
      if (out.rotations) std::copy_n(skin.rotation[j].coeffs().data(), 4, out.rotations + 4 * j);  // x y z w
      if (out.axes) std::copy_n(skin.axes[j].coeffs().data(), 4, out.axes + 4 * j);
      if (out.scales) put(skin.stretch[j], out.scales + 3 * j);
    }
    const Mesh& mesh = base.core().mesh;
    for (std::size_t v = 0; (out.vertex_joints || out.vertex_weights) && v < mesh.report.vertex_count; ++v) {
      std::uint32_t joint[8];
      float weight[8];
      skin_weights(base, mesh.inner_of_given[v] == Mesh::none ? -1 : mesh.inner_of_given[v], weight_count, joint,
                   weight);
      if (out.vertex_joints) std::copy_n(joint, weight_count, out.vertex_joints + v * weight_count);
      if (out.vertex_weights) std::copy_n(weight, weight_count, out.vertex_weights + v * weight_count);
    }
    out.joint_count = static_cast<std::uint32_t>(joints), out.weight_count = weight_count;
    write_struct(info, out);
  });
}

}  // extern "C"
