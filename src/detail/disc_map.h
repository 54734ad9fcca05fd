// Maps a region to the unit disc; the region must be a disc (one boundary loop, no holes, no handles).
//
// The boundary loop maps to the circle, by arc length between given angles. Every other vertex maps to the weighted
// mean of its neighbours. Weights are cotangent weights, raised to a positive floor (disc_least_weight). Positive
// weights guarantee a map without folds (Tutte 1963; Floater 1997).
//
// Cost: one factorisation of the region's own Laplacian, then O(m) work for m vertices of region and rim.
#pragma once
#include "detail/region.h"

namespace hf_inner::detail {

// The boundary loop of a region that is a disc. Vertices are numbered within the region (RegionShape::local).
struct DiscBoundary {
  DiscBoundary(const RegionSurface& surface, const RegionState& state, Memory& memory);
  // Returns the position of a vertex along the loop, or -1 for a vertex off it. local: the vertex's local number.
  std::int32_t place(std::int32_t local) const noexcept { return place_[static_cast<std::size_t>(local)]; }
  Vector<std::int32_t> loop;  // boundary vertices in order; the region lies to the left
  Vector<double> arc;         // length along the loop up to each vertex; last entry: the whole length
 private:
  Vector<std::int32_t> place_;
};

struct DiscPoint {
  double u = 0, v = 0;
};

// Vertices of the boundary loop that are pinned to given angles on the circle. The array `place` counts along the loop,
// in order from the first pinned vertex and without repeats. `turn` is the angle in whole turns and rises from 0.
struct DiscPins {
  explicit DiscPins(Memory& memory) : place(&memory), turn(&memory) {}
  Vector<std::int32_t> place;
  Vector<double> turn;
};

// Returns the disc point of every vertex of the region and around it, by RegionShape::local.
Vector<DiscPoint> map_to_disc(const RegionSurface& surface, const RegionState& state, const DiscBoundary& boundary,
                              const DiscPins& pins, Memory& memory);

// Finds the triangle of a mapped region that contains a point, or else the nearest one. The triangles are kept in a
// tree of boxes, each split at the median. For m triangles it costs O(m log m) to build, and about O(log m) per search.
class DiscSearch {
 public:
  DiscSearch(Span<const std::int32_t> corners, Span<const DiscPoint> points, Memory& memory);
  // Returns the number of the triangle. weights: barycentric weights of the point, each at least 0, with sum 1.
  std::int32_t find(DiscPoint point, double weights[3]) const;

 private:
  struct Box {
    double low[2], high[2];
    std::int32_t first, count;  // range of order_ in a leaf; count 0: the children are boxes first and first + 1
  };
  void split(std::int32_t box, Vector<DiscPoint>& centre);
  Box box_of(std::int32_t first, std::int32_t count) const;
  Span<const std::int32_t> corners_;
  Span<const DiscPoint> points_;
  Vector<std::int32_t> order_;
  Vector<Box> boxes_;
};

}  // namespace hf_inner::detail
