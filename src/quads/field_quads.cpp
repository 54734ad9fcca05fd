#include "quads/field_quads.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/progress.h"
#include "base/timer.h"
#include "quads/counted_quads.h"
#include "quads/cut_mesh.h"
#include "quads/feature_crosses.h"
#include "quads/numbers.h"
#include "quads/other_core.h"
#include "quads/poles.h"
#include "quads/side_crosses.h"
#include "quads/symmetric.h"
#include "remesh/fit.h"
#include "remesh/relax.h"
#include "remesh/unfold.h"

namespace hf_inner::quads {
namespace {

// The lines of this room report other values in 15 to 26 runs. The runs use 11 to 17 small and medium meshes, with and
// without creases, mostly at 1,500 faces. A change of 0.3 % in smooth_radius or half_trust moves single figures by up
// to 13 % and their means by 3 %, as rounding decides whole lines. Distances are Hausdorff distances.

// Spacing of sample points for distances, in edge lengths: trades exactness for time. On quads that are more irregular
// than the quads of this room, half the value makes distances smaller on some meshes and larger on others. Twice the
// value raises the mean distance by up to 6 %.
constexpr double sample_spacing = 0.33;
// A place farther than this from the surface is fitted; in edge lengths. On the same quads, at edges of 2.2 % of the
// box, it gives distances of 0.86 % of the box. Half the value: up to 18 % more faces. Twice: distances up to 2.9 %.
constexpr double fit_tolerance = 0.39;
// A guide whose part along the surface is shorter than this share of it has no direction; it refuses mistakes.
constexpr double least_tangent = 1e-9;
// How many times more a triangle counts in the map where guides hold it. A disc held at 29 degrees to all around is 14
// degrees off with 0, and 1 degree with 30. One stroke over spot is 6 to 9 degrees off with 0 to 100, and 34 without
// guides.
constexpr double guide_importance = 10;
// Reported progress: the ends of the parts of the whole, then of each turn. Only the order is right; the shares are not
// measured.
constexpr struct {
  float cut = 0.05f, cut_done = 0.9f;
  float factored = 0.1f, smoothed = 0.2f, mapped = 0.4f;
  float extracted = 0.4f, relaxed = 0.5f;
} field_progress;
// More quads than this must be asked for. At the default edge length a sphere has 2,000; a polygon of 60,000 corners at
// random, which lies over itself two thousand times, would have 4 million and take 1.6 GB.
constexpr double most_unasked = 1e6;
// Fitting adds quads. A result within this share of the wanted number is good, else other numbers are aimed at. At half
// the value 3 of 15 runs take twice as long, for 1.3 % off on average instead of 1.4. Double changes none of them.
constexpr double fitted_error = 0.045;
// At most this many numbers are aimed at; each takes as long as the first. 2 and 6 change none of 15 runs. Five coarse
// ones are 9 % off with 1, and 2.6 % with 6.
constexpr std::int32_t fit_turns_of_count = 3;

// A mesh of more than this many times the wanted quads is not fitted: it would take longer than was asked for. Less
// leaves more of them as they are, more fits them for as many times as long. A disc of 45,000 corners and no vertex
// inside has 69 times as many. The extremes of 42 meshes at 500 quads are an elephant with holes, with 8 times as many,
// and b9, with 10 times. Without fitting they take 0.8 instead of 2.8 s and 1.6 instead of 5.3 s, with a tenth fewer
// corners turned over. The elephant stays 3.0 % of the box away, b9 is 7.6 instead of 6.2 % away.
constexpr double fitted_share = 4;

// A mesh farther than this from the surface, in wanted edge lengths, has lost a limb: too few lines run around it. Then
// finer quads are made, and as many chords removed as it takes. The nearest mesh stays. On 18 coarse meshes that are
// 1.5 % of the box away or more, distances fall from 3.9 % to 3.1 %, in 1.8 times the time. Half as many edge lengths
// give 2.8 % in 2.6 times the time, twice as many 3.5 %. Meshes that are not fitted, as during drags, are not measured.
constexpr double lost_limb = 1.0;
// The edges of each finer mesh are this share of those before. At 0.72 these distances are 3.6 %.
constexpr double finer_share = 0.85;
// At most so many finer meshes are made in all, and none after one that is not nearer by this share. One that is nearer
// but has too many irregular vertices does not end them: a horse of 590 quads came back with the third. With one try
// the distances are 3.2 %; six change nothing.
constexpr std::int32_t finer_tries = 3;
constexpr double nearer_share = 0.99;
// A finer mesh may have this many times the irregular vertices of the first mesh, but at most the square of how many
// times nearer it is. A mesh of a nearer number may have this many times the irregular vertices of the last mesh. One
// where a component fails has five to eight times as many: seen on five of 36 models. A mesh that brings limbs back has
// up to 3.2 times. With 3, a horse stays 1.14 edges away instead of 0.29. Without the square, a boot of 5,000 quads
// gets 22.8 instead of 9.1 % to be a tenth nearer.
constexpr std::int32_t most_irregular = 4;

// Its edges may be stretched by this many times as much. Chords that are removed around a leg leave long quads: without
// a limit a man of 5,000 quads has ratios of 6.3 instead of 1.8. He is then nearer to the surface, 0.5 instead of 1.3 %
// of the box. With 1.3 another man has 1.8 instead of 2.5, and is 1.1 % away instead of 0.8. With 1.7 a triceratops has
// 2.8 instead of 1.7, and its distance falls by a quarter.
constexpr double most_stretched = 1.5;

// A component that keeps less of its area when it is evened out stays as it was. Without it, coins at the ears and
// elbows of a robot of 66 pieces shrink to points. At 3,000 quads it is then 1.89 % of the box away. With 0.9 it is
// 1.37 %. More keeps more bodies uneven.
constexpr double least_evened = 0.6;

// Maps for at least so many quads are untangled (untangle.h). Below, lines that run to and fro in a fold are often the
// only ones around a limb. At 5,000 quads irregular vertices are a twentieth fewer on 12 of 40 meshes and more on 5.
// Distances are smaller on 11 and larger on 7. At 500 quads distances are smaller on 5 and larger on 17.
constexpr double untangled_from = 1000;

// The guides by vertex: the mean of their crosses, to the fourth degree, and the largest weight.
struct Guided {
  explicit Guided(Memory& memory) : cross(&memory), weight(&memory) {}
  Vector<Complex> cross;
  Vector<double> weight;
};

Guided read_guides(Span<const QuadGuide> guides, const field::Connection& connection, Index vertices, Memory& memory) {
  Guided out(memory);
  if (guides.empty()) return out;
  out.cross.assign(at(vertices), Complex(0, 0));
  out.weight.assign(at(vertices), 0.0);
  Vector<double> sum(at(vertices), 0.0, &memory);
  for (std::size_t i = 0; i < guides.size(); ++i) {
    const QuadGuide& guide = guides[i];
    const std::size_t v = at(guide.vertex);
    Complex z = connection.to_frame(guide.vertex, unit_vector(guide.vector));
    if (!(field::length_of(z) > least_tangent) && guide.given == QuadGuide::of_pole) continue;
    if (!(field::length_of(z) > least_tangent))
      fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(guide.given),
           "guide_vectors[%d] is normal to the surface; give a direction along it", guide.given);
    z /= field::length_of(z);
    z *= z;
    z *= z;
    out.cross[v] += guide.weight * z;
    sum[v] += guide.weight;
    out.weight[v] = std::max(out.weight[v], guide.weight);
  }
  for (std::size_t v = 0; v < out.cross.size(); ++v) {
    if (sum[v] > 0) out.cross[v] /= sum[v];
  }
  return out;
}

// Guides of weight 1 do not give way, but to the crosses of features at their vertex.
void add_held(const Guided& guided, Vector<HardCross>& hard) {
  const std::size_t features = hard.size();
  std::size_t next = 0;
  for (std::size_t v = 0; v < guided.weight.size(); ++v) {
    while (next < features && at(hard[next].vertex) < v) ++next;
    const bool taken = next < features && at(hard[next].vertex) == v;
    const double length = field::length_of(guided.cross[v]);
    if (guided.weight[v] < 1 || taken || !(length > agreement)) continue;
    hard.push_back({static_cast<Index>(v), guided.cross[v] / length});
  }
}

// How many vertices inside have not four quads.
std::int32_t count_irregular(const remesh::QuadMesh& mesh, Memory& memory) {
  remesh::Table<std::int32_t> valence(mesh.position.size(), 0, memory);
  for (const std::int32_t v : mesh.corner) ++valence[v];
  std::int32_t count = 0;
  for (std::int32_t v = 0; v < valence.size(); ++v) count += !mesh.border[v] && valence[v] != 4;
  return count;
}

// The longest edge of a quad over its shortest: 19 of 20 quads have less.
double stretch_of(const remesh::QuadMesh& mesh, Memory& memory) {
  if (mesh.face_count() == 0) return 1;
  Vector<double> ratio(&memory);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    double low = HUGE_VAL, high = 0;
    for (std::int32_t k = 0; k < 4; ++k) {
      const double side = norm(mesh.position[mesh.quad(f)[(k + 1) % 4]] - mesh.position[mesh.quad(f)[k]]);
      low = std::min(low, side);
      high = std::max(high, side);
    }
    ratio.push_back(low > 0 ? high / low : HUGE_VAL);
  }
  const auto at_95 = ratio.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(ratio.size() - 1));
  std::nth_element(ratio.begin(), at_95, ratio.end());
  return *at_95;
}

