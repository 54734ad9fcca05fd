// Computes the numbers of a supernodal Cholesky factor by the multifrontal method (Duff & Reid 1983; Liu 1992, "The
// multifrontal method for sparse matrix solution: theory and practice").
//
// Every supernode assembles a front from its columns of A and the update matrices of its children. It factors its
// columns, and leaves the update matrix -B B' for its parent. Finished columns are written row by row, supernodes from
// last to first, so that a backward sweep reads memory forwards. A supernode is stored as its packed lower triangle
// with inverted diagonal, then its rows below. The pattern determines the number of flops. Memory: two stacks of update
// matrices per thread. After a failure `values` is undefined.
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

namespace hf_inner::factor {

// The factor ends with this many spare numbers. Sweeps may read them, but ignore their values.
constexpr std::size_t value_slack = 64;

// Factorises the matrix. `eliminated` (per unknown, may be empty) marks rows and columns that count as the identity.
// lost_share: see FactorOptions. Throws HF_ERROR_NOT_POSITIVE_DEFINITE; index: the unknown of the first failed pivot in
// factor order.
void factorise(const Symbolic& symbolic, const Plan& plan, const Kernels& kernels, const SymmetricMatrix& matrix,
               Span<const std::uint8_t> eliminated, double lost_share, double* values, Memory& memory, JobRunner& jobs);

// Tells whether no number is NaN or infinite.
bool all_finite(const double* values, std::size_t count) noexcept;

// Throws HF_ERROR_NON_FINITE for the first NaN or infinity; index: its column.
void require_finite(const SymmetricMatrix& matrix);

}  // namespace hf_inner::factor
