// Which closed pieces of a mesh face inwards.
#pragma once
#include <cstdint>

#include "mesh/mesh.h"

namespace hf_inner {

// By component: -1 where the triangles are closed and face inwards (their signed volume is negative), else 1. Open
// components have no inside. Cost: O(n).
Vector<std::int8_t> component_sides(const Mesh& mesh, Memory& memory);

}  // namespace hf_inner
