#include "deform/rotation_batch.h"

#include <cstring>

#include "base/compiler.h"
#include "deform/constants.h"
#include "deform/rotation_step.h"

namespace hf_inner::deform {
namespace {

#include "deform/rotation_step.inl"

constexpr int batch_lanes = RotationBatch::lanes;

struct LaneState {
  double floor;  // pivots up to this number are not safely positive
  bool open;     // needs more steps; if not, it has converged or failed
  bool lost;     // the steps reached no proven maximum
};

// Marks lanes whose Newton step cannot be trusted as lost, and sets the steps of lanes that need none to zero. Returns
// whether any lane needs more steps.
bool judge(RotationStep& step, LaneState (&state)[batch_lanes]) noexcept {
  bool open = false;
  for (int l = 0; l < batch_lanes; ++l) {
    LaneState& lane = state[l];
    const bool good = step.pivot[0][l] > lane.floor && step.pivot[1][l] > lane.floor && step.pivot[2][l] > lane.floor &&
                      step.square[l] <= longest_newton_step;
    const bool moves = lane.open && good;
    lane.lost = lane.lost || (lane.open && !good);
    lane.open = moves && step.square[l] >= settled_newton_step;
    open = open || lane.open;
    if (!moves) step.u[0][l] = step.u[1][l] = step.u[2][l] = 0;
  }
  return open;
}

}  // namespace

void step_rotations(const double* s, double* q, RotationStep& step, bool take) noexcept {
  step_lanes<double>(s, q, step, take);
}

StepLoop rotation_loop() noexcept {
#ifdef HF_DEFORM_AVX512
  if (HF_PROCESSOR_HAS("avx512f")) return &step_rotations_avx512;
#endif
#ifdef HF_DEFORM_AVX2
  if (HF_PROCESSOR_HAS("avx2")) return &step_rotations_avx2;
#endif
#ifdef HF_DEFORM_NEON
  return &step_rotations_neon;
#else
  return &step_rotations;
#endif
}

void best_rotations_from(RotationBatch& batch, int count) noexcept {
  for (int l = count; l < batch_lanes; ++l) {
    for (auto& row : batch.s) row[l] = 0;
    batch.set_rotation(l, Quaternion());
  }
  const RotationBatch start = batch;
  LaneState state[batch_lanes];
  for (int l = 0; l < batch_lanes; ++l) {
    double square = 0;
    for (const auto& row : batch.s) square += row[l] * row[l];
    const bool usable = square > least_matrix_square && square < largest_matrix_square;
    state[l] = {usable ? newton_floor * std::sqrt(square) : 0.0, usable, !usable};
  }
  const StepLoop loop = rotation_loop();
  RotationStep step;
  for (int iteration = 0; iteration < newton_steps; ++iteration) {
    loop(batch.s[0], batch.q[0], step, false);
    const bool open = judge(step, state);
    loop(batch.s[0], batch.q[0], step, true);
    if (!open) break;
  }
  for (int l = 0; l < count; ++l) {
    if (!state[l].lost && !state[l].open) {
      batch.set_rotation(l, normalised(batch.rotation(l)));
      continue;
    }
    Mat3 s;
    for (int k = 0; k < 9; ++k) s(k / 3, k % 3) = batch.s[k][l];
    batch.set_rotation(l, best_rotation(s, start.rotation(l)));
  }
}

}  // namespace hf_inner::deform
