// Returns the factor of a matrix that differs from a factorised one in a few entries, without a new factorisation.
//
// R are the k unknowns whose rows differ, E_R their columns of the identity, and D the k x k change:
//
//     A' = A + E_R D E_R',   P A P' = G G',   Y = G^-1 P E_R        (Y: the elimination paths of R)
//     P A' P' = G (I + Y D Y') G' = (G T) (G T)'
//
// C = Y'Y is a principal block of A^-1, so it has a Cholesky factor H: C = H H'. The other one exists only if A' is
// positive definite: I + H' D H = L L'. Then T is a small change of the identity:
//
//     T = I + Y H'^-1 (L - I) H^-1 Y',   T^-1 = I + Y W Y',   W = H'^-1 (L^-1 - I) H^-1
//
// So a sweep with the factor G T is a sweep with G and a product with Y. An elimination path T^-1 y is the path y with
// k more numbers. Every other object works with the pair as with any factor. D is always counted from A, so errors do
// not add up over many edits.
//
// The products D_ii C_ii say how many times larger a change is than what it changes. The largest of them times 2^-52,
// over the least pivot of I + H' D H, is about the relative error of a solution (FactorStatistics::rounding). It is
// large on long shapes, at needles, and where a soft region is beside a stiff one.
//
// Cost: k paths, and about k^3 operations. A sweep costs 2 k products with a path more. Yeung, Crouch and Pothen (2016)
// solve the same equations with an iterative method; here they are solved exactly.
#pragma once
#include "factor/factor.h"

namespace hf_inner {

// The change D of a matrix on a few unknowns, as sparse entries of both triangles.
struct MatrixChange {
  explicit MatrixChange(Memory& memory) : unknown(&memory), entries(&memory) {}
  struct Entry {
    std::int32_t row, column;  // positions in `unknown`
    double value;
  };
  Vector<std::int32_t> unknown;  // ascending, in the caller's numbering
  Vector<Entry> entries;         // by row
};

// Returns the factor of A', which shares `base`, the factor of A. Throws HF_ERROR_NOT_POSITIVE_DEFINITE (index: an
// unknown) if A' is not positive definite, std::bad_alloc, or HF_ERROR_CANCELLED.
std::shared_ptr<const Factor> edit_factor(std::shared_ptr<const Factor> base, const MatrixChange& change,
                                          Memory& memory, JobRunner& jobs);

}  // namespace hf_inner
