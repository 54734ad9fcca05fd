// Carries distances across a triangle, as if its source lay in the plane of the triangle.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/hypotenuse.h"

namespace hf_inner::mesh {

// Returns the distance of corner C from a source that has distance a from corner A and b from corner B. The numbers ab,
// ac and bc are the edge lengths of the triangle. The path is a straight line if that crosses the edge AB, else it
// follows an edge.
inline double distance_across(double a, double b, double ab, double ac, double bc) noexcept {
  const double along_edges = std::min(a + ac, b + bc);
  if (!(ab > 0)) return along_edges;
  // In the plane, A is the origin, B is (ab, 0), C lies above the x axis and the source below it.
  const double cx = (ac * ac - bc * bc + ab * ab) / (2 * ab), sx = (a * a - b * b + ab * ab) / (2 * ab);
  const double cy2 = ac * ac - cx * cx, sy2 = a * a - sx * sx;
  if (!(cy2 > 0) || sy2 < 0) return along_edges;
  const double cy = std::sqrt(cy2), sy = std::sqrt(sy2);
  const double crossing = sx + (cx - sx) * sy / (sy + cy);
  if (crossing < 0 || crossing > ab) return along_edges;
  return std::min(along_edges, hypotenuse(cx - sx, cy + sy));
}

}  // namespace hf_inner::mesh
