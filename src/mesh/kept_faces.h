// Leaves faces out of a mesh that is being made.
#pragma once
#include <algorithm>

#include "base/index.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// The faces of a mesh: its triangles where the caller gave triangles.
inline Index face_count(const Mesh& mesh) noexcept {
  return mesh.faces.empty() ? mesh.triangle_count() : mesh.faces.count();
}
// The first triangle of a face: of its cut, or itself.
inline Index triangles_begin(const Mesh& mesh, Index face) noexcept {
  return mesh.faces.empty() ? face : mesh.faces.triangle_start[at(face)];
}
// The corners of a face, in order around it.
inline Span<const Index> corners_of(const Mesh& mesh, Index face) noexcept {
  if (mesh.faces.empty()) return {mesh.triangle(face), 3};
  return mesh.faces.corners_of(face);
}

// By face: the number of its first triangle after the faces with kept[f] == 0 are left out. Meaningless for those.
Vector<Index> kept_numbers(const Vector<std::uint8_t>& kept, const Mesh& mesh, Memory& memory);

// Removes the corners of the faces with kept[f] == 0 and their entries in the arrays of faces. Mesh::triangle_of_given
// and the report stay as they are.
void keep_faces(const Vector<std::uint8_t>& kept, Mesh& mesh);

}  // namespace hf_inner::mesh
