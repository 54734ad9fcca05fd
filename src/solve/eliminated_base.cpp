#include "solve/eliminated_base.h"

#include "surface/core.h"

namespace hf_inner::solve {

const SymmetricMatrix& PinnedOperator::k() const { return matrix ? *matrix : core->matrix(); }

std::shared_ptr<const EliminatedBase> EliminatedBase::make(const PinnedOperator& a, Span<const Index> unknowns,
                                                           Span<const Index> components, JobRunner& jobs) {
  Memory& memory = *a.memory;
  const auto base = make_shared_in<EliminatedBase>(memory, memory);
  base->vertex.assign(unknowns.begin(), unknowns.end());
  base->index_of.assign(at(a.size()), -1);
  base->floating.assign(a.component_count(), 1);
  Vector<std::uint8_t> eliminated(at(a.size()), 0, &memory);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    eliminated[at(unknowns[i])] = 1;
    base->index_of[at(unknowns[i])] = static_cast<Index>(i);
    base->floating[at(components[i])] = 0;
  }
  SymmetricMatrix pinned(memory);
  pinned.column_start.assign(a.k().column_start.begin(), a.k().column_start.end());
  pinned.row.assign(a.k().row.begin(), a.k().row.end());
  pinned.value.assign(a.k().value.begin(), a.k().value.end());
  for (std::size_t c = 0; c < a.component_count(); ++c) {
    for (std::size_t p = 0; base->floating[c] && p < a.border(); ++p) {
      const Index pin = a.pins[c * a.border() + p];
      if (pin >= 0) pinned.value[pinned.diagonal(pin)] += a.pin_weight[c];
    }
  }
  base->factor = a.factor->refactor(pinned, eliminated, memory, jobs);
  return base;
}

}  // namespace hf_inner::solve
