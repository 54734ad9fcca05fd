// Finds the components of a surface that do not factor.
//
// A matrix without entries between components is definite when every block is. So each is factorised on its own;
// together they cost what the whole matrix does. A component whose weights spread over more digits than a double has
// says nothing about the others.
#pragma once
#include "engine/core.h"

namespace hf_inner {

// By component: whether its block of the pinned matrix A has a failed pivot, or one near to failing, so that the others
// factor in the order of the whole. Deterministic. Throws what a factorisation does, except for a failed pivot.
Vector<std::uint8_t> lost_components(const Core& core, const FactorOptions& options);

}  // namespace hf_inner
