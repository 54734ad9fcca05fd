// Fields: harmonic, bi-harmonic, screened, previews, vectors and directions.
#include <cmath>

#include "setting.h"

namespace invariance {
namespace {

constexpr std::uint32_t site_count = 6;
const double site_values[site_count] = {0, 1, 0.3, 0.7, 0.5, 0.2};

std::vector<std::uint32_t> site_vertices(const Setting& s) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < site_count; ++i) out.push_back(s.pick(i));
  return out;
}

// A solver with hard sites at the first picks.
Solver solver_on(const Setting& s, hf_surface surface, std::int32_t field_kind) {
  hf_solver_desc d = HF_INIT(hf_solver_desc);
  d.field_kind = field_kind;
  Solver solver;
  ok(hf_create(surface, &d, solver.out()));
  const std::vector<std::uint32_t> vertices = site_vertices(s);
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = site_count;
  sites.vertices = vertices.data();
  sites.values = site_values;
  ok(hf_add_sites(solver, &sites, nullptr));
  return solver;
}

std::vector<double> field_of(const Setting& s, hf_solver solver) {
  std::vector<double> values(s.copy.points.size());
  ok(hf_solver_solve_f64(solver, values.data(), 0, nullptr));
  return s.gather(values);
}

// A vector along the box at a pick, for fields of vectors.
Vec stroke(const Setting& s, std::size_t i) {
  const Vec directions[] = {{1, 0.2, 0.1}, {0.1, 1, 0.3}, {0.2, -0.1, 1}};
  return s.turn(directions[i % 3]);
}

}  // namespace

Measured measure_harmonic(const Setting& s) {
  Measured out;
  const Solver solver = solver_on(s, s.surface(), HF_FIELD_HARMONIC);
  out.add("field", field_of(s, solver));
  std::vector<double> at(2);
  const std::uint32_t asked[] = {s.pick(7), s.pick(8)};
  ok(hf_solver_solve_at(solver, 2, asked, at.data()));
  out.add("at two vertices", at);
  return out;
}

// Sites in triangles, on discs, and soft ones.
Measured measure_places(const Setting& s) {
  Solver solver;
  ok(hf_create(s.surface(), nullptr, solver.out()));
  hf_place places[3] = {};
  const auto count = static_cast<std::uint32_t>(s.body.triangles.size());
  // the triangles lie apart by their numbers; only those of the largest piece count
  std::uint32_t found = 0;
  for (std::uint32_t t = count / 7; t < count && found < 3; t += count / 7) {
    if (s.body.piece[s.body.triangles[t][0]] != s.body.piece[s.body.picks[0]]) continue;
    s.point(t, {0.2, 0.3, 0.5}, places[found].corners, places[found].barycentrics);
    ++found;
  }
  const double values[] = {0.1, 0.9, 0.4}, stiffness[] = {0, 3, 0.5};
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  sites.site_count = found;
  sites.places = places;
  sites.values = values;
  sites.stiffness = stiffness;
  ok(hf_add_sites(solver, &sites, nullptr));
  const std::uint32_t discs[] = {s.pick(0), s.pick(1)};
  const double radii[] = {s.size(0.2 * s.body.spacing), s.size(0.3 * s.body.spacing)};
  sites = HF_INIT(hf_sites_desc);
  sites.site_count = 2;
  sites.vertices = discs;
  sites.values = values + 1;
  sites.radii = radii;
  ok(hf_add_sites(solver, &sites, nullptr));
  Measured out;
  out.add("field", field_of(s, solver));
  return out;
}

Measured measure_operators(const Setting& s) {
  Measured out;
  for (const std::int32_t kind : {HF_OPERATOR_CLAMPED, HF_OPERATOR_UNIFORM, HF_OPERATOR_COTANGENT}) {
    hf_surface_desc options = HF_INIT(hf_surface_desc);
    options.operator_kind = kind;
    const Surface surface = s.make(options);
    out.add("operator " + std::to_string(kind), field_of(s, solver_on(s, surface, HF_FIELD_HARMONIC)));
  }
  return out;
}

