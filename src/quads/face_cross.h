// One cross per triangle, made of the crosses at its corners, and how the crosses of neighbours match.
//
// The frame of a triangle has its x axis along the first half-edge. A cross is four directions; `direction` holds one
// of them as a complex number of length 1. Across an edge, one of the four directions is nearest to it. The half-edge h
// of triangle f, with triangle g on the other side, has direction_f ~ i^turn direction_g. The index of a vertex counts
// the quarter turns of the field around it: (sum of residual turns + angle defect) / (pi / 2). The indices of a closed
// surface sum to 4 chi. A vertex of index k gets 4 - k quads.
#pragma once
#include <complex>

#include "field/connection.h"
#include "quads/sharp_corners.h"

namespace hf_inner::quads {

// Marks, by half-edge, the feature edges: borders, and edges where the normals of the triangles differ by more than
// `crease` radians. crease: at least pi for none.
remesh::Table<std::uint8_t> find_features(const remesh::FluxSurface& surface, double crease, Memory& memory);
// Marks the half-edges of a list of edges too.
void keep_edges(const remesh::FluxSurface& surface, const mesh::Topology& topology, Span<const std::int32_t> edges,
                remesh::Table<std::uint8_t>& features, Memory& memory);

struct FaceCross {
  explicit FaceCross(Memory& memory)
      : edge(memory), direction(memory), importance(memory), turn(memory), index(memory) {}
  // crosses: by inner vertex of the mesh, to the fourth degree, in the frames of the connection. Triangles with creases
  // take the direction of these; at borders the crosses of the vertices count, which are evened out. Parameter
  // of_corner: of SideCrosses; its crosses count instead of the crosses of vertices. It may be empty.
  static FaceCross make(const remesh::FluxSurface& surface, const field::Connection& connection,
                        Span<const std::complex<double>> crosses, const remesh::Table<std::uint8_t>& features,
                        const SharpCorners& corners, const remesh::Table<std::complex<double>>& of_corner,
                        Memory& memory);

  remesh::Table<std::complex<double>> edge;       // by half-edge of a real triangle: its vector in the triangle's frame
  remesh::Table<std::complex<double>> direction;  // by real triangle
  remesh::Table<double> importance;               // by real triangle, in the map; empty: 1
  remesh::Table<std::int8_t> turn;                // by half-edge; 0 on borders
  remesh::Table<std::int32_t> index;              // by vertex; 0 on borders
};

}  // namespace hf_inner::quads
