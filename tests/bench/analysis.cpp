// Extremities beside the sweeps they are made of: from a Poisson field, and from the mean geodesic distance to 40
// sources. A sweep is one field of a solver, hf_solver_solve: one backward pass through the factor, scattered.
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"
#include "support/arrays.h"

namespace bench {

Rows run_analysis(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    for (const uint32_t n : {12000u, 50000u, 304000u}) {
      if (run.small && n > 12000) continue;
      const auto mesh = make_mesh(family, run.small ? 4000 : n);
      if (!run.wants(mesh->name)) continue;
      const Solver solver(*mesh, own_defaults(run.threads));
      Sites(solver).edit({0}, {});
      hf_geodesics geodesics = nullptr;
      hf_geodesics_desc heat = HF_INIT(hf_geodesics_desc);
      heat.method = HF_GEODESICS_HEAT;
      const double factor = median_ms(run.repetitions, [&] {
        hf_geodesics_destroy(geodesics);
        check(hf_geodesics_create(solver.surface(), &heat, &geodesics));
      });
      hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
      desc.kind = HF_EXTREMITIES_GEODESIC;
      desc.geodesics = geodesics;
      std::vector<double> field(mesh->vertex_count());
      const uint32_t vertex = 0;
      uint32_t tips = 0, far_tips = 0;
      auto times = take_turns(
          {{"sweep", [&] { return time_ms([&] { solver.solve(field); }); }},
           {"poisson",
            [&] {
              return time_ms([&] { check(hf_surface_find_extremities(solver.surface(), nullptr, 0, nullptr, &tips)); });
            }},
           {"distance",
            [&] { return time_ms([&] { check(hf_geodesics_solve(geodesics, 1, &vertex, OUT(field.data()))); }); }},
           {"average",
            [&] {
              return time_ms(
                  [&] { check(hf_surface_find_extremities(solver.surface(), &desc, 0, nullptr, &far_tips)); });
            }}},
          run.repetitions);
      hf_geodesics_destroy(geodesics);
      const double poisson = times["poisson"] / times["sweep"], average = times["average"] / times["sweep"];
      std::printf(
          "%-14s sweep %7.2f ms   Poisson extremities %7.2f ms = %4.1f sweeps (%u tips)   heat factor %7.1f ms   "
          "one distance %7.2f ms   mean of 40 %8.1f ms = %5.1f sweeps (%u tips)\n",
          mesh->name.c_str(), times["sweep"], times["poisson"], poisson, tips, factor, times["distance"],
          times["average"], average, far_tips);
      std::fflush(stdout);
      if (n == 50000) {
        report.measure("extremities_poisson", mesh->name, run.threads, poisson);
        report.measure("extremities_geodesic", mesh->name, run.threads, average);
      }
      rows.push_back({{"name", mesh->name},
                      {"n", mesh->vertex_count()},
                      {"sweep_ms", times["sweep"]},
                      {"poisson_ms", times["poisson"]},
                      {"heat_factor_ms", factor},
                      {"distance_ms", times["distance"]},
                      {"average_ms", times["average"]}});
    }
  }
  return rows;
}

void plot_analysis(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"Extremities in sweeps of one field", "tori and creatures, medians", "vertices", "sweeps"};
  for (const nlohmann::json& run : runs) {
    Curve poisson{"Poisson, " + threads_text(run.at("threads")), {}},
        average{"mean distance, " + threads_text(run.at("threads")), {}};
    for (const nlohmann::json& row : run.at("rows")) {
      const double sweep = number_of(row, "/sweep_ms");
      poisson.points.emplace_back(number_of(row, "/n"), number_of(row, "/poisson_ms") / sweep);
      average.points.emplace_back(number_of(row, "/n"), number_of(row, "/average_ms") / sweep);
    }
    plot.curves.push_back(poisson);
    plot.curves.push_back(average);
  }
  write_svg(file, plot);
}

}  // namespace bench
