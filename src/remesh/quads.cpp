#include "remesh/quads.h"

#include <algorithm>
#include <cmath>

#include "field/extremities.h"
#include "remesh/capture.h"
#include "remesh/relax.h"
#include "remesh/ring_levels.h"

namespace hf {

namespace {

constexpr double apex_weight = 30;
constexpr double tip_distance = 0.06;  // of two automatic sites, in box diagonals
constexpr std::size_t most_tips = 32;
constexpr double least_deviation = 0.003;  // below it nothing is drawn out

// Which tips become sites decides whether limbs get rings of their own, and how much flow runs where. No threshold is
// right for all shapes: several lists are tried, and the mesh that comes nearest to the surface is kept.
struct TipLengths {
  double geodesic, poisson;
};
constexpr TipLengths tip_lengths[] = {{0.008, 0.02}, {0.015, 0.05}, {0.03, 0.1}, {0.1, 0.3}};
constexpr int tip_trials = 4;

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

// One surface, its factor and the trees to measure against, for one or more sets of sites.
class Maker {
 public:
  explicit Maker(const QuadOptions& options)
      : options_(options),
        core_(*options.core),
        memory_(*core_.memory),
        surface_(FluxSurface::make(core_.mesh, core_.topology, apex_weight, memory_)),
        solver_(surface_, memory_, *core_.jobs),
        distance_(surface_, memory_) {}

  const FluxSurface& surface() const noexcept { return surface_; }

  // progress: null when several sets are tried.
  QuadResult make(Span<const FluxSite> given, Progress* progress, double* out_deviation) const {
    QuadResult result(memory_);
    result.euler_characteristic = surface_.euler_characteristic;
    result.sites = choose_flux_sites(surface_, given, options_.automatic, options_.edge_length, memory_, progress);
    Vector<double> u = solve_with_borders(surface_, solver_, result.sites);
    RingOptions ring_options;
    ring_options.edge_length = options_.edge_length, ring_options.uniform = options_.uniform;
    if (!options_.uniform && options_.scale_lines) {
      for (int round = 0; round < 2; ++round) {
        fit_lines(surface_, u, ring_options, result.sites, memory_);
        u = solve_with_borders(surface_, solver_, result.sites);
      }
    }
    report(progress, 0.3f);

    const FluxField field(surface_, u, memory_);
    Table<double> lines(surface_.vertex_count(), 0.0, memory_);
    for (const FluxSite& site : result.sites) lines[site.vertex] = std::fabs(site.lines);
    for (std::int32_t v = 0; v < surface_.vertex_count(); ++v) {
      if (lines[v] > 0) continue;
      const std::int32_t changes = field.sign_changes(v);
      if (changes == 0) ++result.extra_extrema;
      if (changes > 2) result.saddles += changes / 2 - 1;
      result.imbalance = std::max(result.imbalance, std::fabs(field.imbalance(v)));
    }
    const ArcGraph graph(field, memory_);
    const RingMesh rings = make_rings(field, graph, lines, ring_options, memory_, progress);
    Table<std::int32_t> centre(memory_);
    result.mesh = make_polygons(field, graph, rings, centre, memory_);
    check_quads(result.mesh, surface_.euler_characteristic, memory_);
    result.raw_faces = result.mesh.face_count(), result.raw_quads = result.mesh.quad_count();
    if (options_.split) {
      result.mesh = split_polygons(surface_, result.mesh, centre, memory_);
      check_quads(result.mesh, surface_.euler_characteristic, memory_);
    }
    report(progress, 0.7f);
    RelaxOptions relax;
    relax.rounds = options_.relax, relax.edge_length = options_.edge_length, relax.progress = progress;
    relax_quads(surface_, result.mesh, relax, memory_);
    double deviation = distance_.largest(result.mesh);
    if (options_.relax > 0 && deviation > least_deviation) {
      // features are drawn out where that brings the meshes nearer to each other, not only one to the other
      QuadMesh drawn = result.mesh;
      CaptureOptions capture;
      capture.edge_length = options_.edge_length;
      capture_features(surface_, drawn, capture, memory_);
      const double after = distance_.largest(drawn);
      if (after < deviation) deviation = after, result.mesh = std::move(drawn);
    }
    *out_deviation = deviation;
    return result;
  }

  // Sites as vertices of the Mesh, weights in the order of its own triangles, which may have been turned here.
  void to_mesh(QuadResult& result) const {
    for (FluxSite& site : result.sites) site.vertex = surface_.mesh_vertex[site.vertex];
    for (SurfacePoint& point : result.mesh.location) {
      const std::int32_t* corners = core_.mesh.triangle(point.triangle);
      const SurfacePoint here = point;
      for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
          if (surface_.mesh_vertex[surface_.tail[3 * here.triangle + j]] == corners[k])
            point.weight[k] = here.weight[j];
        }
      }
    }
  }

 private:
  const QuadOptions& options_;
  const Core& core_;
  Memory& memory_;
  const FluxSurface surface_;
  const FluxSolver solver_;
  const QuadDistance distance_;
};

}  // namespace

QuadResult make_quads(const QuadOptions& options) {
  const Core& core = *options.core;
  Memory& memory = *core.memory;
  report(options.progress, 0.0f);
  const Maker maker(options);
  const FluxSurface& surface = maker.surface();
  // a vertex of several fans counts in its first
  Table<std::int32_t> fan(core.size(), -1, memory);
  for (std::int32_t v = surface.first_apex; v-- > 0;) fan[surface.mesh_vertex[v]] = v;
  Vector<FluxSite> given(&memory);
  double deviation = 0;
  if (!options.automatic) {
    for (const FluxSite& site : options.sites) given.push_back({fan[site.vertex], site.lines});
    QuadResult result = maker.make(given, options.progress, &deviation);
    maker.to_mesh(result);
    report(options.progress, 1.0f);
    return result;
  }

  // tips by both fields: the mean distance knows limbs that the Poisson field sees as shoulders of others
  const Geodesics geodesics(options.core, 1.0);
  const Extremities far = geodesic_extremities(geodesics, 40, tip_lengths[0].geodesic, nullptr),
                    high = poisson_extremities(core, tip_lengths[0].poisson, nullptr);
  QuadResult best(memory);
  double least = -1;
  std::size_t before = 0;
  for (int trial = 0; trial < tip_trials; ++trial) {
    report(options.progress, static_cast<float>(trial + 1) / static_cast<float>(tip_trials + 1));
    given.clear();
    const auto take = [&](const Extremities& found, double length) {
      for (const Extremity& tip : found.points) {
        const Vec3 p = core.mesh.positions[static_cast<std::size_t>(tip.vertex)];
        bool near = tip.length < length || given.size() >= most_tips;
        for (const FluxSite& site : given) near |= norm(surface.position[site.vertex] - p) < tip_distance;
        if (!near) given.push_back({fan[tip.vertex], 0.0});
      }
    };
    take(far, tip_lengths[trial].geodesic), take(high, tip_lengths[trial].poisson);
    if (trial > 0 && given.size() == before) continue;  // the same list, cut at the same place
    before = given.size();
    try {
      QuadResult result = maker.make(given, nullptr, &deviation);
      if (least < 0 || deviation < least) least = deviation, best = std::move(result);
    } catch (const Error&) {
      if (trial + 1 == tip_trials && least < 0) throw;
    }
  }
  maker.to_mesh(best);
  report(options.progress, 1.0f);
  return best;
}

}  // namespace hf
