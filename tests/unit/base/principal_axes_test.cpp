// Principal axes of matrices that points make, of degenerate ones and of numbers that are none.
#include "base/principal_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using hf_eigen::Vector3d;
using hf_inner::Mat3;

Mat3 moments(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a * a.transpose() + b * b.transpose() + c * c.transpose();
}

TEST(PrincipalAxes, are_a_rotation_of_eigenvectors_for_flat_thin_and_extreme_clouds) {
  const Vector3d x(1, 2, 3), y(-2, 1, 0.5), z(0.1, 0, -1), none(0, 0, 0);
  const Mat3 shapes[] = {moments(x, y, z),          moments(x, y, none), moments(x, none, none),
                         moments(none, none, none), Mat3::Identity(),    moments(x, 1e-9 * y, none)};
  for (const Mat3& shape : shapes) {
    for (const double scale : {1.0, 1e-300, 5e-324, 1e150, 1e300}) {
      const Mat3 a = scale * shape;
      const hf_inner::PrincipalAxes out = hf_inner::principal_axes(a);
      const Mat3 error = out.axes.transpose() * (shape * out.axes) - Mat3(Vector3d(out.moment / scale).asDiagonal());
      EXPECT_LT((out.axes.transpose() * out.axes - Mat3::Identity()).norm(), 1e-14) << scale;
      EXPECT_NEAR(out.axes.determinant(), 1, 1e-14) << scale;
      // below 1e-300 the matrix itself has few digits
      EXPECT_LT(error.norm(), (scale < 1e-300 ? 1.0 : 1e-14) * (1 + shape.norm())) << scale;
      EXPECT_GE(out.moment[0], out.moment[1]) << scale;
      EXPECT_GE(out.moment[1], out.moment[2]) << scale;
    }
  }
}

TEST(PrincipalAxes, of_numbers_that_are_none_are_the_identity_with_moments_of_zero) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {infinity, -infinity, nan}) {
    for (int i = 0; i < 9; ++i) {
      Mat3 a = Mat3::Identity();
      a(i / 3, i % 3) = a(i % 3, i / 3) = bad;
      const hf_inner::PrincipalAxes out = hf_inner::principal_axes(a);
      EXPECT_EQ(out.axes, Mat3(Mat3::Identity())) << bad << " at " << i;
      EXPECT_EQ(out.moment, Vector3d(0, 0, 0)) << bad << " at " << i;
    }
  }
}

TEST(PrincipalAxes, fixed_signs_do_not_depend_on_the_signs_given) {
  Mat3 right;
  right.col(0) << -1, 2, 2;  // the first of equal components decides, here the second row
  right.col(1) << 3, -3, 1;
  right.col(2) << 0, -4, 5;
  for (int flips = 0; flips < 8; ++flips) {
    Mat3 axes = right;
    for (int k = 0; k < 3; ++k) {
      if (flips >> k & 1) axes.col(k) *= -1;
    }
    hf_inner::fix_signs(axes);
    EXPECT_EQ(axes, right) << flips;
  }
}

}  // namespace
