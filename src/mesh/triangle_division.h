// Divides one triangle along straight lines between points in it: a constrained Delaunay triangulation.
//
// Points are whole barycentric coordinates of sum `grid`. So every orientation is exact, in 64 bits, whatever the shape
// of the triangle: no rounding turns a new triangle inside out, and two lines that cross are always seen to cross.
#pragma once
#include "base/index.h"
#include "base/memory.h"
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Whole barycentric coordinates: the first two of three.
struct GridPoint {
  // A third of the digits of a double: products of two differences fit 64 bits, and a step is 2e-9 of an edge, which no
  // eye sees. Half is as good. Products of a grid of 2^31 do not fit.
  static constexpr std::int64_t grid = std::int64_t{1} << 29;
  std::int64_t a, b;
  std::int64_t weight(int k) const noexcept { return k == 0 ? a : k == 1 ? b : grid - a - b; }
  bool operator==(const GridPoint& o) const noexcept { return a == o.a && b == o.b; }
};

class TriangleDivision {
 public:
  explicit TriangleDivision(Memory& memory)
      : triangles_(&memory), points_(&memory), plane_(&memory), at_(&memory), queue_(&memory), crossed_(&memory) {}

  // Starts with the triangle of these corners. Its points 0, 1 and 2 are the corners.
  void begin(Vec3 a, Vec3 b, Vec3 c);
  // Adds a point inside or on a side, and returns its number. No point comes twice.
  Index add(GridPoint point);
  // Makes the line between two points an edge. Returns false if it crosses another such line, or passes a point.
  bool join(Index from, Index to);

  std::size_t triangle_count() const noexcept { return triangles_.size(); }
  // The points of triangle t, in the orientation of the whole.
  const Index* corners(std::size_t t) const noexcept { return triangles_[t].v; }
  const GridPoint& point(Index p) const noexcept { return points_[at(p)]; }

 private:
  static constexpr Index none = -1;
  struct Piece {
    Index v[3];
    Index beyond[3];  // the triangle beyond the side from v[k] to the next corner, or none
    bool fixed[3];    // that side lies on a line
  };
  struct Side {
    Index triangle, k;
  };
  static int next(int k) noexcept { return k == 2 ? 0 : k + 1; }
  static int last(int k) noexcept { return k == 0 ? 2 : k - 1; }
  std::int64_t turn(Index p, Index q, Index r) const noexcept;
  int corner_of(Index t, Index p) const noexcept;
  Side twin(Side side) const noexcept;
  Side side_between(Index p, Index q) const noexcept;
  Side first_crossed(Index from, Index to, bool& passes) const noexcept;
  Index locate(Index p);
  void put(Index t, Index p, Index q, Index r);
  void link(Side one, Side other, bool fixed) noexcept;
  void split_inside(Index t, Index p);
  void split_side(Side side, Index p);
  void flip(Side side) noexcept;
  bool is_flippable(Side side) const noexcept;
  bool is_better_flipped(Side side) const noexcept;
  void make_delaunay();

  Vector<Piece> triangles_;
  Vector<GridPoint> points_;
  struct Place {
    double x, y;
  };
  Vector<Place> plane_;  // by point: in the plane of the triangle
  Place corner_[2];      // of a and b; c is the origin
  Vector<Index> at_;     // by point: a triangle that has it
  struct Pair {
    Index p, q;
  };
  Vector<Pair> queue_;    // sides that may not be Delaunay
  Vector<Pair> crossed_;  // sides that the present line crosses
  Index here_ = 0;        // where the last point was found
};

}  // namespace hf_inner::mesh
