// Counts the steps between two joints of a skeleton: 0 for one joint, 1 for parent and child, 2 for siblings. Joints
// that own no vertex do not count: a helper between a shin and its foot is no step. Cost of a query: the logarithm of
// the depth.
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::mesh {

class JointTree {
 public:
  // parents: by joint, HF_NO_INDEX of a root; without a circle. owns: by joint, whether it owns vertices.
  JointTree(Span<const std::uint32_t> parents, Span<const std::uint8_t> owns, Memory& memory);
  // For two joints that own vertices. Roots are 2 apart.
  Index steps(std::uint32_t a, std::uint32_t b) const noexcept;
  // The nearest ancestor that owns vertices, or the number of joints.
  std::uint32_t above(std::uint32_t joint) const noexcept { return above_[joint]; }

 private:
  // The last entries are of a top above all roots.
  Vector<std::uint32_t> above_;
  Vector<std::uint32_t> far_above_;  // one of those above, for long ways
  Vector<Index> depth_;              // joints that own vertices, from the top to this one
};

// Returns a joint on a circle of parents, or HF_NO_INDEX.
std::uint32_t joint_in_circle(Span<const std::uint32_t> parents, Memory& memory);

}  // namespace hf_inner::mesh