// The area of the quads of each component of the surface.
remesh::Table<double> component_areas(const remesh::FluxSurface& surface, const remesh::QuadMesh& mesh,
                                      Memory& memory) {
  remesh::Table<double> out(surface.component_count, 0.0, memory);
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* c = mesh.quad(f);
    const Vec3 normal = cross(mesh.position[c[2]] - mesh.position[c[0]], mesh.position[c[3]] - mesh.position[c[1]]);
    out[surface.component[surface.tail[3 * mesh.location[c[0]].triangle]]] += norm(normal) / 2;
  }
  return out;
}

// Evens out quads. The six quads of a small flat body have corners against the normals of the surface. Such corners
// move to the middle of their quads, and the body shrinks to a point. So components that shrink keep the places they
// had.
void even_out_components(const remesh::FluxSurface& surface, const remesh::RelaxOptions& options,
                         remesh::QuadMesh& mesh, Memory& memory) {
  const remesh::Table<double> before = component_areas(surface, mesh, memory);
  remesh::Table<Vec3> position(memory);
  remesh::Table<remesh::SurfacePoint> location(memory);
  position = mesh.position;
  location = mesh.location;
  remesh::relax_quads(surface, mesh, options, memory);
  const remesh::Table<double> after = component_areas(surface, mesh, memory);
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const std::int32_t c = surface.component[surface.tail[3 * location[v].triangle]];
    if (after[c] < least_evened * before[c]) {
      mesh.position[v] = position[v];
      mesh.location[v] = location[v];
    }
  }
}

