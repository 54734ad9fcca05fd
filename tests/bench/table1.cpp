// Table 1 of the paper: sites inserted and removed on meshes of its sizes, then the whole field.
//
// Every row starts from base sites (the paper does not give their number), applies one batch through hf_edit_sites and
// solves; the batch is taken back untimed. Edit and solve are timed apart, medians over the repetitions. The exact
// answer is engine refactor's (sites eliminated).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <stdexcept>

#include "assets/shapes.h"
#include "bench/bench_support.h"
#include "bench/peer_cholmod.h"

namespace bench {
namespace {

struct Row {
  const char* name;
  uint32_t nu, nv;
  uint32_t base, insert, remove;
};
constexpr Row rows[] = {
    {"173K +40/-30", 416, 416, 100, 40, 30},    {"173K +200/-0", 416, 416, 100, 200, 0},
    {"173K +0/-300", 416, 416, 400, 0, 300},    {"42K +150/-160", 205, 206, 260, 150, 160},
    {"84K +150/-160", 290, 290, 260, 150, 160}, {"304K +60/-50", 551, 552, 150, 60, 50},
    {"304K +100/-80", 551, 552, 180, 100, 80},  {"304K +1/-1", 551, 552, 100, 1, 1},
};

struct Times {
  std::vector<double> edit, solve;
  nlohmann::json json() const { return {{"edit_ms", median(edit)}, {"solve_ms", median(solve)}}; }
  double total() const { return median(edit) + median(solve); }
};

// Sites of a solver by vertex, through the ABI.
class Sites {
 public:
  explicit Sites(hf_solver solver) : solver_(solver) {}
  void edit(const std::vector<uint32_t>& insert, const std::vector<uint32_t>& remove) {
    std::vector<uint32_t> leaving, numbers(insert.size());
    std::vector<double> values;
    for (const uint32_t v : remove) leaving.push_back(number_.at(v));
    for (const uint32_t v : insert) values.push_back(value_of(v));
    hf_sites_desc add;
    HF_INIT(add);
    add.site_count = static_cast<uint32_t>(insert.size()), add.vertices = insert.data(), add.values = values.data();
    hf_edit_desc edit;
    HF_INIT(edit);
    edit.remove_count = static_cast<uint32_t>(leaving.size()), edit.remove_sites = leaving.data();
    if (!insert.empty()) edit.add = &add;
    const Clock clock;
    check(hf_edit_sites(solver_, &edit, numbers.data()));
    last_ms = clock.milliseconds();
    for (const uint32_t v : remove) number_.erase(v);
    for (size_t i = 0; i < insert.size(); ++i) number_[insert[i]] = numbers[i];
  }
  double last_ms = 0;

