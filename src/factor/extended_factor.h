// A factor of another one's matrix and of a multiple of the identity beside it, for unknowns that came later:
//
//     A' = [ A   0   ]
//          [ 0  s² I ]
//
// An edit of it (edited_factor.h) then puts the entries of the new unknowns in. Unknowns that went keep their rows and
// columns of A, without entries to the others. So a factor can have more unknowns than the caller: the unknowns
// of the caller come first, and the unknowns that went follow.
#pragma once
#include "factor/factor.h"

namespace hf_inner::factor {

// rows: by unknown, its row in the base, or size() of the base + j for the j-th new one. Its first `count` entries are
// the unknowns in use: refactor takes a matrix of these alone. scale: s.
std::shared_ptr<const Factor> extend_factor(std::shared_ptr<const Factor> base, Vector<std::int32_t>&& rows,
                                            std::int32_t count, double scale, Memory& memory);

}  // namespace hf_inner::factor
