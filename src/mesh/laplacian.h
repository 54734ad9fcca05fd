// Discrete Laplacians of a Mesh, with one weight w_ij for each edge ij.
//
// The cotangent weight w_ij is half the sum of the cotangents of the angles opposite ij (Pinkall and Polthier 1993). It
// is negative if these angles sum to more than pi. Triangles thinner than 1e-9 are widened first, so that every weight
// is finite and the Laplacian K stays semi-definite.
#pragma once
#include <cstdint>

#include "base/symmetric_matrix.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

// graph: the weights of the caller (graph.h).
enum class OperatorKind : std::int32_t { intrinsic_delaunay = 0, clamped = 1, uniform = 2, cotangent = 3, graph = 4 };

// Selects the matrix K that a field solves with. K is made of the Laplacian L and the vertex masses M (biharmonic.h): K
// = L, K = L M^-1 L, or K = L^2.
enum class FieldKind : std::int32_t { harmonic = 0, biharmonic = 1, biharmonic_graph = 2 };

// Whether the weights of triangle t are not its own: it is so thin that it is widened first.
bool is_widened(const Mesh& mesh, std::int32_t t) noexcept;
// Computes the cotangents at the three corners of triangle t.
void corner_cotangents(const Mesh& mesh, std::int32_t t, double cotangent[3]) noexcept;
// The same for a triangle with these corners.
void corner_cotangents(const Vec3 p[3], double cotangent[3]) noexcept;
// The same for a thin triangle, which is widened first.
void widened_cotangents(const Vec3 p[3], double cotangent[3]) noexcept;
// Returns four times the area of a triangle with these edge lengths. Lengths that violate the triangle inequality count
// as a very thin triangle.
double quadruple_area(const double length[3]) noexcept;
// Computes cotangents from edge lengths; cotangent[k] is opposite length[k]. Lengths that violate the triangle
// inequality count as a thin triangle.
void cotangents_of_lengths(const double length[3], double cotangent[3]) noexcept;

// Returns the edge weights w_ij by edge number. The clamped operator raises them to at least 1e-3 of the median
// absolute weight. In this header, `jobs` are the threads to use, or null for the calling thread; the result is the
// same.
Vector<double> edge_weights(const Mesh& mesh, const Topology& topology, OperatorKind kind, Memory& memory,
                            JobRunner* jobs = nullptr);

// Returns the number of edges whose cotangent weight is negative.
std::uint32_t count_negative(const Vector<double>& weights) noexcept;

// Returns the least weight of the clamped operator: 1e-3 of the median absolute weight.
double clamped_floor(const Vector<double>& weights, Memory& memory);

// Returns the lumped (barycentric) vertex areas: one third of the area of the triangles around each vertex.
Vector<double> vertex_areas(const Mesh& mesh, Memory& memory, JobRunner* jobs = nullptr);

// Raises every weight of K by `share` of the larger diagonal entry at its two vertices, and updates the diagonal so
// that K times ones stays 0. So no connection of a vertex is weaker than rounding. Weights stay non-negative.
void tie_weakly(SymmetricMatrix& matrix, double share, Memory& memory);

// Limits the weights of a component to the range median / spread .. median * spread. Use it when weights span more
// digits than a double has, such as needle triangles with weights of 1e34 beside weights of 1. K times ones stays 0.
// Fields there follow the edge graph more than the lengths, but stay within their site values. component: by vertex.
// confined: by component, 1 to limit its weights.
void confine_weights(SymmetricMatrix& matrix, Span<const std::int32_t> component, const Vector<std::uint8_t>& confined,
                     double spread, Memory& memory);

// Returns the symmetric matrix K with K_ij = -w_ij and K_ii = sum_j w_ij. Each row sums to zero up to the rounding of
// K_ii.
SymmetricMatrix laplacian(const Topology& topology, const Vector<double>& weights, Memory& memory,
                          JobRunner* jobs = nullptr);

}  // namespace hf_inner::mesh
