// The line of a knife on a mesh: vertices, points on edges and points in triangles, each two in a row in one triangle.
//
// The paths between the given points are shortest paths (surface_curve.h). Points near vertices and edges are moved
// onto them. All places become whole numbers (triangle_division.h), so later steps need no tolerance.
#pragma once
#include "mesh/surface_curve.h"
#include "mesh/triangle_division.h"

namespace hf_inner::mesh {

// A point of a line: a vertex, else a point on an edge, else a point in a triangle. The other two are Mesh::none.
struct LinePoint {
  std::int32_t vertex = Mesh::none, edge = Mesh::none, triangle = Mesh::none;
  GridPoint in{0,
               0};  // on an edge, `a` is the weight of its second vertex; in a triangle, `a` and `b` are of its corners
  std::int32_t segment = 0;  // the given point whose path it begins or lies on
  bool given = false;        // one of the given points
};
inline bool is_same(const LinePoint& p, const LinePoint& q) noexcept {
  return p.vertex == q.vertex && p.edge == q.edge && p.triangle == q.triangle &&
         (p.vertex != Mesh::none || p.in == q.in);
}

struct CutLine {
  explicit CutLine(Memory& memory) : points(&memory) {}
  Vector<LinePoint> points;  // no point comes twice in a row
  bool closed = false;       // the last point is joined to the first
};

// Bounds of CutOptions::snap_share. Below the least share a triangle could be narrower than the steps of its grid. At
// half, every point would be a vertex.
constexpr double least_snap_share = 1e-6, most_snap_share = 0.4;

struct CutOptions {
  double snap_share = 0;        // points nearer to a vertex or an edge than this share of the edge or height lie on it
  std::size_t most_points = 0;  // of the line
};

// points: in triangles of one component; the line is closed if the last one is the first. Throws what surface_curve
// throws, and HF_ERROR_EMPTY for a line without length.
CutLine cut_line(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points, const CutOptions& options,
                 Memory& memory);

}  // namespace hf_inner::mesh
