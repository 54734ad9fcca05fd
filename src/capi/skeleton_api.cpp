// Implements hf/skeleton.h.
#include <algorithm>

#include "base/arguments.h"
#include "capi/skeleton_object.h"

namespace hf_inner::capi {
namespace {

std::uint32_t number_of(std::int32_t index) { return index < 0 ? HF_NO_INDEX : static_cast<std::uint32_t>(index); }

void write_point(Vec3 v, double* out) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

void add(Vector<char>& text, const char* words) { text.insert(text.end(), words, words + std::strlen(words)); }

Vector<char> reasons_of(const skeleton::Character& character, Memory& memory) {
  Vector<char> out(&memory);
  const auto axis = [&](const char* name, const Vector<char>& why) {
    if (why.empty()) return;
    add(out, name);
    out.insert(out.end(), why.begin(), why.end());
    out.push_back('\n');
  };
  axis("up: ", character.up_why);
  axis("forward: ", character.forward_why);
  out.insert(out.end(), character.why.begin(), character.why.end());
  out.push_back('\0');
  return out;
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_skeleton_create(const hf_skeleton_desc* given, hf_skeleton* out_skeleton) {
  return create("hf_skeleton_create", out_skeleton, "out_skeleton", [&] {
    const hf_skeleton_desc desc = read_struct(given, "desc");
    const hf_skin_desc skin = read_optional(desc.skin, "skin");
    check_allocator(desc.allocator);
    return with_progress(desc.progress, [&] {
      const auto memory = make_memory(desc.allocator, 0);
      return make_owner_in<SkeletonObject>(
          memory, make_owner_in<skeleton::KnownSkeleton>(memory, desc, desc.skin ? &skin : nullptr, memory));
    });
  });
}

void hf_skeleton_destroy(hf_skeleton skeleton) { destroy<SkeletonObject>(skeleton); }

hf_result hf_skeleton_get_info(hf_skeleton handle, hf_skeleton_info* out_info) {
  return guarded("hf_skeleton_get_info", [&] {
    const auto object = get<SkeletonObject>(handle, "skeleton");
    check_struct(out_info, "out_info");
    const skeleton::Character& character = object->skeleton->character;
    hf_skeleton_info info{};
    info.joint_count = object->skeleton->input.joint_count;
    info.chain_count = static_cast<std::uint32_t>(character.chains.size());
    write_point(character.up, info.up);
    write_point(character.forward, info.forward);
    write_point(character.left, info.left);
    write_point(character.middle, info.middle);
    info.up_confidence = character.up_confidence;
    info.forward_confidence = character.forward_confidence;
    info.left_confidence = character.left_confidence;
    info.role_confidence = character.role_confidence;
    info.height = character.height;
    info.leg_length = character.leg_length;
    info.hip_height = character.hip_height;
    info.arm_length = character.arm_length;
    write_struct(out_info, info);
  });
}

hf_result hf_skeleton_get_joints(hf_skeleton handle, uint32_t capacity, hf_joint_info* out_joints,
                                 uint32_t* out_count) {
  return guarded("hf_skeleton_get_joints", [&] {
    const auto object = get<SkeletonObject>(handle, "skeleton");
    if (!out_joints) require(out_count, "out_joints and out_count");
    const skeleton::Character& character = object->skeleton->character;
    write_count(out_count, character.kinds.size());
    check_capacity(out_joints, capacity, character.kinds.size(), "capacity");
    for (std::size_t j = 0; out_joints && j < character.kinds.size(); ++j)
      out_joints[j] = {static_cast<std::int32_t>(character.kinds[j]), static_cast<std::int32_t>(character.roles[j]),
                       static_cast<std::int32_t>(character.sides[j]), number_of(character.joint_chains[j]),
                       number_of(character.mates[j])};
  });
}

hf_result hf_skeleton_get_chains(hf_skeleton handle, uint32_t capacity, hf_chain* out_chains, uint32_t* out_count) {
  return guarded("hf_skeleton_get_chains", [&] {
    const auto object = get<SkeletonObject>(handle, "skeleton");
    if (!out_chains) require(out_count, "out_chains and out_count");
    const auto& chains = object->skeleton->character.chains;
    write_count(out_count, chains.size());
    check_capacity(out_chains, capacity, chains.size(), "capacity");
    for (std::size_t c = 0; out_chains && c < chains.size(); ++c) {
      const skeleton::Chain& chain = chains[c];
      out_chains[c] = {static_cast<std::int32_t>(chain.role),
                       static_cast<std::int32_t>(chain.side),
                       chain.number,
                       number_of(chain.parent),
                       chain.first,
                       chain.count,
                       chain.length};
    }
  });
}

hf_result hf_skeleton_get_chain_joints(hf_skeleton handle, uint32_t capacity, uint32_t* out_joints,
                                       uint32_t* out_count) {
  return guarded("hf_skeleton_get_chain_joints", [&] {
    const auto object = get<SkeletonObject>(handle, "skeleton");
    if (!out_joints) require(out_count, "out_joints and out_count");
    const auto& joints = object->skeleton->character.chain_joints;
    write_count(out_count, joints.size());
    check_capacity(out_joints, capacity, joints.size(), "capacity");
    if (out_joints) std::copy(joints.begin(), joints.end(), out_joints);
  });
}

hf_result hf_skeleton_get_reasons(hf_skeleton handle, size_t capacity, char* out_text, size_t* out_size) {
  return guarded("hf_skeleton_get_reasons", [&] {
    const auto object = get<SkeletonObject>(handle, "skeleton");
    if (!out_text) require(out_size, "out_text and out_size");
    const Vector<char> text = reasons_of(object->skeleton->character, *object->skeleton->memory);
    if (out_size) *out_size = text.size();
    check_capacity(out_text, capacity, text.size(), "capacity");
    if (out_text) std::copy(text.begin(), text.end(), out_text);
  });
}

}  // extern "C"
