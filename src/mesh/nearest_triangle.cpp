#include "mesh/nearest_triangle.h"

#include <limits>

namespace hf_inner {
namespace {

double squared(Vec3 a) { return dot(a, a); }

}  // namespace

// By the regions of its corners, edges and face (Ericson 2005, Section 5.1.5).
double squared_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double* weights) noexcept {
  const auto take = [&](double s, double t, double rest, double distance) {
    if (weights) weights[0] = s, weights[1] = t, weights[2] = rest;
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
  if (!(sum > 0)) {
    const double corners[3] = {squared(ap), squared(bp), squared(cp)};
    const int k = corners[0] <= corners[1] && corners[0] <= corners[2] ? 0 : corners[1] <= corners[2] ? 1 : 2;
    return take(k == 0, k == 1, k == 2, corners[k]);
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

}  // namespace hf_inner
