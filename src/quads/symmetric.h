// Quad meshes that are their own mirror image.
//
// The surface is cut by the plane. The side that the normal points to gets quads, for which the cut is a border: a line
// of the grid whose vertices stay. The other side is its mirror image.
#pragma once
#include "quads/field_quads.h"

namespace hf_inner {

// options.plane is set. Throws what make_field_quads throws. Throws HF_ERROR_UNSUPPORTED too: the surface is no mirror
// image of itself (index = vertex as given), nothing lies on the side of the normal, or parts at the plane are too
// thin.
QuadResult make_symmetric_quads(const FieldQuadOptions& options, FieldQuadReport* report);

// The part of a surface on the side that a plane's normal points to.
struct HalfSurface {
  explicit HalfSurface(Memory& memory) : position(&memory), corner(&memory), of_vertex(&memory), of_edge(&memory) {}
  static HalfSurface make(const Core& core, const MirrorPlane& plane);
  Vector<Vec3> position;    // inner units of the whole
  Vector<Index> corner;     // three vertices for each triangle
  Vector<Index> of_vertex;  // by vertex of the whole, the vertex of the half, or none
  Vector<Index> of_edge;    // by edge of the whole, the vertex where the plane cuts it, or none
};

// Removes from a mesh of quads those with three sides on the plane, again and again: two mirror images would lie on one
// another. Returns false if an edge off the border has both ends on the plane: its image would be the same edge.
// sides_on_plane: receives how many sides of quads lie on the plane.
bool trim_at_plane(QuadMesh& mesh, const Table<std::uint8_t>& on_plane, std::int32_t& sides_on_plane, Memory& memory);

}  // namespace hf_inner
