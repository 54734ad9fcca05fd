#include "surface/lost_components.h"

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::surface {
namespace {

// A component can be factorised if its pivots exceed the usual limit by this factor. The whole matrix has another
// ordering, so components near to failing count as well. A larger factor would limit the weights of components that
// could be factorised. Half and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double margin = 16;

}  // namespace

Vector<std::uint8_t> lost_components(const Core& core, const factor::FactorOptions& options) {
  Memory& memory = *core.memory;
  const std::size_t n = at(core.size()), components = core.ground.size();
  const SharedVector<Index>& component = core.mesh.component;
  // Sorts the vertices by component, and numbers the vertices of each component.
  Vector<Index> start(components + 1, 0, &memory), vertex(n, &memory), place(n, &memory);
  for (std::size_t v = 0; v < n; ++v) ++start[at(component[v]) + 1];
  for (std::size_t c = 0; c < components; ++c) start[c + 1] += start[c];
  Vector<Index> next(start.begin(), start.end() - 1, &memory);
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t c = at(component[v]);
    place[v] = next[c] - start[c];
    vertex[at(next[c]++)] = static_cast<Index>(v);
  }
  factor::FactorOptions used;
  used.ordering = options.ordering;
  used.lost_share = margin * options.lost_share;
  Vector<std::uint8_t> lost(components, 0, &memory);
  const SymmetricMatrix& k = core.laplacian;
  for (std::size_t c = 0; c < components; ++c) {
    SymmetricMatrix block(memory);
    block.column_start.push_back(0);
    for (Index i = start[c]; i < start[c + 1]; ++i) {
      const Index v = vertex[at(i)];
      for (std::size_t e = at(k.column_start[at(v)]); e < at(k.column_start[at(v) + 1]); ++e) {
        const double beta = k.row[e] == v && v == core.ground[c] ? core.mean_diagonal[c] : 0.0;
        block.row.push_back(place[at(k.row[e])]);
        block.value.push_back(k.value[e] + beta);
      }
      block.column_start.push_back(static_cast<Index>(block.row.size()));
    }
    try {
      factor::Factor::make(block, {}, used, memory, *core.jobs);
    } catch (const Error& error) {
      if (error.code() != HF_ERROR_NOT_POSITIVE_DEFINITE) throw;
      lost[c] = 1;
    }
  }
  return lost;
}

}  // namespace hf_inner::surface
