// Table 1 of the paper: sites inserted and removed on meshes of its sizes, then the whole field, on both mesh families.
//
// Every row starts from base sites (the paper does not give their number), applies one batch and solves; the batch is
// taken back untimed. Edit and solve are timed apart; figures are medians of their sums over the repetitions, and over
// 51 different pairs of sites in the row +1/-1 (9 for CHOLMOD's refactorisation). Beside our engines stand CHOLMOD
// itself, used the paper's way (cholmod_updown and cholmod_solve2, METIS) and factorising again. The exact answer is
// engine refactor's (sites eliminated).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/peer_cholmod.h"
#include "bench/read_once.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

using json = nlohmann::json;

struct Row {
  const char* name;
  Size size;
  uint32_t base, insert, remove;
  uint32_t edits() const { return insert + remove; }
  bool clears() const { return insert == 0; }
};
constexpr Row rows_of_table[] = {
    {"42K +150/-160", Size::k42, 260, 150, 160}, {"84K +150/-160", Size::k84, 260, 150, 160},
    {"173K +40/-30", Size::k173, 100, 40, 30},   {"173K +200/-0", Size::k173, 100, 200, 0},
    {"173K +0/-300", Size::k173, 400, 0, 300},   {"304K +60/-50", Size::k304, 150, 60, 50},
    {"304K +100/-80", Size::k304, 180, 100, 80}, {"304K +1/-1", Size::k304, 100, 1, 1},
};
constexpr uint32_t site_pairs = 51, peer_site_pairs = 9;

struct Times {
  std::vector<double> edit, solve;
  void add(double edit_ms, double solve_ms) {
    edit.push_back(edit_ms);
    solve.push_back(solve_ms);
  }
  double total() const {
    std::vector<double> sums;
    for (size_t i = 0; i < edit.size(); ++i) sums.push_back(edit[i] + solve[i]);
    return median(sums);
  }
  json to_json() const {
    return {{"edit_ms", median(edit)}, {"solve_ms", median(solve)}, {"total_ms", total()}, {"count", edit.size()}};
  }
};

// What a repetition inserts and removes: other sites every time.
struct Batch {
  Batch(const Row& row, uint32_t n, const std::vector<uint32_t>& base, uint32_t repetition) {
    for (const uint32_t v : scattered_vertices(n, row.base + row.insert, 1000 + repetition)) {
      if (insert.size() < row.insert && std::find(base.begin(), base.end(), v) == base.end()) insert.push_back(v);
    }
    for (uint32_t i = 0; i < row.remove; ++i) remove.push_back(base[(i + 7 * repetition) % base.size()]);
  }
  std::vector<uint32_t> insert, remove;
};

// Solvers of one mesh, made once for all its rows.
struct Bed {
  Bed(const Mesh& given, uint32_t threads)
      : mesh(given), green(mesh, {ENGINE_GREEN, threads}), refactor(mesh, {ENGINE_REFACTOR, threads}) {
    // the paper's engine on METIS, as its users have it; not in builds without the GPL part
    try {
      updown.emplace(mesh, SolverOptions{ENGINE_UPDOWN, threads, HF_ORDERING_METIS});
    } catch (const std::runtime_error&) {
      updown.reset();
    }
    peer = CholmodPeer::make(cotangent_matrix(mesh), threads);
    if (peer) peer->analyse_ms();
    read_ms = read_once_ms(green.surface_statistics().factor_bytes, threads);
  }
  const Mesh& mesh;
  Solver green, refactor;
  std::optional<Solver> updown;
  std::unique_ptr<CholmodPeer> peer;
  double read_ms = 0;
};

struct Engine {
  const Row& row;
  const std::vector<uint32_t>& base;
  uint32_t repetitions;

