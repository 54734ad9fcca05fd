#include "mesh/places.h"

#include <algorithm>
#include <cmath>

#include "base/arguments.h"

namespace hf_inner {
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

namespace {

void check_weights(const double* weights, std::size_t position, const char* list = "the list") {
  const std::uint32_t index = static_cast<std::uint32_t>(position);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(weights[k]))
      fail(HF_ERROR_NON_FINITE, index, "entry %zu of %s: barycentric weight %d is not a finite number", position, list,
           k);
    if (weights[k] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of %s: barycentric weight %d is %g; weights must not be negative", position, list, k, weights[k]);
    sum += weights[k];
  }
  if (!(std::fabs(sum - 1) <= weight_sum_error))
    fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of %s: barycentric weights sum to %.9g; they must sum to 1",
         position, list, sum);
}

}  // namespace

SurfacePlace place_in_triangle(const Mesh& mesh, std::uint32_t triangle, const double* weights, std::size_t position) {
  const std::uint32_t index = static_cast<std::uint32_t>(position);
  const char* const noun = mesh.faces.empty() ? "triangle" : "face";
  if (triangle >= mesh.triangle_of_given.size())
    fail(HF_ERROR_OUT_OF_RANGE, index, "entry %zu of the list: %s %u, but there are %zu %ss", position, noun, triangle,
         mesh.triangle_of_given.size(), noun);
  if (!mesh.faces.empty() && mesh.faces.given_size[triangle] != 3)
    fail(HF_ERROR_INVALID_ARGUMENT, index,
         "entry %zu of the list: face %u has %u corners; name three of them in `corners`", position, triangle,
         mesh.faces.given_size[triangle]);
  const std::int32_t inner = mesh.triangle_of_given[triangle];
  if (inner == Mesh::none)
    fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of the list: %s %u has equal corners or no area; choose another",
         position, noun, triangle);
  check_weights(weights, position);
  // The weights belong to the corners in the caller's order.
  const auto entry = std::lower_bound(mesh.doubled.begin(), mesh.doubled.end(), static_cast<std::int32_t>(triangle),
                                      [](const Mesh::Doubled& e, std::int32_t given) { return e.given < given; });
  const bool aside = entry != mesh.doubled.end() && entry->given == static_cast<std::int32_t>(triangle);
  const std::int32_t* v = aside ? entry->corner : mesh.triangle(inner);
  return {{v[0], v[1], v[2]}, weights};
}

SurfacePlace place_between(const Mesh& mesh, const std::uint32_t* vertices, const double* weights,
                           std::size_t position) {
  const std::uint32_t index = static_cast<std::uint32_t>(position);
  SurfacePlace place{{}, weights};
  for (int k = 0; k < 3; ++k) place.vertex[k] = usable_vertex(mesh, vertices[k], position, "corners");
  for (int k = 0; k < 3; ++k) {
    const std::int32_t a = place.vertex[k], b = place.vertex[(k + 1) % 3];
    if (a == b)
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of corners: vertices %u and %u are one; name three different ones", position, vertices[k],
           vertices[(k + 1) % 3]);
    if (mesh.component[static_cast<std::size_t>(a)] != mesh.component[static_cast<std::size_t>(b)])
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of corners: vertices %u and %u are in different components; name corners of one face", position,
           vertices[k], vertices[(k + 1) % 3]);
  }
  check_weights(weights, position);
  return place;
}

SurfacePlace place_on_surface(const Mesh& mesh, const hf_surface_point& point, std::size_t position, const char* name) {
  check_weights(point.barycentrics, position, name);
  SurfacePlace place{{Mesh::none, Mesh::none, Mesh::none}, point.barycentrics};
  for (int k = 0; k < 3; ++k) {
    if (place.weight[k] > 0) place.vertex[k] = usable_vertex(mesh, point.corners[k], position, name);
  }
  return place;
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

Vec3 read_place(const Mesh& mesh, const double* p, const char* name, std::uint32_t i) {
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

}  // namespace hf_inner
