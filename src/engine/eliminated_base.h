// The rebase: many hard vertex sites are taken out of the matrix itself. Their rows and columns become the identity;
// pattern, ordering and symbolic analysis stay. A component that keeps no such site stays pinned. Immutable, shared by
// clones; the values of the sites are not part of it.
//
//     u_F = A_FF^-1 (-K_FE s_E + ...),   A_FF = K_FF (+ pins)
#pragma once
#include "engine/pinned_operator.h"

namespace hf_inner {

struct EliminatedBase {
  explicit EliminatedBase(Memory& memory) : vertex(&memory), index_of(&memory), floating(&memory) {}
  // unknowns: each once; components: of these. Cost: one numeric factorisation.
  static std::shared_ptr<const EliminatedBase> make(const PinnedOperator& a, Span<const Index> unknowns,
                                                    Span<const Index> components, JobRunner& jobs);

  Index count() const noexcept { return static_cast<Index>(vertex.size()); }
  bool eliminated(Index v) const noexcept { return index_of[at(v)] >= 0; }

  Vector<Index> vertex;           // unknowns by base index
  Vector<Index> index_of;         // by unknown; -1: not eliminated
  Vector<std::uint8_t> floating;  // by component: nothing is eliminated, so A is pinned there
  std::shared_ptr<const Factor> factor;
};

}  // namespace hf_inner
