// Limits on how far rotation groups stretch: beyond them the surface gets stiffer.
//
// As-rigid-as-possible energy grows with the square of strain, so a thin wrist takes nearly all of a pull. A group is
// treated as a small sheet. e_1 and e_2 are the axes of the largest moments m_1 >= m_2 of its rest edges,
//     M = sum w_e/2 (p_i - p_j)(p_i - p_j)' = S_g at rest.
// Its mean strain, with eigenvalues sigma_+ >= sigma_- that are 1 at rest, is
//     U = sym(E' R' S E diag(1/m_1, 1/m_2)), E = [e_1 e_2].
// P clamps to [low, high]. The stress X has the eigenvectors of U and the eigenvalues
//     x_+ = clamp(k (P sigma_+ - sigma_+), -c, c) - n (P sigma_- - 1),   and x_- likewise.
// The global step aims at T = R (1 + E X E') in place of R. This makes the group k times stiffer outside the limits. At
// the stress c it yields instead of crumpling its neighbours. n is a contraction across (Poisson), which keeps the
// volume of a limb that is pulled. A common rotation of surface and groups does not change U, and X = 0 at rest. X
// follows with a factor r < 2 / (1 + k), under which the alternation contracts. Figures: docs/benchmarks.md.
//
// Allocates nothing, cannot fail.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/rotation.h"

namespace hf_inner {

struct Sheet {
  Vec3 axis[2];
  double inverse_moment[2] = {0, 0};  // 0: no sheet (a line or a point), never under stress
  std::int32_t limits = 0;            // which of strain_limits
};
// moments: M.
Sheet make_sheet(const Mat3& moments, std::int32_t limits) noexcept;

// X = [along across; across beside] in the axes of the sheet.
struct Stress {
  double along = 0, across = 0, beside = 0;
};
// columns[j][i] = S(i, j); r: the rotation nearest to S.
Stress stress_of(const Sheet& sheet, const double (&columns)[3][4], const Mat3& r) noexcept;
// Takes `stress` the share r of the way to `wanted`; returns the Frobenius norm of the step.
double follow(const Sheet& sheet, const Stress& wanted, Stress& stress) noexcept;
// R (1 + E X E')
Mat3 strained(const Sheet& sheet, const Stress& stress, const Mat3& r) noexcept;

}  // namespace hf_inner
