#include "factor/ordering.h"

#include "base/error.h"
#include "factor/dissection.h"
#include "factor/minimum_degree.h"

namespace hf_inner {
void order_by_minimum_degree(const SymmetricMatrix& matrix, Memory& memory, Buffer<std::int32_t>& order) {
  order_graph_by_minimum_degree(matrix.size(), matrix.column_start.data(), matrix.row.data(), memory, order);
}

void make_order(const SymmetricMatrix& matrix, Coordinates coordinates, Ordering ordering, Memory& memory,
                JobRunner& jobs, Buffer<std::int32_t>& order) {
  switch (ordering) {
    case Ordering::nested_dissection:
      return order_by_dissection(matrix, coordinates, memory, jobs, order);
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
