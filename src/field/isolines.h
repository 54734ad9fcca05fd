// Traces the iso-lines { u = c } of a piecewise linear field u as polylines over the mesh edges.
//
// A vertex with u = c exactly counts as just above c ("simulation of simplicity", Edelsbrunner and Muecke 1990). So a
// line crosses a triangle in exactly two edges or not at all, and has no gaps. A line is closed, or it ends at a border
// edge. At a non-manifold edge the triangles are taken in pairs; a line also ends at the triangle that has no partner.
// Consecutive points at the same vertex are written once. A closed line of fewer than three places is left out, and so
// is an open line of fewer than two. On consistently oriented surfaces higher values lie on the left of a line.
//
// Cost: O(E log levels + length of the lines), with E edges. If the function throws, the output is incomplete.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner::field {

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

// Returns the position of a point, in the unit of the caller's mesh.
Vec3 position_of(const mesh::Mesh& mesh, const Isolines::Point& point) noexcept;

// field: one value per welded vertex; NaN means no value, and triangles at such a vertex are left out. levels: in
// any order. The lines come in the order of the levels. Throws HF_ERROR_NON_FINITE (index = level).
Isolines trace_isolines(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const double> field,
                        Span<const double> levels, Memory& memory);

}  // namespace hf_inner::field
