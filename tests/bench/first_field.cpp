// From a mesh in memory to its first field: hf_create, ten sites, hf_solve, beside METIS + CHOLMOD doing the same
// (cholmod_analyze, cholmod_factorize, cholmod_solve). The peer gets its matrix for nothing; we weld, check and build
// ours inside hf_create. Cold is the first time in this process, the figure is the median of warm repetitions in turns.
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/peer_cholmod.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

struct Ours {
  double total = 0;
  hf_surface_statistics statistics;
};

Ours our_first_field(const Mesh& mesh, const std::vector<uint32_t>& sites, SolverOptions options) {
  Ours ours;
  std::vector<float> field(mesh.vertex_count());
  const Clock clock;
  const Solver solver(mesh, options);
  Sites(solver).edit(sites, {});
  solver.solve(field);
  ours.total = clock.milliseconds();
  ours.statistics = solver.surface_statistics();
  return ours;
}

nlohmann::json run_mesh(const Mesh& mesh, int operator_kind, const Run& run, Report& report) {
  const std::vector<uint32_t> sites = scattered_vertices(mesh.vertex_count(), 10, 5);
  const std::unique_ptr<CholmodPeer> peer = CholmodPeer::make(cotangent_matrix(mesh), run.threads);
  if (peer) peer->set_sites(sites);
  std::vector<double> ours, analyse, factorise, solve, theirs;
  double cold_ours = 0, cold_theirs = 0;
  hf_surface_statistics phases{};
  SolverOptions options;
  options.threads = run.threads;
  options.operator_kind = operator_kind;
  for (uint32_t r = 0; r < run.repetitions + 1; ++r) {
    const Ours own = our_first_field(mesh, sites, options);
    phases = own.statistics;
    double total = 0;
    if (peer) {
      analyse.push_back(peer->analyse_ms());
      factorise.push_back(peer->factorise_ms());
      solve.push_back(peer->solve_ms());
      total = analyse.back() + factorise.back() + solve.back();
    }
    if (r == 0) {
      cold_ours = own.total;
      cold_theirs = total;
    } else {
      ours.push_back(own.total);
      theirs.push_back(total);
    }
  }
  nlohmann::json row = {{"name", mesh.name},
                        {"n", mesh.vertex_count()},
                        {"first_field_ms", median(ours)},
                        {"cold_ms", cold_ours},
                        {"weld_ms", phases.weld_ms},
                        {"operator_ms", phases.operator_ms},
                        {"ordering_ms", phases.ordering_ms},
                        {"symbolic_ms", phases.symbolic_ms},
                        {"numeric_ms", phases.numeric_ms}};
  std::printf("%-14s ours %7.1f (cold %7.1f; weld %.0f operator %.0f ordering %.0f symbolic %.0f numeric %.0f)",
              mesh.name.c_str(), median(ours), cold_ours, phases.weld_ms, phases.operator_ms, phases.ordering_ms,
              phases.symbolic_ms, phases.numeric_ms);
  if (peer) {
    const double ratio = median(theirs) / median(ours);
    row["peer_ms"] = median(theirs);
    row["peer_cold_ms"] = cold_theirs;
    row["peer_analyse_ms"] = median(analyse);
    row["peer_factorise_ms"] = median(factorise);
    row["peer_solve_ms"] = median(solve);
    row["ratio"] = ratio;
    std::printf("   METIS + CHOLMOD %7.1f (cold %7.1f; analyze %.0f factorize %.0f solve %.0f)  %.2fx, cold %.2fx",
                median(theirs), cold_theirs, median(analyse), median(factorise), median(solve), ratio,
                cold_theirs / cold_ours);
    report.measure("first_field", mesh.name, run.threads, ratio);
  }
  std::printf("\n");
  std::fflush(stdout);
  return row;
}

}  // namespace

Rows run_first_field(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    const auto mesh = make_mesh(family, Size::k304, run.small);
    if (run.wants(mesh->name)) rows.push_back(run_mesh(*mesh, HF_OPERATOR_COTANGENT, run, report));
  }
  // slivers, by the operator that hosts get unless they ask for another one
  const uint32_t sizes[] = {437000, 2000000};
  for (const uint32_t vertices : sizes) {
    const std::string name = std::to_string(vertices / 1000) + "K_scan";
    if (run.small || !run.wants(name)) continue;
    rows.push_back(run_mesh(*make_scan(vertices), HF_OPERATOR_INTRINSIC_DELAUNAY, run, report));
  }
  return rows;
}

void plot_first_field(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"From a mesh to its first field", "create + 10 sites + one field; medians, milliseconds", "", "ms"};
  plot.format = "%.0f";
  write_rows(plot,
             {{"this library, all", "/first_field_ms"},
              {"METIS + CHOLMOD, all", "/peer_ms"},
              {"our ordering", "/ordering_ms"},
              {"METIS and symbolic analysis", "/peer_analyse_ms"},
              {"our numeric factorisation", "/numeric_ms"},
              {"CHOLMOD numeric factorisation", "/peer_factorise_ms"}},
             runs, file);
}

}  // namespace bench
