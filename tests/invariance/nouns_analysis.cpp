// Levels, iso-lines, critical points, distances, paths, maps, tips and streamlines.
#include <cmath>
#include <limits>

#include "setting.h"

namespace invariance {
namespace {

// A smooth field of the body that no two vertices share a value of.
std::vector<double> wave(const Body& body) {
  std::vector<double> out;
  for (const Vec& p : body.points) {
    const Vec q = (1 / body.diagonal) * (p - body.low);
    out.push_back(std::sin(7 * q[0] + 1) + std::cos(9 * q[1]) * q[2] + q[1] + 0.3 * q[0]);
  }
  return out;
}

struct Scalars {
  std::vector<double> values;
  hf_scalars desc = HF_INIT(hf_scalars);
  Scalars(const Setting& s, double added) : values(s.spread(wave(s.body), added)) { desc.values_f64 = values.data(); }
};

// A vertex that is not the body's has no value: its triangles do not count.
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

double polyline(const Setting& s, const std::vector<double>& xyz, std::uint32_t begin, std::uint32_t end, bool closed) {
  double out = 0;
  const auto point = [&](std::uint32_t i) { return Vec{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}; };
  for (std::uint32_t i = begin + 1; i < end; ++i) out += length(point(i) - point(i - 1));
  if (closed) out += length(point(begin) - point(end - 1));
  return s.back_size(out) / s.body.diagonal;
}

using Geodesics = Owned<hf_geodesics, hf_geodesics_destroy>;

Geodesics geodesics_of(const Setting& s, std::int32_t method) {
  hf_geodesics_desc d = HF_INIT(hf_geodesics_desc);
  d.method = method;
  Geodesics out;
  ok(hf_geodesics_create(s.surface(), &d, out.out()));
  return out;
}

// From one vertex, and from three at once. -1 stays: it is no length.
Measured distances(const Setting& s, std::int32_t method) {
  Measured out;
  const Geodesics geodesics = geodesics_of(s, method);
  for (const std::uint32_t count : {1u, 3u}) {
    const std::uint32_t sources[] = {s.pick(0), s.pick(4), s.pick(7)};
    std::vector<double> values(s.copy.points.size());
    ok(hf_geodesics_solve_f64(geodesics, count, sources, values.data(), 0));
    for (double& v : values) v = v < 0 ? -1 : s.back_size(v) / s.body.diagonal;
    out.add(count == 1 ? "one source" : "three sources", s.gather(values));
  }
  return out;
}

}  // namespace

Measured measure_isolines(const Setting& s) {
  const Scalars field(s, no_value);
  Measured out;
  std::vector<double> levels(9);
  for (const std::int32_t spacing : {HF_LEVELS_AREA, HF_LEVELS_LENGTH, HF_LEVELS_VALUE}) {
    ok(hf_surface_space_levels(s.surface(), &field.desc, spacing, 9, levels.data()));
    out.add("levels", levels);
  }
  hf_isolines lines = HF_INIT(hf_isolines);
  ok(hf_surface_trace_isolines(s.surface(), &field.desc, 9, levels.data(), &lines));
  std::vector<double> positions(3 * std::size_t{lines.point_count});
  std::vector<std::uint32_t> starts(lines.line_count + 1), level(lines.line_count);
  std::vector<std::int32_t> closed(lines.line_count);
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.positions = positions.data();
  lines.line_starts = starts.data();
  lines.line_levels = level.data();
  lines.line_closed = closed.data();
  ok(hf_surface_trace_isolines(s.surface(), &field.desc, 9, levels.data(), &lines));
  std::vector<double> lengths(9, 0);
  for (std::uint32_t i = 0; i < lines.line_count; ++i)
    lengths[level[i]] += polyline(s, positions, starts[i], starts[i + 1], closed[i] != 0);
  out.count("lines", lines.line_count);
  out.add("lengths", lengths);
  return out;
}

Measured measure_critical(const Setting& s) {
  const Scalars field(s, no_value);
  hf_critical_info info = HF_INIT(hf_critical_info);
  ok(hf_surface_find_critical_points(s.surface(), &field.desc, 0, nullptr, &info));
  std::vector<hf_critical_point> points(info.point_count);
  ok(hf_surface_find_critical_points(s.surface(), &field.desc, info.point_count, points.data(), &info));
  std::vector<double> members;
  for (const hf_critical_point& p : points)
    members.insert(members.end(), {static_cast<double>(s.origin(p.vertex)), static_cast<double>(p.kind),
                                   static_cast<double>(p.index), p.value});
  Measured out;
  out.add_set("points", 4, members);
  out.count("Euler characteristic", info.euler_characteristic);
  return out;
}

Measured measure_exact(const Setting& s) { return distances(s, HF_GEODESICS_EXACT); }
Measured measure_front(const Setting& s) { return distances(s, HF_GEODESICS_FRONT); }
Measured measure_heat(const Setting& s) { return distances(s, HF_GEODESICS_HEAT); }

namespace {

// A point in the first triangle of a pick.
hf_place point_at(const Setting& s, std::size_t pick) {
  hf_place out{};
  std::uint32_t t = 0;
  const auto has = [&](std::uint32_t face, std::uint32_t v) {
    const auto& c = s.body.triangles[face];
    return c[0] == v || c[1] == v || c[2] == v;
  };
  while (!has(t, s.body.picks[pick])) ++t;
  s.point(t, {0.31, 0.23, 0.46}, out.corners, out.barycentrics);
  return out;
}

}  // namespace

Measured measure_paths(const Setting& s) {
  const Geodesics geodesics = geodesics_of(s, HF_GEODESICS_EXACT);
  std::vector<double> lengths;
  for (const std::size_t to : {2u, 5u, 8u}) {
    const hf_place a = point_at(s, 0), b = point_at(s, to);
    hf_path path = HF_INIT(hf_path);
    ok(hf_geodesics_find_path(geodesics, &a, &b, &path));
    lengths.push_back(s.back_size(path.length));
  }
  Measured out;
  out.add("lengths", lengths, s.body.diagonal);
  return out;
}

Measured measure_map(const Setting& s) {
  const Geodesics geodesics = geodesics_of(s, HF_GEODESICS_EXACT);
  const hf_place centre = point_at(s, 1);
  std::vector<double> map(2 * s.copy.points.size()), space(3 * s.copy.points.size());
  double frame[6];
  // a small disc: farther away the map tears where two paths meet
  ok(hf_geodesics_get_map(geodesics, &centre, s.size(0.5 * s.body.spacing), map.data(), frame));
  for (std::size_t v = 0; v < s.copy.points.size(); ++v) {
    for (int k = 0; k < 3; ++k) space[3 * v + k] = s.back_size(map[2 * v] * frame[k] + map[2 * v + 1] * frame[3 + k]);
  }
  Measured out;
  out.add("map", s.gather_directions(space), s.body.diagonal);
  return out;
}

namespace {

Measured tips(const Setting& s, std::int32_t kind) {
  hf_extremities_desc d = HF_INIT(hf_extremities_desc);
  d.kind = kind;
  std::uint32_t count = 0;
  ok(hf_surface_find_extremities(s.surface(), &d, 0, nullptr, &count));
  std::vector<hf_extremity> found(count);
  ok(hf_surface_find_extremities(s.surface(), &d, count, found.data(), &count));
  std::vector<double> members;
  for (const hf_extremity& tip : found) {
    const Vec p = (1 / s.body.diagonal) * s.back({tip.position[0], tip.position[1], tip.position[2]});
    members.insert(members.end(), {p[0], p[1], p[2], s.back_size(tip.length) / s.body.diagonal});
  }
  Measured out;
  out.count("tips", count);
  out.add_set("tips", 4, members);
  return out;
}

}  // namespace

Measured measure_poisson_tips(const Setting& s) { return tips(s, HF_EXTREMITIES_POISSON); }
Measured measure_geodesic_tips(const Setting& s) { return tips(s, HF_EXTREMITIES_GEODESIC); }

// Lines through vertices: where they begin and end, and how long they are.
Measured measure_flow(const Setting& s) {
  const Scalars field(s, 0.5);
  Owned<hf_flow, hf_flow_destroy> flow;
  ok(hf_flow_create(s.surface(), flow.out()));
  std::vector<std::uint32_t> seeds;
  for (std::size_t i = 0; i < s.body.picks.size(); ++i) seeds.push_back(s.pick(i));
  hf_streamlines lines = HF_INIT(hf_streamlines);
  lines.seed_count = static_cast<std::uint32_t>(seeds.size());
  lines.seeds = seeds.data();
  ok(hf_flow_trace(flow, &field.desc, &lines));
  std::vector<double> positions(3 * std::size_t{lines.point_count});
  std::vector<std::uint32_t> starts(lines.line_count + 1), ends(2 * std::size_t{lines.line_count});
  lines.point_capacity = lines.point_count;
  lines.line_capacity = lines.line_count;
  lines.positions = positions.data();
  lines.line_starts = starts.data();
  lines.line_ends = ends.data();
  ok(hf_flow_trace(flow, &field.desc, &lines));
  Measured out;
  std::vector<double> lengths, places;
  for (std::uint32_t i = 0; i < lines.line_count; ++i) {
    lengths.push_back(polyline(s, positions, starts[i], starts[i + 1], false));
    for (int end = 0; end < 2; ++end) places.push_back(s.origin(ends[2 * i + end]));
  }
  out.add("ends", places);
  out.add("lengths", lengths);
  return out;
}

}  // namespace invariance
