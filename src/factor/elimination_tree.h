// Computes the elimination tree, its postorder, and the column counts of a permuted symmetric pattern. The papers are
// named in symbolic.h.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"
#include "factor/matrix.h"

namespace hf_inner::factor {

// The pattern of P A P' and its elimination tree, with the unknowns numbered in postorder of the tree: label[k] is the
// k-th unknown.
struct EliminationTree {
  Buffer<std::int32_t> label;        // label[k]: the unknown eliminated k-th
  Buffer<std::int32_t> parent;       // parent label, -1 for a root
  Buffer<std::int32_t> count;        // non-zeros of the factor's column, diagonal included
  Buffer<std::int32_t> lower_start;  // neighbours with a smaller label, row by row
  Buffer<std::int32_t> lower;
};

void make_elimination_tree(const SymmetricMatrix& matrix, Span<const std::int32_t> order, Memory& memory,
                           EliminationTree& out);

}  // namespace hf_inner::factor