  // field: what the last repetition gave.
  Times run(const Solver& solver, std::vector<double>& field) const {
    Times times;
    Sites sites(solver);
    sites.edit(base, {});
    std::vector<float> drawn;
    solver.solve(drawn);  // warm
    for (uint32_t r = 0; r < repetitions; ++r) {
      const Batch batch(row, solver.vertex_count(), base, r);
      const double edit = sites.edit(batch.insert, batch.remove);
      times.add(edit, time_ms([&] { solver.solve(drawn); }));
      if (r + 1 == repetitions) solver.solve(field);
      sites.edit(batch.remove, batch.insert);
    }
    sites.clear();
    return times;
  }
  Times run_updown(CholmodPeer& peer, uint32_t n, std::vector<double>& field) const {
    Times times;
    peer.begin_updown(base);
    peer.updown_solve_ms();  // warm
    for (uint32_t r = 0; r < repetitions; ++r) {
      const Batch batch(row, n, base, r);
      const double edit = peer.updown_ms(batch.insert, batch.remove);
      times.add(edit, peer.updown_solve_ms());
      if (r + 1 == repetitions) field.assign(peer.solution(), peer.solution() + n);
      peer.updown_ms(batch.remove, batch.insert);
    }
    return times;
  }
  Times run_refactor(CholmodPeer& peer, uint32_t n) const {
    Times times;
    for (uint32_t r = 0; r < std::min(repetitions, peer_site_pairs); ++r) {
      const Batch batch(row, n, base, r);
      std::vector<uint32_t> sites = batch.insert;
      for (const uint32_t v : base) {
        if (std::find(batch.remove.begin(), batch.remove.end(), v) == batch.remove.end()) sites.push_back(v);
      }
      peer.set_sites(sites);
      const double edit = peer.factorise_ms();
      times.add(edit, peer.solve_ms());
    }
    return times;
  }
};

void print(const char* what, const Times& times, const Times& green) {
  std::printf("   %s %7.2f + %6.2f (%5.1fx)", what, median(times.edit), median(times.solve),
              times.total() / green.total());
}

json run_row(const Row& row, const std::string& name, Bed& bed, const Run& run) {
  const uint32_t n = bed.mesh.vertex_count();
  const std::vector<uint32_t> base = scattered_vertices(n, row.base, 3);
  const Engine engine{row, base, row.edits() == 2 ? (run.small ? 3 : site_pairs) : run.repetitions};
  std::vector<double> exact, field;
  const Times green = engine.run(bed.green, field), refactor = engine.run(bed.refactor, exact);
  json out = {{"name", name}, {"n", n}, {"base", row.base}, {"insert", row.insert}, {"remove", row.remove}};
  out["green"] = green.to_json();
  out["refactor"] = refactor.to_json();
  out["ratio_refactor"] = refactor.total() / green.total();
  out["max_error_vs_exact"]["green"] = largest_difference(exact, field);
  std::printf("%-24s green %6.2f + %5.2f", name.c_str(), median(green.edit), median(green.solve));
  print("refactor", refactor, green);
  if (bed.updown) {
    const Times updown = engine.run(*bed.updown, field);
    out["updown"] = updown.to_json();
    out["ratio_updown_engine"] = updown.total() / green.total();
    out["max_error_vs_exact"]["updown"] = largest_difference(exact, field);
    print("updown", updown, green);
  }
  if (bed.peer) {
    const Times updown = engine.run_updown(*bed.peer, n, field), recompute = engine.run_refactor(*bed.peer, n);
    out["cholmod_updown"] = updown.to_json();
    out["cholmod_refactor"] = recompute.to_json();
    out["ratio_updown"] = updown.total() / green.total();
    out["ratio_cholmod_refactor"] = recompute.total() / green.total();
    out["max_error_vs_exact"]["cholmod_updown"] = largest_difference(exact, field);
    print("cholmod_updown", updown, green);
    print("CHOLMOD again", recompute, green);
  }
  std::printf("\n");
  std::fflush(stdout);
  const hf_surface_statistics statistics = bed.green.surface_statistics();
  // no engine that reads the stored factor once can be farther ahead, were its edits for nothing
  if (out.contains("cholmod_updown"))
    out["ratio_bound"] = out["cholmod_updown"]["total_ms"].get<double>() / bed.read_ms;
  out["read_once_ms"] = bed.read_ms;
  out["factor_bytes"] = statistics.factor_bytes;
  out["analysis_ms"] = statistics.ordering_ms + statistics.symbolic_ms;
  out["factorisation_ms"] = statistics.numeric_ms;
  return out;
}

