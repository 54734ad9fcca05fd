// The matrix of a factor. It is independent of meshes: only numbers and coordinates.
#pragma once
#include "base/span.h"
#include "base/symmetric_matrix.h"

namespace hf_inner::factor {

// Coordinates of the unknowns, xyz per unknown, for the geometric part of the ordering. May be empty.
using Coordinates = Span<const float>;

}  // namespace hf_inner::factor
