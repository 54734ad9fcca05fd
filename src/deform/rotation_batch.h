// Finds the best rotations argmax tr(R' S) for eight matrices S at once.
//
// Poses and the full-mesh refinement use it for their local steps. Each lane takes the Newton steps of
// best_rotation_from() (rotation.h), independent of the other lanes. So a lane gives the same bits beside any
// neighbours and on every machine. It is written by hand, because eight lanes take 25 ns per matrix, and one matrix at
// a time with Eigen takes 117 ns.
//
// Cost: about 40 ns per matrix on 256-bit registers when it starts nearby. Allocates nothing and cannot fail.
#pragma once
#include "deform/rotation.h"

namespace hf_inner::deform {

struct alignas(64) RotationBatch {
  static constexpr int lanes = 8;
  double s[9][lanes];  // row-major entries of S
  double q[4][lanes];  // x y z w: the start (unit), then the result
  void set_rotation(int lane, const Quaternion& near) noexcept {
    for (int k = 0; k < 4; ++k) q[k][lane] = near.coeffs()(k);
  }
  // Sets the matrix S of one lane (problem of the batch). columns[j][i] is the entry of S in row i and column j.
  void set_columns(int lane, const double (&columns)[3][4]) noexcept {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) s[3 * i + j][lane] = columns[j][i];
    }
  }
  Quaternion rotation(int lane) const noexcept { return {{q[0][lane], q[1][lane], q[2][lane]}, q[3][lane]}; }
};

// Finds the rotations of the first `count` lanes (problems of the batch). Where the steps reach no proven maximum, it
// calls best_rotation() from the same start.
void best_rotations_from(RotationBatch& batch, int count) noexcept;

}  // namespace hf_inner::deform
