#include "base/principal_axes.h"

namespace hf_inner {

PrincipalAxes principal_axes(const Mat3& symmetric) noexcept {
  if (!symmetric.allFinite()) return {Mat3::Identity(), hf_eigen::Vector3d::Zero()};
  const hf_eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
  PrincipalAxes out{eigen.eigenvectors().rowwise().reverse(), eigen.eigenvalues().reverse()};
  if (out.axes.determinant() < 0) out.axes.col(2) *= -1;
  return out;
}

void fix_signs(Mat3& axes) noexcept {
  for (int k = 0; k < 3; ++k) {
    hf_eigen::Index largest;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0) axes.col(k) *= -1;
  }
}

}  // namespace hf_inner
