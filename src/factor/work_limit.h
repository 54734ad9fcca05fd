// Limits on the work of a factorisation, kept before it begins.
#pragma once
#include "base/memory.h"
#include "factor/matrix.h"

namespace hf_inner::factor {

// Throws HF_ERROR_TOO_LARGE if `flops` exceed `flop_limit`, with both numbers. 0 = no limit.
void require_work(double flops, double flop_limit);

// Minimum degree may give so many times the flops of nested dissection on graphs with hubs; on random graphs both are
// alike to 5 %. Less could refuse what nested dissection makes cheap; more orders soups that are refused afterwards.
constexpr double minimum_degree_times = 4;

// Refuses a matrix whose unknowns are joined at random, if minimum degree gives its factor more than `times` the
// `flop_limit`. The cuts of nested dissection and the product of a bi-harmonic operator take seconds on such a matrix,
// minimum degree a tenth. Costs a search of some levels on other matrices. Throws HF_ERROR_TOO_LARGE.
void refuse_soup(const SymmetricMatrix& matrix, double flop_limit, double times, Memory& memory);

}  // namespace hf_inner::factor
