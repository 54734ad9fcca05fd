// The surface at rest as deformation needs it: vertex areas, vertices by component, triangles at a piece of vertices,
// edge stiffness. Made once per pose, shared by its clones. Cost O(n). On failure nothing is left behind.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "engine/core.h"

namespace hf_inner {

struct Rest {
  Rest(const Core& core, Memory& memory);

  // Vertices of component c: vertices[start[c] .. start[c + 1]), ascending.
  Vector<std::int32_t> component_start;
  Vector<std::int32_t> component_vertex;
  Vector<std::int32_t> component_triangles;  // number of triangles per component
  Vector<double> component_area;
  Vector<double> area;  // lumped, per vertex
  // Corners of the triangles at piece k of the vertices (for_vertex_pieces), three each: piece_corner[3 * i], i from
  // piece_start[k] to piece_start[k + 1]. Those with all corners in the piece come first, up to piece_border[k]; those
  // at a border are in the lists of all its pieces.
  Vector<std::int32_t> piece_start, piece_border;
  Vector<std::int32_t> piece_corner;
  // Edge weights of the elastic energy: the operator's, kept in [least_edge_weight, largest_edge_weight]. Negative ones would reward collapse, huge
  // ones come from triangles without area.
  Vector<double> stiffness;

  Span<const std::int32_t> vertices_of(std::int32_t component) const noexcept {
    const auto first = static_cast<std::size_t>(component_start[component]),
               last = static_cast<std::size_t>(component_start[component + 1]);
    return {component_vertex.data() + first, last - first};
  }
};

// Calls loop(first, last) for every piece of 0 .. count.
template <class Loop>
void for_vertex_pieces(JobRunner& jobs, std::int32_t count, Loop&& loop) {
  const std::int32_t pieces = (count + vertex_piece - 1) / vertex_piece;
  jobs.for_each(static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
    const std::int32_t first = static_cast<std::int32_t>(piece) * vertex_piece;
    loop(first, count - first < vertex_piece ? count : first + vertex_piece);
  });
}

// A number in [0, 1) from an index: the sampling of edges and triangles must not follow the order of the input.
inline double scattered(std::uint32_t index) noexcept {
  std::uint64_t x = index + 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace hf_inner
