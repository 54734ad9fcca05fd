#include "surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace samples {
namespace {

// Squared distance to a triangle: the regions of its corners, edges and face (Ericson 2005, Section 5.1.5).
double to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  auto squared = [&](const glm::dvec3& q) { return dot(p - q, p - q); };
  if (d1 <= 0 && d2 <= 0) return squared(a);
  const glm::dvec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return squared(b);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return squared(a + (d1 / (d1 - d3)) * ab);
  const glm::dvec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return squared(c);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return squared(a + (d2 / (d2 - d6)) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return squared(b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b));
  const double sum = va + vb + vc;
  if (!(sum > 0)) return std::min(squared(a), std::min(squared(b), squared(c)));
  return squared(a + (vb / sum) * ab + (vc / sum) * ac);
}

double to_box(const glm::dvec3& p, const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 d = glm::max(glm::max(low - p, p - high), glm::dvec3(0));
  return dot(d, d);
}

}  // namespace

void append_measured(FaceTriangles& cut, const std::vector<glm::dvec3>& positions, const uint32_t* corners,
                     uint32_t size, std::vector<uint32_t>& triangles) {
  if (size == 4) {
    const glm::dvec3 &a = positions[corners[0]], diagonal = positions[corners[2]] - a;
    const glm::dvec3 first = cross(positions[corners[1]] - a, diagonal);
    const glm::dvec3 second = cross(diagonal, positions[corners[3]] - a), sum = first + second;
    if (dot(first, sum) >= 0 && dot(second, sum) >= 0) {
      triangles.insert(triangles.end(), {corners[0], corners[1], corners[2], corners[0], corners[2], corners[3]});
      return;
    }
  }
  cut.append(positions, corners, size, triangles);
}

NearestPoint::NearestPoint(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size() / 3) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) build(0, static_cast<uint32_t>(order_.size()));
}

uint32_t NearestPoint::build(uint32_t first, uint32_t count) {
  const uint32_t number = static_cast<uint32_t>(boxes_.size());
  Box box{glm::dvec3(std::numeric_limits<double>::infinity()), glm::dvec3(-std::numeric_limits<double>::infinity()),
          first, count, 0};
  auto corner = [&](uint32_t t, uint32_t k) { return positions_[triangles_[3 * size_t{t} + k]]; };
  for (uint32_t i = first; i < first + count; ++i)
    for (uint32_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = corner(order_[i], k);
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  boxes_.push_back(box);
  if (count <= 6) return number;
  const glm::dvec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](uint32_t s, uint32_t t) {
                     const double x = corner(s, 0)[axis] + corner(s, 1)[axis] + corner(s, 2)[axis],
                                  y = corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis];
                     return x != y ? x < y : s < t;
                   });
  boxes_[number].count = 0;
  build(first, half);
  const uint32_t right = build(first + half, count - half);
  boxes_[number].right = right;
  return number;
}

double NearestPoint::distance(const glm::dvec3& p, uint32_t* triangle) const {
  if (boxes_.empty()) return std::numeric_limits<double>::infinity();
  // Nearer than rounding: on a flat part, all thin triangles around a point would be tried otherwise.
  const glm::dvec3 size = boxes_[0].high - boxes_[0].low;
  const double enough = 1e-28 * dot(size, size);
  double best = std::numeric_limits<double>::infinity();
  uint32_t stack[128];
  int top = 0;
  stack[top++] = 0;
  while (top > 0 && best > enough) {
    const uint32_t number = stack[--top];
    const Box& box = boxes_[number];
    if (to_box(p, box.low, box.high) >= best) continue;
    tries_ += box.count;
    for (uint32_t i = box.first; i < box.first + box.count; ++i) {
      const uint32_t* t = &triangles_[3 * size_t{order_[i]}];
      const double d = to_triangle(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
      if (triangle && d < best) *triangle = order_[i];
      best = std::min(best, d);
    }
    if (box.count) continue;
    uint32_t near = number + 1, far = box.right;
    if (to_box(p, boxes_[far].low, boxes_[far].high) < to_box(p, boxes_[near].low, boxes_[near].high))
      std::swap(near, far);
    stack[top++] = far;
    stack[top++] = near;
  }
  return std::sqrt(best);
}

SurfaceDistance surface_distance(const TriangleSoup& a, const TriangleSoup& b, uint32_t samples) {
  SurfaceDistance out;
  auto one_way = [&](const TriangleSoup& from, const TriangleSoup& to, double& mean) {
    const NearestPoint nearest(to);
    double worst = 0, total = 0, area = 0, count = 0;
    const size_t triangles = from.triangles.size() / 3;
    auto corner = [&](size_t t, size_t k) { return from.positions[from.triangles[3 * t + k]]; };
    uint64_t points = 0;
    auto visit = [&](const glm::dvec3& p, double& d) {
      if (nearest.tries() > SurfaceDistance::more_tries + SurfaceDistance::most_tries * points++) out.measured = false;
      if (!out.measured) return;
      if (d < 0) d = nearest.distance(p);
      worst = std::max(worst, d);
      total += d;
      count += 1;
    };
    std::vector<double> of_vertex(from.positions.size(), -1);  // until it is known
    for (size_t t = 0; t < triangles; ++t)
      area += 0.5 * length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
    double carried = 0;
    for (size_t t = 0; t < triangles; ++t) {
      const glm::dvec3 p = corner(t, 0), x = corner(t, 1) - p, y = corner(t, 2) - p;
      carried += area > 0 ? 0.5 * length(cross(x, y)) / area * samples : 0;
      for (size_t k = 0; k < 3; ++k) visit(corner(t, k), of_vertex[from.triangles[3 * t + k]]);
      // the points of a low-discrepancy sequence (Roberts 2018), folded into the triangle
      for (uint32_t i = 1; carried >= 1; carried -= 1, ++i) {
        double u = std::fmod(0.5 + i * 0.7548776662466927, 1.0), v = std::fmod(0.5 + i * 0.5698402909980532, 1.0);
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        double d = -1;
        visit(p + u * x + v * y, d);
      }
    }
    mean = count > 0 ? total / count : 0;
    return worst;
  };
  double unused = 0;
  out.a_to_b = one_way(a, b, out.mean_a_to_b);
  out.b_to_a = one_way(b, a, unused);
  return out;
}

}  // namespace samples
