// Finds the point of a set of triangles nearest to a given point, through a tree of boxes.
#pragma once
#include "base/index.h"
#include "base/span.h"
#include "mesh/box_tree.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Returns the squared distance from p to a triangle. weights: NULL, or receives the barycentric weights of the nearest
// point.
double squared_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c,
                           double* weights = nullptr) noexcept;

class NearestTriangle {
 public:
  // corners: three indices into positions per triangle. Both arrays must outlive this object.
  NearestTriangle(Span<const Vec3> positions, Span<const Index> corners, Memory& memory);
  struct Found {
    Index triangle = -1;
    double squared = 0;
  };
  // Finds the nearest triangle. hint: a triangle that may be near, or -1. enough: a squared distance; the search ends
  // at the first triangle that is at least that near. Cost: O(log triangles) on a surface, O(1) if the hint is near
  // enough.
  Found find(Vec3 p, Index hint = -1, double enough = 0) const noexcept;
  // Computes the barycentric weights of the point of triangle t nearest to p.
  void weights(Vec3 p, Index t, double* out) const noexcept;
  // Returns the triangles in the order of the tree: neighbours in this order are neighbours in space.
  const Vector<Index>& order() const noexcept { return tree_.order(); }

 private:
  double squared(const Vec3& p, Index t, double* weights = nullptr) const noexcept {
    const auto corner = [&](std::size_t k) -> const Vec3& { return positions_[at(corners_[3 * at(t) + k])]; };
    return squared_to_triangle(p, corner(0), corner(1), corner(2), weights);
  }

  Span<const Vec3> positions_;
  Span<const Index> corners_;
  BoxTree tree_;
};

}  // namespace hf_inner::mesh
