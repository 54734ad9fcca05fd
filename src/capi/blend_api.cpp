// Implements the functions of hf/pose.h that give a pose to a shader: info, rows and transforms of the blend.
#include <algorithm>
#include <limits>

#include "capi/boundary.h"
#include "capi/pose_object.h"
#include "capi/vertex_writer.h"
#include "deform/fixed_row.h"
#include "deform/graded_rows.h"

namespace hf_inner::capi {
namespace {

// Returns the pose whose surface is a blend of clusters. Throws HF_ERROR_UNSUPPORTED or HF_ERROR_EMPTY.
const deform::Pose& blended_pose(const deform::PoseStack& stack) {
  if (stack.has_layers())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "the pose has handles on higher layers, so its surface is not a blend of clusters; use hf_deform");
  if (stack.needs_surface())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "the pose has rigid pieces or handles with limb_refine, so its surface is not a blend of clusters; use "
         "hf_deform");
  if (stack.handle_count() == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the pose has no handle; add one first");
  require_float_positions(stack.core().mesh);
  return stack.base();
}

// Returns the count of clusters. If some vertices have no handle, a last cluster that never moves is counted too.
std::uint32_t blend_clusters(const deform::Pose& pose) noexcept {
  const deform::ClusterWeights& weights = *pose.weights();
  const bool unmoved = weights.unreached_vertex_count > 0 || !pose.core().mesh.isolated.empty();
  return static_cast<std::uint32_t>(weights.cluster_count) + unmoved;
}

void put_floats(Vec3 p, float* out) noexcept {
  out[0] = static_cast<float>(p.x);
  out[1] = static_cast<float>(p.y);
  out[2] = static_cast<float>(p.z);
}

Vector<deform::Normal> rest_normals(const deform::Pose& pose, Memory& memory) {
  const surface::Core& core = pose.core();
  Vector<Vec3> rest(&memory);
  for (const Vec3& p : core.mesh.positions) rest.push_back(core.mesh.to_given(p));
  Buffer<deform::NormalSum> sums(memory, rest.size());
  Vector<deform::Normal> normals(rest.size(), deform::Normal(), &memory);
  deform::vertex_normals(core.mesh, pose.rest(), rest.data(), sums.data(), normals.data(), *core.jobs);
  return normals;
}

void write_blend_rows(const deform::Pose& pose, hf_blend_rows* inout) {
  hf_blend_rows out = read_struct(inout, "inout_rows");
  const mesh::Mesh& mesh = pose.core().mesh;
  Memory& memory = *pose.core().memory;
  const deform::GradedRows rows = deform::graded_rows(mesh, *pose.weights(), memory);
  const auto length = [&](std::int32_t inner) {
    return inner == mesh::Mesh::none
               ? 1u
               : std::max(1u, static_cast<std::uint32_t>(rows.start[inner + 1] - rows.start[inner]));
  };
  std::uint64_t entries = 0;
  out.longest_row = 0;
  mesh::visit_given(mesh, [&](std::size_t, std::int32_t inner) {
    out.longest_row = std::max(out.longest_row, length(inner));
    entries += length(inner);
  });
  if (entries > std::numeric_limits<std::uint32_t>::max())
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the blend has more entries than a 32-bit count holds; use fewer handles");
  out.vertex_count = mesh.report.vertex_count;
  out.entry_count = static_cast<std::uint32_t>(entries);
  write_struct(inout, out);
  check_capacity(out.rows || out.positions || out.normals || out.offsets, out.vertex_capacity, out.vertex_count,
                 "vertex_capacity");
  check_capacity(out.clusters || out.weights || out.gradients, out.entry_capacity, out.entry_count, "entry_capacity");

  Vector<deform::Normal> normals(&memory);
  if (out.normals) normals = rest_normals(pose, memory);
  const deform::Crossfade* glide = pose.crossfade();
  const auto unmoved = static_cast<std::uint16_t>(blend_clusters(pose) - 1);  // the cluster that never moves
  std::size_t isolated = 0;
  std::uint32_t entry = 0;
  const auto add = [&](std::uint16_t cluster, float weight, Vec3 gradient) {
    if (out.clusters) out.clusters[entry] = cluster;
    if (out.weights) out.weights[entry] = weight;
    if (out.gradients) put_floats((1 / mesh.scale) * gradient, out.gradients + 3 * std::size_t{entry});
    ++entry;
  };
  mesh::visit_given(mesh, [&](std::size_t v, std::int32_t inner) {
    const bool loose = inner == mesh::Mesh::none;
    if (out.rows) {
      out.rows[2 * v] = entry;
      out.rows[2 * v + 1] = length(inner);
    }
    if (out.positions)
      put_floats(loose ? mesh.isolated[isolated].position - mesh.centre : mesh.scale * mesh.positions[inner],
                 out.positions + 3 * v);
    if (out.normals) put_floats(loose ? Vec3{0, 0, 1} : deform::to_vec3(normals[inner]), out.normals + 3 * v);
    for (std::size_t c = 0; c < 3 && out.offsets; ++c)
      out.offsets[3 * v + c] = loose || !glide ? 0 : glide->offset.data()[3 * static_cast<std::size_t>(inner) + c];
    isolated += loose;
    const std::int32_t first = loose ? 0 : rows.start[inner], last = loose ? 0 : rows.start[inner + 1];
    for (std::int32_t k = first; k < last; ++k) add(rows.cluster[k], rows.weight[k], rows.gradient[k]);
    if (first == last) add(unmoved, 1, {});
  });
  for (std::size_t i = 0; i < mesh.turned.size() && out.normals; ++i) {
    float* normal = out.normals + 3 * static_cast<std::size_t>(mesh.turned[i]);
    for (int c = 0; c < 3; ++c) normal[c] = -normal[c];
  }
}

// One of the two widths of weights: how far its rows are off.
struct Rounding {
  std::uint32_t total;
  double change = 0, error = 0;
  deform::FixedRow row;
};

// Makes the row of an inner vertex and takes its errors. A vertex that no cluster moves has the unmoved one with
// weight 1.
void round_row(const deform::Pose& pose, std::int32_t inner, std::uint32_t count, Rounding& out) {
  static constexpr float whole = 1;
  const deform::ClusterWeights& weights = *pose.weights();
  const auto unmoved = static_cast<std::uint16_t>(blend_clusters(pose) - 1);  // the cluster that never moves
  const std::int32_t first = inner == mesh::Mesh::none ? 0 : weights.start[inner],
                     last = inner == mesh::Mesh::none ? 0 : weights.start[inner + 1];
  if (first == last) {
    deform::fix_row({&unmoved, 1}, {&whole, 1}, count, out.total, out.row);
    return;
  }
  const std::size_t length = static_cast<std::size_t>(last - first);
  const double change = deform::fix_row({weights.cluster.data() + first, length},
                                        {weights.weight.data() + first, length}, count, out.total, out.row);
  out.change = std::max(out.change, change);
  if (!pose.posed()) return;
  const Vec3 p = pose.core().mesh.positions[inner];
  const deform::Affine* const transforms = pose.cluster_transforms().data();
  Vec3 place;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& a = transforms[out.row.cluster[i]].a;
    const double share = out.row.units[i] / static_cast<double>(out.total);
    place = place + share * Vec3{a[0][0] * p.x + a[0][1] * p.y + a[0][2] * p.z + a[0][3],
                                 a[1][0] * p.x + a[1][1] * p.y + a[1][2] * p.z + a[1][3],
                                 a[2][0] * p.x + a[2][1] * p.y + a[2][2] * p.z + a[2][3]};
  }
  out.error = std::max(out.error, norm(place - deform::blend_vertex(pose.core().mesh, weights, transforms, inner)));
}

