#include "remesh/nearest.h"

#include <algorithm>

#include "remesh/constants.h"

namespace hf_inner {
namespace {

double squared(Vec3 a) { return dot(a, a); }

// Returns the squared distance to a triangle, by the regions of its corners, edges and face (Ericson 2005, Section
// 5.1.5). weights: NULL, or receives the barycentric weights of the nearest point.
double to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c, double* weights = nullptr) {
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

double to_box(Vec3 p, Vec3 low, Vec3 high) {
  const double x = std::max(std::max(low.x - p.x, p.x - high.x), 0.0),
               y = std::max(std::max(low.y - p.y, p.y - high.y), 0.0),
               z = std::max(std::max(low.z - p.z, p.z - high.z), 0.0);
  return x * x + y * y + z * z;
}

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

NearestTriangle::NearestTriangle(const Table<Vec3>& positions, const Table<std::int32_t>& corners, Memory& memory)
    : positions_(&positions), corners_(&corners), order_(memory), boxes_(memory) {
  for (std::int32_t t = 0; 3 * t < corners.size(); ++t) order_.push_back(t);
  if (!order_.empty()) build(0, order_.size());
}

std::int32_t NearestTriangle::build(std::int32_t first, std::int32_t count) {
  Box box{corner(order_[first], 0), corner(order_[first], 0), first, count, 0};
  for (std::int32_t i = first; i < first + count; ++i) {
    for (std::int32_t k = 0; k < 3; ++k) {
      const Vec3 p = corner(order_[i], k);
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  }
  const std::int32_t number = boxes_.push_back(box);
  if (count <= triangles_a_leaf) return number;
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::int32_t half = count / 2;
  auto key = [&](std::int32_t t) { return along(corner(t, 0) + corner(t, 1) + corner(t, 2), axis); };
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::int32_t s, std::int32_t t) {
                     const double x = key(s), y = key(t);
                     return x != y ? x < y : s < t;
                   });
  boxes_[number].count = 0;
  build(first, half);
  const std::int32_t right = build(first + half, count - half);
  boxes_[number].right = right;
  return number;
}

void NearestTriangle::weights(Vec3 p, std::int32_t t, double* out) const noexcept {
  to_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2), out);
}

NearestTriangle::Found NearestTriangle::find(Vec3 p, std::int32_t hint, double enough) const noexcept {
  Found found;
  if (hint >= 0) {
    found = {hint, to_triangle(p, corner(hint, 0), corner(hint, 1), corner(hint, 2))};
    if (found.squared <= enough) return found;
  }
  std::int32_t stack[tree_stack], top = 0;
  if (!boxes_.empty()) stack[top++] = 0;
  while (top > 0) {
    const std::int32_t number = stack[--top];
    const Box& box = boxes_[number];
    if (found.triangle >= 0 && to_box(p, box.low, box.high) >= found.squared) continue;
    for (std::int32_t i = box.first; i < box.first + box.count; ++i) {
      const std::int32_t t = order_[i];
      const double d = to_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
      if (found.triangle < 0 || d < found.squared) found.triangle = t, found.squared = d;
    }
    if (box.count) {
      if (found.squared <= enough) return found;
      continue;
    }
    std::int32_t near = number + 1, far = box.right;
    if (to_box(p, boxes_[far].low, boxes_[far].high) < to_box(p, boxes_[near].low, boxes_[near].high))
      std::swap(near, far);
    stack[top++] = far, stack[top++] = near;
  }
  return found;
}

}  // namespace hf_inner
