// Gives degenerate but ordinary input to every function of hf/analysis.h and hf/direction.h, and to streamlines.
//
// Every call answers HF_OK or refuses with a sentence; no code is HF_ERROR_INTERNAL. What comes out is finite and holds
// what the headers promise. The test reliability_degenerate_complete fails on a function that is not called here.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "degenerate_shapes.h"
#include "hf/quads.h"
#include "report.h"

namespace {

using namespace reliability;

unsigned calls, faults;
std::string where;

void check(bool holds, const char* what) {
  if (holds) return;
  if (++faults <= 40) std::fprintf(stderr, "%s: %s\n", where.c_str(), what);
}

// Counts a call and returns whether it was answered. A refusal has a code of the caller's input and a sentence.
bool answered(hf_result result, const char* call) {
  ++calls;
  if (result == HF_OK) return true;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  const bool ordinary = result == HF_ERROR_INVALID_ARGUMENT || result == HF_ERROR_NON_FINITE ||
                        result == HF_ERROR_EMPTY || result == HF_ERROR_EMPTY || result == HF_ERROR_UNSUPPORTED ||
                        result == HF_ERROR_DUPLICATE || result == HF_ERROR_TOO_LARGE;
  if (!ordinary || !detail.message[0])
    check(false, (std::string(call) + ": " + hf_result_get_name(result) + ", " + detail.message).c_str());
  return false;
}
#define ANSWERED(call) answered(call, #call)

bool all_finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
}

struct Scene {
  const DegenerateMesh& mesh;
  hf_surface surface;
  std::size_t n;
  std::vector<double> position;  // as the surface has them
  double size = 0;               // of the bounding box
  std::vector<char> usable;      // by vertex: it lies in a triangle that does not collapse

  bool collapses(std::size_t triangle) const {
    const std::uint32_t* v = mesh.triangles.data() + 3 * triangle;
    const auto same = [&](int i, int j) {
      return v[i] == v[j] || (mesh.weld != HF_WELD_NONE && line(v[i], v[j]) == 0);
    };
    return same(0, 1) || same(1, 2) || same(2, 0);
  }
  double line(std::size_t a, std::size_t b) const {
    return std::hypot(position[3 * a] - position[3 * b], position[3 * a + 1] - position[3 * b + 1],
                      position[3 * a + 2] - position[3 * b + 2]);
  }
};

void play_levels(const Scene& scene, const hf_scalars& field, const std::vector<double>& values) {
  std::vector<double> levels = {0, 1, 1, -2.5, 1e300, -1e-300};
  for (std::int32_t spacing = HF_LEVELS_VALUE; spacing <= HF_LEVELS_LENGTH; ++spacing) {
    for (const std::uint32_t count : {1u, 7u}) {
      double out[7];
      if (!ANSWERED(hf_surface_space_levels(scene.surface, &field, spacing, count, out))) continue;
      check(all_finite(out, count), "levels are not finite");
      check(std::is_sorted(out, out + count), "levels do not ascend");
      double low = 1e308, high = -1e308;
      for (const double value : values) {
        if (!std::isnan(value)) {
          low = std::min(low, value);
          high = std::max(high, value);
        }
      }
      check(out[0] >= low && out[count - 1] <= high, "levels leave the range of the field");
      levels.insert(levels.end(), out, out + count);
    }
  }
  for (const std::uint32_t count : {0u, static_cast<std::uint32_t>(levels.size())}) {
    hf_isolines lines = HF_INIT(hf_isolines);
    if (!ANSWERED(hf_surface_trace_isolines(scene.surface, &field, count, levels.data(), &lines))) continue;
    std::vector<double> t(lines.point_count + 1), p(3 * (lines.point_count + 1));
    std::vector<std::uint32_t> starts(lines.line_count + 1), edges(2 * (lines.point_count + 1));
    lines.point_capacity = lines.point_count;
    lines.line_capacity = lines.line_count;
    lines.parameters = t.data();
    lines.positions = p.data();
    lines.line_starts = starts.data();
    lines.point_edges = edges.data();
    check(ANSWERED(hf_surface_trace_isolines(scene.surface, &field, count, levels.data(), &lines)), "iso-lines twice");
    check(all_finite(p.data(), 3 * lines.point_count), "iso-lines are not finite");
    check(std::is_sorted(starts.begin(), starts.end()) && starts.back() == lines.point_count, "starts of iso-lines");
    for (std::uint32_t i = 0; i < lines.point_count; ++i) check(t[i] >= 0 && t[i] <= 1, "a parameter is not in 0 to 1");
  }
}

