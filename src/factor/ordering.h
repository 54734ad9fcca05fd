// Fill-reducing orderings: order[k] is the unknown eliminated k-th. All are deterministic and the same for any number
// of threads.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "factor/factor.h"
#include "factor/matrix.h"

namespace hf_inner::factor {

// Throws HF_ERROR_UNSUPPORTED if this build does not have the ordering. Callers ask before they do any work.
void require_ordering(Ordering ordering);

// Computes the chosen ordering. Throws HF_ERROR_UNSUPPORTED if this build does not have it.
void make_order(const SymmetricMatrix& matrix, Coordinates coordinates, Ordering ordering, Memory& memory,
                JobRunner& jobs, Buffer<std::int32_t>& order);

// Approximate minimum degree of the whole matrix (minimum_degree.h).
void order_by_minimum_degree(const SymmetricMatrix& matrix, Memory& memory, Buffer<std::int32_t>& order);

// METIS through CHOLMOD, in src/peers. Both throw HF_ERROR_UNSUPPORTED in builds without HF_WITH_GPL. METIS uses
// rand(), so the host's random sequence is saved and restored.
void require_metis();
void order_by_metis(const SymmetricMatrix& matrix, Memory& memory, Buffer<std::int32_t>& order);

}  // namespace hf_inner::factor
