#include "deform/strain.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::deform {

Sheet make_sheet(const Mat3& moments, std::int32_t limits) noexcept {
  Sheet sheet;
  sheet.limits = limits;
  const PrincipalAxes axes = principal_axes(moments);
  const hf_eigen::Vector3d& moment = axes.moment;
  sheet.axis[0] = to_vec3(axes.axes.col(0));
  sheet.axis[1] = to_vec3(axes.axes.col(1));
  if (!(moment(1) > thinnest_sheet * moment(0)) || !(moment(0) > 0)) return sheet;
  sheet.inverse_moment[0] = 1 / moment(0);
  sheet.inverse_moment[1] = 1 / moment(1);
  return sheet;
}

Stress stress_of(const Sheet& sheet, const double (&columns)[3][4], const Mat3& r) noexcept {
  if (!(sheet.inverse_moment[1] > 0)) return {};
  const StrainLimits& limits = strain_limits[sheet.limits];
  Vec3 turned[2], drawn[2];
  for (int k = 0; k < 2; ++k) {
    const Vec3 e = sheet.axis[k];
    const double w = sheet.inverse_moment[k];
    turned[k] = r * e;
    drawn[k] = {w * (columns[0][0] * e.x + columns[1][0] * e.y + columns[2][0] * e.z),
                w * (columns[0][1] * e.x + columns[1][1] * e.y + columns[2][1] * e.z),
                w * (columns[0][2] * e.x + columns[1][2] * e.y + columns[2][2] * e.z)};
  }
  const double along = dot(turned[0], drawn[0]), beside = dot(turned[1], drawn[1]),
               across = 0.5 * (dot(turned[0], drawn[1]) + dot(turned[1], drawn[0]));
  // The eigenvalues of a symmetric 2 x 2 matrix, written by hand: a function of it needs no eigenvectors, whose signs
  // would have to be chosen.
  const double mean = 0.5 * (along + beside), half = 0.5 * (along - beside),
               radius = std::sqrt(half * half + across * across);
  if (!(std::fabs(mean) < largest_strain) || !(radius < largest_strain)) return {};
  const double larger = mean + radius, smaller = mean - radius,
               larger_kept = std::clamp(larger, limits.low, limits.high),
               smaller_kept = std::clamp(smaller, limits.low, limits.high);
  const auto held = [&](double kept, double strain) {
    return std::clamp(limits.stiffness * (kept - strain), -limits.largest, limits.largest);
  };
  const double x = held(larger_kept, larger) - limits.contraction * (smaller_kept - 1),
               y = held(smaller_kept, smaller) - limits.contraction * (larger_kept - 1);
  const double centre = 0.5 * (x + y), spread = radius > 0 ? 0.5 * (x - y) / radius : 0.0;
  return {centre + spread * half, spread * across, centre - spread * half};
}

double follow(const Sheet& sheet, const Stress& wanted, Stress& stress) noexcept {
  const double share = strain_limits[sheet.limits].follow;
  const double along = share * (wanted.along - stress.along), across = share * (wanted.across - stress.across),
               beside = share * (wanted.beside - stress.beside);
  stress.along += along;
  stress.across += across;
  stress.beside += beside;
  return std::sqrt(along * along + 2 * across * across + beside * beside);
}

Mat3 strained(const Sheet& sheet, const Stress& stress, const Mat3& r) noexcept {
  const Vec3 e = sheet.axis[0], f = sheet.axis[1];
  Mat3 target = r;
  add_outer(target, 1, r * e, stress.along * e + stress.across * f);
  add_outer(target, 1, r * f, stress.across * e + stress.beside * f);
  return target;
}

}  // namespace hf_inner::deform
