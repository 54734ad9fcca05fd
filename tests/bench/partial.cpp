// Partial evaluation: the field at ten vertices under 100 sites, on meshes of growing size, beside the whole field. The
// first follows the length of an elimination path, the second the size of the factor.
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"

namespace bench {

Rows run_partial(const Run& run, Report&) {
  Rows rows = Rows::array();
  for (const uint32_t n : {4225u, 16900u, 67600u, 304000u}) {
    if (run.small && n > 5000) continue;
    const auto mesh = n == 304000 ? make_mesh(Family::torus, Size::k304, false) : make_mesh(Family::torus, n);
    if (!run.wants(mesh->name)) continue;
    const Solver solver(*mesh, {ENGINE_GREEN, run.threads});
    Sites(solver).edit(scattered_vertices(mesh->vertex_count(), 100, 21), {});
    std::vector<double> at(10), whole, at_times, whole_times;
    for (uint32_t r = 0; r < 5 * run.repetitions; ++r) {
      const std::vector<uint32_t> probes = scattered_vertices(mesh->vertex_count(), 10, 100 + r);
      at_times.push_back(time_ms([&] { check(hf_solver_solve_at(solver.handle(), 10, probes.data(), at.data())); }));
      whole_times.push_back(time_ms([&] { solver.solve(whole); }));
    }
    std::printf("%-14s at ten vertices %7.3f ms   everywhere %7.3f ms\n", mesh->name.c_str(), median(at_times),
                median(whole_times));
    std::fflush(stdout);
    rows.push_back({{"name", mesh->name},
                    {"n", mesh->vertex_count()},
                    {"solve_at_ms", median(at_times)},
                    {"solve_ms", median(whole_times)}});
  }
  return rows;
}

void plot_partial(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"The field at ten vertices against everywhere", "100 sites, jittered tori, medians", "vertices", "ms"};
  for (const nlohmann::json& run : runs) {
    Curve at{"at ten vertices, " + threads_text(run.at("threads")), {}},
        everywhere{"everywhere, " + threads_text(run.at("threads")), {}};
    for (const nlohmann::json& row : run.at("rows")) {
      at.points.emplace_back(number_of(row, "/n"), number_of(row, "/solve_at_ms"));
      everywhere.points.emplace_back(number_of(row, "/n"), number_of(row, "/solve_ms"));
    }
    plot.curves.push_back(at);
    plot.curves.push_back(everywhere);
  }
  write_svg(file, plot);
}

}  // namespace bench
