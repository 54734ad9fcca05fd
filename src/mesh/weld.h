// Joins vertices at one place: per given vertex the smallest given vertex it is joined with.
//
// Exact: equal coordinates (+0 = -0). Tolerance: not further apart than the tolerance, transitively. Cost O(n log n).
// Long calls poll, and those by tolerance report their share.
#pragma once
#include "mesh/mesh.h"

namespace hf_inner {

Vector<std::int32_t> weld(const MeshInput& input, Memory& memory);

// The part of it that joins equal coordinates.
Vector<std::int32_t> weld_exact(const MeshInput& input, Memory& memory);
// The part of it that joins within input.weld_tolerance. Throws HF_ERROR_INVALID_ARGUMENT for a tolerance that is no
// finite number above 0.
Vector<std::int32_t> weld_tolerance(const MeshInput& input, Memory& memory);

}  // namespace hf_inner
