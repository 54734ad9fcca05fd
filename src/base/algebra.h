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

namespace hf_inner {

using Mat3 = hf_eigen::Matrix3d;
static_assert(alignof(Mat3) == alignof(double),
              "arrays of Mat3 and of structs that hold one need no special alignment");

}  // namespace hf_inner