// Evens out quads and fits them to the surface. Returns their distance.
double even_out(const remesh::FluxSurface& surface, const remesh::QuadDistance& distance, std::int32_t rounds,
                double edge_length, remesh::QuadMesh& mesh, Memory& memory) {
  remesh::RelaxOptions relax;
  relax.rounds = rounds;
  relax.edge_length = edge_length;
  {
    const ProgressRange range(field_progress.extracted, field_progress.relaxed);
    even_out_components(surface, relax, mesh, memory);
  }
  const ProgressRange range(field_progress.relaxed, 1.0f);
  distance.turn_quads(mesh);
  remesh::FitOptions fit;
  fit.edge_length = edge_length;
  fit.tolerance = fit_tolerance * edge_length;
  const double away = remesh::fit_quads(surface, distance, mesh, fit, memory);
  return remesh::unfold_quads(surface, distance, edge_length, away, mesh, memory);
}

}  // namespace

double area_of(const surface::Core& core) {
  double sum = 0;
  for (const double part : core.areas) sum += part;
  return sum;
}

void check_expected(const FieldQuadOptions& options, double area) {
  const double expected = area / (options.edge_length * options.edge_length);
  if (options.faces == 0 && options.edge_length == default_edge_length && expected > most_unasked)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "the surface lies over itself: %.0f quads of the default edge length; set edge_length or face_count",
         expected);
}

