// Returns the factor of a matrix that differs from a factorised one in a few entries, without a new factorisation.
//
// R are the k unknowns whose rows differ, E_R their columns of the identity, and D the k x k change:
//
//     A' = A + E_R D E_R',   P A P' = G G'
//
// An unknown of R is inside if its row of A has entries in R alone, and on the rim if not. The vectors
//
//     V = G^-1 P [E_rim, A E_inside] = [Y, G' P E_inside]
//
// span what G^-1 P E_R spans. Only the rim needs elimination paths Y. The others are rows of G, which are short. Their
// products are known: V'V = C is the rim's block of A^-1 beside the inside's block of A, and nothing between the two.
// With E_R = [E_rim, A E_inside] B^-1 the change is
//
//     P A' P' = G (I + V B^-1 D B'^-1 V') G' = (G T) (G T)'
//
// C = H H' by blocks, and I + H' B^-1 D B'^-1 H = L L' exists only if A' is positive definite. Then T is a small change
// of the identity:
//
//     T = I + V H'^-1 (L - I) H^-1 V',   T^-1 = I + V W V',   W = H'^-1 (L^-1 - I) H^-1
//
// So a sweep with the factor G T is a sweep with G and a product with V. An elimination path T^-1 y is the path y with
// k more numbers, and V'y is known for the inside: the weights of the site there. Every other object works with the
// pair as with any factor. D is always counted from A, so errors do not add up over many edits.
//
// D_ii (A^-1)_ii says how large a change is beside its row, and L_ii^2 how much softer the matrix becomes there. The
// largest D_ii (A^-1)_ii / min(1, L_ii^2) times 2^-52 is about the relative error of a solution
// (FactorStatistics::rounding). It is large on long shapes and at needles.
//
// Cost: a path for each of the r unknowns of the rim, the inside's rows of G, two sparse factors of the inside, and
// about 3 k r^2 operations. A sweep costs two products with V more. Yeung, Crouch and Pothen (2016) solve the same
// equations with an iterative method; here they are solved exactly.
#pragma once
#include "factor/factor.h"

namespace hf_inner::factor {

// The change D of a matrix on a few unknowns, as sparse entries of both triangles.
struct MatrixChange {
  explicit MatrixChange(Memory& memory)
      : unknown(&memory), entries(&memory), inside(&memory), inside_entries(&memory) {}
  struct Entry {
    std::int32_t row, column;  // positions in `unknown`
    double value;
  };
  Vector<std::int32_t> unknown;  // ascending, in the caller's numbering
  Vector<Entry> entries;         // by row
  // The unknowns inside, as ascending positions in `unknown`, and all entries of their rows of A. Those whose rows the
  // caller does not know count as the rim.
  Vector<std::int32_t> inside;
  Vector<Entry> inside_entries;
};

// Returns the factor of A', which shares `base`, the factor of A. Throws HF_ERROR_NOT_POSITIVE_DEFINITE (index: an
// unknown) if A' is not positive definite, std::bad_alloc, or HF_ERROR_CANCELLED.
std::shared_ptr<const Factor> edit_factor(std::shared_ptr<const Factor> base, const MatrixChange& change,
                                          Memory& memory, JobRunner& jobs);

}  // namespace hf_inner::factor
