// Includes Eigen for small dense algebra. No other header of src includes Eigen directly.
//
// The macros below make results the same bits on every machine. Vectorisation is off, because the lane count would
// change the order of sums. Threads are off, and the build forbids contraction (a * b + c in one rounding). All sizes
// are fixed, so Eigen never allocates; the test tests/unit/rooms checks this. Matrices start at zero.
//
// The macro `Eigen` renames Eigen's namespace to hf_eigen. A host may compile Eigen with other flags and link
// hf_static. With one name the linker would keep only one of two different functions. Include this header before any
// header that includes Eigen itself.
#pragma once
#ifdef EIGEN_CORE_H
#error "base/algebra.h must come before any other header that includes Eigen"
#endif

#define EIGEN_DONT_VECTORIZE
#define EIGEN_DONT_PARALLELIZE
#define EIGEN_MAX_ALIGN_BYTES 0
#define EIGEN_INITIALIZE_MATRICES_BY_ZERO
#define EIGEN_MPL2_ONLY
#define EIGEN_NO_IO
#define Eigen hf_eigen
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#undef Eigen

#include "base/vec3.h"

namespace hf_inner {

using Mat3 = hf_eigen::Matrix3d;
static_assert(alignof(Mat3) == alignof(double),
              "arrays of Mat3 and of structs that hold one need no special alignment");

// Written out, like rotate() of deform/rotation.h, because Eigen's expressions are calls where a compiler builds for
// size: a step of refine took four times as long in WebAssembly. The order of sums is Eigen's. Inlining all of Eigen
// there instead adds 11 kB and no speed.
inline Vec3 operator*(const Mat3& a, Vec3 v) noexcept {
  const double* m = a.data();
  return {m[0] * v.x + (m[3] * v.y + m[6] * v.z), m[1] * v.x + (m[4] * v.y + m[7] * v.z),
          m[2] * v.x + (m[5] * v.y + m[8] * v.z)};
}

}  // namespace hf_inner
