#include "remesh/quads.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/elementary.h"
#include "base/stable_sort.h"
#include "field/extremities.h"
#include "remesh/capture.h"
#include "remesh/coarsen.h"
#include "remesh/constants.h"
#include "remesh/fit.h"
#include "remesh/relax.h"
#include "remesh/ring_levels.h"

namespace hf_inner {

namespace {

// Scales the number of flow lines of every component, so that the mean face is a little smaller than a square of the
// edge length. The number of faces is the sum, over all rings of nodes, of the lines that cross them.
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
    const double wanted = area_share * area[c] / (options.edge_length * options.edge_length);
    if (faces[c] > 0)
      scale_lines(surface, c, std::min(std::max(wanted / faces[c], least_line_scale), most_line_scale), sites);
  }
}

// Returns how uneven a mesh is. The result is 0 if edges have `shortest` to `longest` edge lengths and quads have an
// aspect of at most `narrowest`. A few may be worse (outliers).
double shape_cost(const QuadMesh& mesh, double edge_length, double shortest, double longest, double narrowest,
                  Memory& memory) {
  Vector<double> lengths(&memory), aspects(&memory);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    double least = HUGE_VAL, most = 0;
    for (std::int32_t k = 0; k < mesh.size(f); ++k) {
      const std::int32_t* c = mesh.corner.data() + mesh.face_start[f];
      const double length = norm(mesh.position[c[(k + 1) % mesh.size(f)]] - mesh.position[c[k]]) / edge_length;
      lengths.push_back(length), least = std::min(least, length), most = std::max(most, length);
    }
    aspects.push_back(least > 0 ? std::min(most / least, most_aspect) : most_aspect);
  }
  auto at = [](Vector<double>& values, double share) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  return short_edge_cost * std::max(0.0, shortest - at(lengths, outliers)) +
         std::max(0.0, at(lengths, 1 - outliers) - longest) +
         std::max(0.0, logarithm(at(aspects, 1 - outliers) / narrowest));
}

// Makes quad meshes of one surface from several sets of sites (ends of flow lines), with one factor, and one search
// tree for distances.
class Maker {
 public:
  explicit Maker(const QuadOptions& options)
      : options_(options),
        core_(*options.core),
        memory_(*core_.memory),
        surface_(FluxSurface::make(core_.mesh, core_.topology, apex_weight, memory_)),
        solver_(surface_, memory_, *core_.jobs),
        distance_(surface_, sample_spacing * options.edge_length, memory_, core_.jobs.get()) {}

  const FluxSurface& surface() const noexcept { return surface_; }

  // Makes one mesh. out_deviation: the distance between mesh and surface. density: edges are 1 / density of the wanted
  // edge length.
  QuadResult make(Span<const FluxSite> given, double density, double* out_deviation) const {
    QuadResult result(memory_);
    result.euler_characteristic = surface_.euler_characteristic;
    RingOptions ring_options;
    ring_options.edge_length = options_.edge_length / density, ring_options.uniform = options_.uniform;
    Vector<double> u = flow(given, ring_options, result);
    report(make_progress.solved);

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
    report(make_progress.counted);
    const ArcGraph graph(field, memory_);
    report(make_progress.arcs);
    const RingMesh rings = [&] {
      const ProgressRange range(make_progress.arcs, make_progress.rings);
      return make_rings(field, graph, lines, ring_options, memory_);
    }();
    Table<std::int32_t> centre(memory_);
    result.mesh = make_polygons(field, graph, rings, centre, memory_);
    check_quads(result.mesh, surface_.euler_characteristic, memory_);
    result.raw_faces = result.mesh.face_count(), result.raw_quads = result.mesh.quad_count();
    report(make_progress.polygons);
    if (options_.split) {
      result.mesh = split_polygons(surface_, result.mesh, centre, memory_);
      check_quads(result.mesh, surface_.euler_characteristic, memory_);
    }
    report(make_progress.split);
    const ProgressRange range(make_progress.split, 1.0f);
    *out_deviation = even_out(result.mesh, ring_options.edge_length);
    return result;
  }

