// Quad meshes that are their own mirror image.
//
// The surface is cut by the plane. The side that the normal points to gets quads, for which the cut is a border: a line
// of the grid whose vertices stay. The other side is its mirror image.
#pragma once
#include "mesh/nearest_triangle.h"
#include "quads/field_quads.h"

namespace hf_inner::quads {

// The part of a surface on the side that a plane's normal points to.
struct HalfSurface {
  explicit HalfSurface(Memory& memory) : position(&memory), corner(&memory), of_vertex(&memory), of_edge(&memory) {}
  static HalfSurface make(const surface::Core& core, const mesh::MirrorPlane& plane);
  Vector<Vec3> position;    // inner units of the whole
  Vector<Index> corner;     // three vertices for each triangle
  Vector<Index> of_vertex;  // by vertex of the whole, the vertex of the half, or none
  Vector<Index> of_edge;    // by edge of the whole, the vertex where the plane cuts it, or none
};

// The data that symmetric quads of one surface and plane share.
struct HalfBase {
  // Throws as make_symmetric_quads for the surface.
  HalfBase(const surface::Core& whole, const mesh::MirrorPlane& plane);
  mesh::MirrorPlane plane;
  mesh::NearestTriangle nearest;  // of the whole
  HalfSurface half;
  std::shared_ptr<const surface::Core> core;  // of the half
  QuadKeeper kept;
};

// options.plane is set. Throws what make_field_quads throws. Throws HF_ERROR_UNSUPPORTED too: the surface is no mirror
// image of itself (index = vertex of the caller), or nothing is on the side of the normal.
QuadResult make_symmetric_quads(const FieldQuadOptions& options, FieldQuadReport* report, QuadKeeper* kept = nullptr);

// Makes the half of a mesh such that its image can be joined to it. An edge off the border with both ends on the plane
// would be its own image. Quads with three sides on the plane have one, and go. Where small pieces have one, or one is
// left, a piece gets a row of quads along the plane. The function place finds a point of the surface near another
// point. sides_on_plane: receives how many sides of quads lie on the plane.
struct PlaceOnSurface {
  const surface::Core& core;
  const mesh::NearestTriangle& nearest;
  Vec3 operator()(Vec3 p) const noexcept;
};
void prepare_at_plane(remesh::QuadMesh& mesh, remesh::Table<std::uint8_t>& on_plane, const mesh::MirrorPlane& plane,
                      const PlaceOnSurface& place, std::int32_t& sides_on_plane, Memory& memory);

}  // namespace hf_inner::quads
