// Limits on how far rotation groups are stretched and squeezed: beyond them the surface gets stiffer.
//
// As-rigid-as-possible energy pays for strain by its square everywhere alike, so a thin wrist or the foot of a lifted
// hill takes nearly all of it. A group is a small sheet: e_1, e_2 are the directions of its rest edges' largest moments
// m_1 >= m_2, M = sum w_e/2 (p_i - p_j)(p_i - p_j)' = S_g at rest, and its mean strain is
//     U = sym(E' R' S E diag(1/m_1, 1/m_2)), E = [e_1 e_2], eigenvalues sigma_+ >= sigma_-  (1 at rest).
// With P the clamp to [low, high], the stress X, symmetric with the eigenvectors of U,
//     x_+ = clamp(k (P sigma_+ - sigma_+), -c, c) - n (P sigma_- - 1),   and x_- likewise,
// goes into the group's target for the global step, T = R (1 + E X E') in place of R: k times stiffer outside the
// limits, up to a stress of c, where it yields instead of crumpling what lies beside; n is a contraction across
// (Poisson), which keeps the volume of a limb that is pulled. U is unchanged by a common rotation of surface and
// groups, and X = 0 at rest. X follows with a factor r < 2 / (1 + k), under which the alternation contracts.
//
// Measured (docs/benchmarks.md): a scan pulled by one hand, longest edge 1.35 -> 1.29, smallest stretch 0.67 -> 0.74,
// volume +3.3 -> +3.1 per cent, for 12 per cent more energy; a lifted plane, edges within [0.8, 1.25] 71.0 -> 72.1 per
// cent for 1 per cent less. Bends and twists that stay within the limits are what they were. The numbers were fitted on
// two poses of one scan and two planes; on 16 poses of eight other meshes more edges lie within [0.8, 1.25] in 15, the
// smallest stretch gains in 11, but the longest edge only in 9: where it is beyond 1.4 it grows.
//
// Allocates nothing, cannot fail.
#pragma once
#include <cstdint>

#include "deform/rotation.h"

namespace hf_inner {

struct StrainLimits {
  double low, high;    // of sigma
  double stiffness;    // k
  double largest;      // c
  double contraction;  // n
  double follow;       // r
};
// By the handles of the component: two, more.
constexpr StrainLimits strain_limits[] = {{0.8, 1.24, 4.0, 0.25, 0.0, 0.28}, {0.92, 1.14, 8.0, 0.5, 0.2, 0.16}};

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
