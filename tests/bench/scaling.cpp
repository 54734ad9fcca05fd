// How time and memory grow from 10,000 to a million vertices, against theory. Nested dissection of a surface mesh
// (George 1973; Lipton, Rose and Tarjan 1979): ordering, factor entries, sweep and memory O(n log n), numeric
// factorisation O(n^1.5); the elimination path of one site is O(n) at worst, so an edit is too. Constants are printed
// per unit of theory: equal down a column means it grows as predicted.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

struct Quantity {
  const char* name;
  const char* theory;
  const char* unit;
  double scale;  // from the row's unit over theory to the printed unit
};
constexpr Quantity quantities[] = {
    {"ordering_ms", "n log n", "ns", 1e6},   {"numeric_ms", "n^1.5", "ns", 1e6},
    {"field_ms", "n log n", "ns", 1e6},      {"edit_ms", "n", "ns", 1e6},
    {"create_ms", "n log n", "ns", 1e6},     {"factor_entries", "n log n", "entries", 1},
    {"factor_bytes", "n log n", "bytes", 1}, {"peak_bytes", "n log n", "bytes", 1},
};

double theory(const std::string& name, double n) {
  if (name == "n^1.5") return std::pow(n, 1.5);
  return name == "n" ? n : n * std::log2(n);
}

nlohmann::json scale_mesh(const Mesh& mesh, const Run& run) {
  std::vector<double> create, ordering, symbolic, numeric;
  const uint32_t n = mesh.vertex_count();
  std::unique_ptr<Solver> solver;
  for (uint32_t r = 0; r < std::min(run.repetitions, n > 500000 ? 3u : 5u); ++r) {
    solver.reset();
    solver = std::make_unique<Solver>(mesh, SolverOptions{ENGINE_GREEN, run.threads});
    const hf_surface_statistics s = solver->surface_statistics();
    create.push_back(solver->create_ms());
    ordering.push_back(s.ordering_ms);
    symbolic.push_back(s.symbolic_ms);
    numeric.push_back(s.numeric_ms);
  }
  Sites sites(*solver);
  std::vector<uint32_t> order = scattered_vertices(n, 151, 9);
  const std::vector<uint32_t> base(order.begin(), order.begin() + 100);
  sites.edit(base, {});
  std::vector<float> field;
  solver->solve(field);
  std::vector<double> edit, solve;
  for (uint32_t r = 0; r < 51; ++r) {
    edit.push_back(sites.edit({order[100 + r]}, {order[r]}));
    solve.push_back(time_ms([&] { solver->solve(field); }));
  }
  const hf_surface_statistics s = solver->surface_statistics();
  nlohmann::json row = {{"name", mesh.name},
                        {"n", n},
                        {"create_ms", median(create)},
                        {"ordering_ms", median(ordering)},
                        {"symbolic_ms", median(symbolic)},
                        {"numeric_ms", median(numeric)},
                        {"field_ms", median(solve)},
                        {"edit_ms", median(edit)},
                        {"factor_entries", s.factor_entries},
                        {"factor_bytes", s.factor_bytes},
                        {"peak_bytes", s.peak_memory_bytes}};
  for (const Quantity& q : quantities)
    row["constants"][q.name] = q.scale * row[q.name].get<double>() / theory(q.theory, n);
  std::printf(
      "%-16s create %8.1f  ordering %8.1f  symbolic %7.1f  numeric %8.1f  field %7.2f  +1/-1 edit %6.3f ms; "
      "factor %.1f MB, peak %.1f MB\n",
      mesh.name.c_str(), median(create), median(ordering), median(symbolic), median(numeric), median(solve),
      median(edit), 1e-6 * s.factor_bytes, 1e-6 * s.peak_memory_bytes);
  std::fflush(stdout);
  return row;
}

}  // namespace

Rows run_scaling(const Run& run, Report&) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    for (const uint32_t n : {10000u, 30000u, 100000u, 304000u, 1000000u}) {
      if (run.small && n > 10000) continue;
      const auto mesh = run.small     ? make_mesh(family, Size::k42, true)
                        : n == 304000 ? make_mesh(family, Size::k304, false)
                                      : make_mesh(family, n);
      if (run.wants(mesh->name)) rows.push_back(scale_mesh(*mesh, run));
    }
  }
  std::printf("constants over theory:\n%-16s", "");
  for (const Quantity& q : quantities) std::printf(" %14s", q.name);
  std::printf("\n%-16s", "");
  for (const Quantity& q : quantities) std::printf(" %14s", (std::string(q.unit) + " / " + q.theory).c_str());
  std::printf("\n");
  for (const nlohmann::json& row : rows) {
    std::printf("%-16s", row.at("name").get<std::string>().c_str());
    for (const Quantity& q : quantities) std::printf(" %14.3f", row.at("constants").at(q.name).get<double>());
    std::printf("\n");
  }
  std::fflush(stdout);
  return rows;
}

void plot_scaling(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"Growth from 10,000 to a million vertices", "", "vertices", "ms"};
  const nlohmann::json& run = runs.back();
  plot.text.subtitle = "jittered tori, " + threads_text(run.at("threads")) + "; dashed: theory, from the smallest size";
  const std::pair<const char*, const char*> curves[] = {{"ordering", "/ordering_ms"},
                                                        {"numeric factorisation", "/numeric_ms"},
                                                        {"one field", "/field_ms"},
                                                        {"+1/-1 edit", "/edit_ms"}};
  const char* theories[] = {"n log n", "n^1.5", "n log n", ""};
  for (int i = 0; i < 4; ++i) {
    Curve curve{curves[i].first, {}, false, i}, guide{std::string(theories[i]), {}, true, i};
    for (const nlohmann::json& row : run.at("rows")) {
      if (row.at("name").get<std::string>().find("torus") == std::string::npos) continue;
      const double n = number_of(row, "/n");
      curve.points.emplace_back(n, number_of(row, curves[i].second));
      if (*theories[i])
        guide.points.emplace_back(
            n, curve.points[0].second * theory(theories[i], n) / theory(theories[i], curve.points[0].first));
    }
    plot.curves.push_back(curve);
    if (*theories[i]) plot.curves.push_back(guide);
  }
  write_svg(file, plot);
}

}  // namespace bench
