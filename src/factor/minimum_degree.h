// Approximate minimum degree: a fill-reducing order of a whole graph.
//
// Method: Amestoy, Davis & Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix Anal. Appl. 17, 1996.
// All decisions use integers, and ties go to the variable that joined its degree list last. So every system gets the
// same order.
#pragma once
#include <cstdint>

#include "base/memory.h"

namespace hf_inner::factor {

// Orders a symmetric graph. The neighbours of v are neighbour[start[v]] to neighbour[start[v + 1] - 1]; v itself may be
// among them. order[k] is the vertex eliminated k-th. Throws HF_ERROR_TOO_LARGE beyond about 1.7e9 neighbours.
void order_graph_by_minimum_degree(std::int32_t size, const std::int32_t* start, const std::int32_t* neighbour,
                                   Memory& memory, Buffer<std::int32_t>& order);

}  // namespace hf_inner::factor
