#include "mesh/places.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"

namespace hf_inner::mesh {
std::int32_t inner_vertex(const Mesh& mesh, std::uint32_t vertex, std::size_t position, const char* list) {
  if (vertex >= mesh.report.vertex_count)
    fail(HF_ERROR_OUT_OF_RANGE, static_cast<std::uint32_t>(position),
         "entry %zu of %s: vertex %u, but there are %u vertices", position, list, vertex, mesh.report.vertex_count);
  return mesh.inner_of_given[vertex];
}

std::int32_t usable_vertex(const Mesh& mesh, std::uint32_t vertex, std::size_t position, const char* list) {
  const std::int32_t inner = inner_vertex(mesh, vertex, position, list);
  if (inner == Mesh::none)
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(position),
         "entry %zu of %s: vertex %u %s; choose a vertex of the surface", position, list, vertex,
         mesh.is_graph() ? "has no edge" : "belongs to no usable triangle");
  return inner;
}

Vec3 position_of(const Mesh& mesh, const SurfacePlace& place) noexcept {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    if (place.vertex[k] != Mesh::none)
      p = p + place.weight[k] * mesh.positions[static_cast<std::size_t>(place.vertex[k])];
  }
  return mesh.to_given(p);
}

bool keeps_vertices(const Mesh& mesh) noexcept {
  if (mesh.report.vertex_count != static_cast<std::uint32_t>(mesh.vertex_count())) return false;
  for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
    if (mesh.inner_of_given[v] != static_cast<std::int32_t>(v)) return false;
  }
  return true;
}

Vector<std::uint32_t> given_triangles(const Mesh& mesh, Memory& memory) {
  Vector<std::uint32_t> given(static_cast<std::size_t>(mesh.triangle_count()), HF_NO_INDEX, &memory);
  for (std::size_t t = 0; mesh.faces.empty() && t < mesh.triangle_of_given.size(); ++t) {
    const std::int32_t inner = mesh.triangle_of_given[t];
    if (inner == Mesh::none) continue;
    std::uint32_t& first = given[static_cast<std::size_t>(inner)];
    first = std::min(first, static_cast<std::uint32_t>(t));
  }
  for (std::size_t t = 0; !mesh.faces.empty() && t < given.size(); ++t)
    given[t] = mesh.given_of_triangle(static_cast<std::int32_t>(t));
  return given;
}

Vec3 read_point(const double* p, const char* name) {
  require(p, name);
  if (!is_finite_point(p)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "%s is not finite", name);
  return {p[0], p[1], p[2]};
}

Vec3 read_point_near(const Mesh& mesh, const double* p, const char* name, std::uint32_t i) {
  if (!is_finite_point(p)) fail(HF_ERROR_NON_FINITE, i, "%s %u is not finite", name, i);
  const Vec3 place = mesh.to_inner({p[0], p[1], p[2]});
  if (const double away = norm(place); !(away <= farthest_point))
    fail(HF_ERROR_TOO_LARGE, i,
         "%s %u is %.3g box diagonals from the middle of the surface; at most %g are taken. Give points in the unit of "
         "the positions",
         name, i, away, farthest_point);
  return place;
}

void require_triangles(const Mesh& mesh, const char* purpose, std::uint32_t index) {
  if (mesh.is_graph())
    fail(HF_ERROR_UNSUPPORTED, index, "this call needs triangles for %s; the surface was made of a graph", purpose);
}

}  // namespace hf_inner::mesh
