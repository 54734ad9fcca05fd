// A loop of an arc as a closed polyline on the surface, with places along it for points of the flow.
//
// The loop at value c crosses its edges at points P_i. Edge i gets the stretch from the middle of the segment before
// P_i to the middle of the segment behind it, and its flux is spread evenly along that stretch. So nodes keep their
// order and lie on the surface.
#pragma once
#include "remesh/rings.h"

namespace hf_inner {

class LoopLine {
 public:
  explicit LoopLine(Memory& memory) : edges_(memory), points_(memory), starts_(memory) {}
  // border: points lie at the ends of the edges that are no apex.
  void build(const FluxField& field, Loop loop, double value, bool border);

  const Table<std::int32_t>& edges() const noexcept { return edges_; }
  double length() const noexcept { return length_; }
  // Place along the loop at which a line crosses edge i.
  double place(std::int32_t i, double offset) const noexcept;
  // The line at a place; any real number, modulo the length.
  FluxPoint at(double place) const noexcept;
  // The place of a point of the flow; 0 if the loop does not cross its edge.
  double place_of(FluxPoint p) const noexcept;
  SurfacePoint location(double place) const noexcept;

 private:
  struct Spot {
    std::int32_t edge;
    double share;  // 0 at its left end, 1 at its right
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
    double t;  // from the tail of the edge to its head
  };
  Table<Point> points_;
  Table<double> starts_;  // place of every point
  double length_ = 0;
};

}  // namespace hf_inner
