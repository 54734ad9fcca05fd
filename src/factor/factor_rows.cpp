// Reads rows of the factor out of its supernodes. Row j has entries in its own supernode, and in each supernode that
// has j among the rows below its triangle. They form a subtree (Liu 1990).
#include <algorithm>

#include "factor/supernodal_factor.h"

namespace hf_inner::factor {
namespace {

// Replaces a row w of X or of B X by the row w X^-1 of L or of B. x: the packed triangle X.
void multiply_by_triangle(const double* x, std::int32_t count, double* w) noexcept {
  const auto at = [&](std::int64_t row, std::int64_t column) { return x[row * (row + 1) / 2 + column]; };
  for (std::int32_t c = count; c-- > 0;) {
    for (std::int32_t i = c + 1; i < count; ++i) w[c] -= w[i] * at(i, c);
    w[c] /= at(c, c);
  }
}

}  // namespace

bool SupernodalFactor::rows_of(Span<const std::int32_t> unknowns, SparseVectors& out) const {
  struct Visit {
    std::int32_t supernode, place;  // place of the row among those below the triangle, or -1: it is in the triangle
  };
  const Symbolic& s = symbolic();
  Vector<Visit> open(&memory_);
  out.start.assign(1, 0);
  out.row.clear();
  out.value.clear();
  for (const std::int32_t unknown : unknowns) {
    const std::int32_t row = s.position[unknown];
    open.push_back({s.supernode[row], -1});
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const std::int32_t node = visit.supernode, columns = s.columns(node), own = row - s.first[node];
      const bool narrow = columns <= narrow_columns, in_triangle = visit.place < 0;
      const std::int32_t count = in_triangle ? own + 1 : columns;
      const std::size_t begin = out.value.size();
      for (std::int32_t c = 0; c < count; ++c) out.row.push_back(s.first[node] + c);
      if (in_triangle && narrow) {
        out.value.resize(begin + static_cast<std::size_t>(own), 0.0);
        out.value.push_back(1.0);
      } else {
        const double* const from = in_triangle ? triangle(node) + static_cast<std::int64_t>(own) * (own + 1) / 2
                                               : below(node) + static_cast<std::int64_t>(visit.place) * columns;
        out.value.insert(out.value.end(), from, from + count);
        if (in_triangle) out.value.back() = 1 / out.value.back();  // a wide triangle has its diagonal inverted
      }
      if (narrow) multiply_by_triangle(triangle(node), count, out.value.data() + begin);
      for (std::int32_t child = plan().child[node]; child >= 0; child = plan().sibling[child]) {
        const std::int32_t *list = s.row_list(child), *end = list + s.below(child);
        const std::int32_t* const found = std::lower_bound(list, end, row);
        if (found != end && *found == row) open.push_back({child, static_cast<std::int32_t>(found - list)});
      }
    }
    out.start.push_back(static_cast<std::int32_t>(out.value.size()));
  }
  return true;
}

}  // namespace hf_inner::factor
