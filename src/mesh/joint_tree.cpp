#include "mesh/joint_tree.h"

#include "hf/base.h"

namespace hf_inner {

JointTree::JointTree(Span<const std::uint32_t> parents, Span<const std::uint8_t> owns, Memory& memory)
    : parent_(parents.begin(), parents.end(), &memory),
      depth_(parents.size(), -1, &memory),
      owners_(parents.size(), 0, &memory) {
  Vector<std::uint32_t> way(&memory);
  for (std::size_t j = 0; j < parents.size(); ++j) {
    way.clear();
    for (std::uint32_t at = static_cast<std::uint32_t>(j); at != HF_NO_INDEX && depth_[at] < 0; at = parents[at])
      way.push_back(at);
    for (; !way.empty(); way.pop_back()) {
      const std::uint32_t joint = way.back(), above = parents[joint];
      depth_[joint] = above == HF_NO_INDEX ? 0 : depth_[above] + 1;
      owners_[joint] = (above == HF_NO_INDEX ? 0 : owners_[above]) + owns[joint];
    }
  }
}

Index JointTree::steps(std::uint32_t a, std::uint32_t b) const noexcept {
  const Index both = owners_[a] + owners_[b];
  while (a != b && a != HF_NO_INDEX && b != HF_NO_INDEX) {
    std::uint32_t& deeper = depth_[a] >= depth_[b] ? a : b;
    deeper = parent_[deeper];
  }
  return a == b && a != HF_NO_INDEX ? both - 2 * owners_[a] : both;
}

std::uint32_t joint_in_circle(Span<const std::uint32_t> parents, Memory& memory) {
  enum : std::uint8_t { unseen, on_way, done };
  Vector<std::uint8_t> state(parents.size(), unseen, &memory);
  for (std::size_t j = 0; j < parents.size(); ++j) {
    std::uint32_t at = static_cast<std::uint32_t>(j);
    for (; at != HF_NO_INDEX && state[at] == unseen; at = parents[at]) state[at] = on_way;
    if (at != HF_NO_INDEX && state[at] == on_way) return at;
    for (at = static_cast<std::uint32_t>(j); at != HF_NO_INDEX && state[at] == on_way; at = parents[at])
      state[at] = done;
  }
  return HF_NO_INDEX;
}

}  // namespace hf_inner
