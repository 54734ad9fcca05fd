// The operator that a ConstraintSystem constrains, as a view of what its owner keeps alive.
//
// K is semi-definite: it may map to zero a constant, or a parallel field, on every component. So one vertex of every
// component is pinned, A = K + sum_c beta_c E_c E_c', and A is factorised. Pinning must not change the answer:
//   - K maps constants to zero (fields): the lambda of a component sum to 0, and the component gets a constant;
//   - any other K (direction fields): the paths of the pins, Y_g = G^-1 P E_g, take the pins away again.
#pragma once
#include "base/index.h"
#include "base/jobs.h"
#include "base/symmetric_matrix.h"
#include "factor/factor.h"

namespace hf_inner {

// Columns Y_g of the pins, by component and pin, and C = Y_g'Y_g - I / beta.
struct PinPaths {
  explicit PinPaths(Memory& memory) : groups(&memory), group(&memory), column(&memory), corner(&memory) {}
  Vector<std::shared_ptr<const PathGroup>> groups;
  Vector<Index> group, column;  // where the path of a pin lies
  Vector<double> corner;        // border x border numbers of every component
};

struct PinnedOperator {
  static constexpr std::size_t most_border = 2;
  Index size() const noexcept { return matrix->size(); }
  std::size_t component_count() const noexcept { return pin_weight.size(); }
  // Pins of a component, and so the width of the border of its dense block.
  std::size_t border() const noexcept { return pin_weight.empty() ? 1 : pins.size() / pin_weight.size(); }
  bool keeps_constants() const noexcept { return paths == nullptr; }

  const SymmetricMatrix* matrix = nullptr;  // K
  const Factor* factor = nullptr;           // of A
  Span<const Index> pins;                   // pinned unknowns, border() of every component
  Span<const double> pin_weight;            // beta by component; the unit of stiffness too
  const PinPaths* paths = nullptr;          // null: K maps constants to zero
  Memory* memory = nullptr;
  JobRunner* jobs = nullptr;
};

}  // namespace hf_inner
