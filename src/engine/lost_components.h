// Which components of a surface do not factor. A matrix without entries between components is definite when every block
// is, so each is factorised on its own: together they cost what the whole matrix does, and one component whose weights
// spread over more digits than there are says nothing about the others.
#pragma once
#include "engine/core.h"

namespace hf_inner {

// By component: whether its block of the grounded matrix A loses a pivot. Those near to it count too, so that the
// whole, in an order of its own, keeps what is not named. Deterministic. Throws what a factorisation does, but for a
// lost pivot; nothing is changed then.
Vector<std::uint8_t> lost_components(const Core& core, const FactorOptions& options);

}  // namespace hf_inner
