// The bi-harmonic operators K of a Laplacian L. Their fields have continuous slope at the sites and can overshoot the
// site values.
//
//     K = L M^-1 L     M = lumped vertex areas, with mean 1 in every component (Botsch and Kobbelt 2004).
//                      The field is the same at any scale of the mesh.
//     K = L^2          M = 1 (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.2). The field depends on how densely the
//     mesh is sampled.
//
// K connects every vertex with the vertices within two edges, so it has about 3.4 times the entries of L. Compute its
// fill-reducing ordering on this graph. Each diagonal entry is minus the sum of the other entries of its column, so K
// times a constant is zero up to rounding. K is symmetric bit for bit. Cost: O(sum of squared valences), in parallel.
//
// A vertex with d neighbours gives K a dense block of d x d entries. So K is not formed where a vertex has very many of
// them. It is then applied as two products with L, and solve/mixed_solver.h solves with L alone.
#pragma once
#include "base/symmetric_matrix.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Returns 1 / m for every vertex, with the masses m from the vertex areas, scaled to mean 1 in every component. Each
// mass is at least a ten-thousandth of that mean. Otherwise a vertex of zero-area triangles would dominate its
// neighbours.
Vector<double> inverse_masses(const Mesh& mesh, Vector<double> areas);

// Limits the weights of L to `times` their median and returns how many weights it changed. K squares the weights.
// Weights between vertices that nearly coincide would then exceed the rest of K by more digits than a double has, and K
// would not be positive definite. changed: NULL, or by vertex. It is set where a weight was limited. rounding: weights
// of at most this size do not count for the median.
std::int32_t cap_weights(SymmetricMatrix& laplacian, double times, Memory& memory,
                         Vector<std::uint8_t>* changed = nullptr, double rounding = 0);

// Returns L diag(inverse_mass) L. An empty inverse_mass stands for ones. jobs: threads to use; null = the calling
// thread.
SymmetricMatrix biharmonic(const SymmetricMatrix& laplacian, const Vector<double>& inverse_mass, Memory& memory,
                           JobRunner* jobs = nullptr);

// Returns whether a vertex has more than `most` neighbours in L.
bool exceeds_valence(const SymmetricMatrix& laplacian, std::int32_t most) noexcept;

// Writes out_v = scale_v sum_j L_vj (u_j - u_v), with `channels` numbers per vertex. The differences keep the digits
// that a large constant in u would cost. An empty scale stands for ones. out must not be u.
void apply_laplacian(const SymmetricMatrix& laplacian, const Vector<double>& scale, const double* u,
                     std::int32_t channels, double* out, JobRunner& jobs);

// Returns the diagonal of L diag(inverse_mass) L, which need not be formed.
Vector<double> biharmonic_diagonal(const SymmetricMatrix& laplacian, const Vector<double>& inverse_mass,
                                   Memory& memory);

}  // namespace hf_inner::mesh
