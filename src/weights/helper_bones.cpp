#include "weights/helper_bones.h"

#include <algorithm>

#include "weights/bone_names.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

// Chosen on 13 shared rigs of 415 joints. These points propose 31 of the 37 joints without weights, and 3 of the
// others. A threshold of 3 proposes 32 and 17.
constexpr HelperPoints helper_points[] = {{helper_name_root, 3},  {helper_name_control, 2}, {helper_name_end, 1},
                                          {helper_root, 1},       {helper_apart, 1},        {helper_no_length, 1},
                                          {helper_coincident, 1}, {helper_outside, 2},      {helper_informs_none, 2}};
constexpr int helper_threshold = 4;

// Words in names of bones that carry no skin, in rigs of Blender, Maya, Unreal, Unity and Mixamo.
constexpr const char* root_words[] = {"root",  "armature", "master",     "global",
                                      "world", "origin",   "trajectory", "rootjoint"};
constexpr const char* control_words[] = {"pole",       "target", "poletarget", "pt",   "ik",     "ctrl",  "control",
                                         "controller", "ctl",    "handle",     "mch",  "helper", "dummy", "locator",
                                         "null",       "ikgoal", "goal",       "look", "lookat"};
constexpr const char* end_words[] = {"end", "tip", "nub", "endsite", "leaf", "slot", "socket", "attach", "handslot"};

template <std::size_t count>
bool has_word(const BoneName& name, const char* const (&words)[count]) {
  bool found = false;
  for_words(name, [&](std::size_t begin, std::size_t end) {
    for (const char* word : words) found |= is_word(name, begin, end, word);
  });
  return found;
}

std::uint32_t name_reasons(const BoneName& name) {
  std::uint32_t out = 0;
  if (has_word(name, root_words)) out |= helper_name_root;
  if (has_word(name, control_words)) out |= helper_name_control;
  if (has_word(name, end_words)) out |= helper_name_end;
  return out;
}

int points_of(std::uint32_t reasons) noexcept {
  int sum = 0;
  for (const HelperPoints& entry : helper_points) sum += (reasons & entry.reason) ? entry.points : 0;
  return sum;
}

}  // namespace

Vector<std::uint32_t> helper_reasons(const Bones& bones, const Vector<std::uint32_t>& faults, Span<const char> names,
                                     Memory& memory) {
  const std::size_t count = bones.head.size();
  Vector<std::uint32_t> out(count, 0u, &memory);
  Vector<Index> children(count, 0, &memory);
  for (const Index parent : bones.parent) {
    if (parent >= 0) ++children[at(parent)];
  }
  const Vector<BoneName> lines = split_names(names, memory);
  for (std::size_t b = 0; b < count; ++b) {
    if (!bones.deforms[b]) continue;
    const Index parent = bones.parent[b];
    std::uint32_t reasons = b < lines.size() ? name_reasons(lines[b]) : 0u;
    if (parent < 0 && children[b] > 0) reasons |= helper_root;
    if (children[b] == 0 && parent >= 0 && bones.parent[at(parent)] < 0 && children[at(parent)] > 1)
      reasons |= helper_apart;
    if (faults[b] & bone_no_length) reasons |= helper_no_length;
    if (faults[b] & bone_coincident) reasons |= helper_coincident;
    if (faults[b] & bone_outside) reasons |= helper_outside;
    if (faults[b] & bone_informs_none) reasons |= helper_informs_none;
    if (points_of(reasons) >= helper_threshold) reasons |= helper_proposed;
    out[b] = reasons;
  }
  return out;
}

}  // namespace hf_inner::weights
