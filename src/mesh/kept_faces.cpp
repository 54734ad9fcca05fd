#include "mesh/kept_faces.h"

namespace hf_inner::mesh {

Vector<Index> kept_numbers(const Vector<std::uint8_t>& kept, const Mesh& mesh, Memory& memory) {
  Vector<Index> number(kept.size(), Mesh::none, &memory);
  Index next = 0;
  for (std::size_t f = 0; f < kept.size(); ++f) {
    if (!kept[f]) continue;
    const Index face = static_cast<Index>(f);
    number[f] = next;
    next += triangles_begin(mesh, face + 1) - triangles_begin(mesh, face);
  }
  return number;
}

void keep_faces(const Vector<std::uint8_t>& kept_face, Mesh& mesh) {
  Faces& faces = mesh.faces;
  std::size_t kept = 0, corner = 0, triangle = 0;
  const std::size_t count = kept_face.size();
  for (std::size_t f = 0; f < count; ++f) {
    if (!kept_face[f]) continue;
    const std::size_t begin = at(triangles_begin(mesh, static_cast<Index>(f)));
    const std::size_t end = at(triangles_begin(mesh, static_cast<Index>(f) + 1));
    std::copy(mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * begin),
              mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * end),
              mesh.corners.begin() + static_cast<std::ptrdiff_t>(3 * triangle));
    triangle += end - begin;
    if (!faces.empty()) {
      const Span<const Index> own = faces.corners_of(static_cast<Index>(f));
      const std::size_t size = own.size();
      std::copy(own.begin(), own.end(), faces.corner.begin() + static_cast<std::ptrdiff_t>(corner));
      corner += size;
      faces.given[kept] = faces.given[f];
      faces.second_cut[kept] = faces.second_cut[f];
      // The old starts of the faces to come are still needed; kept + 1 <= f + 1 never reaches beyond this face.
      faces.triangle_start[kept] = static_cast<Index>(triangle - (end - begin));
      faces.corner_start[kept] = static_cast<Index>(corner - size);
    }
    ++kept;
  }
  mesh.corners.resize(3 * triangle);
  if (faces.empty()) return;
  faces.corner.resize(corner);
  faces.given.resize(kept);
  faces.second_cut.resize(kept);
  faces.triangle_start.resize(kept + 1);
  faces.corner_start.resize(kept + 1);
  faces.triangle_start[kept] = static_cast<Index>(triangle);
  faces.corner_start[kept] = static_cast<Index>(corner);
}

}  // namespace hf_inner::mesh
