// Joins vertices at one place: per given vertex the smallest given vertex it is joined with.
//
// Exact: equal coordinates (+0 = -0). Tolerance: closer than the tolerance, transitively, through a grid of cells as
// wide as the tolerance (at most 27 cells to search). Cost O(n log n).
#pragma once
#include "mesh/mesh.h"

namespace hf_inner {

Vector<std::int32_t> weld(const MeshInput& input, Memory& memory);

}  // namespace hf_inner
