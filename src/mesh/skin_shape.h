// Tells inside from outside of a surface by rays.
#pragma once
#include "mesh/box_tree.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// The triangles of a surface in a tree. Rays tell which points are inside, and how thick the surface is there.
class SkinShape {
 public:
  SkinShape(const Mesh& mesh, Memory& memory);
  // Whether a segment enters the skin of a piece or, outwards, leaves it. Triangles of the vertex `own` do not count.
  bool crosses(const Vec3& from, const Vec3& to, Index piece, Index own, bool outwards) const noexcept;
  // The distance from a point along a unit direction to the first place where it leaves the skin, or `most`.
  double way_out(const Vec3& from, const Vec3& direction, double most) const noexcept;
  // Whether a point is inside: a ray from it leaves the skin more often than it enters.
  bool inside(const Vec3& point) const noexcept;
  // Writes the pieces whose triangles a segment crosses, each once.
  void pieces_along(const Vec3& from, const Vec3& to, Vector<Index>& out) const;
  const Vector<Vec3>& normals() const noexcept { return normals_; }

 private:
  const Mesh& mesh_;
  Vector<std::int8_t> side_;  // by piece: -1 where closed triangles face inwards
  Vector<Vec3> normals_;      // unit, by vertex; zero where triangles have no area
  BoxTree tree_;
};

}  // namespace hf_inner::mesh
