// Draws curves through triangles: shortest paths along the surface between their points.
//
// Each path is exact (mesh/exact_path.h). It is no longer than the shortest path along edges. So it stays in an
// ellipsoid whose foci are its two ends, and the search stays there too. Cost: a path costs O(d log d) for the d
// vertices nearer than its end along edges, and exact distances on the triangles in the ellipsoid.
#pragma once
#include <limits>

#include "mesh/exact_path.h"

namespace hf_inner::mesh {

// A point of a triangle. A corner of weight 0 may be Mesh::none. The weights sum to 1.
struct CurvePoint {
  std::int32_t corner[3];
  double weight[3];
};
inline CurvePoint at_vertex(std::int32_t v) noexcept { return {{v, Mesh::none, Mesh::none}, {1, 0, 0}}; }

// A curve. Its places are the vertices that it passes, the edges that it crosses, and its points inside
// triangles; between two places it is a straight line in one triangle.
struct SurfaceCurve {
  explicit SurfaceCurve(Memory& memory) : place(&memory), point_of(&memory), triangle(&memory) {}
  Vector<PathPoint> place;        // no place comes twice in a row
  Vector<std::int32_t> point_of;  // the point whose path place[i] lies on, or that it is
  Vector<std::int32_t> triangle;  // of the line from place[i] to the next one; an open curve has one less
};

struct CurveOptions {
  bool closed = true;  // the last point is joined to the first
  std::size_t most_places = std::numeric_limits<std::size_t>::max();
};
// points: of one component, each in a triangle of the mesh (CurvePoint). Weights up to place_tolerance count as 0, as
// for crossings of edges. topology: of the triangles alone. Throws HF_ERROR_TOO_LARGE for more places than the options
// allow (index = the point whose path has them), what shortest_path throws, or std::bad_alloc.
SurfaceCurve surface_curve(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points,
                           const CurveOptions& options, Memory& memory);

// The triangle that has these three corners; Mesh::none if none has.
std::int32_t triangle_of(const Mesh& mesh, const Topology& topology, const std::int32_t corners[3]);

// Tells whether the corners of weight above 0 form a vertex, an edge or a triangle of the mesh.
bool is_on_triangle(const Mesh& mesh, const Topology& topology, const CurvePoint& point);

// The corner of largest weight.
std::int32_t nearest_corner(const CurvePoint& point) noexcept;

// Throws HF_ERROR_INVALID_ARGUMENT if a point lies in another component than the first point; index: its position.
void require_one_component(const Mesh& mesh, Span<const CurvePoint> points);

}  // namespace hf_inner::mesh
