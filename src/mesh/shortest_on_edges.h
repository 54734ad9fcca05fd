// Keeps, on edges of three and more triangles, the windows of exact_distance.h that are shortest somewhere.
//
// A window passes on to every other triangle of its edge. Where many triangles share an edge, windows of the same paths
// would come again from each of them, and their number would grow by a factor at every edge. But a path can go on from
// any triangle of an edge to any other. So a window is of use only where no window before it on the edge is as short.
#pragma once
#include "base/memory.h"

namespace hf_inner::mesh {

struct Interval {
  double begin, end;
};

// The paths through an interval of an edge: at place u their length is sigma plus the distance from (x, y) to (u, 0).
struct EdgeRays {
  Interval part;
  double x, y, sigma;
  double length_to(double u) const noexcept;
};

class ShortestOnEdges {
 public:
  ShortestOnEdges(std::int32_t edge_count, Memory& memory)
      : edge_count_(edge_count), known_(&memory), last_(&memory), rest_(&memory) {}

  // Writes the parts of an interval where the paths are shorter than all before them on the edge, and keeps those.
  void keep(std::int32_t edge, const EdgeRays& rays, Vector<Interval>& parts);

 private:
  struct Known {
    EdgeRays rays;
    std::int32_t before;  // the one before on this edge, or -1
  };
  std::int32_t edge_count_;
  Vector<Known> known_;
  Vector<std::int32_t> last_;  // by edge: the last in known_, or -1
  Vector<Interval> rest_;
};

}  // namespace hf_inner::mesh
