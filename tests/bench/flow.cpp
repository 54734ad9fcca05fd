// A site is dragged and 64 streamlines follow: move, field, trace, beside the same with a fresh factorisation of the
// field (engine refactor: its ordering and analysis are kept) and beside a solver made anew. The trace is the same in
// all three, on one prepared surface.
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

// Streamlines into arrays that are kept.
class Tracer {
 public:
  explicit Tracer(const Solver& solver) { check(hf_flow_create(solver.surface(), &flow_)); }
  ~Tracer() { hf_flow_destroy(flow_); }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;
  uint32_t trace(const std::vector<double>& values) {
    const hf_array field = HF_ARRAY(values.data(), values.size());
    hf_streamlines lines = HF_INIT(hf_streamlines);
    lines.wanted_count = 64;
    for (;;) {
      lines.point_capacity = static_cast<uint32_t>(positions_.size() / 3);
      lines.line_capacity = static_cast<uint32_t>(ends_.size() / 2);
      lines.positions = positions_.data();
      lines.line_starts = starts_.data();
      lines.line_ends = ends_.data();
      const hf_result result = hf_flow_trace(flow_, &field, &lines);
      if (result == HF_OK) return lines.line_count;
      if (result != HF_ERROR_TOO_SMALL) check(result);
      positions_.resize(size_t{lines.point_count} * 6);
      starts_.resize(lines.line_count + 1u);
      ends_.resize(size_t{lines.line_count} * 2);
    }
  }

 private:
  hf_flow flow_ = nullptr;
  std::vector<double> positions_ = std::vector<double>(60000);
  std::vector<uint32_t> starts_ = std::vector<uint32_t>(129), ends_ = std::vector<uint32_t>(256);
};

}  // namespace

Rows run_flow(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    for (const uint32_t n : {12000u, 50000u}) {
      if (run.small && n > 12000) continue;
      const auto mesh = make_mesh(family, run.small ? 4000 : n);
      if (!run.wants(mesh->name)) continue;
      const std::vector<uint32_t> places = scattered_vertices(mesh->vertex_count(), 60, 5);
      const std::vector<uint32_t> sites(places.begin(), places.begin() + 8);
      SolverOptions fresh = own_defaults(run.threads);
      fresh.engine = ENGINE_REFACTOR;
      const Solver solver(*mesh, own_defaults(run.threads)), again(*mesh, fresh);
      Sites live(solver), slow(again);
      live.edit(sites, {});
      slow.edit(sites, {});
      Tracer tracer(solver);
      std::vector<double> field(mesh->vertex_count());
      uint32_t at = sites[0], at_slow = sites[0], lines = 0;
      size_t turn = 8, slow_turn = 8;
      const auto following = [&](size_t& k) { return places[k = k + 1 < places.size() ? k + 1 : 8]; };
      auto times = take_turns({{"live",
                                [&] {
                                  const uint32_t to = following(turn);
                                  return time_ms([&] {
                                    live.move(at, to);
                                    solver.solve(field);
                                    lines = tracer.trace(field);
                                    at = to;
                                  });
                                }},
                               {"trace", [&] { return time_ms([&] { lines = tracer.trace(field); }); }},
                               {"fresh",
                                [&] {
                                  const uint32_t to = following(slow_turn);
                                  return time_ms([&] {
                                    slow.move(at_slow, to);
                                    again.solve(field);
                                    lines = tracer.trace(field);
                                    at_slow = to;
                                  });
                                }},
                               {"create",
                                [&] {
                                  return time_ms([&] {
                                    const Solver made(*mesh, own_defaults(run.threads));
                                    Sites(made).edit(sites, {});
                                    made.solve(field);
                                    lines = tracer.trace(field);
                                  });
                                }}},
                              run.repetitions);
      const double ratio = times["fresh"] / times["live"];
      std::printf(
          "%-14s site moved, %u lines re-traced %7.2f ms (the trace alone %6.2f)   on a fresh factorisation %7.1f ms = "
          "%4.1f x   on a new solver %7.1f ms = %4.1f x\n",
          mesh->name.c_str(), lines, times["live"], times["trace"], times["fresh"], ratio, times["create"],
          times["create"] / times["live"]);
      std::fflush(stdout);
      if (n == 50000) report.measure("flow_live", mesh->name, run.threads, ratio);
      rows.push_back({{"name", mesh->name},
                      {"n", mesh->vertex_count()},
                      {"live_ms", times["live"]},
                      {"trace_ms", times["trace"]},
                      {"fresh_ms", times["fresh"]},
                      {"create_ms", times["create"]}});
    }
  }
  return rows;
}

void plot_flow(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"A site moved, 64 streamlines re-traced", "tori and creatures, medians", "vertices", "milliseconds"};
  for (const nlohmann::json& run : runs) {
    Curve live{"live, " + threads_text(run.at("threads")), {}}, fresh{"fresh, " + threads_text(run.at("threads")), {}};
    for (const nlohmann::json& row : run.at("rows")) {
      live.points.emplace_back(number_of(row, "/n"), number_of(row, "/live_ms"));
      fresh.points.emplace_back(number_of(row, "/n"), number_of(row, "/fresh_ms"));
    }
    plot.curves.push_back(live);
    plot.curves.push_back(fresh);
  }
  write_svg(file, plot);
}

}  // namespace bench
