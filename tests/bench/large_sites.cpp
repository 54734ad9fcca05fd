// Hundreds to thousands of sites at once and the whole field: our own route against our own refactorisation with the
// sites eliminated and its two sweeps (engine refactor), in turns.
#include <algorithm>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

double insert_and_solve(const Solver& solver, const std::vector<uint32_t>& vertices, std::vector<float>& field) {
  Sites sites(solver);
  double ms = sites.edit(vertices, {});
  ms += time_ms([&] { solver.solve(field); });
  sites.clear();
  return ms;
}

Rows run_mesh(const Mesh& mesh, const Run& run, Report& report) {
  Rows rows = Rows::array();
  const Solver green(mesh, {ENGINE_GREEN, run.threads}), refactor(mesh, {ENGINE_REFACTOR, run.threads});
  std::vector<float> field;
  const uint32_t scale = run.small ? 10 : 1;
  for (const uint32_t count : {100u, 300u, 1000u, 2000u, 5000u, 10000u}) {
    const std::string name = std::to_string(count / scale) + "_sites_" + mesh.name;
    if (!run.wants(name)) continue;
    const std::vector<uint32_t> vertices = scattered_vertices(mesh.vertex_count(), count / scale, 11);
    const uint32_t before = green.statistics().factorisation_count;
    std::vector<double> ours, theirs;
    for (uint32_t r = 0; r < run.repetitions; ++r) {
      ours.push_back(insert_and_solve(green, vertices, field));
      theirs.push_back(insert_and_solve(refactor, vertices, field));
    }
    const bool rebased = green.statistics().factorisation_count > before;
    const double ratio = median(ours) / median(theirs);
    std::printf("%-26s green %8.1f ms (%s)   refactor %8.1f ms   ratio %.2f\n", name.c_str(), median(ours),
                rebased ? "rebased" : "dense", median(theirs), ratio);
    std::fflush(stdout);
    rows.push_back({{"name", name},
                    {"n", mesh.vertex_count()},
                    {"mesh", mesh.name},
                    {"sites", count / scale},
                    {"green_ms", median(ours)},
                    {"rebased", rebased},
                    {"refactor_ms", median(theirs)},
                    {"ratio", ratio}});
    if (count == 1000) report.measure("sites_1000", mesh.name, run.threads, ratio);
    if (count == 10000) report.measure("sites_10000", mesh.name, run.threads, ratio);
  }
  return rows;
}

}  // namespace

Rows run_large_sites(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    const auto mesh = make_mesh(family, Size::k304, run.small);
    for (auto& row : run_mesh(*mesh, run, report)) rows.push_back(std::move(row));
  }
  return rows;
}

void plot_large_sites(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"Many sites at once", "insert all and solve for the whole field, medians", "sites", "ms"};
  for (const nlohmann::json& run : runs) {
    for (const char* mesh : {"torus", "creature"}) {
      Curve green{std::string("green, ") + mesh + ", " + threads_text(run.at("threads")),
                  {},
                  false,
                  static_cast<int>(plot.curves.size() / 2)};
      Curve refactor{std::string("refactor, ") + mesh + ", " + threads_text(run.at("threads")),
                     {},
                     true,
                     static_cast<int>(plot.curves.size() / 2)};
      for (const nlohmann::json& row : run.at("rows")) {
        if (row.at("mesh").get<std::string>().find(mesh) == std::string::npos) continue;
        green.points.emplace_back(number_of(row, "/sites"), number_of(row, "/green_ms"));
        refactor.points.emplace_back(number_of(row, "/sites"), number_of(row, "/refactor_ms"));
      }
      if (green.points.empty()) continue;
      plot.curves.push_back(green);
      plot.curves.push_back(refactor);
    }
  }
  write_svg(file, plot);
}

}  // namespace bench
