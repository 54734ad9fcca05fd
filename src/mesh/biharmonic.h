// The bi-harmonic operators of a Laplacian L, fourth order: fields with continuous slope at their sites, which
// overshoot the site values.
//
//     K = L M^-1 L     M = lumped vertex areas, scaled to mean 1 in every component: the same field at any scale of the
//                      mesh (Botsch and Kobbelt 2004)
//     K = L^2          M = 1, the paper's (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.2): depends on the sampling
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

// Weights of L above `times` their median are cut to it: squared, the stiff ties between vertices that nearly coincide
// would swamp the rest of K and cost it its definiteness. Returns how many were.
std::int32_t cap_weights(SymmetricMatrix& laplacian, double times, Memory& memory);

// L diag(inverse_mass) L; an empty inverse_mass stands for ones. jobs: threads to use, null for the caller's alone.
SymmetricMatrix biharmonic(const SymmetricMatrix& laplacian, const Vector<double>& inverse_mass, Memory& memory,
                           JobRunner* jobs = nullptr);

}  // namespace hf_inner
