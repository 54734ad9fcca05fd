// Edges and neighbours of a Mesh, stored in compressed rows. Non-manifold edges keep all their triangles.
#pragma once
#include <cstdint>

#include "mesh/mesh.h"

namespace hf_inner::mesh {

struct Topology {
  explicit Topology(Memory& memory)
      : edges(&memory),
        edge_triangle_start(&memory),
        edge_side(&memory),
        neighbour_start(&memory),
        neighbour(&memory),
        neighbour_edge(&memory) {}
  static Topology make(const Mesh& mesh, Memory& memory, JobRunner* jobs = nullptr);
  // Fills the rows of neighbours from the list of edges. vertex_count: rows to make.
  void fill_neighbours(std::size_t vertex_count, Memory& memory, JobRunner* jobs = nullptr);

  std::int32_t edge_count() const noexcept { return static_cast<std::int32_t>(edges.size() / 2); }
  // first and second are the end vertices of edge e, the smaller one first. Edges are ordered by (first, second).
  std::int32_t first(std::int32_t e) const noexcept { return edges[std::size_t{2} * static_cast<std::size_t>(e)]; }
  std::int32_t second(std::int32_t e) const noexcept { return edges[std::size_t{2} * static_cast<std::size_t>(e) + 1]; }

  // Side i is an edge of a triangle: it runs from corner c = 3 t + k of triangle t to the triangle's next corner. It is
  // forward if it runs from the edge's first vertex to its second.
  std::int32_t triangle(std::int32_t i) const noexcept { return side(i) / 6; }
  std::int32_t corner(std::int32_t i) const noexcept { return side(i) / 2; }
  bool forward(std::int32_t i) const noexcept { return (side(i) & 1) != 0; }

  // Appends the triangles at a vertex, each twice.
  void triangles_at(std::int32_t v, Vector<std::int32_t>& out) const;

  // The edge between two vertices, or Mesh::none.
  std::int32_t edge_between(std::int32_t a, std::int32_t b) const noexcept;

  Vector<std::int32_t> edges;                // 2 per edge
  Vector<std::int32_t> edge_triangle_start;  // sides of edge e: edge_side[start[e] .. start[e+1]), by triangle
  Vector<std::int32_t> edge_side;            // 2 c + 1 if the side runs from the edge's first vertex, else 2 c
  Vector<std::int32_t> neighbour_start;      // neighbours of vertex v, ascending: neighbour[start[v] .. start[v+1])
  Vector<std::int32_t> neighbour;
  Vector<std::int32_t> neighbour_edge;  // the edge to that neighbour

 private:
  std::int32_t side(std::int32_t i) const noexcept { return edge_side[static_cast<std::size_t>(i)]; }
};

// Counts boundary, non-manifold and flipped edges in the report. An edge is flipped when two triangles run through it
// in the same direction.
void count_edges(const Topology& topology, MeshReport& report) noexcept;

}  // namespace hf_inner::mesh
