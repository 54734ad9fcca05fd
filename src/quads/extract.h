// The quads of a map to the grid, found by the lines of halves.
//
// In the map, the lines u = c + 1/2 and v = d + 1/2 run between the vertices of the grid. On the surface they are
// curves without an end but at borders. Every crossing of a u-line and a v-line is a quad. Every piece of the surface
// between the lines is a vertex. So every face has four corners, even where the map is turned over. There,
// lines cross back and forth, which makes vertices of two quads; remove_doublets() takes these away. Two edges between
// the same vertices can be left, and check_quads() refuses them. The quad mesh is
// the dual of the lines (Campen, Bommes and Kobbelt 2012 design meshes by such loops; exact coordinates follow the
// truncation of Ebke, Bommes, Campen and Kobbelt 2013).
//
// A line has no vertex of the surface (grid_map.h), so a line enters a triangle through one edge and leaves it through
// another. The order of the lines along an edge is computed once, in whole numbers, for both triangles. All else
// follows from these orders, so no rounding can make a wrong mesh.
#pragma once
#include "quads/grid_map.h"
#include "quads/quad_complex.h"

namespace hf_inner::quads {

// Makes the quads. A vertex is at the place where the map has its whole numbers. Vertices on feature edges are pinned.
// features: by half-edge. backward: the number of crossings where the map is turned over. If a piece between the lines
// is no disc, the Euler characteristic differs from the surface's.
QuadComplex extract_quads(const remesh::FluxSurface& surface, const GridMap& map,
                          const remesh::Table<std::uint8_t>& features, std::int32_t& backward, Memory& memory);

}  // namespace hf_inner::quads
