// Traces the shortest path between two points of a surface, from exact distances (exact_distance.h).
#pragma once
#include "mesh/exact_distance.h"

namespace hf_inner::mesh {

// A corner of a path. It lies at (1 - t) a + t b on the edge between the vertices a and b. At a vertex a is b. The ends
// of a path inside a triangle have a = b = Mesh::none.
struct PathPoint {
  std::int32_t a, b;
  double t;
};

// Crossings of edges nearer to an end than this share of the edge are that vertex. A path that passes a vertex then
// passes it always, whichever way it runs. It is far above the rounding of a path (1e-13 of its length), and no eye
// sees it. With 1e-10, half, double and 1e-7, the tests of paths and curves pass.
constexpr double place_tolerance = 1e-9;

// The position of a corner that is not inside a triangle, in the unit of the caller.
Vec3 position_of(const Mesh& mesh, const PathPoint& point) noexcept;

struct SurfacePath {
  explicit SurfacePath(Memory& memory) : points(&memory) {}
  // From the first point to the second; empty: no path leads there. Each two in a row share a triangle. No crossing
  // lies on an edge of the point before it or after it, so no vertex and no crossing comes twice in a row.
  Vector<PathPoint> points;
  double length = 0;  // the exact distance; -1: no path
};

// Computes the shortest path. If several are as short, one of them. at_most: the length of a path that is known, or 0:
// the call finds one along edges. Throws HF_ERROR_CANCELLED or std::bad_alloc.
SurfacePath shortest_path(const TriangleSides& sides, const GeodesicPoint& from, const GeodesicPoint& to,
                          Memory& memory, double at_most = 0);

}  // namespace hf_inner::mesh