namespace {

// Quads of a surface whose triangles are short enough.
QuadResult make_quads_here(const FieldQuadOptions& options, FieldQuadReport* out_report, QuadKeeper* kept) {
  const surface::Core& core = *options.core;
  Memory& memory = *core.memory;
  FieldQuadReport made;
  hf_inner::report(0.0f);
  std::optional<ProgressRange> part(std::in_place, 0.0f, field_progress.factored);
  Timer timer;
  std::optional<QuadBase> own;
  if (kept && !kept->whole) kept->whole = make_owner_in<QuadBase>(core.memory, options.core);
  QuadBase& base = kept ? *kept->whole : own.emplace(options.core);
  const remesh::FluxSurface& surface = base.surface;
  double edge_length = options.edge_length;
  if (options.faces > 0) edge_length = std::sqrt(base.area / options.faces);
  base.prepare(edge_length, options.facet);
  const field::Connection& connection = base.system->connection;
  part.reset();
  remesh::Table<std::uint8_t> features = find_features(surface, options.crease > 0 ? options.crease : HUGE_VAL, memory);
  keep_edges(surface, core.topology(), options.crease_edges, features, memory);
  const SharpCorners corners = SharpCorners::find(surface, features, edge_length, memory);
  Vector<HardCross> hard = feature_crosses(core, surface, connection, features, corners, base.passes);
  const SideCrosses sides = SideCrosses::find(surface, connection, features, corners, hard, memory);
  Vector<Complex> wish(base.curvature.begin(), base.curvature.end(), &memory);
  leave_out_near(core.mesh, core.topology(), sides.turned, edge_length, wish);  // two lie between two turned creases
  const Guided guided = read_guides(options.guides, connection, core.size(), memory);
  Vector<QuadPole> poles(options.poles.begin(), options.poles.end(), &memory);
  for (QuadPole& pole : poles) pole.place = base.apart.moved(surface, pole.place);
  for (std::size_t v = 0; v < guided.weight.size(); ++v)
    wish[v] = (1 - guided.weight[v]) * wish[v] + guided.weight[v] * guided.cross[v];
  add_held(guided, hard);
  Vector<Complex> crosses(&memory);
  const auto face_crosses = [&](float from) {
    const ProgressRange range(from, field_progress.smoothed);
    crosses = base.smoother->smooth(wish, hard, sides.seen);
    return FaceCross::make(surface, connection, crosses, features, corners, sides.of_corner, memory);
  };
  FaceCross faces = face_crosses(field_progress.factored);
  if (!sides.turned.empty() &&
      part_turns(surface, core.topology(), connection, wish, crosses, faces.index, hard, memory))
    faces = face_crosses(field_progress.smoothed);
  if (!guided.weight.empty()) {
    // The map cannot turn everywhere as the crosses do. Where there are guides, it does.
    for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
      double w = 0;
      for (int k = 0; k < 3; ++k) w += guided.weight[at(surface.mesh_vertex[surface.tail[3 * t + k]])] / 3;
      faces.importance.push_back(1 + guide_importance * w);
    }
  }
  const Vector<Index> order(base.system->position.begin(), base.system->position.end(), &memory);
  if (!kept) {
    base.smoother.reset();
    base.system.reset();
  }  // their factor and matrices are a tenth of the memory
  made.field_ms = timer.milliseconds();

  Timer map_timer;
  part.emplace(field_progress.smoothed, field_progress.mapped);
  const Seams seams = Seams::make(surface, faces, memory);
  made.singularities = seams.singularity_count;
  made.parameters = seams.parameter_count;
  made.cut_edges = seams.cut_edges;
  GridMapper mapper(surface, faces, seams, features, order, memory, *core.jobs);
  made.left_out = mapper.left_out();
  made.map_ms = map_timer.milliseconds();
  part.reset();