// The worst of a ratio over the rows of a family that `counts`.
void judge_worst(const char* figure, const char* key, Family family, const Rows& rows, const Run& run, Report& report,
                 bool (*counts)(uint32_t edits, uint32_t insert)) {
  const json* worst = nullptr;
  for (const json& row : rows) {
    const uint32_t insert = row.at("insert"), remove = row.at("remove");
    const std::string name = row.at("name");
    if (name.find(family_name(family)) == std::string::npos || !row.contains(key) || !counts(insert + remove, insert))
      continue;
    if (!worst || row.at(key) < worst->at(key)) worst = &row;
  }
  if (worst) report.measure(figure, family_name(family), run.threads, worst->at(key), worst->at("name"));
}

void judge(const Rows& rows, const Run& run, Report& report) {
  for (const Family family : families) {
    const bool torus = family == Family::torus;
    judge_worst(torus ? "table1_torus" : "table1_creature", "ratio_updown", family, rows, run, report,
                [](uint32_t edits, uint32_t) { return edits >= 40; });
    judge_worst("table1_single", "ratio_updown", family, rows, run, report,
                [](uint32_t edits, uint32_t) { return edits == 2; });
    judge_worst(torus ? "table1_clear_torus" : "table1_clear_creature", "ratio_updown", family, rows, run, report,
                [](uint32_t, uint32_t insert) { return insert == 0; });
    judge_worst("table1_recompute", "ratio_cholmod_refactor", family, rows, run, report,
                [](uint32_t, uint32_t) { return true; });
  }
}

}  // namespace

Rows run_table1(const Run& run, Report& report) {
  Rows rows = Rows::array();
  std::printf("milliseconds, edit + field (ratio to green)\n");
  for (const Family family : families) {
    std::unique_ptr<Bed> bed;
    std::shared_ptr<const Mesh> mesh;
    for (const Row& row : rows_of_table) {
      const std::string name = std::string(row.name) + "_" + family_name(family);
      if (!run.wants(name)) continue;
      const auto wanted = make_mesh(family, row.size, run.small);
      if (wanted != mesh) {
        bed.reset();
        mesh = wanted;
        bed = std::make_unique<Bed>(*mesh, run.threads);
        std::printf("-- %s: %u vertices, factor %.1f MB, read once %.2f ms\n", mesh->name.c_str(), mesh->vertex_count(),
                    1e-6 * bed->green.surface_statistics().factor_bytes, bed->read_ms);
      }
      rows.push_back(run_row(row, name, *bed, run));
    }
  }
  judge(rows, run, report);
  return rows;
}

void plot_table1(const Runs& runs, const std::string& file) {
  const json& run = runs.back();
  BarPlot plot;
  plot.text = {"Table 1 of the paper: edit + full field", "median milliseconds, " + threads_text(run.at("threads")), "",
               "ms (logarithmic)"};
  plot.log_y = true;
  const std::pair<const char*, const char*> series[] = {{"green", "/green/total_ms"},
                                                        {"cholmod_updown + solve", "/cholmod_updown/total_ms"},
                                                        {"our refactorisation", "/refactor/total_ms"},
                                                        {"CHOLMOD refactorisation", "/cholmod_refactor/total_ms"}};
  for (const auto& [name, key] : series) plot.bars.push_back({name, {}});
  for (const json& row : run.at("rows")) {
    plot.groups.push_back(row.at("name"));
    for (size_t i = 0; i < plot.bars.size(); ++i) plot.bars[i].values.push_back(number_of(row, series[i].second));
  }
  write_svg(file, plot);
}

}  // namespace bench
