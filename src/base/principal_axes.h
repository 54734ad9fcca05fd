// The axes of a cloud of points, from the moments of its places: for the order of elimination and for strain.
#pragma once
#include "base/algebra.h"

namespace hf_inner {

struct PrincipalAxes {
  Mat3 axes;                  // columns: unit eigenvectors by falling eigenvalue; a rotation
  hf_eigen::Vector3d moment;  // the eigenvalues
};
// symmetric: its lower triangle is read. Non-finite numbers give the identity and moments of 0.
PrincipalAxes principal_axes(const Mat3& symmetric) noexcept;
// Turns each column so that its largest component is positive, the first of equal ones: for results that must not
// depend on the signs an eigen solver happens to give. Columns need not be a rotation afterwards.
void fix_signs(Mat3& axes) noexcept;

}  // namespace hf_inner
