// Eigen for small dense algebra: the only header of src that includes it.
//
// What is set here makes results the same bits everywhere: no vectorisation (the order of a sum would follow the
// lanes), no threads; the build forbids contraction. Sizes are fixed, so nothing is allocated (a test of the rooms
// reads that). Matrices start at zero.
//
// The namespace is renamed while Eigen is read: a host may compile Eigen with other flags and link hf_static, and the
// linker would keep one of two functions of the same name. Include this before any header that includes Eigen itself.
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
