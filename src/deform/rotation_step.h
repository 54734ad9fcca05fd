// The result of one Newton step for eight rotations, shared by rotation_batch.cpp and its AVX2, AVX-512 and NEON
// builds.
#pragma once

namespace hf_inner::deform {

struct alignas(64) RotationStep {
  double u[3][8];      // rotation vector of the step
  double pivot[3][8];  // pivots of the Hessian: safely positive near a maximum
  double square[8];    // |u|^2
};

// Finds a Newton step, or takes it if `take` is true. s: nine rows of eight lanes, the matrices. q: four rows, the
// quaternions.
using StepLoop = void (*)(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations_avx2(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations_avx512(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations_neon(const double* s, double* q, RotationStep& step, bool take) noexcept;
StepLoop rotation_loop() noexcept;  // for the widest registers that this processor has

}  // namespace hf_inner::deform
