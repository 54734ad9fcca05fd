// Iso-lines of a piecewise linear field: for each level c the set { u = c } as polylines over the edges of the mesh.
//
// A vertex with u = c exactly counts as just above c (Edelsbrunner and Muecke 1990, "simulation of simplicity", for one
// comparison), so every triangle is crossed by a line in exactly two edges or not at all, whatever the values, and
// lines have no gaps: they are closed, or end at a border edge (or at the odd triangle of a non-manifold edge, whose
// triangles are taken in pairs). Points that fall on one vertex are written once; lines that shrink to fewer than three
// places (two for open ones) have no extent and are left out. On consistently oriented surfaces higher values lie on
// the left.
//
// Cost: O(E log levels + length of the lines). On failure the output is as far as it got.
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
  Vector<Point> points;         // of all lines, one after the other; a closed line does not repeat its first point
  Vector<std::uint32_t> start;  // line i: points start[i] .. start[i + 1]
  Vector<std::uint32_t> level;  // of line i, its position in the caller's list
  Vector<std::uint8_t> closed;
};

// field: one value per inner vertex; NaN = none, triangles at such a vertex are left out. levels: finite, any order.
// Lines come in the order of the list.
Isolines trace_isolines(const Mesh& mesh, const Topology& topology, Span<const double> field, Span<const double> levels,
                        Memory& memory);

}  // namespace hf_inner
