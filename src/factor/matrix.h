// The matrix a factor is made of. Knows no mesh: numbers and coordinates only.
#pragma once
#include "base/span.h"
#include "base/symmetric_matrix.h"

namespace hf_inner {

// Coordinates of the unknowns, xyz per unknown, used by the geometric part of the ordering; may be empty.
using Coordinates = Span<const float>;

}  // namespace hf_inner
