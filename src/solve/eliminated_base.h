// The rebase: takes many hard vertex sites out of the matrix. The rows and columns of these sites become the identity.
// Pattern, ordering and symbolic analysis stay. A component without such a site stays pinned. The object is immutable,
// and clones share it. It does not contain the values of the sites.
//
// With E the vertices of the sites, s_E their values and F the other vertices:
//     u_F = A_FF^-1 (-K_FE s_E + ...),   A_FF = K_FF (+ pins)
#pragma once
#include "solve/pinned_operator.h"

namespace hf_inner::solve {

struct EliminatedBase {
  explicit EliminatedBase(Memory& memory) : vertex(&memory), index_of(&memory), floating(&memory) {}
  // Factorises with some vertices eliminated. unknowns: these vertices, each once. components: the component of each
  // unknown. Cost: one numeric factorisation.
  static std::shared_ptr<const EliminatedBase> make(const PinnedOperator& a, Span<const Index> unknowns,
                                                    Span<const Index> components, JobRunner& jobs);

  Index count() const noexcept { return static_cast<Index>(vertex.size()); }
  bool eliminated(Index v) const noexcept { return index_of[at(v)] >= 0; }

  Vector<Index> vertex;           // the eliminated unknowns
  Vector<Index> index_of;         // by unknown: position in `vertex`, or -1
  Vector<std::uint8_t> floating;  // by component: 1 if no vertex of it is eliminated
  std::shared_ptr<const factor::Factor> factor;
};

}  // namespace hf_inner::solve
