// Limits how far rotation groups stretch: beyond the limits the surface gets stiffer.
//
// As-rigid-as-possible energy grows with the square of strain, so a thin wrist takes nearly all of a pull. Each group
// is treated as a small sheet. Its axes e_1 and e_2 belong to the largest moments m_1 >= m_2 of its rest edges p_i -
// p_j,
//     M = sum w_e/2 (p_i - p_j)(p_i - p_j)', which is S_g at rest.
// R is the group's rotation. The mean strain of the group, with eigenvalues sigma_+ >= sigma_- that are 1 at rest, is
//     U = sym(E' R' S E diag(1/m_1, 1/m_2)), E = [e_1 e_2].
// P clamps to [low, high]. The stress X has the eigenvectors of U and the eigenvalues
//     x_+ = clamp(k (P sigma_+ - sigma_+), -c, c) - n (P sigma_- - 1),   and x_- likewise.
// The solve for the cluster transforms (global step) aims at T = R (1 + E X E') instead of R. This makes the group k
// times stiffer outside the limits. At the stress c it yields instead of crumpling its neighbours. n is a contraction
// across the pull (Poisson's ratio), which keeps the volume of a pulled limb. A common rotation of surface and groups
// does not change U, and X = 0 at rest. In each iteration X moves towards its new value by the share r < 2 / (1 + k);
// then the iterations converge. Figures: docs/poses.md.
//
// Allocates nothing and cannot fail.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/rotation.h"

namespace hf_inner::deform {

struct Sheet {
  Vec3 axis[2];
  double inverse_moment[2] = {0, 0};  // 1 / m_1, 1 / m_2; 0: the group is a line or point and has no stress
  std::int32_t limits = 0;            // index into strain_limits
};
// Makes the description of a rotation group (a patch of vertices) as a small sheet that stretches along two axes.
// moments: the second moments M = sum w_e/2 (p_i - p_j)(p_i - p_j)' of its rest edges. limits: index into
// strain_limits.
Sheet make_sheet(const Mat3& moments, std::int32_t limits) noexcept;

// The symmetric stress matrix X = [along across; across beside] of a group of vertices, in the axes E of its edges.
struct Stress {
  double along = 0, across = 0, beside = 0;
};
// Returns the stress that a group of vertices should have. columns[j][i]: entry (i, j) of the group's moment matrix S.
// r: the rotation nearest to S.
Stress stress_of(const Sheet& sheet, const double (&columns)[3][4], const Mat3& r) noexcept;
// Moves the stress of a group of vertices towards `wanted` by the share StrainLimits::follow. Returns the Frobenius
// norm of the step.
double follow(const Sheet& sheet, const Stress& wanted, Stress& stress) noexcept;
// Returns R (1 + E X E'), the rotation with stretch that the next solve should give the edges of a group of vertices. R
// is the group's rotation, X its stress in the axes E.
Mat3 strained(const Sheet& sheet, const Stress& stress, const Mat3& r) noexcept;

}  // namespace hf_inner::deform
