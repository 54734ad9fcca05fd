#include "mesh/nearest_triangle.h"

#include <limits>

namespace hf_inner::mesh {
namespace {

double squared(Vec3 a) { return dot(a, a); }

// Below this the areas of a needle, seen from a point, are mostly rounding: their relative error is the unit of
// rounding over this. Above, the nearest point of the sides would be as far off as the needle is wide: the square root
// of this. Both are 6e-6 of its length here.
constexpr double needle = 3e-11;

}  // namespace

// By the regions of its corners, edges and face (Ericson 2005, Section 5.1.5).
double squared_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double* weights) noexcept {
  const auto take = [&](double s, double t, double rest, double distance) {
    if (weights) {
      weights[0] = s;
      weights[1] = t;
      weights[2] = rest;
    }
    return distance;
  };
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return take(1, 0, 0, squared(ap));
  if (d3 >= 0 && d4 <= d3) return take(0, 1, 0, squared(bp));
  if (d6 >= 0 && d5 <= d6) return take(0, 0, 1, squared(cp));
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double w = d1 / (d1 - d3);
    return take(1 - w, w, 0, squared(ap - w * ab));
  }
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double w = d2 / (d2 - d6);
    return take(1 - w, 0, w, squared(ap - w * ac));
  }
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return take(0, 1 - w, w, squared(bp - w * (c - b)));
  }
  const double sum = va + vb + vc;
  const double most =
      std::fmax(std::fmax(std::fabs(d1), std::fabs(d2)),
                std::fmax(std::fmax(std::fabs(d3), std::fabs(d4)), std::fmax(std::fabs(d5), std::fabs(d6))));
  if (!(sum > needle * most * most) || va < 0 || vb < 0 || vc < 0) {
    // Rounding decides the areas, so the nearest point of the sides is taken.
    const Vec3* corner[3] = {&a, &b, &c};
    double best = -1, at[3] = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const Vec3 side = *corner[next] - *corner[k], away = p - *corner[k];
      const double length = squared(side);
      const double w = length > 0 ? std::fmin(1.0, std::fmax(0.0, dot(side, away) / length)) : 0.0;
      const double distance = squared(away - w * side);
      if (best >= 0 && distance >= best) continue;
      best = distance;
      at[k] = 1 - w;
      at[next] = w;
      at[(k + 2) % 3] = 0;
    }
    return take(at[0], at[1], at[2], best);
  }
  return take(va / sum, vb / sum, vc / sum, squared(ap - (vb / sum) * ab - (vc / sum) * ac));
}

NearestTriangle::NearestTriangle(Span<const Vec3> positions, Span<const Index> corners, Memory& memory)
    : positions_(positions), corners_(corners), tree_(triangle_boxes(positions, corners, memory), memory) {}

void NearestTriangle::weights(Vec3 p, Index t, double* out) const noexcept { squared(p, t, out); }

NearestTriangle::Found NearestTriangle::find(Vec3 p, Index hint, double enough) const noexcept {
  Found found{-1, std::numeric_limits<double>::infinity()};
  if (hint >= 0) found = {hint, squared(p, hint)};
  // The search ends when the reach is below 0.
  const auto reach = [&] { return found.triangle >= 0 && found.squared <= enough ? -1.0 : found.squared; };
  tree_.near(p, reach, [&](Index t) {
    const double d = squared(p, t);
    if (d < found.squared || found.triangle < 0) found = {t, d};
  });
  return found;
}

}  // namespace hf_inner::mesh
