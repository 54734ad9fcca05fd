#include "mesh/corner_tree.h"

namespace hf_inner::mesh {
namespace {

// A share of the largest coordinate, more than the 1e-16 by which rounding moves a place. A wider margin looks at more
// corners, a narrower one might miss one. Three faces of 60,000 corners are cut alike from 1e-15 to 1e-4.
constexpr double place_margin = 1e-9;
// Corners of a leaf, at most. Fewer cost more levels, more look at more corners. Half and double take the same
// time within 5 %, the noise, on a circle, a comb and a star of 60,000 corners.
constexpr std::size_t leaf_size = 8;

}  // namespace

void CornerTree::make(Span<const Vec3> points, Vec3 normal) {
  const std::size_t n = points.size();
  const double largest = std::max({std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)});
  const Vec3 axis = std::fabs(normal.x) < largest   ? Vec3{1, 0, 0}
                    : std::fabs(normal.y) < largest ? Vec3{0, 1, 0}
                                                    : Vec3{0, 0, 1};
  const Vec3 across = cross(normal, axis), u = (1 / norm(across)) * across, along = cross(normal, u),
             v = (1 / norm(along)) * along;
  place_.resize(n);
  order_.resize(n);
  leaf_.resize(n);
  double extent = 0;
  for (std::size_t i = 0; i < n; ++i) {
    place_[i] = {dot(points[i] - points[0], u), dot(points[i] - points[0], v)};
    order_[i] = static_cast<Index>(i);
    extent = std::max({extent, std::fabs(place_[i].x), std::fabs(place_[i].y)});
  }
  margin_ = place_margin * extent;
  for (leaves_ = 1; leaf_size * leaves_ < n;) leaves_ *= 2;
  nodes_.assign(2 * leaves_, Node());
  split(1, 0, leaves_);
}

// Sorts the corners of these leaves so far that each leaf has its own, and measures the nodes.
void CornerTree::split(std::size_t node, std::size_t first_leaf, std::size_t last_leaf) {
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first_of(first_leaf));
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(first_of(last_leaf));
  Place low = place_[at(*begin)], high = low;
  for (auto it = begin; it != end; ++it) {
    const Place p = place_[at(*it)];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  nodes_[node].low = low;
  nodes_[node].high = high;
  if (last_leaf - first_leaf == 1) {
    for (auto it = begin; it != end; ++it) leaf_[at(*it)] = static_cast<Index>(first_leaf);
    return;
  }
  const std::size_t middle = (first_leaf + last_leaf) / 2;
  const bool by_x = high.x - low.x > high.y - low.y;
  std::nth_element(begin, order_.begin() + static_cast<std::ptrdiff_t>(first_of(middle)), end, [&](Index a, Index b) {
    const Place &p = place_[at(a)], &q = place_[at(b)];
    return by_x ? p.x < q.x : p.y < q.y;
  });
  split(2 * node, first_leaf, middle);
  split(2 * node + 1, middle, last_leaf);
}

CornerTree::Triangle::Triangle(Place a, Place b, Place c, double margin) noexcept {
  low_ = {std::min({a.x, b.x, c.x}) - margin, std::min({a.y, b.y, c.y}) - margin};
  high_ = {std::max({a.x, b.x, c.x}) + margin, std::max({a.y, b.y, c.y}) + margin};
  const double turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < 0 ? -1 : 1;
  const Place corner[4] = {a, b, c, a};
  for (int k = 0; k < 3; ++k) {
    const Place p = corner[k], q = corner[k + 1];
    Side& s = side_[k];
    s.x = -turn * (q.y - p.y);
    s.y = turn * (q.x - p.x);
    s.least = s.x * p.x + s.y * p.y - margin * (std::fabs(s.x) + std::fabs(s.y));
  }
}

}  // namespace hf_inner::mesh
