// Joins vertices that lie at one place. Returns for each vertex of the caller the vertex of lowest number that it is
// joined with.
//
// Exact welding joins equal coordinates (+0 = -0). Tolerance welding joins vertices that are closer than the tolerance,
// transitively. It sorts the vertices into grid cells as wide as the tolerance and searches at most 27 cells. Cost: O(n
// log n).
#pragma once
#include "mesh/mesh.h"

namespace hf_inner::mesh {

Vector<std::int32_t> weld(const MeshInput& input, Memory& memory);

// The part of it that joins equal coordinates.
Vector<std::int32_t> weld_exact(const MeshInput& input, Memory& memory);
// The part of it that joins within input.weld_tolerance. Throws HF_ERROR_INVALID_ARGUMENT for a tolerance that is no
// finite number above 0.
Vector<std::int32_t> weld_tolerance(const MeshInput& input, Memory& memory);

}  // namespace hf_inner::mesh
