// Elimination tree, postorder and column counts of a permuted symmetric pattern; see symbolic.h for the sources.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"
#include "factor/matrix.h"

namespace hf_inner {

// Pattern of P A P' and its elimination tree, all in postordered labels: label[k] = unknown.
struct EliminationTree {
  Buffer<std::int32_t> label;        // label -> unknown
  Buffer<std::int32_t> parent;       // parent label, -1 for a root
  Buffer<std::int32_t> count;        // non-zeros of the column of G, diagonal included
  Buffer<std::int32_t> lower_start;  // neighbours with a smaller label, by rows: [lower_start[i], lower_start[i + 1])
  Buffer<std::int32_t> lower;
};

void make_elimination_tree(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory,
                           EliminationTree& out);

}  // namespace hf_inner
