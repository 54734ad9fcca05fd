// The corners of one face by place, so that those inside a triangle of corners are found without looking at all.
//
// The plane is cut into about sqrt(n) slabs of equal numbers of corners; each slab is sorted across. A search looks at
// the slabs that the triangle meets, and in each at the part that the triangle covers. Cost: O(n log n) to make; a
// search costs O(log n) a slab and what it finds near the triangle, however uneven the corners lie.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner {

class CornerSlabs {
 public:
  explicit CornerSlabs(Memory& memory) : place_(&memory), order_(&memory), low_(&memory) {}

  // normal: of the plane, of any length above 0.
  void make(Span<const Vec3> points, Vec3 normal);

  // Returns the first corner near the triangle a b c for which accept(corner) holds, or -1. "Near": every corner inside
  // is looked at, and some outside.
  template <class Accept>
  Index find(Index a, Index b, Index c, Accept&& accept) const noexcept {
    const Place corner[3] = {place_[at(a)], place_[at(b)], place_[at(c)]};
    const double left = std::min({corner[0].x, corner[1].x, corner[2].x}) - margin_;
    const double right = std::max({corner[0].x, corner[1].x, corner[2].x}) + margin_;
    // the last slab that begins at or before the left end holds it
    std::size_t slab = static_cast<std::size_t>(std::upper_bound(low_.begin(), low_.end(), left) - low_.begin());
    // corners of one x may stand in several slabs
    slab = slab > 0 ? slab - 1 : 0;
    while (slab > 0 && low_[slab] >= left) --slab;
    for (; slab < low_.size() && low_[slab] <= right; ++slab) {
      const double from = std::max(left, low_[slab]);
      const double to = std::min(right, slab + 1 < low_.size() ? low_[slab + 1] : right);
      double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
      for (int k = 0; k < 3; ++k) widen(corner[k], corner[(k + 1) % 3], from - margin_, to + margin_, bottom, top);
      bottom -= margin_, top += margin_;
      const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(slab * slab_size_);
      const auto end = order_.begin() + static_cast<std::ptrdiff_t>(std::min(order_.size(), (slab + 1) * slab_size_));
      auto it = std::lower_bound(begin, end, bottom, [&](Index i, double y) { return place_[at(i)].y < y; });
      for (; it != end && place_[at(*it)].y <= top; ++it) {
        if (accept(*it)) return *it;
      }
    }
    return -1;
  }

 private:
  struct Place {
    double x, y;
  };
  // Widens [bottom, top] by the part of the edge p q between two values of x.
  static void widen(Place p, Place q, double from, double to, double& bottom, double& top) noexcept {
    if (p.x > q.x) std::swap(p, q);
    if (q.x < from || p.x > to) return;
    const auto y_at = [&](double x) {
      if (x <= p.x) return p.y;
      return x >= q.x ? q.y : p.y + (q.y - p.y) * ((x - p.x) / (q.x - p.x));
    };
    for (const double y : {y_at(from), y_at(to)}) bottom = std::min(bottom, y), top = std::max(top, y);
  }

  Vector<Place> place_;
  Vector<Index> order_;  // by slab, then by y
  Vector<double> low_;   // the least x of every slab
  std::size_t slab_size_ = 1;
  double margin_ = 0;  // more than rounding moves a corner
};

}  // namespace hf_inner
