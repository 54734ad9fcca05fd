// The rebase: many hard vertex sites are taken out of the matrix itself. Their rows and columns become the identity
// (the pattern, the ordering and the symbolic analysis stand), every component that keeps no such site is grounded as
// before. Immutable, shared by clones; the sites' values are not part of it.
//
//     u_F = A_FF^-1 (-K_FE s_E + ...),   A_FF = K_FF (+ ground)
#pragma once
#include "engine/site_solver.h"

namespace hf_inner {

struct EliminatedBase {
  explicit EliminatedBase(Memory& memory) : vertex(&memory), index_of(&memory), floating(&memory) {}
  // vertices: inner, each once. Cost: one numeric factorisation.
  static std::shared_ptr<const EliminatedBase> make(const Core& core, Span<const std::int32_t> vertices,
                                                    JobRunner& jobs);

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(vertex.size()); }
  bool eliminated(std::int32_t v) const noexcept { return index_of[static_cast<std::size_t>(v)] >= 0; }

  Vector<std::int32_t> vertex;    // by base index
  Vector<std::int32_t> index_of;  // by inner vertex; -1: free
  Vector<std::uint8_t> floating;  // by component: nothing eliminated, so A is grounded there
  std::shared_ptr<const Factor> factor;
};

}  // namespace hf_inner
