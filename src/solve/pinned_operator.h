// The operator K that a ConstraintSystem constrains. The struct is a view; its owner keeps the data alive.
//
// K is semi-definite: on every component it may map a constant, or a parallel vector field, to zero. So one vertex of
// every component is pinned, and A = K + sum_c beta_c E_c E_c' is factorised as P A P' = G G'. E_c are the pinned
// unknowns of component c, and beta_c is the weight of the pin. Pinning must not change the solution. There are two
// cases.
// - Case 1: K maps constants to zero (scalar fields). Then the fluxes lambda of a component sum to 0, and the solution
//   gets a constant.
// - Case 2: any other K (direction fields). Then the elimination paths of the pins, Y_g = G^-1 P E_g, remove the effect
//   of the pins.
#pragma once
#include "base/index.h"
#include "base/jobs.h"
#include "base/symmetric_matrix.h"
#include "factor/factor.h"
#include "solve/dense_block.h"

namespace hf_inner::surface {
struct Core;
}

namespace hf_inner::solve {

// The columns Y_g of the pinned unknowns, by component and pin, and the matrix C = Y_g'Y_g - I / beta.
struct PinPaths {
  explicit PinPaths(Memory& memory) : groups(&memory), group(&memory), column(&memory), corner(&memory) {}
  Vector<std::shared_ptr<const factor::PathGroup>> groups;
  Vector<Index> group, column;  // group and column in which the path of a pinned unknown lies
  Vector<double> corner;        // border x border numbers of every component
};

struct PinnedOperator {
  static constexpr std::size_t most_border = DenseBlock::most_border;
  Index size() const noexcept { return factor->size(); }
  std::size_t component_count() const noexcept { return pin_weight.size(); }
  // Returns the number of pinned unknowns of a component. Its dense system has as many additional (border) unknowns.
  std::size_t border() const noexcept { return pin_weight.empty() ? 1 : pins.size() / pin_weight.size(); }
  bool keeps_constants() const noexcept { return paths == nullptr; }

  // K: from the core, or the matrix. The matrix of an edited core is made at its first use.
  const SymmetricMatrix& k() const;
  const SymmetricMatrix* matrix = nullptr;
  const surface::Core* core = nullptr;
  const factor::Factor* factor = nullptr;  // of K with raised diagonals at the pins
  // Unknowns with raised diagonals, border() per component. A component that is definite by itself has -1 there, no
  // path, and a corner below 0 (screened.h).
  Span<const Index> pins;
  // By component: how much the diagonals are raised; the unit of stiffness too.
  Span<const double> pin_weight;
  const PinPaths* paths = nullptr;  // elimination paths of the pins; null: K maps constants to zero
  Memory* memory = nullptr;
  JobRunner* jobs = nullptr;
};

}  // namespace hf_inner::solve
