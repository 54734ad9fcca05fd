// Finds the items near a point or a box, or on a segment, among many triangles, bones or points.
//
// It knows the boxes of the items only. The caller tests the items themselves, through a function. Items can be sorted
// into groups, with a tree for each. The order of the visits is the same on every machine. It is immutable, so any
// number of threads may search it.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

struct ItemBox {
  Vec3 low, high;
  void take(const Vec3& p) noexcept {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void take(const ItemBox& other) noexcept {
    take(other.low);
    take(other.high);
  }
  static ItemBox of(const Vec3& p) noexcept { return {p, p}; }
};

// Squared distances between a point or a box and a box.
inline double squared_distance(const Vec3& p, const ItemBox& box) noexcept {
  const double x = std::max(std::max(box.low.x - p.x, p.x - box.high.x), 0.0),
               y = std::max(std::max(box.low.y - p.y, p.y - box.high.y), 0.0),
               z = std::max(std::max(box.low.z - p.z, p.z - box.high.z), 0.0);
  return x * x + y * y + z * z;
}
inline double squared_distance(const ItemBox& a, const ItemBox& b) noexcept {
  const double x = std::max(std::max(b.low.x - a.high.x, a.low.x - b.high.x), 0.0),
               y = std::max(std::max(b.low.y - a.high.y, a.low.y - b.high.y), 0.0),
               z = std::max(std::max(b.low.z - a.high.z, a.low.z - b.high.z), 0.0);
  return x * x + y * y + z * z;
}

// Returns the boxes of triangles. corners: three indices into positions per triangle.
Vector<ItemBox> triangle_boxes(Span<const Vec3> positions, Span<const Index> corners, Memory& memory);

class BoxTree {
 public:
  // Builds one tree. It keeps no reference to `items`. Cost: O(n log n).
  BoxTree(Span<const ItemBox> items, Memory& memory);
  // Builds one tree per group. group: by item, below group_count.
  BoxTree(Span<const ItemBox> items, Span<const Index> group, Index group_count, Memory& memory);

  // Visits the items of a group whose boxes are nearer to p than the square root of reach(). item(i) may lower what
  // reach() returns; below 0 it ends the search. The nearer of two boxes comes first.
  template <class Reach, class Item>
  void near(Index group, const Vec3& p, Reach&& reach, Item&& item) const;
  template <class Reach, class Item>
  void near(const Vec3& p, Reach&& reach, Item&& item) const {
    near(0, p, reach, item);
  }
  // Visits the items whose boxes a segment touches, until item(i) returns true. Returns whether one did. Only for a
  // single tree.
  template <class Item>
  bool along(const Vec3& from, const Vec3& to, Item&& item) const;

  // Returns the items in the order of the trees: neighbours in this order are neighbours in space.
  const Vector<Index>& order() const noexcept { return order_; }

 private:
  // A node's children are the next node and `right`; a leaf has the items order_[first .. first + count).
  struct Node {
    ItemBox box;
    Index first, count, right;
  };
  struct Entry;
  // The stack of a search: 2^31 items halved to leaves make 31 levels, and each leaves one node to visit.
  static constexpr std::size_t depth = 64;
  Index build(Span<const ItemBox> items, Entry* entries, Index first, Index count);
  // A segment that many boxes are tested against. The inverse of its way saves a division for each side of a box.
  struct Segment {
    Segment(const Vec3& from, const Vec3& way) noexcept;
    double from[3], inverse[3];  // inverse 0: the segment does not move along this axis
  };
  static bool touches(const ItemBox& box, const Segment& segment) noexcept;

  Vector<Index> order_, start_, root_;  // start_, root_: by group; root -1: it is empty
  Vector<Node> nodes_;
};

template <class Reach, class Item>
void BoxTree::near(Index group, const Vec3& p, Reach&& reach, Item&& item) const {
  if (root_[at(group)] < 0) return;
  struct Open {
    Index node;
    double squared;
  };
  Open stack[depth];
  std::size_t open = 0;
  stack[open++] = {root_[at(group)], squared_distance(p, nodes_[at(root_[at(group)])].box)};
  while (open > 0) {
    const Open next = stack[--open];
    if (next.squared > reach()) continue;
    const Node& node = nodes_[at(next.node)];
    if (node.right < 0) {
      for (Index i = node.first; i < node.first + node.count; ++i) item(order_[at(i)]);
      continue;
    }
    Open left{next.node + 1, squared_distance(p, nodes_[at(next.node) + 1].box)};
    Open right{node.right, squared_distance(p, nodes_[at(node.right)].box)};
    if (right.squared < left.squared) std::swap(left, right);
    stack[open++] = right;
    stack[open++] = left;
  }
}

template <class Item>
bool BoxTree::along(const Vec3& from, const Vec3& to, Item&& item) const {
  if (nodes_.empty()) return false;
  Index stack[depth];
  std::size_t open = 0;
  stack[open++] = 0;
  const Segment segment(from, to - from);
  while (open > 0) {
    const Index here = stack[--open];
    const Node& node = nodes_[at(here)];
    if (!touches(node.box, segment)) continue;
    if (node.right >= 0) {
      stack[open++] = node.right;
      stack[open++] = here + 1;
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

}  // namespace hf_inner::mesh
