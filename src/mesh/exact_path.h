// Traces the shortest path between two points of a surface, from exact distances (exact_distance.h).
#pragma once
#include "mesh/exact_distance.h"

namespace hf_inner {

// A corner of a path. It lies at (1 - t) a + t b on the edge between the vertices a and b. At a vertex a is b. The ends
// of a path inside a triangle have a = b = Mesh::none.
struct PathPoint {
  std::int32_t a, b;
  double t;
};

// The position of a corner that is not inside a triangle, in the unit of the caller.
Vec3 position_of(const Mesh& mesh, const PathPoint& point) noexcept;

struct SurfacePath {
  explicit SurfacePath(Memory& memory) : points(&memory) {}
  Vector<PathPoint> points;  // from the first point to the second; empty: no path leads there
  double length = 0;         // the exact distance; -1: no path
};

// Computes the shortest path. If several are as short, one of them. at_most: the length of a path that is known, or 0:
// the call finds one along edges. Throws HF_ERROR_CANCELLED or std::bad_alloc.
SurfacePath shortest_path(const TriangleSides& sides, const GeodesicPoint& from, const GeodesicPoint& to,
                          Memory& memory, double at_most = 0);

}  // namespace hf_inner
