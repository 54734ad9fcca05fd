#include "mesh/joint_tree.h"

#include <utility>

#include "hf/base.h"

namespace hf_inner::mesh {

JointTree::JointTree(Span<const std::uint32_t> parents, Span<const std::uint8_t> owns, Memory& memory)
    : above_(parents.size() + 1, 0, &memory),
      far_above_(above_.size(), 0, &memory),
      depth_(above_.size(), -1, &memory) {
  const std::uint32_t top = static_cast<std::uint32_t>(parents.size());
  above_[top] = far_above_[top] = top;
  depth_[top] = 0;
  Vector<std::uint32_t> way(&memory);
  for (std::uint32_t j = 0; j < top; ++j) {
    const auto parent = [&](std::uint32_t joint) { return parents[joint] == HF_NO_INDEX ? top : parents[joint]; };
    for (std::uint32_t at = j; depth_[at] < 0; at = parent(at)) way.push_back(at);
    for (; !way.empty(); way.pop_back()) {
      const std::uint32_t joint = way.back(), direct = parent(joint),
                          up = direct == top || owns[direct] ? direct : above_[direct], far = far_above_[up];
      above_[joint] = up;
      depth_[joint] = depth_[up] + 1;
      // Two steps of one length above make one of twice that: any depth is reached in about 2 log steps.
      far_above_[joint] = depth_[up] - depth_[far] == depth_[far] - depth_[far_above_[far]] ? far_above_[far] : up;
    }
  }
}

Index JointTree::steps(std::uint32_t a, std::uint32_t b) const noexcept {
  const Index both = depth_[a] + depth_[b];
  if (depth_[a] < depth_[b]) std::swap(a, b);
  while (depth_[a] > depth_[b]) a = depth_[far_above_[a]] >= depth_[b] ? far_above_[a] : above_[a];
  while (a != b) {
    const Vector<std::uint32_t>& up = far_above_[a] != far_above_[b] ? far_above_ : above_;
    a = up[a];
    b = up[b];
  }
  return both - 2 * depth_[a];
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

}  // namespace hf_inner::mesh
