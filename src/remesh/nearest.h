// Finds the point of a set of triangles nearest to a given point, through a tree of boxes.
#pragma once
#include "mesh/mesh.h"
#include "remesh/table.h"

namespace hf_inner {

class NearestTriangle {
 public:
  // corners: three indices into positions per triangle. Both arrays must outlive this object.
  NearestTriangle(const Table<Vec3>& positions, const Table<std::int32_t>& corners, Memory& memory);
  struct Found {
    std::int32_t triangle = -1;
    double squared = 0;
  };
  // Finds the nearest triangle. hint: a triangle that may be near, or -1. enough: a squared distance; the search ends
  // at the first triangle that is at least that near. Cost: O(log triangles) on a surface, O(1) if the hint is near
  // enough.
  Found find(Vec3 p, std::int32_t hint = -1, double enough = 0) const noexcept;
  // Computes the barycentric weights of the point of triangle t nearest to p.
  void weights(Vec3 p, std::int32_t t, double* out) const noexcept;
  // Returns the triangles in the order of the tree: neighbours in this order are neighbours in space.
  const Table<std::int32_t>& order() const noexcept { return order_; }

 private:
  struct Box {
    Vec3 low, high;
    // Triangles of a leaf; right: number of the right child (the left is the next box).
    std::int32_t first, count, right;
  };
  std::int32_t build(std::int32_t first, std::int32_t count);
  Vec3 corner(std::int32_t t, std::int32_t k) const noexcept { return (*positions_)[(*corners_)[3 * t + k]]; }

  const Table<Vec3>* positions_;
  const Table<std::int32_t>* corners_;
  Table<std::int32_t> order_;
  Table<Box> boxes_;
};

}  // namespace hf_inner
