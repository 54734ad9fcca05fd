#include "mesh/nearest_triangle.h"

#include <algorithm>

namespace hf_inner {
namespace {

// Triangles in a leaf of the search tree: trades tests of boxes for tests of triangles. No result depends on it.
constexpr Index triangles_a_leaf = 4;
// Depth of the search stack: 2^31 triangles halved to leaves make 29 levels, and each level leaves one box to visit.
constexpr Index tree_stack = 32;

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

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double squared_gap(double low, double high, double other_low, double other_high) noexcept {
  const double gap = std::max(std::max(low - other_high, other_low - high), 0.0);
  return gap * gap;
}

}  // namespace

double nearest_in_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c, double weights[3]) noexcept {
  return to_triangle(p, a, b, c, weights);
}

double squared_distance(const NearestTriangle::Box& a, const NearestTriangle::Box& b) noexcept {
  return squared_gap(a.low.x, a.high.x, b.low.x, b.high.x) + squared_gap(a.low.y, a.high.y, b.low.y, b.high.y) +
         squared_gap(a.low.z, a.high.z, b.low.z, b.high.z);
}

NearestTriangle::NearestTriangle(Span<const Vec3> positions, Span<const Index> corners, Memory& memory)
    : positions_(positions), corners_(corners), order_(&memory), roots_(&memory), nodes_(&memory) {
  for (std::size_t t = 0; 3 * t < corners.size(); ++t) order_.push_back(static_cast<Index>(t));
  roots_.push_back(order_.empty() ? -1 : build(0, static_cast<Index>(order_.size())));
}

NearestTriangle::NearestTriangle(Span<const Vec3> positions, Span<const Index> corners, Span<const Index> group,
                                 Index group_count, Memory& memory)
    : positions_(positions), corners_(corners), order_(group.size(), &memory), roots_(&memory), nodes_(&memory) {
  Vector<Index> start(at(group_count) + 1, 0, &memory);
  for (const Index g : group) ++start[at(g) + 1];
  for (std::size_t g = 0; g < at(group_count); ++g) start[g + 1] += start[g];
  Vector<Index> next(start.begin(), start.end() - 1, &memory);
  for (std::size_t t = 0; t < group.size(); ++t) order_[at(next[at(group[t])]++)] = static_cast<Index>(t);
  for (std::size_t g = 0; g < at(group_count); ++g)
    roots_.push_back(start[g] == start[g + 1] ? -1 : build(start[g], start[g + 1] - start[g]));
}

NearestTriangle::Box NearestTriangle::box(Index group) const noexcept {
  const Node& root = nodes_[at(roots_[at(group)])];
  return {root.low, root.high};
}

Index NearestTriangle::build(Index first, Index count) {
  Node node{corner(order_[at(first)], 0), corner(order_[at(first)], 0), first, count, 0};
  for (Index i = first; i < first + count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = corner(order_[at(i)], k);
      node.low = {std::min(node.low.x, p.x), std::min(node.low.y, p.y), std::min(node.low.z, p.z)};
      node.high = {std::max(node.high.x, p.x), std::max(node.high.y, p.y), std::max(node.high.z, p.z)};
    }
  }
  const Index number = static_cast<Index>(nodes_.size());
  nodes_.push_back(node);
  if (count <= triangles_a_leaf) return number;
  const Vec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const Index half = count / 2;
  auto key = [&](Index t) { return along(corner(t, 0) + corner(t, 1) + corner(t, 2), axis); };
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](Index s, Index t) {
                     const double x = key(s), y = key(t);
                     return x != y ? x < y : s < t;
                   });
  nodes_[at(number)].count = 0;
  build(first, half);
  const Index right = build(first + half, count - half);
  nodes_[at(number)].right = right;
  return number;
}

void NearestTriangle::weights(Vec3 p, Index t, double* out) const noexcept {
  to_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2), out);
}

NearestTriangle::Found NearestTriangle::find(Vec3 p, Index hint, double enough) const noexcept {
  Found found;
  if (hint >= 0) {
    found = {hint, to_triangle(p, corner(hint, 0), corner(hint, 1), corner(hint, 2))};
    if (found.squared <= enough) return found;
  }
  search(roots_[0], p, enough, found.triangle >= 0, found);
  return found;
}

NearestTriangle::Found NearestTriangle::find_in(Index group, Vec3 p, double within, Index hint) const noexcept {
  Found found{-1, within};
  if (hint >= 0) {
    const double d = to_triangle(p, corner(hint, 0), corner(hint, 1), corner(hint, 2));
    if (d < within) found = {hint, d};
  }
  search(roots_[at(group)], p, 0, true, found);
  return found;
}

// bounded: found.squared is a distance that a triangle must be below.
void NearestTriangle::search(Index root, Vec3 p, double enough, bool bounded, Found& found) const noexcept {
  const auto to_box = [&](Index number) {
    return squared_distance(p, Box{nodes_[at(number)].low, nodes_[at(number)].high});
  };
  Index stack[tree_stack], top = 0;
  if (root >= 0) stack[top++] = root;
  while (top > 0) {
    const Index number = stack[--top];
    const Node& node = nodes_[at(number)];
    if (bounded && to_box(number) >= found.squared) continue;
    for (Index i = node.first; i < node.first + node.count; ++i) {
      const Index t = order_[at(i)];
      const double d = to_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
      if (!bounded || d < found.squared) found.triangle = t, found.squared = d, bounded = true;
    }
    if (node.count) {
      if (found.triangle >= 0 && found.squared <= enough) return;
      continue;
    }
    Index near = number + 1, far = node.right;
    if (to_box(far) < to_box(near)) std::swap(near, far);
    stack[top++] = far, stack[top++] = near;
  }
}

}  // namespace hf_inner
