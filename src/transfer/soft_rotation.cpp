// See soft_rotation.h.
#include "transfer/soft_rotation.h"

#include <algorithm>
#include <cmath>

#include "transfer/constants.h"

namespace hf_inner::transfer {

deform::Quaternion soft_rotation(const Mat3& s, const deform::Quaternion& guide, double sharpness) noexcept {
  const double size = s.norm();
  if (!(size > 0) || !std::isfinite(size)) return guide;
  // Each step of the power stays positive definite, because no eigenvalue of N is larger than 2 |S|.
  const double factor = std::min(sharpness / soft_steps, most_soft_step / size);
  hf_eigen::Matrix4d p;
  p(0, 0) = s(0, 0) - s(1, 1) - s(2, 2);
  p(1, 1) = s(1, 1) - s(0, 0) - s(2, 2);
  p(2, 2) = s(2, 2) - s(0, 0) - s(1, 1);
  p(0, 1) = p(1, 0) = s(0, 1) + s(1, 0);
  p(0, 2) = p(2, 0) = s(0, 2) + s(2, 0);
  p(1, 2) = p(2, 1) = s(1, 2) + s(2, 1);
  p(0, 3) = p(3, 0) = s(2, 1) - s(1, 2);
  p(1, 3) = p(3, 1) = s(0, 2) - s(2, 0);
  p(2, 3) = p(3, 2) = s(1, 0) - s(0, 1);
  p(3, 3) = s.trace();
  p = hf_eigen::Matrix4d::Identity() + factor * p;
  for (int power = 1; power < soft_steps; power *= 2) {
    const hf_eigen::Matrix4d square = p * p;
    p = square;
  }
  const hf_eigen::Vector4d q = p * guide.coeffs();
  return deform::normalised(deform::Quaternion(hf_eigen::Quaterniond(q)));
}

}  // namespace hf_inner::transfer
