#include "deform/intake.h"

#include <algorithm>

#include "base/arguments.h"
#include "deform/constants.h"
#include "field/intake.h"
#include "mesh/vertex_lists.h"

namespace hf_inner::deform {
namespace {

static_assert(static_cast<int>(HandleReason::foot) == HF_HANDLE_REASON_FOOT &&
                  static_cast<int>(HandleReason::tip) == HF_HANDLE_REASON_TIP &&
                  static_cast<int>(HandleReason::end) == HF_HANDLE_REASON_END &&
                  static_cast<int>(HandleReason::joint) == HF_HANDLE_REASON_JOINT &&
                  static_cast<int>(HandleReason::middle) == HF_HANDLE_REASON_MIDDLE,
              "hf/pose.h states other reasons");

// The unit vector away from the ground. For 0 0 0 it is the up axis of the skeleton where that is known, else y.
Vec3 read_up(const double* up, const skeleton::KnownSkeleton* skeleton) {
  if (!is_finite_point(up)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "up is not finite");
  const Vec3 unit = unit_vector({up[0], up[1], up[2]});
  if (unit.x != 0 || unit.y != 0 || unit.z != 0) return unit;
  return skeleton && skeleton->character.up_confidence >= sure_roles ? skeleton->character.up : Vec3{0, 1, 0};
}

void check_skeleton(const hf_handle_proposals_desc& desc) {
  if (desc.joint_count == 0) return;
  if (desc.joint_count > most_skeleton_joints)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "joint_count is %u; it must be at most %u", desc.joint_count,
         most_skeleton_joints);
  require(desc.joints, "joints");
  require(desc.parents, "parents");
  for (std::uint32_t j = 0; j < desc.joint_count; ++j) {
    const double* p = desc.joints + 3 * std::size_t{j};
    if (!is_finite_point(p)) fail(HF_ERROR_NON_FINITE, j, "joint %u is not finite", j);
    if (desc.parents[j] != HF_NO_INDEX && desc.parents[j] >= desc.joint_count)
      fail(HF_ERROR_OUT_OF_RANGE, j, "the parent of joint %u is %u; there are %u joints", j, desc.parents[j],
           desc.joint_count);
  }
}

void check_character(const hf_handle_proposals_desc& desc, const mesh::Mesh& mesh,
                     const skeleton::KnownSkeleton& skeleton) {
  if (desc.joint_count > 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "joints and a skeleton are both set; set one");
  const std::uint32_t skinned = skeleton.input.vertex_count;
  if (skinned > 0 && skinned != mesh.report.vertex_count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "the skin of the skeleton has %u vertices and the mesh %u; make the skeleton with the skin of this mesh",
         skinned, mesh.report.vertex_count);
}

}  // namespace

HandleInput read_handles(const surface::Core& core, const hf_handles_desc& desc, Memory& memory) {
  check_region_count(0, desc.handle_count, "handle");  // before lists of that length are read
  check_flag(desc.in_place, "in_place");
  check_flag(desc.free_rotation, "free_rotation");
  require_zero(desc.reserved);
  HandleInput input(&memory);
  input.layer = desc.layer;
  input.kind.in_place = desc.in_place != 0;
  input.kind.free_turn = desc.free_rotation != 0;
  input.by_places = desc.vertices || desc.places || desc.points || desc.radii;
  if (input.by_places) {
    if (desc.region_counts || desc.region_vertices)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "regions and places are both set; set one");
    const mesh::Places places(desc.handle_count, desc.vertices, desc.places, desc.points);
    require(desc.radii, "radii");
    regions_near(core, places, desc.radii, input.start, input.vertices);
    return input;
  }
  require(desc.region_counts, "region_counts");
  require(desc.region_vertices, "region_vertices");
  mesh::append_starts(desc.handle_count, desc.region_counts, core.mesh.report.vertex_count, input.start);
  mesh::append_inner(core.mesh, input.start.back(), desc.region_vertices, "region_vertices", input.vertices);
  return input;
}