  QuadResult result(memory);
  FieldQuadReport chosen;
  result.euler_characteristic = surface.euler_characteristic;
  const double wanted = options.faces > 0 ? options.faces : base.area / (edge_length * edge_length);
  QuadSource source(surface, mapper, features, options.faces == 0, options.strict, memory);
  double aim = wanted, best = -1;
  std::int32_t chosen_irregular = 0, finer_left = finer_tries;
  float from = field_progress.mapped;
  for (std::int32_t turn = 0; turn < fit_turns_of_count; ++turn) {
    // One turn is mostly enough, so each gets half of the rest.
    const float to = options.faces == 0 ? 1.0f : (from + 1) / 2;
    const ProgressRange turn_range(from, to);
    from = to;
    const double aimed = std::sqrt(base.area / aim);
    CountedQuads counted(surface, source, aim, aimed, options.faces > 0, memory);
    remesh::QuadMesh mesh(memory);
    FieldQuadReport now;
    bool too_many = false, fewest = false;  // fewest: nothing more can be removed
    double off = HUGE_VAL, done = 0;        // the distance to the surface; the progress of this turn
    double share = 1;                       // of the edges
    std::int32_t irregular = 0;             // irregular vertices of the first mesh
    double first = 0, stretch = 0;          // distance and stretch of the first mesh
    const bool untangled = wanted >= untangled_from;
    for (std::int32_t i = 0; i == 0 || (finer_left > 0 && source.is_open()); ++i) {
      if (i > 0) {
        --finer_left;
        share *= finer_share;
      }
      // One try is mostly enough.
      const ProgressRange try_range(done, (done + 1) / 2);
      done = (done + 1) / 2;
      FieldQuadReport tried = made;
      Timer turn_timer;
      remesh::QuadMesh found(memory);
      try {
        found = i == 0 ? counted.make(untangled, tried) : counted.make_finer(share, untangled, tried);
      } catch (const QuadSource::LostComponent&) {
        if (turn == 0 && i == 0) throw;
        break;
      }
      // If every component has a substitute, its quads come from the try before.
      if (i > 0 && tried.substitutes == surface.component_count && now.substitutes == surface.component_count) break;
      if (i == 0) fewest = found.face_count() > (1 + fitted_error) * aim;
      remesh::check_quads(found, surface.euler_characteristic, memory);
      hold_poles(surface, poles, tried.edge_length, found, memory);
      made.quads_ms += turn_timer.milliseconds();
      hf_inner::report(field_progress.extracted);
      Timer fit_timer;
      double away = 0;
      const bool unfit = options.relax > 0 && found.face_count() > fitted_share * wanted;
      if (unfit && i > 0) break;
      too_many = unfit;
      if (options.relax > 0 && !too_many) {
        away =
            even_out(surface, base.distance(sample_spacing * aimed), options.relax, tried.edge_length, found, memory);
        remesh::check_quads(found, surface.euler_characteristic, memory);
      }
      made.fit_ms += fit_timer.milliseconds();
      hf_inner::report(1.0f);
      const std::int32_t count = count_irregular(found, memory);
      const double stretched = stretch_of(found, memory);
      if (i == 0) {
        first = away;
        irregular = count;
        stretch = stretched;
      }
      const double nearer = away > 0 ? first / away : HUGE_VAL;
      const bool better = away < off && count <= irregular * std::min<double>(most_irregular, nearer * nearer) &&
                          stretched <= most_stretched * stretch;
      const bool enough = away <= lost_limb * aimed || away > nearer_share * off;
      if (better) {
        off = away;
        mesh = std::move(found);
        now = tried;
        if (i > 0) now.edge_length = aimed;  // with as many quads
      }
      if (enough) break;
    }
    hf_inner::report(1.0f);  // tries that were not needed are passed over
    if (mesh.face_count() == 0) break;
    const double ratio = mesh.face_count() / wanted, error = miss_of(ratio);
    const std::int32_t count = count_irregular(mesh, memory);
    if (best < 0 || (error < best && count <= most_irregular * chosen_irregular)) {
      best = error;
      chosen_irregular = count;
      result.mesh = std::move(mesh);
      now.quads_ms = made.quads_ms;
      now.fit_ms = made.fit_ms;
      chosen = now;
    }
    // Fitting adds quads, so the next turn aims at less.
    if (options.faces == 0 || error <= fitted_error || too_many || fewest) break;
    aim /= ratio;
  }
  made = chosen;
  base.apart.bring_home(surface, core.mesh, result.mesh);
  remesh::locate_in_mesh(surface, core.mesh, result.mesh);
  if (out_report) *out_report = made;
  hf_inner::report(1.0f);
  return result;
}

