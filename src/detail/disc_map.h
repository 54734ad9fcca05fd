// Maps a region that is a disc to the unit disc.
//
// Its boundary loop maps to the circle, by arc length between given angles. Every other vertex maps to the weighted
// mean of its neighbours. All weights are positive (cotangent weights with a floor, disc_least_weight), so the map is
// an embedding (Tutte 1963; Floater 1997).
//
// Cost: one factorisation of the region's own Laplacian, O(m) for the rest with m vertices of region and rim.
#pragma once
#include "detail/region.h"

namespace hf_inner {

// The boundary loop of a region that is a disc. Numbers are local ones of its shape.
struct DiscBoundary {
  DiscBoundary(const RegionSurface& surface, const RegionState& state, Memory& memory);
  // Position along the loop of a local vertex, or -1.
  std::int32_t place(std::int32_t local) const noexcept { return place_[static_cast<std::size_t>(local)]; }
  Vector<std::int32_t> loop;  // boundary vertices, the region to the left
  Vector<double> arc;         // length along the loop up to each of them, and in the end the whole
 private:
  Vector<std::int32_t> place_;
};

struct DiscPoint {
  double u = 0, v = 0;
};

// Places along the loop with given angles, in turns: places in order from the first, without repeats; angles rise from
// 0.
struct DiscPins {
  explicit DiscPins(Memory& memory) : place(&memory), turn(&memory) {}
  Vector<std::int32_t> place;
  Vector<double> turn;
};

// Returns disc points by local number.
Vector<DiscPoint> map_to_disc(const RegionSurface& surface, const RegionState& state, const DiscBoundary& boundary,
                              const DiscPins& pins, Memory& memory);

// Finds the triangle of a mapped region that contains a point, or the nearest one, through a tree of boxes halved at
// the median. Cost: O(m log m) to make, about O(log m) a search.
class DiscSearch {
 public:
  DiscSearch(Span<const std::int32_t> corners, Span<const DiscPoint> points, Memory& memory);
  // The triangle; weights: of its corners, >= 0 and of sum 1.
  std::int32_t find(DiscPoint point, double weights[3]) const;

 private:
  struct Box {
    double low[2], high[2];
    std::int32_t first, count;  // of order_, in leaves; count 0: the children are first and first + 1
  };
  void split(std::int32_t box, Vector<DiscPoint>& centre);
  Box box_of(std::int32_t first, std::int32_t count) const;
  Span<const std::int32_t> corners_;
  Span<const DiscPoint> points_;
  Vector<std::int32_t> order_;
  Vector<Box> boxes_;
};

}  // namespace hf_inner
