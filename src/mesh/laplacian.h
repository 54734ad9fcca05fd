// Discrete Laplacians on a Mesh: one weight per edge.
//
// Cotangent: w_ij = (1/2) sum over the triangles of ij of cot(angle opposite ij), cot = (a . b) / |a x b| (Pinkall and
// Polthier 1993). Negative on obtuse pairs. Triangles thinner than 1e-9 are widened first, so that every weight is
// finite and K stays definite.
#pragma once
#include <cstdint>

#include "base/symmetric_matrix.h"
#include "mesh/topology.h"

namespace hf_inner {

enum class OperatorKind : std::int32_t { intrinsic_delaunay = 0, clamped = 1, uniform = 2, cotangent = 3 };

// Which operator of L the field solves: K = L, K = L M^-1 L, or the paper's K = L^2 (biharmonic.h).
enum class FieldKind : std::int32_t { harmonic = 0, biharmonic = 1, biharmonic_graph = 2 };

// Whether the weights of triangle t are not its own: it is so thin that it is widened first.
bool is_widened(const Mesh& mesh, std::int32_t t) noexcept;
// Cotangents at the three corners of triangle t.
void corner_cotangents(const Mesh& mesh, std::int32_t t, double cotangent[3]) noexcept;
// Four times the area of a triangle with these edges, at least that of one that closes by 1e-12.
double quadruple_area(const double length[3]) noexcept;
// Cotangents from edge lengths, cotangent[k] opposite length[k]; lengths that do not close are taken as a
// thin triangle.
void cotangents_of_lengths(const double length[3], double cotangent[3]) noexcept;

// Edge weights w_ij by edge number. Clamped: floored at 1e-3 of the median absolute weight.
// jobs, here and below: threads to use, null for the caller's alone; the result is the same.
Vector<double> edge_weights(const Mesh& mesh, const Topology& topology, OperatorKind kind, Memory& memory,
                            JobRunner* jobs = nullptr);

// Number of edges whose cotangent weight is negative.
std::uint32_t count_negative(const Vector<double>& weights) noexcept;

// Lumped (barycentric) vertex areas: one third of the triangles around.
Vector<double> vertex_areas(const Mesh& mesh, Memory& memory, JobRunner* jobs = nullptr);

// Adds to every stored weight of K a share of the larger diagonal at its ends, keeping K 1 = 0: no vertex is tied to
// the others by less than rounding. Weights stay non-negative.
void tie_weakly(SymmetricMatrix& matrix, double share, Memory& memory);

// The last resort where weights of one component span more digits than a double has, as needles at 1e34 beside parts
// of size 1. Every stored weight is brought within `spread` of the component's median, both ways, keeping K 1 = 0.
// Fields there follow the graph more than the lengths; they stay within the values of their sites. component: by
// vertex; confined: by component, the others stay as they are.
void confine_weights(SymmetricMatrix& matrix, const Vector<std::int32_t>& component,
                     const Vector<std::uint8_t>& confined, double spread, Memory& memory);

// K_ij = -w_ij, K_ii = sum_j w_ij: symmetric, K 1 = 0 exactly in each row up to the rounding of one sum.
SymmetricMatrix laplacian(const Topology& topology, const Vector<double>& weights, Memory& memory,
                          JobRunner* jobs = nullptr);

}  // namespace hf_inner
