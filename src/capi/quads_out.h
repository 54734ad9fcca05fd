// Quad meshes and streamlines, written as hf_quads_mesh and hf_streamlines say.
#pragma once
#include <algorithm>

#include "capi/objects.h"
#include "capi/vertex_writer.h"
#include "hf/quads.h"
#include "quads/field_quads.h"
#include "remesh/streamlines.h"

namespace hf_inner::capi {

// Fills the arrays that are given; capacities are checked.
inline void write_mesh(const surface::Core& core, const quads::QuadResult& result, const hf_quads_mesh& out) {
  const mesh::Mesh& mesh = core.mesh;
  Vector<std::uint32_t> triangle(core.memory.get());
  if (out.triangles) triangle = mesh::given_triangles(mesh, *core.memory);
  for (std::int32_t v = 0; v < result.mesh.position.size(); ++v) {
    const remesh::SurfacePoint& point = result.mesh.location[v];
    const std::size_t i = static_cast<std::size_t>(v);
    if (out.positions) put(mesh.to_given(result.mesh.position[v]), out.positions + 3 * i);
    if (out.triangles) out.triangles[i] = triangle[static_cast<std::size_t>(point.triangle)];
    for (std::size_t k = 0; out.corners && k < 3; ++k)
      out.corners[3 * i + k] = mesh::given_vertex(mesh, mesh.triangle(point.triangle)[k]);
    if (out.barycentrics) std::copy(point.weight, point.weight + 3, out.barycentrics + 3 * i);
  }
  if (out.faces) std::copy(result.mesh.corner.begin(), result.mesh.corner.end(), out.faces);
}

// Fills the arrays that are given; capacities are checked.
inline void write_lines(const mesh::Mesh& mesh, const remesh::StreamlineSet& lines, const hf_streamlines& out) {
  for (std::size_t i = 0; out.positions && i < lines.point.size(); ++i)
    put(mesh.to_given(lines.point[i]), out.positions + 3 * i);
  if (out.values) std::copy(lines.value.begin(), lines.value.end(), out.values);
  if (out.line_starts) std::copy(lines.start.begin(), lines.start.end(), out.line_starts);
  for (std::size_t l = 0; out.line_ends && l < lines.from.size(); ++l) {
    out.line_ends[2 * l] = mesh::given_vertex(mesh, lines.from[l]);
    out.line_ends[2 * l + 1] = mesh::given_vertex(mesh, lines.to[l]);
  }
}

}  // namespace hf_inner::capi
