// The Newton steps of rotation_batch.cpp with eight matrices (lanes) in a register; the bits are the same. The build
// uses -mavx512f, and the program chooses the loop at run time. The file includes no header with inline functions,
// because their AVX-512 code could be linked into other files.
#include <cstring>

#include "base/compiler.h"
#include "deform/rotation_step.h"

namespace hf_inner::deform {
namespace {

HF_VECTOR(Lanes, double, 8);

#include "deform/rotation_step.inl"

}  // namespace

void step_rotations_avx512(const double* s, double* q, RotationStep& step, bool take) noexcept {
  step_lanes<Lanes>(s, q, step, take);
}

}  // namespace hf_inner::deform