template <class Number, class Value>
void put_row(std::uint32_t count, const Value* values, std::size_t vertex, Number* out) noexcept {
  for (std::uint32_t i = 0; i < count && out; ++i) out[vertex * count + i] = static_cast<Number>(values[i]);
}

void write_blend_influences(const deform::Pose& pose, hf_blend_influences* inout) {
  constexpr std::uint32_t standard = 8, byte_clusters = 256;
  hf_blend_influences out = read_struct(inout, "inout_influences");
  const mesh::Mesh& mesh = pose.core().mesh;
  const std::uint32_t count = count_of(out.influence_count, standard, 1, deform::most_row_entries, "influence_count");
  if (out.byte_clusters && blend_clusters(pose) > byte_clusters)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "the blend has %u clusters; byte_clusters takes at most %u. Use clusters, which has 16 bits, or fewer handles",
         blend_clusters(pose), byte_clusters);
  out.influence_count = count;
  out.vertex_count = mesh.report.vertex_count;
  write_struct(inout, out);
  check_capacity(out.clusters || out.weights || out.byte_clusters || out.byte_weights, out.vertex_capacity,
                 out.vertex_count, "vertex_capacity");
  Rounding wide{0xffff, 0, 0, {}}, narrow{0xff, 0, 0, {}};
  mesh::visit_given(mesh, [&](std::size_t v, std::int32_t inner) {
    round_row(pose, inner, count, wide);
    round_row(pose, inner, count, narrow);
    put_row(count, wide.row.cluster, v, out.clusters);
    put_row(count, wide.row.units, v, out.weights);
    put_row(count, narrow.row.cluster, v, out.byte_clusters);
    put_row(count, narrow.row.units, v, out.byte_weights);
  });
  out.change = wide.change;
  out.error = wide.error;
  out.byte_change = narrow.change;
  out.byte_error = narrow.error;
  write_struct(inout, out);
}

