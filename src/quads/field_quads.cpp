#include "quads/field_quads.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/timer.h"
#include "quads/numbers.h"
#include "remesh/fit.h"
#include "remesh/relax.h"

namespace hf_inner {
namespace {

// Radius in edge lengths over which crosses are evened out.
constexpr double smooth_radius = 4;
// Radius in edge lengths over which the curvature is evened out, and the limits of its rounds.
constexpr double curvature_radius = 1;
constexpr std::int32_t least_passes = 2, most_passes = 20;
// The feature edges of a vertex agree if their crosses sum to more than this share of their number. Else the cross at
// the vertex is free.
constexpr double agreement = 0.5;
constexpr double degrees = half_turn / 180;
// Edge lengths that are tried until a mesh is valid: each is this share of the one before.
constexpr double shorter = 0.9;
constexpr std::int32_t most_tries = 8;
// A number of faces this near to the wanted one is good; tries to come nearer.
constexpr double faces_error = 0.02;
constexpr std::int32_t count_tries = 4;

// Crosses at feature edges lie along them.
Vector<HardCross> feature_crosses(const Core& core, const FluxSurface& surface, const Connection& connection,
                                  const Table<std::uint8_t>& features) {
  Memory& memory = *core.memory;
  Vector<Complex> sum(at(core.size()), Complex(0, 0), &memory);
  Vector<double> count(at(core.size()), 0.0, &memory);
  Vector<HardCross> out(&memory);
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    const std::int32_t g = surface.twin[h];
    if (!features[h] || (surface.is_real(g) && g < h)) continue;
    const Vec3 edge = surface.position[surface.head(h)] - surface.position[surface.tail[h]];
    for (const Index v : {surface.mesh_vertex[surface.tail[h]], surface.mesh_vertex[surface.head(h)]}) {
      Complex z = connection.to_frame(v, edge);
      if (!(length_of(z) > 0)) continue;
      z /= length_of(z), z *= z, z *= z;
      sum[at(v)] += z, count[at(v)] += 1;
    }
  }
  for (Index v = 0; v < core.size(); ++v) {
    const double length = length_of(sum[at(v)]);
    if (count[at(v)] > 0 && length > agreement * count[at(v)]) out.push_back({v, sum[at(v)] / length});
  }
  return out;
}

double area_of(const FluxSurface& surface) {
  double sum = 0;
  for (std::int32_t t = 0; t < surface.real_triangles; ++t) {
    const Vec3 a = surface.position[surface.tail[3 * t]];
    sum +=
        0.5 * norm(cross(surface.position[surface.tail[3 * t + 1]] - a, surface.position[surface.tail[3 * t + 2]] - a));
  }
  return sum;
}

}  // namespace

QuadResult make_field_quads(const FieldQuadOptions& options, FieldQuadReport* out_report) {
  const Core& core = *options.core;
  Memory& memory = *core.memory;
  FieldQuadReport made;
  hf_inner::report(0.0f);
  Timer timer;
  const FluxSurface surface = FluxSurface::make(core.mesh, core.topology, 0, memory);
  double edge_length = options.edge_length;
  if (options.faces > 0) edge_length = std::sqrt(area_of(surface) / options.faces);

  const DirectionSystem system(options.core, 4);
  double mean = 0;
  for (Index e = 0; e < core.topology.edge_count(); ++e)
    mean += norm(core.mesh.positions[at(core.topology.second(e))] - core.mesh.positions[at(core.topology.first(e))]);
  mean /= std::max(core.topology.edge_count(), 1);
  const double rings = curvature_radius * edge_length / mean;
  const Vector<Complex> wish = curvature_crosses(
      core, system.connection,
      static_cast<Index>(std::min<double>(most_passes, std::max<double>(least_passes, rings * rings))));
  CrossOptions cross_options;
  cross_options.radius = smooth_radius * edge_length;
  const Table<std::uint8_t> features =
      find_features(surface, options.crease > 0 ? options.crease * degrees : HUGE_VAL, memory);
  const Vector<Complex> crosses =
      smooth_crosses(system, wish, feature_crosses(core, surface, system.connection, features), cross_options);
  const FaceCross faces = FaceCross::make(surface, system.connection, crosses, features, memory);
  made.field_ms = timer.milliseconds();
  hf_inner::report(0.2f);

  Timer map_timer;
  const Seams seams = Seams::make(surface, faces, memory);
  made.singularities = seams.singularity_count, made.parameters = seams.parameter_count,
  made.cut_edges = seams.cut_edges;
  GridMapper mapper(surface, faces, seams, features, system.position, memory, *core.jobs);
  made.left_out = mapper.left_out();
  made.map_ms = map_timer.milliseconds();
  hf_inner::report(0.4f);

  Timer quads_timer;
  QuadResult result(memory);
  result.euler_characteristic = surface.euler_characteristic;
  double length = edge_length, best = -1;
  std::optional<Error> refused;
  for (std::int32_t round = 0, counted = 0; round < most_tries && counted < count_tries; ++round) {
    ++made.tries;
    try {
      const GridMap map = mapper.make(length);
      ExtractReport extracted;
      QuadMesh mesh = extract_quads(surface, map, features, extracted, memory);
      const std::int32_t raw = mesh.face_count();
      extracted.doublets = remove_doublets(mesh, memory);
      check_quads(mesh, surface.euler_characteristic, memory);
      const double ratio = options.faces > 0 ? static_cast<double>(mesh.face_count()) / options.faces : 1;
      const double error = std::fabs(ratio - 1);
      if (best < 0 || error < best) {
        best = error;
        result.raw_faces = raw, result.raw_quads = raw;
        result.mesh = std::move(mesh);
        made.turned_over = map.turned_over, made.roundings = map.roundings, made.backward = extracted.backward;
        made.doublets = extracted.doublets, made.edge_length = length;
      }
      if (error <= faces_error) break;
      ++counted, length *= std::sqrt(ratio);
    } catch (const Error& error) {
      if (error.code() == HF_ERROR_CANCELLED) throw;
      refused = error;
      length *= shorter;
    }
  }
  if (best < 0) {
    if (refused->code() != HF_ERROR_INTERNAL) throw Error(*refused);
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "no edge length from %g to %g box diagonals gives quads around every thin part (%s); ask for shorter edges",
         length, edge_length, refused->what());
  }
  made.quads_ms = quads_timer.milliseconds();
  hf_inner::report(0.6f);

  Timer fit_timer;
  if (options.relax > 0) {
    RelaxOptions relax;
    relax.rounds = options.relax, relax.edge_length = made.edge_length;
    relax_quads(surface, result.mesh, relax, memory);
    const QuadDistance distance(surface, sample_spacing * made.edge_length, memory, core.jobs.get());
    distance.turn_quads(result.mesh);
    FitOptions fit;
    fit.edge_length = made.edge_length, fit.tolerance = fit_tolerance * made.edge_length;
    fit_quads(surface, distance, result.mesh, fit, memory);
    check_quads(result.mesh, surface.euler_characteristic, memory);
  }
  made.fit_ms = fit_timer.milliseconds();
  locate_in_mesh(surface, core.mesh, result.mesh);
  if (out_report) *out_report = made;
  hf_inner::report(1.0f);
  return result;
}

}  // namespace hf_inner
