// Opens corners between two feature edges that are too sharp for the grid to one quad.
//
// Crosses follow feature edges. Below 45 degrees the nearest directions of a cross are the same along both edges of a
// corner. The corner would then have no quad, and both edges would lie on one line of the grid. The tips of a saw are
// like this. So the crosses in such a corner stand as if it were a right angle: turned away from both edges. They stay
// turned along the edges up to the next corners, such as the valleys of the saw. There the angle counts without the
// turns, so that the sum of all corners stays equal to the shape's.
//
// Two creases from a sharp corner are a tooth if both are at least two edges of quads long. On a tooth, crosses stay
// turned only where two quads have no room between the creases. Beyond, crosses follow the creases again, and a vertex
// of three quads lies between them. If the next corners are near that place, crosses stay turned up to these corners.
#pragma once
#include <complex>

#include "remesh/flux_surface.h"

namespace hf_inner::quads {

struct SharpCorners {
  explicit SharpCorners(Memory& memory) : turn(memory), tooth(memory), inside(memory), passed(memory) {}
  // features: by half-edge. edge_length: of the quads.
  static SharpCorners find(const remesh::FluxSurface& surface, const remesh::Table<std::uint8_t>& features,
                           double edge_length, Memory& memory);
  bool empty() const noexcept { return count == 0; }

  std::int32_t count = 0;
  remesh::Table<double> turn;  // by half-edge: how far the crosses on its left are turned from it, counter-clockwise
  remesh::Table<std::uint8_t> tooth;  // by half-edge: it is turned by the corner of a tooth
  // By triangle: the same, of its half-edge that leaves the corner; only in corners and where that is no feature.
  struct Inside {
    std::int32_t half = -1;
    double turn = 0;
  };
  remesh::Table<Inside> inside;
  remesh::Table<std::uint8_t> passed;  // by vertex: turned feature edges run through it
};

// The angle of a triangle at the tail of h.
double corner_angle(const remesh::FluxSurface& surface, std::int32_t h) noexcept;

}  // namespace hf_inner::quads
