// Numeric supernodal Cholesky factorisation by the multifrontal method (Duff & Reid 1983; Liu 1992, "The multifrontal
// method for sparse matrix solution: theory and practice").
//
// Every supernode assembles a front from its columns of A and the update matrices of its children, factors its columns,
// and leaves -B B' for its parent. Finished columns are written row by row, supernodes last to first, so that a
// backward sweep reads memory forwards: packed lower triangle with the diagonal inverted, then the rows below. Cost:
// flops of the pattern; memory: two stacks of update matrices per thread. On failure `values` is undefined.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/span.h"
#include "factor/kernels.h"
#include "factor/matrix.h"
#include "factor/plan.h"
#include "factor/symbolic.h"

namespace hf_inner {

// Numbers behind the last stored one that sweeps may read over (and ignore).
constexpr std::size_t value_slack = 64;

// `eliminated` (per unknown, may be empty): rows and columns taken as the identity. lost_share: see FactorOptions.
// Throws HF_ERROR_NOT_POSITIVE_DEFINITE with the unknown of the first failed pivot, in factor order.
void factorise(const Symbolic& symbolic, const Plan& plan, const Kernels& kernels, const SymmetricMatrix& matrix,
               Span<const std::uint8_t> eliminated, double lost_share, double* values, Memory& memory, JobRunner& jobs);

// No NaN and no infinity among the numbers.
bool all_finite(const double* values, std::size_t count) noexcept;

// Throws HF_ERROR_NON_FINITE with the column of the first NaN or infinity.
void require_finite(const SymmetricMatrix& matrix);

}  // namespace hf_inner
