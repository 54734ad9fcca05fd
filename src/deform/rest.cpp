#include "deform/rest.h"

#include <algorithm>

namespace hf {
namespace {

void sort_components(const Mesh& mesh, Rest& rest) {
  const std::int32_t n = mesh.vertex_count(), components = mesh.component_count();
  rest.component_start.assign(components + 1, 0);
  rest.component_vertex.resize(n);
  for (std::int32_t v = 0; v < n; ++v) ++rest.component_start[mesh.component[v] + 1];
  for (std::int32_t c = 0; c < components; ++c) rest.component_start[c + 1] += rest.component_start[c];
  Vector<std::int32_t> next(rest.component_start, rest.component_start.get_allocator());
  for (std::int32_t v = 0; v < n; ++v) rest.component_vertex[next[mesh.component[v]]++] = v;
  rest.component_area.assign(components, 0.0);
  for (std::int32_t v = 0; v < n; ++v) rest.component_area[mesh.component[v]] += rest.area[v];
  rest.component_triangles.assign(components, 0);
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t)
    ++rest.component_triangles[mesh.component[mesh.triangle(t)[0]]];
}

void find_incident_triangles(const Mesh& mesh, Rest& rest) {
  const std::int32_t n = mesh.vertex_count(), triangles = mesh.triangle_count();
  rest.incident_start.assign(n + 1, 0);
  rest.incident.resize(mesh.corners.size());
  for (const std::int32_t v : mesh.corners) ++rest.incident_start[v + 1];
  for (std::int32_t v = 0; v < n; ++v) rest.incident_start[v + 1] += rest.incident_start[v];
  Vector<std::int32_t> next(rest.incident_start, rest.incident_start.get_allocator());
  for (std::int32_t t = 0; t < triangles; ++t) {
    for (int k = 0; k < 3; ++k) rest.incident[next[mesh.triangle(t)[k]]++] = t;
  }
}

}  // namespace

Rest::Rest(const Core& core, Memory& memory)
    : component_start(&memory),
      component_vertex(&memory),
      component_triangles(&memory),
      component_area(&memory),
      area(vertex_areas(core.mesh, memory)),
      incident_start(&memory),
      incident(&memory),
      stiffness(core.weights.begin(), core.weights.end(), &memory) {
  sort_components(core.mesh, *this);
  find_incident_triangles(core.mesh, *this);
  for (double& w : stiffness) w = std::clamp(w, 0.01, 25.0);
}

}  // namespace hf
