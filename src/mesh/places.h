// Turns vertices and triangle points that a caller names into inner ones.
//
// `position` is the place in the caller's list and becomes the index of the error; `list` names the list in the text.
#pragma once
#include "hf/surface.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// The inner vertex, Mesh::none for an isolated one. Throws HF_ERROR_OUT_OF_RANGE.
std::int32_t inner_vertex(const Mesh& mesh, std::uint32_t vertex, std::size_t position, const char* list = "the list");

// The inner vertex. Throws as inner_vertex, and HF_ERROR_INVALID_ARGUMENT for an isolated one.
std::int32_t usable_vertex(const Mesh& mesh, std::uint32_t vertex, std::size_t position, const char* list = "the list");

// A place on the surface: up to three inner vertices of one component and their weights, of sum 1. Unused corners are
// Mesh::none and stand last.
struct SurfacePlace {
  std::int32_t vertex[3] = {Mesh::none, Mesh::none, Mesh::none};
  double weight[3] = {0, 0, 0};
  bool is_vertex() const noexcept { return vertex[1] == Mesh::none; }
  static SurfacePlace at_vertex(std::int32_t v) noexcept { return {{v, Mesh::none, Mesh::none}, {1, 0, 0}}; }
};

// The position of a place, in the unit of the caller.
Vec3 position_of(const Mesh& mesh, const SurfacePlace& place) noexcept;

// The vertex of the caller for an inner one: the first that was welded to it. HF_NO_INDEX for Mesh::none.
inline std::uint32_t given_vertex(const Mesh& mesh, std::int32_t inner) noexcept {
  return inner == Mesh::none ? HF_NO_INDEX
                             : static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(inner)]);
}

// Calls visit(given, inner) for the caller's vertices begin .. end - 1. inner: the welded vertex, or Mesh::none for an
// isolated one.
template <class Visit>
void visit_given(const Mesh& mesh, std::size_t begin, std::size_t end, Visit&& visit) {
  for (std::size_t v = begin; v < end; ++v) visit(v, mesh.inner_of_given[v]);
}
// The same for all vertices of the caller.
template <class Visit>
void visit_given(const Mesh& mesh, Visit&& visit) {
  visit_given(mesh, 0, mesh.report.vertex_count, visit);
}

// The component of an inner vertex; HF_NO_INDEX for Mesh::none.
inline std::uint32_t component_of(const Mesh& mesh, std::int32_t inner) noexcept {
  return inner == Mesh::none ? HF_NO_INDEX
                             : static_cast<std::uint32_t>(mesh.component[static_cast<std::size_t>(inner)]);
}

// Whether the inner vertices are the caller's, in the same order: none is welded, none isolated.
bool keeps_vertices(const Mesh& mesh) noexcept;

// Returns by inner triangle the triangle or face of the caller.
Vector<std::uint32_t> given_triangles(const Mesh& mesh, Memory& memory);

// Returns a point of the caller: xyz. Throws HF_ERROR_NULL_POINTER or HF_ERROR_NON_FINITE.
Vec3 read_point(const double* p, const char* name);

// A point that names a part of the surface is at most this many box diagonals from the middle of the box. A point
// farther away has another unit than the mesh. The surface ends half a diagonal from there; half and double take other
// mistakes for meant.
constexpr double farthest_point = 2;
// Returns the inner place of such a point: xyz. name, i: the point in the text of errors. Throws HF_ERROR_NON_FINITE or
// HF_ERROR_TOO_LARGE (index i).
Vec3 read_point_near(const Mesh& mesh, const double* p, const char* name, std::uint32_t i);

// A posed vertex, or where one shall go, lies up to this many box diagonals away. Farther, a double holds nothing of
// the shape any more, and squares leave the range.
constexpr double farthest_pose = 1e15;
inline bool is_too_far(Vec3 inner) noexcept { return !(norm(inner) <= farthest_pose); }

// Throws HF_ERROR_UNSUPPORTED for a surface that was made of a graph. purpose: why the call needs triangles.
void require_triangles(const Mesh& mesh, const char* purpose, std::uint32_t index = HF_NO_INDEX);

}  // namespace hf_inner::mesh
