// The result of a Newton step of eight rotations, for rotation_batch.cpp and its wider builds.
#pragma once

namespace hf_inner {

struct alignas(64) RotationStep {
  double u[3][8];      // rotation vector of the step
  double pivot[3][8];  // of the Hessian: all safely positive near a maximum
  double square[8];    // |u|^2
};

// s: nine rows of eight lanes, q: four. take: the step is taken; otherwise it is found.
using StepLoop = void (*)(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations_avx2(const double* s, double* q, RotationStep& step, bool take) noexcept;
void step_rotations_avx512(const double* s, double* q, RotationStep& step, bool take) noexcept;
StepLoop rotation_loop() noexcept;  // the widest this processor has

}  // namespace hf_inner
