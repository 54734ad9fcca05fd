#include "mesh/places.h"

#include <cmath>

#include "base/error.h"

namespace hf_inner {
namespace {

// Barycentric weights may sum to 1 within this. Single-precision ones do; a larger bound would hide wrong ones.
constexpr double weight_sum_error = 1e-6;

}  // namespace

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

std::int32_t usable_triangle(const Mesh& mesh, std::uint32_t triangle, const double* weights, std::size_t position) {
  const std::uint32_t index = static_cast<std::uint32_t>(position);
  require_triangles(mesh, "a point in a triangle", index);
  if (triangle >= mesh.report.triangle_count)
    fail(HF_ERROR_OUT_OF_RANGE, index, "entry %zu of the list: triangle %u, but there are %u triangles", position,
         triangle, mesh.report.triangle_count);
  const std::int32_t inner = mesh.triangle_of_given[triangle];
  if (inner == Mesh::none)
    fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of the list: triangle %u has equal corners; choose another",
         position, triangle);
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(weights[k]))
      fail(HF_ERROR_NON_FINITE, index, "entry %zu of the list: barycentric weight %d is not a finite number", position,
           k);
    if (weights[k] < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, index,
           "entry %zu of the list: barycentric weight %d is %g; weights must not be negative", position, k, weights[k]);
    sum += weights[k];
  }
  if (!(std::fabs(sum - 1) <= weight_sum_error))
    fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of the list: barycentric weights sum to %.9g; they must sum to 1",
         position, sum);
  return inner;
}

void require_triangles(const Mesh& mesh, const char* purpose, std::uint32_t index) {
  if (mesh.is_graph())
    fail(HF_ERROR_UNSUPPORTED, index, "this call needs triangles for %s; the surface was made of a graph", purpose);
}

}  // namespace hf_inner
