// Finds the items near a point or on a segment, among many triangles, bones or points.
//
// The tree knows the boxes of the items only. The caller tests the items themselves, through a function. The order of
// the visits is the same on every machine. A tree is immutable, so any number of threads may search it.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "mesh/mesh.h"

namespace hf_inner {

struct ItemBox {
  Vec3 low, high;
  void take(const Vec3& p) noexcept {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void take(const ItemBox& other) noexcept { take(other.low), take(other.high); }
  static ItemBox of(const Vec3& p) noexcept { return {p, p}; }
};

class BoxTree {
 public:
  // Builds the tree. It keeps no reference to `items`. Cost: O(n log n).
  BoxTree(const Vector<ItemBox>& items, Memory& memory);

  // Visits the items whose boxes are nearer to p than the square root of reach(). item(i) may lower what reach()
  // returns. The nearer of two boxes comes first.
  template <class Reach, class Item>
  void near(const Vec3& p, Reach&& reach, Item&& item) const;
  // Visits the items whose boxes a segment touches, until item(i) returns true. Returns whether one did.
  template <class Item>
  bool along(const Vec3& from, const Vec3& to, Item&& item) const;

 private:
  // A node's children are the next node and `right`; a leaf has the items order_[first .. first + count).
  struct Node {
    ItemBox box;
    Index first, count, right;
  };
  // The stack of a search: 2^31 items halved to leaves make 31 levels, and each leaves one node to visit.
  static constexpr std::size_t depth = 64;
  Index build(const Vector<ItemBox>& items, Index first, Index count);
  static double squared(const ItemBox& box, const Vec3& p) noexcept {
    const double x = std::max(std::max(box.low.x - p.x, p.x - box.high.x), 0.0),
                 y = std::max(std::max(box.low.y - p.y, p.y - box.high.y), 0.0),
                 z = std::max(std::max(box.low.z - p.z, p.z - box.high.z), 0.0);
    return x * x + y * y + z * z;
  }
  static bool touches(const ItemBox& box, const Vec3& from, const Vec3& along) noexcept;

  Vector<Index> order_;
  Vector<Node> nodes_;
};

template <class Reach, class Item>
void BoxTree::near(const Vec3& p, Reach&& reach, Item&& item) const {
  if (nodes_.empty()) return;
  struct Open {
    Index node;
    double squared;
  };
  Open stack[depth];
  std::size_t open = 0;
  stack[open++] = {0, squared(nodes_[0].box, p)};
  while (open > 0) {
    const Open next = stack[--open];
    if (next.squared > reach()) continue;
    const Node& node = nodes_[at(next.node)];
    if (node.right < 0) {
      for (Index i = node.first; i < node.first + node.count; ++i) item(order_[at(i)]);
      continue;
    }
    Open left{next.node + 1, squared(nodes_[at(next.node) + 1].box, p)};
    Open right{node.right, squared(nodes_[at(node.right)].box, p)};
    if (right.squared < left.squared) std::swap(left, right);
    stack[open++] = right, stack[open++] = left;
  }
}

template <class Item>
bool BoxTree::along(const Vec3& from, const Vec3& to, Item&& item) const {
  if (nodes_.empty()) return false;
  Index stack[depth];
  std::size_t open = 0;
  stack[open++] = 0;
  const Vec3 way = to - from;
  while (open > 0) {
    const Index here = stack[--open];
    const Node& node = nodes_[at(here)];
    if (!touches(node.box, from, way)) continue;
    if (node.right >= 0) {
      stack[open++] = node.right, stack[open++] = here + 1;
      continue;
    }
    for (Index i = node.first; i < node.first + node.count; ++i) {
      if (item(order_[at(i)])) return true;
    }
  }
  return false;
}

// Returns the point of the segment a, b nearest to p.
inline Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 ab = b - a;
  const double square = dot(ab, ab);
  if (!(square > 0)) return a;
  const double t = dot(p - a, ab) / square;
  return t <= 0 ? a : t >= 1 ? b : a + t * ab;
}

// The share t of the way at which a segment from `from` crosses a triangle, or a negative number if it does not.
// entering: the crossing goes against the triangle's normal.
double crossing(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b, const Vec3& c,
                bool& entering) noexcept;

}  // namespace hf_inner
