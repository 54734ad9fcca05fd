// Finds the components of a surface whose matrix cannot be factorised.
//
// The matrix has no entries between components, so it is positive definite if every component's block is. So each block
// is factorised alone. Together the blocks cost as much as the whole matrix. The failure of one block, whose weights
// may span more digits than a double has, does not affect the others.
#pragma once
#include "surface/core.h"

namespace hf_inner::surface {

// Returns, for each component, whether its block of the pinned matrix A has a failed pivot or one near to failing.
// Without these components the whole matrix can be factorised. The test asks more of a pivot than a factorisation,
// because the whole matrix has another ordering. The result is deterministic. Throws what a factorisation throws,
// except for a failed pivot.
Vector<std::uint8_t> lost_components(const Core& core, const factor::FactorOptions& options);

}  // namespace hf_inner::surface
