#include "factor/ordering.h"

#include "base/error.h"
#include "factor/dissection.h"
#include "factor/minimum_degree.h"

namespace hf_inner::factor {

void require_ordering(Ordering ordering) {
  if (ordering == Ordering::metis) require_metis();
}

void order_by_minimum_degree(const SymmetricMatrix& matrix, Memory& memory, Buffer<std::int32_t>& order) {
  order_graph_by_minimum_degree(matrix.size(), matrix.column_start.data(), matrix.row.data(), memory, order);
}

void make_order(const SymmetricMatrix& matrix, Coordinates coordinates, Ordering ordering, Memory& memory,
                JobRunner& jobs, Buffer<std::int32_t>& order) {
  require_ordering(ordering);
  switch (ordering) {
    case Ordering::nested_dissection:
      return order_by_dissection(matrix, coordinates, memory, jobs, order);
    case Ordering::minimum_degree:
      return order_by_minimum_degree(matrix, memory, order);
    case Ordering::metis:
      return order_by_metis(matrix, memory, order);
    case Ordering::natural:
      order.allocate(memory, static_cast<std::size_t>(matrix.size()));
      for (std::int32_t k = 0; k < matrix.size(); ++k) order[k] = k;
      return;
  }
  fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "unknown ordering %d", static_cast<int>(ordering));
}

}  // namespace hf_inner::factor