Measured measure_biharmonic(const Setting& s) {
  Measured out;
  out.add("field", field_of(s, solver_on(s, s.surface(), HF_FIELD_BIHARMONIC)));
  return out;
}

Measured measure_screened(const Setting& s) {
  const Solver solver = solver_on(s, s.surface(), HF_FIELD_HARMONIC);
  const double unit = s.size(s.body.diagonal);
  std::vector<double> targets(s.body.points.size());
  for (std::size_t v = 0; v < targets.size(); ++v) targets[v] = std::sin(5 * s.body.points[v][1] / s.body.diagonal);
  const std::vector<double> screening(s.copy.points.size(), 50 / (unit * unit));
  ok(hf_solver_set_screening(solver, screening.data(), s.spread(targets, 0).data()));
  Measured out;
  out.add("field", field_of(s, solver));
  return out;
}

Measured measure_preview(const Setting& s) {
  Measured out;
  const Solver solver = solver_on(s, s.surface(), HF_FIELD_HARMONIC);
  std::vector<double> values(s.copy.points.size());
  ok(hf_solver_solve_preview_f64(solver, values.data(), 0, 0, nullptr));
  out.add("preview", s.gather(values));
  return out;
}

Measured measure_vectors(const Setting& s) {
  hf_solver_desc d = HF_INIT(hf_solver_desc);
  d.channel_count = 3;
  Solver solver;
  ok(hf_create(s.surface(), &d, solver.out()));
  for (std::size_t i = 0; i < 4; ++i) ok(hf_solver_add_site(solver, s.pick(i), stroke(s, i).data(), nullptr));
  std::vector<double> vectors(3 * s.copy.points.size()), normals(vectors.size());
  ok(hf_solver_solve_vectors_f64(solver, vectors.data(), 0, normals.data(), nullptr));
  Measured out;
  out.add("vectors", s.gather_directions(vectors));
  out.add("normals", s.gather_directions(normals));
  return out;
}

namespace {

using Direction = Owned<hf_direction, hf_direction_destroy>;

Direction direction_of(const Setting& s, std::uint32_t degree) {
  hf_direction_desc d = HF_INIT(hf_direction_desc);
  d.degree = degree;
  Direction direction;
  ok(hf_direction_create(s.surface(), &d, direction.out()));
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t vertex = s.pick(i);
    const Vec vector = stroke(s, i);
    ok(hf_direction_add_sites(direction, 1, &vertex, vector.data(), nullptr));
  }
  return direction;
}

}  // namespace

Measured measure_direction(const Setting& s) {
  Measured out;
  for (const std::uint32_t degree : {1u, 2u}) {
    const Direction direction = direction_of(s, degree);
    std::vector<double> vectors(3 * s.copy.points.size());
    ok(hf_direction_solve_f64(direction, vectors.data(), 0, nullptr));
    std::vector<double> here = s.gather_directions(vectors);
    if (degree == 1) {
      out.add("vectors", here);
      continue;
    }
    // a line is v v' / |v|, which both of its directions give
    std::vector<double> lines;
    for (std::size_t i = 0; i < here.size(); i += 3) {
      const Vec v{here[i], here[i + 1], here[i + 2]};
      const double size = length(v);
      for (int a = 0; a < 3; ++a) {
        for (int b = a; b < 3; ++b) lines.push_back(size > 0 ? v[a] * v[b] / size : 0);
      }
    }
    out.add("lines", lines);
  }
  return out;
}

// Vectors, since those of crosses of equal energy turn on the last digits.
Measured measure_singularities(const Setting& s) {
  const Direction direction = direction_of(s, 1);
  std::uint32_t count = 0;
  ok(hf_direction_get_singularities(direction, 0, nullptr, &count));
  std::vector<hf_singularity> found(count);
  ok(hf_direction_get_singularities(direction, count, found.data(), &count));
  std::vector<double> places;
  for (const hf_singularity& f : found) {
    const std::uint32_t face = s.copy.origin_face[f.triangle];
    if (face == none) continue;
    places.push_back(face);
    places.push_back(f.index);
  }
  Measured out;
  out.add_set("triangles", 2, places);
  return out;
}

}  // namespace invariance
