// The rows of an operator that differ after triangles were exchanged (mesh_patch.h).
//
// The intrinsic Delaunay triangulation of the mesh after differs from that before near the patch alone: an edge is
// Delaunay or not by its two triangles. So the operator is made of the triangles within a few rings of the patch, once
// with the old triangles and once with the new ones. The rows that differ between the two are the rows of the patch, if
// the rows with the old triangles equal the rows of the surface before, there and at all neighbours. Then the new
// triangulation inside and the old one outside have the same triangles along their border, so every edge of the two
// together is Delaunay. If the test fails, more rings are taken.
#pragma once
#include "surface/core.h"
#include "surface/vertex_map.h"

namespace hf_inner::surface {

struct PatchRows {
  PatchRows(const mesh::Mesh& before, const mesh::Mesh& after, Memory& memory)
      : map(before, after, memory), vertex(&memory), start(1, 0, &memory), column(&memory), value(&memory) {}
  // plain: the core before, without stiffness, whose laplacian is K. Returns null if the rows are not local: a clamped
  // operator depends on the median of all weights, and thin triangles are mollified together.
  static std::shared_ptr<const PatchRows> make(const Core& plain, const Geometry& after);
  // Returns the position of a vertex in `vertex`, or -1.
  Index find(Index v) const noexcept;
  // The diagonal of a row, by position in `vertex`.
  double diagonal(Index i) const noexcept;

  VertexMap map;
  Vector<Index> vertex;         // after, ascending
  Vector<Index> start, column;  // their rows, by ascending column, with the diagonal
  Vector<double> value;
};

}  // namespace hf_inner::surface