hf_blend_info blend_info(const deform::Pose& pose) noexcept {
  hf_blend_info info{};
  info.cluster_count = blend_clusters(pose);
  info.revision = pose.blend_revision();
  info.offset_share = pose.crossfade_share();
  put(pose.core().mesh.centre, info.centre);
  const deform::BlendBox box = pose.blend_box();
  put(box.low, info.low);
  put(box.high, info.high);
  return info;
}

void write_blend_transforms(const deform::Pose& pose, float* out) noexcept {
  const Span<const deform::Affine> moved = pose.cluster_transforms();
  for (std::uint32_t c = 0; c < blend_clusters(pose); ++c) {
    const bool at_rest = !pose.posed() || c >= static_cast<std::uint32_t>(pose.weights()->cluster_count);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        const double unit = j == 3 ? pose.core().mesh.scale : 1;  // translations are in the unit of the mesh
        *out++ = static_cast<float>(at_rest ? (i == j) : unit * moved[c].a[i][j]);
      }
    }
  }
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_pose_get_blend_info(hf_pose handle, hf_blend_info* out_info) {
  return guarded("hf_pose_get_blend_info", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(out_info, "out_info");
    const Reading reading(*pose);
    write_struct(out_info, blend_info(blended_pose(*pose->pose)));
  });
}

hf_result hf_pose_get_blend_rows(hf_pose handle, hf_blend_rows* inout_rows) {
  return guarded("hf_pose_get_blend_rows", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(inout_rows, "inout_rows");
    const Reading reading(*pose);
    write_blend_rows(blended_pose(*pose->pose), inout_rows);
  });
}

hf_result hf_pose_get_blend_influences(hf_pose handle, hf_blend_influences* inout_influences) {
  return guarded("hf_pose_get_blend_influences", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    check_struct(inout_influences, "inout_influences");
    const Reading reading(*pose);
    write_blend_influences(blended_pose(*pose->pose), inout_influences);
  });
}

hf_result hf_pose_get_blend_transforms(hf_pose handle, std::uint32_t capacity, float* out_transforms,
                                       std::uint32_t* out_count) {
  return guarded("hf_pose_get_blend_transforms", [&] {
    const auto pose = get<PoseObject>(handle, "pose");
    const Reading reading(*pose);
    const deform::Pose& base = blended_pose(*pose->pose);
    const std::uint32_t count = blend_clusters(base);
    require_either(out_transforms, out_count, "out_transforms and out_count");
    write_count(out_count, count);
    check_capacity(out_transforms != nullptr, capacity, count, "capacity");
    if (out_transforms) write_blend_transforms(base, out_transforms);
  });
}

}  // extern "C"
