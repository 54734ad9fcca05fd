// A level loop of the flow field as a closed polyline on the surface. It turns points of the flow into places along the
// polyline, and back.
//
// The loop at value c crosses its edges at points P_i. Edge i gets a stretch of the polyline: from the middle of the
// segment before P_i to the middle of the segment behind it. The edge's flux is spread evenly along that stretch. So
// nodes keep their order and lie on the surface.
#pragma once
#include "remesh/rings.h"

namespace hf_inner {

class LoopLine {
 public:
  explicit LoopLine(Memory& memory) : edges_(memory), points_(memory), starts_(memory) {}
  // Builds the polyline of a level loop. border: the loop is the border itself, so each point is a vertex of it.
  void build(const FluxField& field, Loop loop, double value, bool border);

  const Table<std::int32_t>& edges() const noexcept { return edges_; }
  double length() const noexcept { return length_; }
  // Returns the place along the loop at which a flux line crosses edge i with this offset in the edge's flux.
  double place(std::int32_t i, double offset) const noexcept;
  // Returns the flux line that crosses the loop at a place. `place` may be any real number; it counts modulo the loop's
  // length.
  FluxPoint at(double place) const noexcept;
  // Returns the place along the loop of a point on a flux line, or 0 if the loop does not cross the point's edge.
  double place_of(FluxPoint p) const noexcept;
  SurfacePoint location(double place) const noexcept;

 private:
  struct Spot {
    std::int32_t edge;
    double share;  // place within the edge's flux: 0 at its left end, 1 at its right
  };
  std::int32_t around(std::int32_t i) const noexcept {
    return i < 0 ? i + edges_.size() : i >= edges_.size() ? i - edges_.size() : i;
  }
  Spot spot(double place) const noexcept;
  double segment(std::int32_t i) const noexcept;  // length of the segment behind point i
  void add(std::int32_t i, double share, std::int32_t triangle, SurfacePoint& out) const noexcept;

  const FluxField* field_ = nullptr;
  Table<std::int32_t> edges_;
  struct Point {
    Vec3 p;
    double t;  // position on the edge, from its tail (0) to its head (1)
  };
  Table<Point> points_;
  Table<double> starts_;  // place of each point along the loop
  double length_ = 0;
};

}  // namespace hf_inner