  // Fits the mesh to the surface and collapses short edges in turns. In kind pure (no line ends between sites) it only
  // collapses edges that refining made. Each turn allows more turned-over corners than the last. Returns the cost of
  // the mesh.
  double fit(QuadMesh& mesh, double density, double deviation) const {
    const double allowed = fit_tolerance * options_.edge_length, edge_length = options_.edge_length / density;
    if (options_.relax > 0) {
      for (int turn = 0; turn < fit_turns; ++turn) {
        const double before = deviation;
        const std::int32_t faces = mesh.face_count();
        const float share = 1.0f / static_cast<float>(fit_turns);
        const float from = share * static_cast<float>(turn);
        {
          const ProgressRange range(from, from + fit_progress * share);
          FitOptions fit;
          fit.edge_length = edge_length, fit.tolerance = allowed;
          fit.most_folds = folds_a_turn * turn, fit.relax_rings = turn % 2 == 0 ? fit_rings : fit_rings_odd;
          deviation = fit_quads(surface_, distance_, mesh, fit, memory_);
        }
        const ProgressRange range(from + fit_progress * share, from + share);
        CoarsenOptions coarsen;
        if (!options_.uniform) coarsen.only_refined = true, coarsen.shortest = short_edge_pure;
        coarsen.edge_length = edge_length, coarsen.tolerance = collapse_tolerance * allowed,
        deviation = coarsen_quads(surface_, distance_, mesh, deviation, coarsen, memory_);
        if (turn > 0 && cost(mesh, deviation) <= 1) break;
        if (turn > 1 && deviation == before && mesh.face_count() == faces) break;
      }
      check_quads(mesh, surface_.euler_characteristic, memory_);
    }
    report(1.0f);
    deviation = distance_.measure(mesh, 0, nullptr, nullptr);
    return cost(mesh, deviation);
  }

  // Returns at most 1 for a good mesh, and more for a worse one.
  double cost(const QuadMesh& mesh, double deviation) const {
    const double shape =
        options_.uniform ? shape_cost(mesh, options_.edge_length, shortest_even, longest_even, narrowest_even, memory_)
                         : shape_cost(mesh, options_.edge_length, 0, HUGE_VAL, narrowest_pure, memory_);
    return std::max(deviation / (near_distance * options_.edge_length), 1.0) + shape;
  }

  // Changes the result to vertices and triangles of the Mesh.
  void to_mesh(QuadResult& result) const {
    for (FluxSite& site : result.sites) site.vertex = surface_.mesh_vertex[site.vertex];
    locate_in_mesh(surface_, core_.mesh, result.mesh);
  }

 private:
  // Chooses the sites with their numbers of flow lines, and returns the flow field.
  Vector<double> flow(Span<const FluxSite> given, const RingOptions& rings, QuadResult& result) const {
    const ProgressRange range(0.0f, make_progress.flow);
    result.sites = choose_flux_sites(surface_, given, options_.automatic, rings.edge_length, memory_);
    Vector<double> u = solve_with_borders(surface_, solver_, result.sites);
    for (int round = 0; round < line_rounds && !options_.uniform && options_.scale_lines; ++round) {
      report(1.0f);
      fit_lines(surface_, u, rings, result.sites, memory_);
      u = solve_with_borders(surface_, solver_, result.sites);
    }
    return u;
  }

  // Relaxes the mesh. It snaps vertices to missed features of the surface, and keeps this if the distance both ways
  // falls.
  double even_out(QuadMesh& mesh, double edge_length) const {
    auto relax = [&](std::int32_t rounds, float from, float to) {
      const ProgressRange range(from, to);
      RelaxOptions options;
      options.rounds = rounds, options.edge_length = edge_length;
      relax_quads(surface_, mesh, options, memory_);
    };
    auto measure = [&](QuadMesh& at, float from, float to) {
      const ProgressRange range(from, to);
      distance_.turn_quads(at);
      return distance_.measure(at, 0, nullptr);
    };
    // Vertices slide off thin parts where edges are long. So in kind pure (no line ends between sites), the mesh after
    // few rounds of relaxation is kept if it is nearer to the surface.
    const std::int32_t little = options_.uniform ? 0 : options_.relax / early_share;
    relax(little, 0.0f, even_progress.early);
    QuadMesh early = mesh;
    const double before = little > 0 ? measure(early, even_progress.early, even_progress.early_measured) : -1;
    relax(options_.relax - little, even_progress.early_measured, even_progress.relaxed);
    double deviation = measure(mesh, even_progress.relaxed, even_progress.measured);
    if (little > 0 && before < early_gain * deviation) deviation = before, mesh = std::move(early);
    if (options_.relax > 0 && deviation > capture_from) {
      QuadMesh snapped = mesh;
      {
        const ProgressRange range(even_progress.measured, even_progress.captured);
        CaptureOptions capture;
        capture.edge_length = edge_length;
        capture_features(surface_, distance_, snapped, capture, memory_);
      }
      const double after = measure(snapped, even_progress.captured, 1.0f);
      if (after < deviation) deviation = after, mesh = std::move(snapped);
    }
    report(1.0f);
    return deviation;
  }

  const QuadOptions& options_;
  const Core& core_;
  Memory& memory_;
  const FluxSurface surface_;
  const FluxSolver solver_;
  const QuadDistance distance_;
};

}  // namespace

void locate_in_mesh(const FluxSurface& surface, const Mesh& mesh, QuadMesh& quads) {
  for (SurfacePoint& point : quads.location) {
    const std::int32_t* corners = mesh.triangle(point.triangle);
    const SurfacePoint here = point;
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) {
        if (surface.mesh_vertex[surface.tail[3 * here.triangle + j]] == corners[k]) point.weight[k] = here.weight[j];
      }
    }
  }
}

