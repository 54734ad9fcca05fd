#include "mesh/corner_slabs.h"

namespace hf_inner {

// A share of the largest coordinate, more than the 1e-16 by which rounding moves a place. A wider margin looks at more
// corners, a narrower one might miss one. Three faces of 60,000 corners are cut alike from 1e-15 to 1e-4.
constexpr double slab_margin = 1e-9;

void CornerSlabs::make(Span<const Vec3> points, Vec3 normal) {
  const std::size_t n = points.size();
  const double largest = std::max({std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)});
  const Vec3 axis = std::fabs(normal.x) < largest   ? Vec3{1, 0, 0}
                    : std::fabs(normal.y) < largest ? Vec3{0, 1, 0}
                                                    : Vec3{0, 0, 1};
  const Vec3 across = cross(normal, axis), u = (1 / norm(across)) * across, along = cross(normal, u),
             v = (1 / norm(along)) * along;
  place_.resize(n), order_.resize(n);
  double extent = 0;
  for (std::size_t i = 0; i < n; ++i) {
    place_[i] = {dot(points[i] - points[0], u), dot(points[i] - points[0], v)};
    order_[i] = static_cast<Index>(i);
    extent = std::max({extent, std::fabs(place_[i].x), std::fabs(place_[i].y)});
  }
  margin_ = slab_margin * extent;
  std::sort(order_.begin(), order_.end(), [&](Index a, Index b) { return place_[at(a)].x < place_[at(b)].x; });
  slab_size_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(static_cast<double>(n))));
  low_.clear();
  for (std::size_t first = 0; first < n; first += slab_size_) {
    low_.push_back(place_[at(order_[first])].x);
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = order_.begin() + static_cast<std::ptrdiff_t>(std::min(n, first + slab_size_));
    std::sort(begin, end, [&](Index a, Index b) { return place_[at(a)].y < place_[at(b)].y; });
  }
}

}  // namespace hf_inner