void play_field(const Scene& scene, const DegenerateField& given) {
  hf_scalars field = HF_INIT(hf_scalars);
  field.values_f64 = given.values.data();
  play_levels(scene, field, given.values);
  hf_critical_info info = HF_INIT(hf_critical_info);
  if (ANSWERED(hf_surface_find_critical_points(scene.surface, &field, 0, nullptr, &info))) {
    std::vector<hf_critical_point> points(info.point_count + 1);
    check(ANSWERED(hf_surface_find_critical_points(scene.surface, &field, info.point_count, points.data(), &info)),
          "critical points twice");
    check(info.index_sum == info.euler_characteristic, "indices do not sum to the Euler characteristic");
  }
  hf_flow flow = nullptr;
  if (!ANSWERED(hf_flow_create(scene.surface, &flow))) return;
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t v = 0; v < scene.n; ++v) {
    if (scene.usable[v]) seeds.push_back(v);
  }
  for (const bool seeded : {false, true}) {
    hf_streamlines lines = HF_INIT(hf_streamlines);
    lines.wanted_count = 20;
    if (seeded) {
      lines.seed_count = static_cast<std::uint32_t>(seeds.size());
      lines.seeds = seeds.data();
    }
    if (!ANSWERED(hf_flow_trace(flow, &field, &lines))) continue;
    std::vector<double> p(3 * (lines.point_count + 1)), u(lines.point_count + 1);
    std::vector<std::uint32_t> starts(lines.line_count + 1);
    lines.point_capacity = lines.point_count;
    lines.line_capacity = lines.line_count;
    lines.positions = p.data();
    lines.values = u.data();
    lines.line_starts = starts.data();
    check(ANSWERED(hf_flow_trace(flow, &field, &lines)), "streamlines twice");
    check(all_finite(p.data(), 3 * lines.point_count), "streamlines are not finite");
    if (seeded) check(lines.line_count == seeds.size(), "a seed has no line");
    for (std::uint32_t l = 0; l < lines.line_count; ++l) {
      check(starts[l + 1] > starts[l], "a line without points");
      check(std::is_sorted(u.data() + starts[l], u.data() + starts[l + 1]), "a line does not rise");
    }
  }
  hf_flow_destroy(flow);
}

// Lengths of paths along edges, which no distance exceeds: by triangles, from any of the sources.
std::vector<double> along_edges(const Scene& scene, const std::vector<std::uint32_t>& sources) {
  std::vector<double> d(scene.n, 1e300);
  for (const std::uint32_t s : sources) d[s] = 0;
  const auto& corner = scene.mesh.triangles;
  for (bool shorter = true; shorter;) {
    shorter = false;
    const auto offer = [&](std::size_t a, std::size_t b) {
      const double to = d[a] + scene.line(a, b);
      if (to < d[b]) {
        d[b] = to;
        shorter = true;
      }
    };
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const std::size_t t = k / 3 * 3, a = corner[k], b = corner[t + (k + 1) % 3];
      if (!scene.collapses(k / 3)) {
        offer(a, b);
        offer(b, a);
      }
    }
  }
  return d;
}

void play_distances(const Scene& scene, hf_geodesics geodesics, std::int32_t method) {
  const double rounding = 1e-12 * scene.size;
  std::uint32_t first = 0;
  while (!scene.usable[first]) ++first;
  std::vector<std::vector<std::uint32_t>> sets = {{}, {first}, {first, first}, {first, 2}, {}};
  for (std::uint32_t v = 0; v < scene.n; ++v) {
    if (scene.usable[v] && scene.line(v, 0) < 0.6 * scene.size) sets.back().push_back(v);
  }
  for (const auto& sources : sets) {
    std::vector<double> d(scene.n);
    std::vector<float> single(scene.n);
    const std::uint32_t count = static_cast<std::uint32_t>(sources.size());
    if (!ANSWERED(hf_geodesics_solve_f64(geodesics, count, sources.data(), d.data(), 0))) continue;
    check(ANSWERED(hf_geodesics_solve(geodesics, count, sources.data(), single.data(), 0)), "float distances");
    const std::vector<double> most = along_edges(scene, sources);
    for (std::size_t v = 0; v < scene.n; ++v) {
      check(d[v] == -1 || (d[v] >= 0 && std::isfinite(d[v])), "a distance is no distance");
      check(single[v] == static_cast<float>(d[v]), "float and double distances differ");
      if (d[v] < 0 || method == HF_GEODESICS_HEAT) continue;
      double least = 1e300;
      for (const std::uint32_t s : sources) least = std::min(least, scene.line(s, v));
      check(d[v] >= least - rounding, "a distance is below the straight line");
      const double off = method == HF_GEODESICS_FRONT ? 1.1 : 1.0;  // fronts are off by some per cent
      check(d[v] <= off * most[v] + rounding, "a distance is above a path along edges");
    }
  }
}

