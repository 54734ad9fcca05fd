// Iso-lines of a piecewise linear field: the set { u = c } of each level c as polylines over the edges of the mesh.
//
// A vertex with u = c exactly counts as just above c (Edelsbrunner and Muecke 1990, "simulation of simplicity", for one
// comparison). So a line crosses a triangle in exactly two edges or not at all, whatever the values, and has no gaps.
// It is closed, or ends at a border edge, or at the odd triangle of a non-manifold edge, whose triangles are paired.
// Points that fall on one vertex are written once. Lines that shrink to fewer than three places (two for open ones) are
// left out. On consistently oriented surfaces higher values lie on the left.
//
// Cost: O(E log levels + length of the lines). On failure the output is incomplete.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner {

struct Isolines {
  explicit Isolines(Memory& memory) : points(&memory), start(&memory), level(&memory), closed(&memory) {}
  std::uint32_t line_count() const noexcept { return static_cast<std::uint32_t>(level.size()); }

  struct Point {
    std::int32_t a, b;  // an edge, inner vertices
    double t;           // (1 - t) a + t b, in [0, 1]
  };
  Vector<Point> points;         // all lines in order; a closed line does not repeat its first point
  Vector<std::uint32_t> start;  // first point of a line, and the end
  Vector<std::uint32_t> level;  // position of a line's level in the caller's list
  Vector<std::uint8_t> closed;
};

// Where a point lies, in the unit of the mesh as given.
Vec3 position_of(const Mesh& mesh, const Isolines::Point& point) noexcept;

// field: one value per inner vertex; NaN = none, triangles at such a vertex are left out. levels: finite, any order.
// Lines come in the order of the list.
Isolines trace_isolines(const Mesh& mesh, const Topology& topology, Span<const double> field, Span<const double> levels,
                        Memory& memory);

}  // namespace hf_inner
