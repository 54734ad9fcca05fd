// Makes rows of a fixed length with whole-number weights, as vertex buffers of engines hold them.
//
// The heaviest weights w of a vertex are scaled to the sum 1 and rounded to units of 1 / total by largest remainders,
// so that the units sum to exactly `total`. Let d be the changes of the weights; they sum to 0. A vertex that its
// clusters move to places x_c goes astray by |sum d_c x_c| <= (sum |d_c|) / 2 times the largest distance between the
// x_c. That half sum is the change of the row.
#pragma once
#include <cstdint>

#include "base/span.h"

namespace hf_inner::deform {

// At most this many entries in a row; more than any engine reads. It bounds a table on the stack.
constexpr std::uint32_t most_row_entries = 64;

struct FixedRow {
  std::uint16_t cluster[most_row_entries];  // by falling weight; where units are 0, the cluster of the first entry
  std::uint32_t units[most_row_entries];
};

// Writes the first `count` entries (1 to most_row_entries) of `out`. The row is not empty, its clusters ascend, and its
// weights are positive and sum to 1. total: at most 2^24. Returns the change of the row. Cost: row length times count.
double fix_row(Span<const std::uint16_t> cluster, Span<const float> weight, std::uint32_t count, std::uint32_t total,
               FixedRow& out) noexcept;

}  // namespace hf_inner::deform