// Points of every triangle: a corner, on each side, inside.
void play_paths(const Scene& scene, hf_geodesics geodesics) {
  const double rounding = 1e-10 * scene.size;
  const double weights[][3] = {{1, 0, 0}, {0.5, 0.5, 0}, {0, 0.25, 0.75}, {0.25, 0, 0.75}, {0.5, 0.25, 0.25}};
  std::vector<hf_place> points;
  for (std::uint32_t t = 0; t < scene.mesh.triangle_count(); t += 1 + scene.mesh.triangle_count() / 9) {
    for (const auto& weight : weights) {
      hf_place point{};
      std::copy_n(scene.mesh.triangles.data() + 3 * t, 3, point.corners);
      std::copy_n(weight, 3, point.barycentrics);
      points.push_back(point);
    }
  }
  const auto length = [&](const hf_place& a, const hf_place& b) {
    hf_path path = HF_INIT(hf_path);
    std::vector<double> positions(3 * 1000);
    path.point_capacity = 1000;
    path.positions = positions.data();
    if (!ANSWERED(hf_geodesics_find_path(geodesics, &a, &b, &path))) return -2.0;
    check(all_finite(positions.data(), 3 * path.point_count), "a path is not finite");
    double sum = 0;
    for (std::uint32_t i = 1; i < path.point_count; ++i)
      sum += std::hypot(positions[3 * i] - positions[3 * i - 3], positions[3 * i + 1] - positions[3 * i - 2],
                        positions[3 * i + 2] - positions[3 * i - 1]);
    if (path.length >= 0) check(std::fabs(sum - path.length) <= rounding, "a path has another length than it says");
    return path.length;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const hf_place &a = points[i], &b = points[(7 * i + 3) % points.size()];
    const double there = length(a, b), back = length(b, a);
    check(std::fabs(there - back) <= rounding, "a path and the way back have different lengths");
    check(std::fabs(length(a, a)) <= rounding || there == -2, "a path to its own point has a length");
    for (const double radius : {0.0, 1e-9, 1.5, 1e12}) {
      std::vector<double> map(2 * scene.n);
      double frame[6];
      if (!ANSWERED(hf_geodesics_get_map(geodesics, &a, radius, map.data(), frame))) continue;
      check(all_finite(frame, 6), "a frame is not finite");
      for (std::size_t v = 0; v < scene.n; ++v) {
        check(std::isnan(map[2 * v]) == std::isnan(map[2 * v + 1]), "half of a place of a map");
        check(!std::isinf(map[2 * v]) && !std::isinf(map[2 * v + 1]), "a map is infinite");
      }
    }
  }
}

void play_geodesics(const Scene& scene) {
  for (std::int32_t method = HF_GEODESICS_AUTO; method <= HF_GEODESICS_HEAT; ++method) {
    hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
    desc.method = method;
    hf_geodesics geodesics = nullptr;
    if (!ANSWERED(hf_geodesics_create(scene.surface, &desc, &geodesics))) continue;
    play_distances(scene, geodesics, method);
    if (method <= HF_GEODESICS_FRONT) play_paths(scene, geodesics);
    for (std::int32_t kind = HF_EXTREMITIES_POISSON; kind <= HF_EXTREMITIES_GEODESIC; ++kind) {
      hf_extremities_desc tips = HF_INIT(hf_extremities_desc);
      std::vector<double> field(scene.n);
      std::vector<hf_extremity> found(scene.n);
      std::uint32_t count = 0;
      tips.kind = kind;
      tips.out_field = field.data();
      tips.source_count = 5;
      tips.geodesics = kind == HF_EXTREMITIES_GEODESIC ? geodesics : nullptr;
      const std::uint32_t room = static_cast<std::uint32_t>(scene.n);
      if (!ANSWERED(hf_surface_find_extremities(scene.surface, &tips, room, found.data(), &count))) continue;
      check(all_finite(field.data(), field.size()), "the field of extremities is not finite");
      for (std::uint32_t i = 0; i < count; ++i)
        check(std::isfinite(found[i].length) && all_finite(found[i].position, 3), "a tip is not finite");
    }
    hf_geodesics_destroy(geodesics);
  }
}

void play_solve(const Scene& scene, hf_direction direction) {
  std::vector<double> d(3 * scene.n);
  std::vector<float> f(3 * scene.n);
  hf_solve_info info = HF_INIT(hf_solve_info);
  if (ANSWERED(hf_direction_solve_f64(direction, d.data(), 0, &info)))
    check(all_finite(d.data(), d.size()), "a direction is not finite");
  if (ANSWERED(hf_direction_solve(direction, f.data(), 0, nullptr))) {
    for (const float x : f) check(std::isfinite(x), "a direction in float is not finite");
  }
  std::uint32_t count = 0;
  if (ANSWERED(hf_direction_get_singularities(direction, 0, nullptr, &count))) {
    std::vector<hf_singularity> found(count + 1);
    check(ANSWERED(hf_direction_get_singularities(direction, count, found.data(), &count)), "singularities twice");
  }
}

