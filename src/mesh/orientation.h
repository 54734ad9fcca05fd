// Which pieces of a mesh are open, and which closed ones face inwards.
#pragma once
#include <cstdint>

#include "mesh/mesh.h"

namespace hf_inner::mesh {

// By component: -1 where the triangles are closed and face inwards (their signed volume is negative), else 1. Open
// components have no inside. Cost: O(n).
Vector<std::int8_t> component_sides(const Mesh& mesh, Memory& memory);
// By component: the length of the sum of its area vectors as a share of its area. 0: closed, 1: flat. Cost: O(n).
Vector<double> component_openness(const Mesh& mesh, Memory& memory);

}  // namespace hf_inner::mesh
