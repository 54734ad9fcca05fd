// Finds the point of a set of triangles nearest to a given point, through a tree of boxes, or one tree for each group
// of triangles.
#pragma once
#include <algorithm>

#include "base/index.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner {

class NearestTriangle {
 public:
  // corners: three indices into positions per triangle. Both arrays must outlive this object.
  NearestTriangle(Span<const Vec3> positions, Span<const Index> corners, Memory& memory);
  // Makes one tree per group. group: by triangle, below group_count.
  NearestTriangle(Span<const Vec3> positions, Span<const Index> corners, Span<const Index> group, Index group_count,
                  Memory& memory);
  struct Found {
    Index triangle = -1;
    double squared = 0;
  };
  struct Box {
    Vec3 low, high;
  };
  // Finds the nearest triangle. hint: a triangle that may be near, or -1. enough: a squared distance; the search ends
  // at the first triangle that is at least that near. Cost: O(log triangles) on a surface, O(1) if the hint is near
  // enough.
  Found find(Vec3 p, Index hint = -1, double enough = 0) const noexcept;
  // Finds the nearest triangle of a group whose squared distance is below `within`; triangle -1: there is none. hint: a
  // triangle of the group that may be near, or -1.
  Found find_in(Index group, Vec3 p, double within, Index hint = -1) const noexcept;
  // Computes the barycentric weights of the point of triangle t nearest to p.
  void weights(Vec3 p, Index t, double* out) const noexcept;
  // Returns the triangles in the order of the tree: neighbours in this order are neighbours in space.
  const Vector<Index>& order() const noexcept { return order_; }
  bool has(Index group) const noexcept { return roots_[at(group)] >= 0; }
  // The box around a group that has a triangle.
  Box box(Index group) const noexcept;

 private:
  struct Node {
    Vec3 low, high;
    // Triangles of a leaf; right: number of the right child (the left is the next node).
    Index first, count, right;
  };
  Index build(Index first, Index count);
  void search(Index root, Vec3 p, double enough, bool bounded, Found& found) const noexcept;
  Vec3 corner(Index t, std::size_t k) const noexcept { return positions_[at(corners_[3 * at(t) + k])]; }

  Span<const Vec3> positions_;
  Span<const Index> corners_;
  Vector<Index> order_, roots_;
  Vector<Node> nodes_;
};

// Returns the squared distance from a point to a triangle. weights: receives the barycentric weights of the nearest
// point.
double nearest_in_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c, double weights[3]) noexcept;

// Returns the squared distance from a point to a box.
inline double squared_distance(Vec3 p, const NearestTriangle::Box& box) noexcept {
  const double x = std::max(std::max(box.low.x - p.x, p.x - box.high.x), 0.0),
               y = std::max(std::max(box.low.y - p.y, p.y - box.high.y), 0.0),
               z = std::max(std::max(box.low.z - p.z, p.z - box.high.z), 0.0);
  return x * x + y * y + z * z;
}
// Returns the squared distance between two boxes.
double squared_distance(const NearestTriangle::Box& a, const NearestTriangle::Box& b) noexcept;

}  // namespace hf_inner
