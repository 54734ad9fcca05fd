// A symmetric sparse matrix. Operators have this format, and factors are computed from it.
#pragma once
#include <algorithm>
#include <cstdint>

#include "base/memory.h"

namespace hf_inner {

// Stores both triangles of a symmetric n x n matrix, compressed by columns. Every column has its diagonal entry, and
// row indices ascend in a column. column_start has n + 1 entries. The matrix has fewer than 2^31 entries.
struct SymmetricMatrix {
  explicit SymmetricMatrix(Memory& memory) : column_start(&memory), row(&memory), value(&memory) {}
  std::int32_t size() const noexcept {
    return column_start.empty() ? 0 : static_cast<std::int32_t>(column_start.size()) - 1;
  }
  // Returns the position of the diagonal entry of column v in `row` and `value`.
  std::size_t diagonal(std::int32_t v) const noexcept {
    const auto begin = row.begin() + column_start[static_cast<std::size_t>(v)],
               end = row.begin() + column_start[static_cast<std::size_t>(v) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, v) - row.begin());
  }
  Vector<std::int32_t> column_start;
  Vector<std::int32_t> row;
  Vector<double> value;
};

}  // namespace hf_inner