 private:
  hf_solver solver_;
  std::map<uint32_t, uint32_t> number_;
};

// What a repetition inserts and removes; one site pair is not a sample, so +1/-1 takes other sites every time.
void choose(const Row& row, uint32_t n, const std::vector<uint32_t>& base, uint32_t repetition,
            std::vector<uint32_t>& insert, std::vector<uint32_t>& remove) {
  insert.clear(), remove.clear();
  const std::vector<uint32_t> all = scattered_vertices(n, row.base + row.insert + 4 * repetition, 1000 + repetition);
  for (const uint32_t v : all) {
    if (insert.size() < row.insert && std::find(base.begin(), base.end(), v) == base.end()) insert.push_back(v);
  }
  for (uint32_t i = 0; i < row.remove; ++i) remove.push_back(base[(i + 7 * repetition) % base.size()]);
}

Times run_engine(const Row& row, const Solver& solver, const std::vector<uint32_t>& base, uint32_t repetitions,
                 std::vector<double>& last_field) {
  Times times;
  Sites sites(solver.handle());
  sites.edit(base, {});
  const uint32_t n = solver.statistics().unknown_count;
  std::vector<float> field(n);
  check(hf_solve(solver.handle(), field.data(), 0, nullptr));  // warm
  std::vector<uint32_t> insert, remove;
  for (uint32_t r = 0; r < repetitions; ++r) {
    choose(row, n, base, r, insert, remove);
    sites.edit(insert, remove);
    times.edit.push_back(sites.last_ms);
    const Clock clock;
    check(hf_solve(solver.handle(), field.data(), 0, nullptr));
    times.solve.push_back(clock.milliseconds());
    if (r + 1 == repetitions) {
      last_field.resize(n);
      check(hf_solve_f64(solver.handle(), last_field.data(), 0, nullptr));
    }
    sites.edit(remove, insert);
  }
  return times;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

double first_field_ms(const Mesh& mesh, uint32_t threads) {
  const Clock clock;
  const Solver solver(mesh, HF_ENGINE_GREEN, threads);
  Sites sites(solver.handle());
  sites.edit(scattered_vertices(mesh.vertex_count(), 10, 5), {});
  std::vector<float> field(mesh.vertex_count());
  check(hf_solve(solver.handle(), field.data(), 0, nullptr));
  return clock.milliseconds();
}

// Solvers of one mesh, made once for all its rows.
struct Bed {
  Bed(Mesh given, uint32_t threads)
      : mesh(std::move(given)), green(mesh, HF_ENGINE_GREEN, threads), refactor(mesh, HF_ENGINE_REFACTOR, threads) {
    // the paper's engine on METIS, as its users have it; not in builds without the GPL part
    try {
      updown.emplace(mesh, HF_ENGINE_UPDOWN, threads, HF_ORDERING_METIS);
    } catch (const std::exception&) {
      updown.reset();
    }
    peer = CholmodPeer::make(mesh);
    first_field = first_field_ms(mesh, threads);
    stream = stream_ms(green.statistics().factor_bytes, threads);
  }
  Mesh mesh;
  Solver green, refactor;
  std::optional<Solver> updown;
  std::unique_ptr<CholmodPeer> peer;
  double first_field, stream;
};

nlohmann::json run_row(const Row& row, Bed& bed, uint32_t repetitions) {
  const uint32_t n = bed.mesh.vertex_count();
  const uint32_t count = row.insert == 1 ? std::max(repetitions, 51u) : repetitions;
  const std::vector<uint32_t> base = scattered_vertices(n, row.base, 3);
  const hf_statistics statistics = bed.green.statistics();
  std::vector<double> exact, green_field, updown_field;
  const auto clear = [&](const Solver& solver) {  // back to no sites
    hf_site_info info;
    HF_INIT(info);
    std::vector<uint32_t> numbers(hf_get_site_count(solver.handle()));
    info.capacity = static_cast<uint32_t>(numbers.size()), info.sites = numbers.data();
    check(hf_get_sites(solver.handle(), &info));
    check(hf_remove_sites(solver.handle(), static_cast<uint32_t>(numbers.size()), numbers.data()));
  };
  const Times green = run_engine(row, bed.green, base, count, green_field);
  clear(bed.green);
  // the baselines are slow: as many repetitions as make a median; the last batch must be the same for the comparison
  const Times refactor = run_engine(row, bed.refactor, base, repetitions, exact);
  clear(bed.refactor);
  if (count != repetitions) {
    Times again = run_engine(row, bed.green, base, repetitions, green_field);
    clear(bed.green);
  }
  nlohmann::json out = {{"name", std::string(row.name) + "_torus"},
                        {"n", n},
                        {"base", row.base},
                        {"insert", row.insert},
                        {"remove", row.remove}};
  out["green"] = green.json(), out["refactor"] = refactor.json();
  out["max_error_vs_exact"] = {{"green", largest_difference(exact, green_field)}};
  std::printf("%-16s green %7.2f + %6.2f", row.name, median(green.edit), median(green.solve));
  if (bed.updown) {
    const Times updown = run_engine(row, *bed.updown, base, repetitions, updown_field);
    clear(*bed.updown);
    out["updown"] = updown.json();
    out["max_error_vs_exact"]["updown"] = largest_difference(exact, updown_field);
    out["ratio_updown"] = updown.total() / green.total();
    std::printf("   updown %8.2f + %6.2f (%5.1fx)", median(updown.edit), median(updown.solve),
                updown.total() / green.total());
  }
  std::printf("   refactor %7.1f + %6.2f (%5.1fx)", median(refactor.edit), median(refactor.solve),
              refactor.total() / green.total());
  if (bed.peer) {
    Times peer;
    std::vector<uint32_t> insert, remove;
    for (uint32_t r = 0; r < std::min(repetitions, 5u); ++r) {
      choose(row, n, base, r, insert, remove);
      std::vector<uint32_t> sites = insert;
      for (const uint32_t v : base) {
        if (std::find(remove.begin(), remove.end(), v) == remove.end()) sites.push_back(v);
      }
      bed.peer->set_sites(sites);
      peer.edit.push_back(bed.peer->factorise_ms());
      peer.solve.push_back(bed.peer->solve_ms());
    }
    out["cholmod_refactor"] = peer.json();
    out["cholmod_analyse_ms"] = bed.peer->analyse_ms();
    out["ratio_cholmod_refactor"] = peer.total() / green.total();
    std::printf("   CHOLMOD %7.1f + %6.2f (%5.1fx)", median(peer.edit), median(peer.solve),
                peer.total() / green.total());
  }
  std::printf("\n");
  std::fflush(stdout);
  out["stream_ms"] = bed.stream, out["factor_bytes"] = statistics.factor_bytes, out["first_field_ms"] = bed.first_field;
  out["analysis_ms"] = statistics.ordering_ms + statistics.symbolic_ms, out["factorisation_ms"] = statistics.numeric_ms;
  return out;
}

}  // namespace

int table1(const Arguments& arguments) {
  const uint32_t threads = arguments.threads, repetitions = std::max(arguments.repetitions, 5u);
  const std::string& filter = arguments.rows;
  nlohmann::json out = {{"machine", machine_name()}, {"threads", threads}, {"rows", nlohmann::json::array()}};
  std::printf("%s, %u thread%s, medians of %u; milliseconds: edit + field (ratio to green)\n", machine_name().c_str(),
              threads, threads == 1 ? "" : "s", repetitions);
  std::unique_ptr<Bed> bed;
  std::pair<uint32_t, uint32_t> size{0, 0};
  for (const Row& row : rows) {
    if (!filter.empty() && std::string(row.name).find(filter) == std::string::npos) continue;
    if (size != std::make_pair(row.nu, row.nv)) {
      size = {row.nu, row.nv};
      bed.reset();
      samples::ShapeMesh torus = samples::jittered_torus(row.nu, row.nv);
      bed = std::make_unique<Bed>(Mesh{row.name, std::move(torus.positions), std::move(torus.triangles)}, threads);
      const hf_statistics s = bed->green.statistics();
      std::printf(
          "-- %u vertices: create %.0f ms (ordering %.0f, symbolic %.0f, numeric %.0f), first field %.0f ms, factor "
          "%.1f MB, read once %.2f ms\n",
          bed->mesh.vertex_count(), bed->green.create_ms(), s.ordering_ms, s.symbolic_ms, s.numeric_ms,
          bed->first_field, s.factor_bytes / 1e6, bed->stream);
    }
    out["rows"].push_back(run_row(row, *bed, repetitions));
  }
  write_json(arguments.json_file, out);
  return 0;
}

}  // namespace bench
