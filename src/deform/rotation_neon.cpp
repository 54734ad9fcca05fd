// The Newton steps of rotation_batch.cpp with two matrices (lanes) in a register; the bits are the same. Every 64-bit
// ARM processor can run it.
#include <cstring>

#include "base/compiler.h"
#include "deform/rotation_step.h"

namespace hf_inner::deform {
namespace {

HF_VECTOR(Lanes, double, 2);

#include "deform/rotation_step.inl"

}  // namespace

void step_rotations_neon(const double* s, double* q, RotationStep& step, bool take) noexcept {
  step_lanes<Lanes>(s, q, step, take);
}

}  // namespace hf_inner::deform