QuadResult make_quads(const QuadOptions& options) {
  const Core& core = *options.core;
  Memory& memory = *core.memory;
  report(0.0f);
  const std::optional<Maker> made = [&]() -> std::optional<Maker> {
    const ProgressRange range(0.0f, quads_progress.prepared);
    return std::optional<Maker>(std::in_place, options);
  }();
  const Maker& maker = *made;
  const FluxSurface& surface = maker.surface();
  // A mesh vertex where several fans of triangles meet counts as the vertex of its first fan.
  Table<std::int32_t> fan(core.size(), -1, memory);
  for (std::int32_t v = surface.first_apex; v-- > 0;) fan[surface.mesh_vertex[v]] = v;
  Vector<FluxSite> given(&memory);
  double deviation = 0;
  if (!options.automatic) {
    for (const FluxSite& site : options.sites) given.push_back({fan[site.vertex], site.lines});
    QuadResult result = [&] {
      const ProgressRange sub(quads_progress.prepared, given_made);
      return maker.make(given, 1, &deviation);
    }();
    const ProgressRange range(given_made, 1.0f);
    maker.fit(result.mesh, 1, deviation);
    maker.to_mesh(result);
    report(1.0f);
    return result;
  }

  // Tips of limbs come from two fields (field/extremities.h): the mean distance finds limbs that the Poisson field
  // merges into others.
  const Extremities far = [&] {
    const ProgressRange range(quads_progress.prepared, quads_progress.far_tips);
    return geodesic_extremities(options.core, geodesic_smoothing, geodesic_sources, tip_lengths[0].geodesic);
  }();
  const Extremities high = [&] {
    const ProgressRange range(quads_progress.far_tips, quads_progress.tips);
    return poisson_extremities(core, tip_lengths[0].poisson);
  }();
  struct Trial {
    double deviation;
    QuadResult result;
    Vector<FluxSite> given;
  };
  Vector<Trial> trials(&memory);
  trials.reserve(tip_trials);
  std::size_t before = 0;
  for (int trial = 0; trial < tip_trials; ++trial) {
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
    if (trial > 0 && given.size() == before) continue;  // the same sites as before
    before = given.size();
    const float share = (quads_progress.tried - quads_progress.tips) / static_cast<float>(tip_trials),
                from = quads_progress.tips + share * static_cast<float>(trial);
    const ProgressRange range(from, from + share);
    try {
      QuadResult result = maker.make(given, 1, &deviation);
      trials.push_back({deviation, std::move(result), Vector<FluxSite>(given, &memory)});
    } catch (const Error& error) {
      if (error.code() == HF_ERROR_CANCELLED || (trial + 1 == tip_trials && trials.empty())) throw;
    }
  }
  if (trials.empty())
    // If no mesh can be made, throws why.
    trials.push_back({0, maker.make(given, 1, &deviation), Vector<FluxSite>(given, &memory)});
  // Meshes are fitted in order of distance. The first good one is taken, or else the best.
  stable_sort(
      trials, [](const Trial& a, const Trial& b) { return a.deviation < b.deviation; }, memory);
  double least = -1;
  std::size_t taken = 0;
  for (std::size_t i = 0; i < std::min(trials.size(), most_fitted) && (i == 0 || least > 1); ++i) {
    if (trials[i].deviation > trial_cutoff * trials[0].deviation) break;
    const float share = (quads_progress.fitted - quads_progress.tried) / static_cast<float>(most_fitted),
                from = quads_progress.tried + share * static_cast<float>(i);
    const ProgressRange range(from, from + share);
    const double cost = maker.fit(trials[i].result.mesh, 1, trials[i].deviation);
    if (least < 0 || cost < least) least = cost, taken = i;
  }
  QuadResult best = std::move(trials[taken].result);
  float from = quads_progress.fitted;
  for (const double density : densities) {
    for (std::size_t i = 0; i < std::min(trials.size(), most_dense) && options.relax > 0 && least > near_enough; ++i) {
      const float share = (1 - quads_progress.fitted) / static_cast<float>(density_count * most_dense);
      const ProgressRange range(from, from + share);
      from += share;
      try {
        QuadResult result = [&] {
          const ProgressRange sub(0.0f, dense_made);
          return maker.make(trials[i].given, density, &deviation);
        }();
        const ProgressRange sub(dense_made, 1.0f);
        const double cost = maker.fit(result.mesh, density, deviation);
        if (cost < least) least = cost, best = std::move(result);
      } catch (const Error& error) {
        if (error.code() == HF_ERROR_CANCELLED) throw;  // keeps the best mesh so far
      }
    }
  }
  maker.to_mesh(best);
  report(1.0f);
  return best;
}

}  // namespace hf_inner
