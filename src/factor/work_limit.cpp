#include "factor/work_limit.h"

#include <algorithm>

#include "base/error.h"
#include "base/progress.h"
#include "factor/ordering.h"
#include "factor/symbolic.h"

namespace hf_inner::factor {
namespace {

// A graph is searched from so many unknowns, so many levels deep. The widest level of random triangles is the second to
// sixth. Half and twice the levels, and half the starts, find the same soups among seven, and none of ten meshes.
constexpr std::int32_t starts = 4, most_levels = 24;
// A level with more than this share of the unknowns marks the graph random. Ten meshes of 2,700 to 62,000 vertices have
// 0.006 to 0.073, random triangles 0.49 to 0.96. Half marks no mesh either, double misses one soup of seven. Hubs are
// marked too, which costs one minimum degree.
constexpr double widest_share = 0.25;
// Smaller matrices take milliseconds in any ordering.
constexpr std::int32_t least_size = 1000;

bool is_random(const SymmetricMatrix& matrix, Memory& memory) {
  const std::int32_t n = matrix.size();
  const double most = widest_share * n;
  Buffer<std::int32_t> seen(memory, static_cast<std::size_t>(n));
  std::fill(seen.begin(), seen.end(), -1);
  Vector<std::int32_t> level(&memory), next(&memory);
  for (std::int32_t k = 0; k < starts; ++k) {
    level.assign(1, static_cast<std::int32_t>(static_cast<std::int64_t>(n) * k / starts));
    for (std::int32_t depth = 0; depth < most_levels && !level.empty(); ++depth) {
      poll();
      next.clear();
      for (const std::int32_t v : level) {
        for (std::int32_t e = matrix.column_start[v]; e < matrix.column_start[v + 1]; ++e) {
          const std::int32_t w = matrix.row[e];
          if (seen[w] != k) {
            seen[w] = k;
            next.push_back(w);
          }
        }
      }
      if (static_cast<double>(next.size()) > most) return true;
      level.swap(next);
    }
  }
  return false;
}

}  // namespace

void require_work(double flops, double flop_limit) {
  if (!(flop_limit > 0 && flops > flop_limit)) return;
  fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
       "the factorisation takes %.0f * 10^9 operations, and the work_limit_gflop is %.0f; triangles that join far "
       "vertices at random cost that much. Raise the limit or repair the mesh",
       1e-9 * flops, 1e-9 * flop_limit);
}

void refuse_soup(const SymmetricMatrix& matrix, double flop_limit, double times, Memory& memory) {
  if (!(flop_limit > 0) || matrix.size() < least_size || !is_random(matrix, memory)) return;
  Buffer<std::int32_t> order;
  order_by_minimum_degree(matrix, memory, order);
  const FillEstimate fill = estimate_fill(matrix, Span<const std::int32_t>(order.data(), order.size()), memory);
  if (fill.flops > times * flop_limit) require_work(fill.flops, flop_limit);
}

}  // namespace hf_inner::factor
