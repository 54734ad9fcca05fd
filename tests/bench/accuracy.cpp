// How exact a field is. With K the plain cotangent Laplacian made here from the mesh (not the library's own):
//   site error   largest |w_i' u - s_i| over hard sites at vertices and at points inside triangles
//   residual     largest |sum_j w_vj (u_j - u_v)| over the vertices that carry no site, over the mean diagonal
//   edits        after 10,000 random single edits (insert, remove, move, set a value; values offset by 1e4) the field
//                against that of a fresh solver that eliminates the same sites, over the range of the values; the
//                paper's engine beside ours on a smaller mesh
//   bi-harmonic  what a second refinement changes (biharmonic.h)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "assets/shapes.h"
#include "bench/bench_mesh.h"
#include "bench/biharmonic.h"
#include "bench/commands.h"
#include "bench/peer_cholmod.h"
#include "bench/svg_plot.h"
#include "support/place_in.h"

namespace bench {
namespace {

using json = nlohmann::json;

// Points inside triangles that share no corner with each other or with the vertices.
std::vector<uint32_t> scattered_triangles(const Mesh& mesh, uint32_t count, std::vector<uint8_t>& taken) {
  std::vector<uint32_t> triangles;
  for (const uint32_t t : scattered_vertices(mesh.vertex_count(), 4 * count, 17)) {
    const uint32_t* corner = mesh.triangles.data() + 3 * size_t{t};
    if (triangles.size() == count || taken[corner[0]] || taken[corner[1]] || taken[corner[2]]) continue;
    for (int k = 0; k < 3; ++k) taken[corner[k]] = 1;
    triangles.push_back(t);
  }
  return triangles;
}

// Largest |(K u)_v| over the vertices not taken, over the mean diagonal.
double interior_residual(const Mesh& mesh, const std::vector<double>& u, const std::vector<uint8_t>& taken) {
  const PeerMatrix k = cotangent_matrix(mesh);
  std::vector<double> flow(k.size(), 0.0);
  double diagonal = 0;
  for (size_t v = 0; v < k.size(); ++v) {
    diagonal += k.value[static_cast<size_t>(k.start[v])] / static_cast<double>(k.size());
    for (int i = k.start[v] + 1; i < k.start[v + 1]; ++i) {
      const size_t w = static_cast<size_t>(k.row[static_cast<size_t>(i)]);
      const double through = -k.value[static_cast<size_t>(i)] * (u[w] - u[v]);
      flow[v] += through;
      flow[w] -= through;
    }
  }
  double worst = 0;
  for (size_t v = 0; v < flow.size(); ++v) {
    if (!taken[v]) worst = std::max(worst, std::fabs(flow[v]));
  }
  return worst / diagonal;
}

json hard_sites(const Mesh& mesh, const Run& run, Report& report) {
  const Solver solver(mesh, {HF_ENGINE_GREEN, run.threads});
  const std::vector<uint32_t> vertices = scattered_vertices(mesh.vertex_count(), 100, 3);
  std::vector<uint8_t> taken(mesh.vertex_count(), 0);
  for (const uint32_t v : vertices) taken[v] = 1;
  Sites(solver).edit(vertices, {});
  const std::vector<uint32_t> triangles = scattered_triangles(mesh, 100, taken);
  const double weights[3] = {0.2, 0.3, 0.5};
  std::vector<hf_place> places;
  std::vector<double> values;
  for (const uint32_t t : triangles) {
    places.push_back(place_in(mesh.triangles.data(), static_cast<uint32_t>(mesh.triangles.size() / 3), t, weights));
    values.push_back(value_of(t));
  }
  hf_sites_desc points = HF_INIT(hf_sites_desc);
  points.site_count = static_cast<uint32_t>(triangles.size());
  points.places = places.data();
  points.values = values.data();
  check(hf_add_sites(solver.handle(), &points, nullptr));
  std::vector<double> u;
  solver.solve(u);
  double at_vertices = 0, at_points = 0;
  for (const uint32_t v : vertices) at_vertices = std::max(at_vertices, std::fabs(u[v] - value_of(v)));
  for (size_t i = 0; i < triangles.size(); ++i) {
    double value = 0;
    for (size_t k = 0; k < 3; ++k) value += weights[k] * u[mesh.triangles[3 * size_t{triangles[i]} + k]];
    at_points = std::max(at_points, std::fabs(value - values[i]));
  }
  const double residual = interior_residual(mesh, u, taken), worst = std::max(at_vertices, at_points);
  std::printf(
      "%-14s 100 vertex sites: error %.1e; 100 points in triangles: error %.1e; interior residual / mean "
      "diagonal %.1e\n",
      mesh.name.c_str(), at_vertices, at_points, residual);
  report.measure("site_error", mesh.name, run.threads, worst);
  report.measure("residual", mesh.name, run.threads, residual);
  return {{"vertex_site_error", at_vertices},
          {"point_site_error", at_points},
          {"site_error", worst},
          {"residual", residual}};
}

// One of the four single edits, by a counter.
void random_edit(Sites& sites, uint32_t n, uint64_t i) {
  const auto unit = [&](uint64_t stream) { return samples::hash_to_unit(1000 + stream, i); };
  const auto vertex = [&](uint64_t stream) {
    for (uint64_t again = 0;; ++again) {
      const uint32_t v = std::min(n - 1, static_cast<uint32_t>(samples::hash_to_unit(stream + again, i) * n));
      if (!sites.has(v)) return v;
    }
  };
  auto chosen = sites.numbers().begin();
  std::advance(chosen, static_cast<long>(unit(1) * static_cast<double>(sites.numbers().size())));
  const uint32_t site = chosen->first;
  const double kind = unit(2);
  const bool grow = sites.numbers().size() < 60 || (sites.numbers().size() < 140 && unit(3) < 0.5);
  if (kind < 0.6 && grow)
    sites.edit({vertex(2000)}, {});
  else if (kind < 0.6)
    sites.edit({}, {site});
  else if (kind < 0.8)
    sites.move(site, vertex(4000));
  else
    sites.set_value(site, unit(4));
}

// The field after `count` edits against exact elimination of the sites that are there then, over the values' range.
double error_after_edits(const Mesh& mesh, const SolverOptions& options, uint32_t count, double offset) {
  const Solver solver(mesh, options);
  Sites sites(solver, offset);
  sites.edit(scattered_vertices(mesh.vertex_count(), 100, 3), {});
  for (uint64_t i = 0; i < count; ++i) random_edit(sites, mesh.vertex_count(), i);
  hf_sites_info info = HF_INIT(hf_sites_info);
  std::vector<uint32_t> vertices(hf_solver_get_site_count(solver.handle()));
  std::vector<double> values(vertices.size());
  info.capacity = static_cast<uint32_t>(vertices.size());
  info.vertices = vertices.data();
  info.values = values.data();
  check(hf_solver_get_sites(solver.handle(), &info));
  const Solver exact(mesh, {HF_ENGINE_REFACTOR, options.threads});
  hf_sites_desc same = HF_INIT(hf_sites_desc);
  same.site_count = info.capacity;
  same.vertices = vertices.data();
  same.values = values.data();
  check(hf_add_sites(exact.handle(), &same, nullptr));
  std::vector<double> u, v;
  solver.solve(u);
  exact.solve(v);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return largest_difference(u, v) / (*high - *low);
}

json run_mesh(Family family, const Run& run, Report& report) {
  const auto mesh = make_mesh(family, Size::k304, run.small);
  if (!run.wants(mesh->name)) return nullptr;
  json row = hard_sites(*mesh, run, report);
  row["name"] = mesh->name;
  row["n"] = mesh->vertex_count();
  const uint32_t count = run.small ? 500 : 10000;
  const double green = error_after_edits(*mesh, {HF_ENGINE_GREEN, run.threads}, count, 1e4);
  row["edits"] = count;
  row["edits_error"] = green;
  std::printf("%-14s after %u random edits, values offset by 1e4: error / range %.1e\n", "", count, green);
  std::fflush(stdout);
  report.measure("edits_error", mesh->name, run.threads, green);
  const BiharmonicResult bent = biharmonic_refinement(*mesh, run.threads);
  row["biharmonic_change"] = bent.change;
  row["biharmonic_residual"] = bent.residual;
  row["biharmonic_create_ms"] = bent.create_ms;
  row["biharmonic_solve_ms"] = bent.solve_ms;
  std::printf(
      "%-14s bi-harmonic: a second refinement changes the field by %.1e of its range; residual / mean diagonal "
      "%.1e; create %.0f ms, field %.1f ms\n",
      "", bent.change, bent.residual, bent.create_ms, bent.solve_ms);
  std::fflush(stdout);
  report.measure("biharmonic_change", mesh->name, run.threads, bent.change);
  const auto smaller = make_mesh(family, Size::k42, run.small);
  const double same = error_after_edits(*smaller, {HF_ENGINE_GREEN, run.threads}, count, 1e4);
  row["edits_error_42K"] = same;
  std::printf("%-14s the same on %s: green %.1e", "", smaller->name.c_str(), same);
  try {
    const double updown = error_after_edits(*smaller, {HF_ENGINE_UPDOWN, run.threads, HF_ORDERING_METIS}, count, 1e4);
    row["edits_error_42K_updown"] = updown;
    std::printf(", updown (the paper's, refined) %.1e", updown);
  } catch (const std::runtime_error& error) {
    std::printf(", no updown: %s", error.what());
  }
  std::printf("\n");
  std::fflush(stdout);
  return row;
}

}  // namespace

Rows run_accuracy(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    json row = run_mesh(family, run, report);
    if (!row.is_null()) rows.push_back(std::move(row));
  }
  return rows;
}

void plot_accuracy(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"How exact", "largest errors; 10,000 random edits on values offset by 1e4", "", "error (logarithmic)"};
  plot.log_y = true;
  plot.format = "%.0e";
  write_rows(plot,
             {{"hard sites: error", "/site_error"},
              {"hard sites: residual / mean diagonal", "/residual"},
              {"bi-harmonic: second refinement", "/biharmonic_change"},
              {"10,000 edits: green", "/edits_error"},
              {"10,000 edits, 42K: green", "/edits_error_42K"},
              {"10,000 edits, 42K: updown", "/edits_error_42K_updown"}},
             runs, file);
}

}  // namespace bench
