// Reads a field of the caller: one value per vertex.
#pragma once
#include <cmath>

#include "base/arguments.h"
#include "hf/analysis.h"
#include "mesh/places.h"
#include "surface/geometry.h"

namespace hf_inner::field {

// Returns one value per welded vertex. Throws HF_ERROR_NON_FINITE for an infinite value; NaN stays NaN.
inline Vector<double> read_scalars(const surface::Geometry& shape, const hf_array* given) {
  const ConstRows rows = need_reals(given, 1, shape.mesh.report.vertex_count, "vertices", "field");
  Vector<double> field(static_cast<std::size_t>(shape.mesh.vertex_count()), shape.memory.get());
  for (std::size_t v = 0; v < field.size(); ++v) {
    const std::uint32_t vertex = static_cast<std::uint32_t>(shape.mesh.given_of_inner[v]);
    field[v] = rows.get(vertex, 0);
    if (std::isinf(field[v]))
      fail(HF_ERROR_NON_FINITE, vertex, "the value of vertex %u is infinite; NaN marks a vertex without a value",
           vertex);
  }
  return field;
}

// Throws HF_ERROR_NON_FINITE for a value that is NaN; index: the vertex of the caller's mesh. field: by inner vertex.
inline void require_values(const mesh::Mesh& mesh, Span<const double> field) {
  for (std::size_t v = 0; v < field.size(); ++v) {
    const std::uint32_t given = mesh::given_vertex(mesh, static_cast<std::int32_t>(v));
    if (std::isnan(field[v])) fail(HF_ERROR_NON_FINITE, given, "the value of vertex %u is NaN", given);
  }
}

}  // namespace hf_inner::field