// Quads of a surface whose long triangles are cut.
QuadResult make_cut_quads(const FieldQuadOptions& options, double area, double length, FieldQuadReport* out_report,
                          QuadKeeper* kept) {
  const surface::Core& whole = *options.core;
  const double wanted = options.faces > 0 ? options.faces : area / (length * length);
  std::shared_ptr<CutBase> base = kept ? kept->cut : nullptr;
  if (!base || base->length != length || base->quads != wanted) {
    if (kept) kept->cut.reset();
    const ProgressRange part(0.0f, field_progress.cut);
    base = make_owner_in<CutBase>(whole.memory, whole, length, wanted);
    if (kept) kept->cut = base;
  }
  OtherOptions own(options, base->core, length);
  // Crosses of poles get triangles that are small enough for them.
  for (const QuadGuide& guide : options.guides) {
    if (guide.given != QuadGuide::of_pole) own.add_guide(guide, guide.vertex);
  }
  for (const Index e : options.crease_edges) {
    base->cut.for_pieces(whole.topology().first(e), whole.topology().second(e),
                         [&](Index a, Index b) { own.add_crease(a, b); });
  }
  for (const QuadPole& pole : options.poles) own.add_pole(pole);
  own.add_pole_guides();
  FieldQuadOptions cut_options = own.get();
  cut_options.facet = base->facet / base->core->mesh.scale;
  cut_options.strict = true;
  FieldQuadReport found;
  try {
    const ProgressRange part(field_progress.cut, field_progress.cut_done);
    QuadResult result = make_quads_here(cut_options, &found, kept ? &base->kept : nullptr);
    for (Vec3& p : result.mesh.position) p = base->core->mesh.to_given(p);
    for (remesh::SurfacePoint& point : result.mesh.location) point = base->in_whole(point);
    found.edge_length *= base->core->mesh.scale;
    if (out_report) *out_report = found;
    hf_inner::report(1.0f);
    return result;
  } catch (const QuadSource::LostComponent&) {
    // Whether a component loses a handle, say, is luck. The surface as it is may keep it, and has fewer triangles to
    // split if not: boeing has 7 instead of 62 % irregular vertices at 5,000 quads.
    const ProgressRange part(field_progress.cut_done, 1.0f);
    return make_quads_here(options, out_report, kept);
  }
}

}  // namespace

QuadResult make_field_quads(const FieldQuadOptions& options, FieldQuadReport* out_report, QuadKeeper* kept) {
  if (options.plane) return make_symmetric_quads(options, out_report, kept);
  const double area = area_of(*options.core);
  check_expected(options, area);
  const double length = options.faces > 0 ? std::sqrt(area / options.faces) : options.edge_length;
  const double coarse = coarse_part(*options.core, length);
  if (is_coarse(coarse)) return make_cut_quads(options, area, length, out_report, kept);
  const bool creased = options.crease > 0 || !options.crease_edges.empty();
  if (!creased || coarse == 0) return make_quads_here(options, out_report, kept);
  // A patch between creases may be a single fan of long triangles. All its singularities then fall on one vertex.
  FieldQuadOptions own = options;
  own.strict = true;
  try {
    const ProgressRange part(0.0f, field_progress.cut_done);
    return make_quads_here(own, out_report, kept);
  } catch (const QuadSource::LostComponent&) {
    const ProgressRange part(field_progress.cut_done, 1.0f);
    return make_cut_quads(options, area, length, out_report, kept);
  }
}

}  // namespace hf_inner::quads
