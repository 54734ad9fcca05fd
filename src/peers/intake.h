// Checks the arguments of the baselines.
#pragma once
#include "surface/core.h"

namespace hf_inner::peers {

// Returns the weight of a hard site as a penalty, relative to the mean diagonal of K; 0 gives the default. Throws
// HF_ERROR_INVALID_ARGUMENT.
double read_penalty(double given);

// Throws HF_ERROR_UNSUPPORTED for a core whose bi-harmonic K is not formed (Core::root): these engines need its
// entries.
void require_formed(const surface::Core& core);

}  // namespace hf_inner::peers
