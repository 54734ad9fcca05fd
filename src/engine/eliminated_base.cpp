#include "engine/eliminated_base.h"

namespace hf_inner {

std::shared_ptr<const EliminatedBase> EliminatedBase::make(const Core& core, Span<const std::int32_t> vertices,
                                                           JobRunner& jobs) {
  Memory& memory = *core.memory;
  const auto base = make_shared_in<EliminatedBase>(memory, memory);
  base->vertex.assign(vertices.begin(), vertices.end());
  base->index_of.assign(static_cast<std::size_t>(core.size()), -1);
  base->floating.assign(static_cast<std::size_t>(core.mesh.component_count()), 1);
  Vector<std::uint8_t> eliminated(static_cast<std::size_t>(core.size()), 0, &memory);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::size_t v = static_cast<std::size_t>(vertices[i]);
    eliminated[v] = 1, base->index_of[v] = static_cast<std::int32_t>(i);
    base->floating[static_cast<std::size_t>(core.mesh.component[v])] = 0;
  }
  SymmetricMatrix a = grounded(core);
  // only floating components stay grounded
  for (std::size_t c = 0; c < core.ground.size(); ++c) {
    if (base->floating[c]) continue;
    const std::size_t diagonal = a.diagonal(core.ground[c]);
    a.value[diagonal] = core.laplacian.value[diagonal];
  }
  base->factor = core.factor->refactor(a, eliminated, memory, jobs);
  return base;
}

}  // namespace hf_inner
