#include "remesh/quads.h"

#include <algorithm>
#include <cmath>

#include "field/extremities.h"
#include "remesh/relax.h"
#include "remesh/ring_levels.h"

namespace hf {

namespace {

constexpr double tip_distance = 0.06;  // of two automatic sites, in box diagonals

// Scales the lines of every component so that its faces have a little less than the area of squares of the edge length
// in the mean: rings times lines, summed over arcs, are the faces.
void fit_lines(const FluxSurface& surface, Span<const double> u, const RingOptions& options, Vector<FluxSite>& sites,
               Memory& memory) {
  const FluxField field(surface, u, memory);
  const ArcGraph graph(field, memory);
  RingMesh rings(memory);
  place_rings(field, graph, options, memory, rings);
  Table<double> faces(surface.component_count, 0.0, memory), area(surface.component_count, 0.0, memory);
  for (const Ring& ring : rings.rings) faces[surface.component[surface.tail[ring.seed]]] += graph.arcs[ring.arc].flux;
  for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
    const Vec3 a = surface.position[surface.tail[3 * t]];
    area[surface.component[surface.tail[3 * t]]] +=
        0.5 * norm(cross(surface.position[surface.tail[3 * t + 1]] - a, surface.position[surface.tail[3 * t + 2]] - a));
  }
  for (std::int32_t c = 0; c < surface.component_count; ++c) {
    const double wanted = 1.15 * area[c] / (options.edge_length * options.edge_length);
    if (faces[c] > 0) scale_lines(surface, c, std::min(std::max(wanted / faces[c], 0.25), 8.0), sites);
  }
}

}  // namespace

QuadResult make_quads(const QuadOptions& options) {
  const Core& core = *options.core;
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
    // tips by both fields: the mean distance knows limbs that the Poisson field sees as shoulders of others
    const auto take = [&](const Extremities& found, std::size_t most) {
      for (const Extremity& tip : found.points) {
        const Vec3 p = core.mesh.positions[static_cast<std::size_t>(tip.vertex)];
        bool near = given.size() >= most;
        for (const FluxSite& site : given) near |= norm(surface.position[site.vertex] - p) < tip_distance;
        if (!near) given.push_back({fan[tip.vertex], 0.0});
      }
    };
    const Geodesics geodesics(options.core, 1.0);
    take(geodesic_extremities(geodesics, 40, 0.008, nullptr), 24);
    take(poisson_extremities(core, 0.02, nullptr), 32);
  } else {
    for (const FluxSite& site : options.sites) given.push_back({fan[site.vertex], site.lines});
  }
  result.sites = choose_flux_sites(surface, given, options.automatic, options.edge_length, memory, options.progress);
  const FluxSolver solver(surface, memory, *core.jobs);
  Vector<double> u = solve_with_borders(surface, solver, result.sites);
  RingOptions ring_options;
  ring_options.edge_length = options.edge_length, ring_options.uniform = options.uniform;
  if (!options.uniform && options.scale_lines) {
    for (int round = 0; round < 2; ++round) {
      fit_lines(surface, u, ring_options, result.sites, memory);
      u = solve_with_borders(surface, solver, result.sites);
    }
  }
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
  relax.rounds = options.relax, relax.edge_length = options.edge_length;
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