void add_handles(PoseStack& pose, const HandleInput& input, Span<std::uint32_t> out_numbers) {
  try {
    pose.add_handles(input.start, input.vertices, input.layer, out_numbers, input.kind);
  } catch (const Error& error) {
    if (!input.by_places || error.code() != HF_ERROR_CONFLICT) throw;
    const auto after = std::upper_bound(input.start.begin(), input.start.end(), error.index());
    const std::uint32_t r = static_cast<std::uint32_t>(after - input.start.begin() - 1);
    fail(HF_ERROR_CONFLICT, r, "the region of place %u overlaps another handle; make its radius smaller", r);
  }
}

void check_handles(std::uint32_t count, const std::uint32_t* handles) {
  require_list(count, handles, "handle_count", "handles");
  if (count > HF_HANDLE_LIMIT)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u handles; a pose has at most %d", count, HF_HANDLE_LIMIT);
}

Vector<std::int32_t> read_rigid_pieces(const surface::Core& core, std::uint32_t count, const std::uint32_t* vertices,
                                       Memory& memory) {
  Vector<std::int32_t> inner(&memory);
  if (count == 0) return inner;
  require(vertices, "vertices");
  mesh::check_vertex_count(core.mesh, count, "vertex_count");
  mesh::append_usable(core.mesh, count, vertices, "vertices", inner);
  return inner;
}

void check_following(double following) {
  check_finite(following, "following");
  if (following < 0 || following > 1)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "following is %g; it must be 0 (the limb alone) to 1 (all)",
         following);
}

std::uint32_t read_refine(std::int32_t refine) {
  if (refine < 0 || refine > static_cast<std::int32_t>(most_refine_steps))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "refine is %d; it must be 0 to %u steps", refine, most_refine_steps);
  return static_cast<std::uint32_t>(refine);
}

HandleTransform read_transform(const hf_transform& given) noexcept {
  HandleTransform out;
  const double* q = given.rotation;
  out.rotation = {{q[0], q[1], q[2]}, q[3]};
  out.translation = {given.translation[0], given.translation[1], given.translation[2]};
  return out;
}

VertexRange read_range(const hf_deform_desc& desc, std::uint32_t vertex_count) {
  if (desc.first_vertex > vertex_count || desc.vertex_count > vertex_count - desc.first_vertex)
    fail(HF_ERROR_OUT_OF_RANGE, HF_NO_INDEX, "vertices %u to %llu are asked for; the mesh has %u", desc.first_vertex,
         static_cast<unsigned long long>(desc.first_vertex) + desc.vertex_count, vertex_count);
  const std::uint32_t count = desc.vertex_count ? desc.vertex_count : vertex_count - desc.first_vertex;
  return {desc.first_vertex, count, count == vertex_count};
}

DeformRequest read_request(const hf_deform_desc& desc) {
  require_zero(desc.reserved);
  check_flag(desc.restart, "restart");
  const std::uint32_t refine = read_refine(desc.refine);
  check_flag(desc.refine_from_last, "refine_from_last");
  if (desc.refine_from_last && desc.refine == 0)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "refine_from_last needs steps; set refine to 1 or more");
  DeformRequest request;
  request.normals = is_given(desc.normals);
  request.iteration_count = desc.iteration_count;
  request.restart = desc.restart != 0;
  request.refine = refine;
  request.refine_from_last = desc.refine_from_last != 0;
  return request;
}

ProposalOptions read_proposal_options(const hf_handle_proposals_desc& desc, const mesh::Mesh& mesh,
                                      const skeleton::KnownSkeleton* skeleton) {
  ProposalOptions options;
  options.skeleton = skeleton;
  if (skeleton) check_character(desc, mesh, *skeleton);
  options.up = read_up(desc.up, skeleton);
  options.least_length_share = field::read_least_length(desc.least_length_share);
  options.limit = count_of(desc.limit, default_proposals, 1, HF_HANDLE_LIMIT, "limit");
  require_zero(desc.reserved);
  check_skeleton(desc);
  if (desc.joint_count == 0) return options;
  options.joints = {desc.joints, 3 * std::size_t{desc.joint_count}};
  options.parents = {desc.parents, desc.joint_count};
  return options;
}

}  // namespace hf_inner::deform