void play_direction(const Scene& scene, std::uint32_t degree) {
  hf_direction_desc desc = HF_INIT(hf_direction_desc);
  desc.degree = degree;
  hf_direction direction = nullptr, copy = nullptr;
  if (!ANSWERED(hf_direction_create(scene.surface, &desc, &direction))) return;
  play_solve(scene, direction);
  std::vector<std::uint32_t> numbers, all;
  for (std::uint32_t v = 0; v < scene.n; ++v) {
    if (scene.usable[v]) all.push_back(v);
  }
  const double vectors[][3] = {{1, 0, 0}, {0, 0, 0}, {0, 1e-300, 0}, {1e300, 1e300, 0}, {0, 0, 1}};
  for (const auto& vector : vectors) {
    std::uint32_t number = 0;
    const std::uint32_t v = all[numbers.size() * 5 % all.size()];
    if (!ANSWERED(hf_direction_add_sites(direction, 1, &v, vector, &number))) continue;
    numbers.push_back(number);
    play_solve(scene, direction);
    const double angle = 1e9;
    ANSWERED(hf_direction_rotate_sites(direction, 1, &number, &angle));
    ANSWERED(hf_direction_set_vectors(direction, 1, &number, vectors[0]));
    ANSWERED(hf_direction_move_sites(direction, 1, &number, &v));  // to where it is
    ANSWERED(hf_direction_move_sites(direction, 1, &number, &all.back()));
    play_solve(scene, direction);
  }
  std::vector<double> every(3 * all.size(), 1.0);
  std::vector<std::uint32_t> sites(scene.n), vertices(scene.n);
  std::vector<double> given(3 * scene.n);
  const std::uint32_t count = static_cast<std::uint32_t>(all.size());
  if (ANSWERED(hf_direction_clone(direction, &copy))) {
    ANSWERED(hf_direction_remove_sites(copy, static_cast<std::uint32_t>(numbers.size()), numbers.data()));
    check(hf_direction_get_site_count(copy) == 0, "constraints that were removed");
    if (ANSWERED(hf_direction_add_sites(copy, count, all.data(), every.data(), sites.data()))) play_solve(scene, copy);
    std::uint32_t now = 0;
    check(ANSWERED(hf_direction_get_sites(copy, static_cast<std::uint32_t>(scene.n), sites.data(), vertices.data(),
                                          given.data(), &now)),
          "the constraints");
    check(all_finite(given.data(), 3 * now), "a constraint is not finite");
    hf_direction_destroy(copy);
  }
  ANSWERED(hf_direction_add_sites(direction, 0, nullptr, nullptr, nullptr));
  play_solve(scene, direction);
  hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
  check(ANSWERED(hf_direction_get_statistics(direction, &statistics)), "the statistics");
  hf_direction_destroy(direction);
}

void play(const DegenerateMesh& mesh) {
  where = mesh.name;
  std::vector<float> floats(mesh.positions.begin(), mesh.positions.end());
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = mesh.vertex_count();
  desc.triangle_count = mesh.triangle_count();
  if (mesh.in_float)
    desc.positions = floats.data();
  else
    desc.positions_f64 = mesh.positions.data();
  desc.triangles = mesh.triangles.data();
  desc.weld = mesh.weld;
  desc.allocator = padded_allocator();
  hf_surface surface = nullptr;
  check(ANSWERED(hf_surface_create(&desc, &surface)), "the surface");
  if (!surface) return;
  Scene scene{mesh, surface, mesh.vertex_count(), mesh.positions, 0, std::vector<char>(mesh.vertex_count(), 0)};
  if (mesh.in_float) std::copy(floats.begin(), floats.end(), scene.position.begin());
  for (std::size_t a = 0; a < scene.n; ++a) scene.size = std::max(scene.size, scene.line(a, 0));
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    for (std::size_t c = 3 * t; c < 3 * t + 3 && !scene.collapses(t); ++c) scene.usable[mesh.triangles[c]] = 1;
  }
  for (const DegenerateField& field : degenerate_fields(mesh)) {
    where = mesh.name + ", " + field.name;
    play_field(scene, field);
  }
  where = mesh.name + ", distances";
  play_geodesics(scene);
  for (const std::uint32_t degree : {1u, 2u, 4u}) {
    where = mesh.name + ", directions";
    play_direction(scene, degree);
  }
  hf_surface_destroy(surface);
}

}  // namespace

int main() {
  for (const DegenerateMesh& mesh : degenerate_meshes()) play(mesh);
  report_at_least("degenerate_calls", calls, 1000);
  report_at_most("degenerate_faults", faults, 0);
  return report_status();
}
