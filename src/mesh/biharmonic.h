// The bi-harmonic operators of a Laplacian L, fourth order: fields with continuous slope at their sites, which
// overshoot the site values.
//
//     K = L M^-1 L     M = lumped vertex areas, with mean 1 in every component (Botsch and Kobbelt 2004).
//                      The field is the same at any scale of the mesh.
//     K = L^2          M = 1 (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.2). The field depends on the sampling.
//
// The graph of K is the two-ring graph of the mesh, about 3.4 times the entries of L; its fill-reducing order must be
// computed on that graph. The diagonal is minus the sum of the rest of its column, so that K annihilates constants to
// rounding. Symmetric to the bit. Cost: O(sum of squared valences), in parallel.
#pragma once
#include "base/symmetric_matrix.h"
#include "mesh/mesh.h"

namespace hf_inner {

// 1 / m of every vertex, from vertex areas: mean 1 by component, masses floored at a ten-thousandth of it, so that a
// vertex of zero-area triangles does not swamp its neighbours.
Vector<double> inverse_masses(const Mesh& mesh, Vector<double> areas);

// Cuts weights of L to `times` their median and returns how many it cut. Squared, the weights between vertices that
// nearly coincide would exceed the rest of K by more than its digits, and K would not be definite.
// changed: null, or by vertex, set where a weight was cut.
std::int32_t cap_weights(SymmetricMatrix& laplacian, double times, Memory& memory,
                         Vector<std::uint8_t>* changed = nullptr);

// L diag(inverse_mass) L; an empty inverse_mass stands for ones. jobs: threads to use, null for the caller's alone.
SymmetricMatrix biharmonic(const SymmetricMatrix& laplacian, const Vector<double>& inverse_mass, Memory& memory,
                           JobRunner* jobs = nullptr);

}  // namespace hf_inner
