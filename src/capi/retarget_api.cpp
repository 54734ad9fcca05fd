// Implements hf/retarget.h.
#include <algorithm>

#include "base/arguments.h"
#include "capi/skeleton_object.h"

namespace hf_inner::capi {
namespace {

constexpr double degree_in_radians = 3.14159265358979323846 / 180;
constexpr std::uint32_t all_left_out =
    HF_RETARGET_KEEP_RESTS | HF_RETARGET_NO_GOALS | HF_RETARGET_NO_LOCK | HF_RETARGET_NO_COPY;

retarget::RetargetOptions options_of(const hf_retarget_desc& desc) {
  require_zero(desc.reserved);
  check_choice(desc.root_motion, 3, "root_motion");
  if (desc.leave_out & ~all_left_out)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "leave_out is %u; it must be a sum of HF_RETARGET_* flags",
         desc.leave_out);
  retarget::RetargetOptions out;
  out.root_motion = static_cast<retarget::RootMotion>(desc.root_motion);
  out.align_rests = !(desc.leave_out & HF_RETARGET_KEEP_RESTS);
  out.goals = !(desc.leave_out & HF_RETARGET_NO_GOALS);
  out.lock_feet = !(desc.leave_out & HF_RETARGET_NO_LOCK);
  out.copy_same = !(desc.leave_out & HF_RETARGET_NO_COPY);
  out.scale = desc.scale;
  std::copy(desc.ground_velocity, desc.ground_velocity + 3, out.ground_velocity);
  return out;
}

std::shared_ptr<const Vector<double>> rest_of(const float* given, const skeleton::KnownSkeleton& skeleton,
                                              const std::shared_ptr<Memory>& memory) {
  if (!given) return nullptr;
  return make_owner_in<Vector<double>>(memory, given, given + 10 * std::size_t{skeleton.input.joint_count},
                                       memory.get());
}

std::shared_ptr<const skeleton::KnownSkeleton> skeleton_of(hf_skeleton handle, const char* name) {
  return get<SkeletonObject>(handle, name)->skeleton;
}

hf_retarget_info info_of(const RetargetObject& object) {
  const retarget::RetargetReport& report = object.retarget.report();
  hf_retarget_info info{};
  info.source_joint_count = object.parts.source->input.joint_count;
  info.target_joint_count = object.parts.target->input.joint_count;
  info.matched_joint_count = report.matched_joints;
  info.chain_count = static_cast<std::uint32_t>(report.chains.size());
  info.same_skeleton = report.same_skeleton;
  info.scale_from = static_cast<std::int32_t>(report.scale_source);
  info.frame_count = static_cast<std::uint32_t>(std::min<std::uint64_t>(report.frames, UINT32_MAX));
  info.scale = report.scale;
  info.limb_angle = degree_in_radians * report.limb_degrees;
  info.stride_share = report.stride;
  info.deepest_drop = report.deepest_drop;
  return info;
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_retarget_create(hf_skeleton source, hf_skeleton target, const hf_retarget_desc* given,
                             hf_retarget* out_retarget) {
  return create("hf_retarget_create", out_retarget, "out_retarget", [&] {
    RetargetParts parts;
    parts.source = skeleton_of(source, "source");
    parts.target = skeleton_of(target, "target");
    const hf_retarget_desc desc = read_optional(given, "desc");
    parts.options = options_of(desc);
    const std::shared_ptr<Memory>& memory = parts.target->memory;
    return with_progress(desc.progress, [&] {
      parts.source_rest = rest_of(desc.source_rest, *parts.source, memory);
      parts.target_rest = rest_of(desc.target_rest, *parts.target, memory);
      return make_owner_in<RetargetObject>(memory, parts);
    });
  });
}

hf_result hf_retarget_clone(hf_retarget handle, hf_retarget* out_retarget) {
  return clone_object<RetargetObject>("hf_retarget_clone", handle, "retarget", out_retarget, "out_retarget");
}

void hf_retarget_destroy(hf_retarget retarget) { destroy<RetargetObject>(retarget); }

hf_result hf_retarget_solve(hf_retarget handle, const float* source_pose, double seconds, float* out_target_pose) {
  return guarded("hf_retarget_solve", [&] {
    const auto object = get<RetargetObject>(handle, "retarget");
    require(source_pose, "source_pose");
    require(out_target_pose, "out_target_pose");
    const Changing changing(*object);
    std::copy(source_pose, source_pose + object->source_pose.size(), object->source_pose.begin());
    object->retarget.frame(object->source_pose.data(), seconds, object->target_pose.data());
    std::transform(object->target_pose.begin(), object->target_pose.end(), out_target_pose,
                   [](double v) { return static_cast<float>(v); });
  });
}

hf_result hf_retarget_reset(hf_retarget handle) {
  return guarded("hf_retarget_reset", [&] {
    const auto object = get<RetargetObject>(handle, "retarget");
    const Changing changing(*object);
    object->retarget.reset();
  });
}

hf_result hf_retarget_get_info(hf_retarget handle, hf_retarget_info* out_info) {
  return guarded("hf_retarget_get_info", [&] {
    const auto object = get<RetargetObject>(handle, "retarget");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    write_struct(out_info, info_of(*object));
  });
}

hf_result hf_retarget_get_chains(hf_retarget handle, uint32_t capacity, hf_chain_match* out_chains,
                                 uint32_t* out_count) {
  return guarded("hf_retarget_get_chains", [&] {
    const auto object = get<RetargetObject>(handle, "retarget");
    if (!out_chains) require(out_count, "out_chains and out_count");
    const Reading reading(*object);
    const auto& chains = object->retarget.report().chains;
    write_count(out_count, chains.size());
    check_capacity(out_chains, capacity, chains.size(), "capacity");
    for (std::size_t c = 0; out_chains && c < chains.size(); ++c)
      out_chains[c] = {static_cast<std::int32_t>(chains[c].role),
                       static_cast<std::int32_t>(chains[c].side),
                       chains[c].source_joints,
                       chains[c].target_joints,
                       degree_in_radians * chains[c].mean_degrees,
                       degree_in_radians * chains[c].worst_degrees};
  });
}

hf_result hf_retarget_get_partners(hf_retarget handle, uint32_t capacity, uint32_t* out_partners, uint32_t* out_count) {
  return guarded("hf_retarget_get_partners", [&] {
    const auto object = get<RetargetObject>(handle, "retarget");
    if (!out_partners) require(out_count, "out_partners and out_count");
    const Reading reading(*object);
    const std::uint32_t count = object->parts.target->input.joint_count;
    write_count(out_count, count);
    check_capacity(out_partners, capacity, count, "capacity");
    for (std::uint32_t j = 0; out_partners && j < count; ++j) out_partners[j] = HF_NO_INDEX;
    if (out_partners) object->retarget.partners(out_partners);
  });
}

hf_result hf_skeleton_get_ground_velocity(hf_skeleton handle, uint32_t frame_count, const float* poses, double seconds,
                                          double* out_velocity) {
  return guarded("hf_skeleton_get_ground_velocity", [&] {
    const auto skeleton = skeleton_of(handle, "skeleton");
    require_list(frame_count, poses, "frame_count", "poses");
    require(out_velocity, "out_velocity");
    const std::size_t numbers = std::size_t{10} * skeleton->input.joint_count * frame_count;
    const Vector<double> copy(poses, poses + numbers, skeleton->memory.get());
    double velocity[3];
    retarget::find_ground_velocity({skeleton->input, skeleton->character, nullptr}, copy.data(), frame_count, seconds,
                                   velocity, *skeleton->memory);
    std::copy(velocity, velocity + 3, out_velocity);
  });
}

}  // extern "C"
