// argmax tr(R' S) for eight matrices at once: the local steps of poses and of the full-mesh refinement.
//
// The lanes take the Newton steps of best_rotation_from() (rotation.h) and do not depend on each other. So a lane gives
// the same bits beside any neighbours and on every machine. By hand, not with Eigen: eight
// lanes take 25 ns a matrix, one matrix at a time takes 117 ns.
//
// Cost: about 40 ns a matrix on 256-bit lanes when it starts nearby. Allocates nothing, cannot fail.
#pragma once
#include "deform/rotation.h"

namespace hf_inner {

struct alignas(64) RotationBatch {
  static constexpr int lanes = 8;
  double s[9][lanes];  // row-major entries of S
  double q[4][lanes];  // x y z w: where to start (unit), and what was found
  void set_rotation(int lane, const Quaternion& near) noexcept {
    for (int k = 0; k < 4; ++k) q[k][lane] = near.coeffs()(k);
  }
  // columns[j][i] = S(i, j)
  void set_columns(int lane, const double (&columns)[3][4]) noexcept {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) s[3 * i + j][lane] = columns[j][i];
    }
  }
  Quaternion rotation(int lane) const noexcept { return {{q[0][lane], q[1][lane], q[2][lane]}, q[3][lane]}; }
};

// The first `count` lanes; best_rotation() from the same start where the steps do not reach a certified maximum.
void best_rotations_from(RotationBatch& batch, int count) noexcept;

}  // namespace hf_inner
