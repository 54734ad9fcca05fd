// argmax tr(R' S) for eight matrices side by side: the local steps of poses and of the full-mesh refinement, where
// thousands of rotations are asked for at once. The Newton steps of best_rotation_from() (rotation.h) in lanes that do
// not see each other: what a lane gives depends on its own numbers only, and the bits are those of every machine.
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
    q[0][lane] = near.x, q[1][lane] = near.y, q[2][lane] = near.z, q[3][lane] = near.w;
  }
  // columns[j][i] = S(i, j)
  void set_columns(int lane, const double (&columns)[3][4]) noexcept {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) s[3 * i + j][lane] = columns[j][i];
    }
  }
  Quaternion rotation(int lane) const noexcept { return {q[0][lane], q[1][lane], q[2][lane], q[3][lane]}; }
};

// The first `count` lanes; best_rotation() from the same start where the steps do not settle on a certified maximum.
void best_rotations_from(RotationBatch& batch, int count) noexcept;

}  // namespace hf_inner
