// The surface of streamlines and quads: an oriented half-edge mesh without borders, with a weight for each edge.
//
// Triangles are turned so that neighbours agree. If an edge has three or more triangles, the two flattest are joined,
// then the next two. A triangle without a partner gets a border. A Moebius band is parted across. A vertex where
// several fans of triangles meet becomes one vertex per fan. Every border loop is closed by an additional vertex, an
// apex, that is joined to all its vertices. So the code that uses this mesh only sees closed surfaces. Weights are
// cotangent weights with a floor of 1e-3 of their median, which keeps every flux positive uphill. Edges to an apex
// weigh 0, so an apex has no effect on a field.
//
// Half-edge 3 t + k of triangle t runs from its corner k to the next corner. Cost: O(n log n) for n vertices.
#pragma once
#include "mesh/laplacian.h"
#include "remesh/table.h"

namespace hf_inner::remesh {

struct FluxSurface {
  explicit FluxSurface(Memory& memory)
      : tail(memory),
        twin(memory),
        weight(memory),
        out(memory),
        position(memory),
        mesh_vertex(memory),
        component(memory) {}
  // Throws HF_ERROR_UNSUPPORTED (index: a vertex of the caller) in two cases, each for more than 5 % of the edges
  // between triangles. The edges join three or more triangles, or they must be cut so that all triangles can agree.
  static FluxSurface make(const mesh::Mesh& mesh, const mesh::Topology& topology, Memory& memory);

  std::int32_t vertex_count() const noexcept { return out.size(); }
  std::int32_t half_count() const noexcept { return tail.size(); }
  static std::int32_t next(std::int32_t h) noexcept { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t previous(std::int32_t h) noexcept { return h % 3 == 0 ? h + 2 : h - 1; }
  std::int32_t head(std::int32_t h) const noexcept { return tail[next(h)]; }
  // Returns the next half-edge that leaves the same vertex, counter-clockwise.
  std::int32_t turn_left(std::int32_t h) const noexcept { return twin[previous(h)]; }
  std::int32_t turn_right(std::int32_t h) const noexcept { return next(twin[h]); }
  bool is_apex(std::int32_t v) const noexcept { return v >= first_apex; }
  // Not in a triangle that closes a border.
  bool is_real(std::int32_t h) const noexcept { return h < 3 * real_triangles; }

  Table<std::int32_t> tail, twin;   // By half-edge.
  Table<double> weight;             // By half-edge; equal for both of an edge.
  Table<std::int32_t> out;          // By vertex, any half-edge that leaves it.
  Table<Vec3> position;             // By vertex, inner units; an apex (closes a border) is in its middle.
  Table<std::int32_t> mesh_vertex;  // By vertex, the inner vertex of the Mesh; none for an apex.
  Table<std::int32_t> component;    // By vertex, the component of the surface.
  std::int32_t real_triangles = 0, first_apex = 0, component_count = 0;
  std::int32_t euler_characteristic = 0;  // of the surface before its borders are closed
};

}  // namespace hf_inner::remesh
