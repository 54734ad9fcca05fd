#include "factor/ordering.h"

#include <amd.h>

#include <algorithm>

#include "base/error.h"
#include "factor/dissection.h"

namespace hf_inner {
namespace {

// AMD asks for room of a fifth of the pattern and more.
constexpr std::size_t elbow_divisor = 5;

}  // namespace

void order_graph_by_minimum_degree(std::int32_t size, const std::int32_t* start, const std::int32_t* neighbour,
                                   Memory& memory, Buffer<std::int32_t>& order) {
  const std::size_t n = static_cast<std::size_t>(size);
  order.allocate(memory, n);
  if (size == 0) return;
  // the core routine of AMD takes the pattern without diagonal and destroys it; it wants elbow room of a fifth
  std::size_t pattern = static_cast<std::size_t>(start[size] - start[0]);
  const std::size_t room = pattern + pattern / elbow_divisor + n + 1;
  if (room > static_cast<std::size_t>(INT32_MAX)) {
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the matrix has %zu entries; minimum degree takes at most about 1.7e9",
         pattern);
  }
  Buffer<std::int32_t> graph(memory, room);
  Buffer<std::int32_t> work(memory, n * 8);
  std::int32_t* begin = work.data();
  std::int32_t* length = begin + n;
  std::int32_t free_at = 0;
  for (std::int32_t j = 0; j < size; ++j) {
    begin[j] = free_at;
    for (std::int32_t e = start[j]; e < start[j + 1]; ++e) {
      if (neighbour[e] != j) graph[free_at++] = neighbour[e];
    }
    length[j] = free_at - begin[j];
  }
  double control[AMD_CONTROL], info[AMD_INFO];
  amd_defaults(control);
  amd_2(size, begin, graph.data(), length, static_cast<std::int32_t>(room), free_at, length + n, length + 2 * n,
        order.data(), length + 3 * n, length + 4 * n, length + 5 * n, length + 6 * n, control, info);
}

void order_by_minimum_degree(const SymmetricMatrix& matrix, Memory& memory, Buffer<std::int32_t>& order) {
  order_graph_by_minimum_degree(matrix.size(), matrix.column_start.data(), matrix.row.data(), memory, order);
}

void make_order(const SymmetricMatrix& matrix, Coordinates coordinates, Ordering ordering, Memory& memory,
                JobRunner& jobs, Progress* progress, Buffer<std::int32_t>& order) {
  switch (ordering) {
    case Ordering::nested_dissection:
      return order_by_dissection(matrix, coordinates, memory, jobs, progress, order);
    case Ordering::minimum_degree:
      return order_by_minimum_degree(matrix, memory, order);
    case Ordering::metis:
#if defined(HF_WITH_GPL)
      return order_by_metis(matrix, memory, order);
#else
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "METIS needs a build with HF_WITH_GPL; use nested dissection");
#endif
    case Ordering::natural:
      order.allocate(memory, static_cast<std::size_t>(matrix.size()));
      for (std::int32_t k = 0; k < matrix.size(); ++k) order[k] = k;
      return;
  }
  fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "unknown ordering %d", static_cast<int>(ordering));
}

}  // namespace hf_inner
