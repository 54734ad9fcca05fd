// A cut along edges: vertices on it part, and triangles on one side take the copies.
//
// At a vertex the triangles that share an edge form fans. Cut edges part a fan into groups. The group with the lowest
// triangle keeps the vertex, every other one takes a copy of it. So the end of a cut inside the surface stays one
// vertex, and its end on the border becomes two.
#pragma once
#include "mesh/mesh_patch.h"

namespace hf_inner::mesh {

// edges: two vertices of the caller each. Returns the corners that take copies, by copy. Copies are numbered from
// mesh.report.vertex_count on, by the vertices that they copy. Throws HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT
// (equal ends), HF_ERROR_NOT_FOUND (not an edge), all with the edge as index, HF_ERROR_EMPTY (nothing parts), or
// std::bad_alloc. Cost: a pass over the triangles.
Vector<Mesh::CutCorner> cut_edges(const Mesh& mesh, Span<const std::uint32_t> edges, Memory& memory);

}  // namespace hf_inner::mesh
