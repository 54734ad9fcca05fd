// The rest shape as poses need it: vertex areas, vertices by component, triangles by piece of vertices, edge stiffness.
//
// Made once per pose and shared by its clones. A pose on an edited surface shares all but the stiffness. Cost: O(n). A
// failed call changes nothing.
#pragma once
#include <cstdint>
#include <memory>

#include "deform/constants.h"
#include "surface/core.h"

namespace hf_inner::deform {

// The part that depends on the geometry alone.
struct RestShape {
  RestShape(const surface::Core& core, Memory& memory);

  // The vertices of component c are component_vertex[component_start[c] .. component_start[c + 1]), ascending.
  Vector<std::int32_t> component_start;
  Vector<std::int32_t> component_vertex;
  Vector<std::int32_t> component_triangles;  // number of triangles per component
  Vector<double> component_area;
  Vector<double> area;  // per vertex: a third of its triangles
  // The triangles at the k-th run of vertex_piece vertices, piece k: corners piece_corner[3 * i] and the next two, i
  // from piece_start[k] to piece_start[k + 1]. Triangles with all corners in the piece come first, up to
  // piece_border[k]. A triangle with corners in several pieces is in the list of each of them.
  Vector<std::int32_t> piece_start, piece_border;
  Vector<std::int32_t> piece_corner;
  // The faces at vertex v are face[face_start[v] .. face_start[v + 1]), ascending. Empty where triangles were given.
  Vector<std::int32_t> face_start, face;
  // The triangles that give a field's mean gradient (levels.h): all of a component with few triangles, else a sample.
  struct SampledTriangle {
    std::int32_t corner[3];
    Vec3 opposite[3];   // the edge opposite each corner
    double twice_area;  // above 0
  };
  Vector<SampledTriangle> sampled;
  std::int32_t sampled_start[histogram_shares + 1];  // cut into jobs at fixed triangles
  // Edge weights of the operator without stiffness, clamped to [least_edge_weight, largest_edge_weight]. Negative
  // weights would reward collapse, and huge ones come from triangles without area.
  Vector<double> edge_weight;

  Span<const std::int32_t> vertices_of(std::int32_t component) const noexcept {
    const auto first = static_cast<std::size_t>(component_start[component]),
               last = static_cast<std::size_t>(component_start[component + 1]);
    return {component_vertex.data() + first, last - first};
  }
};

struct Rest {
  using SampledTriangle = RestShape::SampledTriangle;
  Rest(const surface::Core& core, Memory& memory)
      : Rest(make_shared_in<RestShape>(memory, core, memory), core, memory) {}
  // shape: of the core's geometry.
  Rest(std::shared_ptr<const RestShape> shape, const surface::Core& core, Memory& memory);

  std::shared_ptr<const RestShape> shape;
  Span<const std::int32_t> component_start, component_vertex, component_triangles;  // this and the next: of the shape
  Span<const double> component_area, area;
  Span<const std::int32_t> piece_start, piece_border, piece_corner, face_start, face;
  Span<const SampledTriangle> sampled;
  Span<const std::int32_t> sampled_start;
  Vector<double> stiffness;  // edge weights of the elastic energy: the shape's, times the stiffness of the surface

  Span<const std::int32_t> vertices_of(std::int32_t component) const noexcept { return shape->vertices_of(component); }
};

// Cuts the numbers 0 .. count into pieces of vertex_piece numbers, and calls loop(first, last) for each piece on
// several threads.
template <class Loop>
void for_vertex_pieces(JobRunner& jobs, std::int32_t count, Loop&& loop) {
  const std::int32_t pieces = (count + vertex_piece - 1) / vertex_piece;
  jobs.for_each(static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
    const std::int32_t first = static_cast<std::int32_t>(piece) * vertex_piece;
    loop(first, count - first < vertex_piece ? count : first + vertex_piece);
  });
}

// Returns a pseudo-random number in [0, 1) for an index. With it, the sampling of edges and triangles does not follow
// the order of the input.
inline double scattered(std::uint32_t index) noexcept {
  std::uint64_t x = index + 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace hf_inner::deform
