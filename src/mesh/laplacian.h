// Discrete Laplacians on a Mesh: one weight per edge.
//
// Cotangent: w_ij = (1/2) sum over the triangles of ij of cot(angle opposite ij), cot = (a . b) / |a x b| (Pinkall and
// Polthier 1993). Negative on obtuse pairs. Triangles thinner than 1e-9 are widened first, so that every weight is
// finite and K stays definite.
#pragma once
#include <cstdint>

#include "base/symmetric_matrix.h"
#include "mesh/topology.h"

namespace hf {

enum class OperatorKind : std::int32_t { cotangent = 0, clamped = 1, uniform = 2 };

// Edge weights w_ij by edge number. Clamped: floored at 1e-3 of the median absolute weight.
Vector<double> edge_weights(const Mesh& mesh, const Topology& topology, OperatorKind kind, Memory& memory);

// Number of edges whose cotangent weight is negative.
std::uint32_t count_negative(const Vector<double>& weights) noexcept;

// Lumped (barycentric) vertex areas: one third of the triangles around.
Vector<double> vertex_areas(const Mesh& mesh, Memory& memory);

// K_ij = -w_ij, K_ii = sum_j w_ij: symmetric, K 1 = 0 exactly in each row up to the rounding of one sum.
SymmetricMatrix laplacian(const Topology& topology, const Vector<double>& weights, Memory& memory);

}  // namespace hf
