#include "remesh/quads.h"

#include <algorithm>
#include <cmath>

#include "field/extremities.h"
#include "remesh/relax.h"

namespace hf {

QuadResult make_quads(const Core& core, const QuadOptions& options) {
  Memory& memory = *core.memory;
  QuadResult result(memory);
  report(options.progress, 0.0f);
  const FluxSurface surface = FluxSurface::make(core.mesh, core.topology, 30.0, memory);
  result.euler_characteristic = surface.euler_characteristic;

  // sites on the surface: a vertex of several fans counts in its first
  Table<std::int32_t> fan(core.size(), -1, memory);
  for (std::int32_t v = surface.first_apex; v-- > 0;) fan[surface.mesh_vertex[v]] = v;
  Vector<FluxSite> given(&memory);
  if (options.automatic) {
    const Extremities found = poisson_extremities(core, 0.05, nullptr);
    for (const Extremity& tip : found.points) {
      if (given.size() >= 40) break;
      given.push_back({fan[tip.vertex], 0.0});
    }
  } else {
    for (const FluxSite& site : options.sites) given.push_back({fan[site.vertex], site.lines});
  }
  result.sites = choose_flux_sites(surface, given, options.edge_length, memory, options.progress);
  const Vector<double> u = solve_flux(surface, result.sites, memory, *core.jobs);
  report(options.progress, 0.3f);

  const FluxField field(surface, u, memory);
  Table<double> lines(surface.vertex_count(), 0.0, memory);
  for (const FluxSite& site : result.sites) lines[site.vertex] = std::fabs(site.lines);
  for (std::int32_t v = 0; v < surface.vertex_count(); ++v) {
    if (lines[v] > 0) continue;
    const std::int32_t changes = field.sign_changes(v);
    if (changes == 0) ++result.extra_extrema;
    if (changes > 2) result.saddles += changes / 2 - 1;
    result.imbalance = std::max(result.imbalance, std::fabs(field.imbalance(v)));
  }
  const ArcGraph graph(field, memory);
  RingOptions ring_options;
  ring_options.edge_length = options.edge_length, ring_options.uniform = options.uniform;
  const RingMesh rings = make_rings(field, graph, lines, ring_options, memory, options.progress);
  Table<std::int32_t> centre(memory);
  result.mesh = make_polygons(field, graph, rings, centre, memory);
  check_quads(result.mesh, surface.euler_characteristic, memory);
  result.raw_faces = result.mesh.face_count(), result.raw_quads = result.mesh.quad_count();
  if (options.split) {
    result.mesh = split_polygons(surface, result.mesh, centre, memory);
    check_quads(result.mesh, surface.euler_characteristic, memory);
  }
  report(options.progress, 0.7f);
  RelaxOptions relax;
  relax.rounds = options.relax, relax.edge_length = options.uniform ? options.edge_length : 0;
  relax.progress = options.progress;
  relax_quads(surface, result.mesh, relax, memory);

  for (FluxSite& site : result.sites) site.vertex = surface.mesh_vertex[site.vertex];
  // turned triangles list their corners the other way; the Mesh's own order is asked for
  for (std::int32_t v = 0; v < result.mesh.location.size(); ++v) {
    SurfacePoint& point = result.mesh.location[v];
    const std::int32_t* corners = core.mesh.triangle(point.triangle);
    SurfacePoint own = point;
    for (int k = 0; k < 3; ++k) {
      own.weight[k] = 0;
      for (int j = 0; j < 3; ++j)
        if (surface.mesh_vertex[surface.tail[3 * point.triangle + j]] == corners[k]) own.weight[k] = point.weight[j];
    }
    point = own;
  }
  report(options.progress, 1.0f);
  return result;
}

}  // namespace hf
