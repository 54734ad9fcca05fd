// The factor in its parts, on the matrix hf_create makes: ordering against METIS alone, symbolic analysis against
// cholmod_analyze_p, numeric factorisation against CHOLMOD's supernodal one with OpenBLAS under one and the same
// permutation (METIS's, and ours), storing and loading (C ABI) against making. Baseline and candidate take turns.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/inner_factor.h"
#include "bench/peer_cholmod.h"
#include "bench/svg_plot.h"
#include "factor/numeric.h"
#include "factor/ordering.h"
#include "factor/supernodal_factor.h"

namespace bench {
namespace {

using json = nlohmann::json;
using Order = hf_inner::Buffer<int32_t>;

struct OrderResult {
  double ms = 0;
  hf_inner::factor::FillEstimate fill;
  json to_json() const { return {{"ms", ms}, {"entries", fill.entries}, {"flops", fill.flops}}; }
};

double order_ms(const InnerSystem& system, hf_inner::factor::Ordering kind, Order& order) {
  return time_ms([&] {
    hf_inner::factor::make_order(system.matrix(), system.coordinates(), kind, system.memory(), system.jobs(), order);
  });
}

// Our two orderings, AMD and METIS alone (without CHOLMOD's symbolic analysis and without our wrapper), in turns.
struct Orderings {
  Orderings(const InnerSystem& system, CholmodPeer* peer, uint32_t repetitions) {
    std::vector<double> own_times, degree_times, amd_times, metis_times;
    Order degree_order;
    std::vector<int> amd_order, metis_order;
    for (uint32_t r = 0; r < repetitions; ++r) {
      own_times.push_back(order_ms(system, hf_inner::factor::Ordering::nested_dissection, own_order));
      degree_times.push_back(order_ms(system, hf_inner::factor::Ordering::minimum_degree, degree_order));
      if (!peer) continue;
      amd_times.push_back(peer->amd_ms(amd_order));
      metis_times.push_back(peer->metis_ms(metis_order));
    }
    const auto fill = [&](const int32_t* order) {
      return hf_inner::factor::estimate_fill(system.matrix(), {order, own_order.size()}, system.memory());
    };
    own = {median(own_times), fill(own_order.data())};
    degree = {median(degree_times), fill(degree_order.data())};
    if (!peer) return;
    amd = {median(amd_times), fill(amd_order.data())};
    metis = {median(metis_times), fill(metis_order.data())};
  }
  Order own_order;
  OrderResult own, degree, amd, metis;
};

double time_symbolic(const InnerSystem& system, hf_inner::Span<const int32_t> order, uint32_t repetitions) {
  return median_ms(repetitions, [&] {
    hf_inner::factor::Symbolic symbolic;
    hf_inner::factor::analyse(system.matrix(), order, system.memory(), symbolic);
  });
}

// Numeric factorisation into memory that is there already, ours and the peer's in turns, on the factor's permutation.
json compare_numeric(const InnerSystem& system, const hf_inner::factor::SupernodalFactor& factor, CholmodPeer* peer,
                     const Run& run) {
  hf_inner::Buffer<double> values(system.memory(), factor.values().size());
  std::memset(values.data(), 0, values.size() * sizeof(double));
  if (peer) peer->analyse_given_ms(std::vector<int>(factor.order().begin(), factor.order().end()));
  const auto ours_with = [&](const hf_inner::factor::Kernels& kernels) {
    return time_ms([&] {
      hf_inner::factor::factorise(factor.symbolic(), factor.plan(), kernels, system.matrix(), {},
                                  hf_inner::factor::default_lost_share, values.data(), system.memory(), system.jobs());
    });
  };
  std::vector<double> ours, narrow, theirs, theirs_serial;
  for (uint32_t r = 0; r < run.repetitions; ++r) {
    ours.push_back(ours_with(factor.kernels()));
    if (const hf_inner::factor::Kernels* kernels = hf_inner::factor::avx2_kernels())
      narrow.push_back(ours_with(*kernels));
    if (!peer) continue;
    theirs.push_back(peer->factorise_ms());
    // should more threads of BLAS not help the peer, it gets one
    if (run.threads > 1) theirs_serial.push_back(peer->factorise_ms(1));
  }
  const hf_inner::factor::FactorStatistics& statistics = factor.statistics();
  json out = {{"ms", median(ours)},
              {"gflops", 1e-6 * statistics.flops / median(ours)},
              {"entries", statistics.entries},
              {"stored_entries", statistics.stored_entries},
              {"flops", statistics.flops}};
  if (!narrow.empty()) out["avx2_ms"] = median(narrow);
  if (peer) {
    double best = median(theirs);
    if (!theirs_serial.empty()) {
      out["cholmod_serial_ms"] = median(theirs_serial);
      best = std::min(best, median(theirs_serial));
    }
    out["cholmod_ms"] = best;
    out["ratio"] = best / median(ours);
  }
  return out;
}

void print_numeric(const char* what, const json& row) {
  std::printf("%-14s numeric on %-7s ours %7.1f ms (%.1f GFlop/s; AVX2 kernels %.1f)", "", what, number_of(row, "/ms"),
              number_of(row, "/gflops"), number_of(row, "/avx2_ms"));
  if (row.contains("ratio"))
    std::printf("   CHOLMOD %7.1f (%.2fx)", number_of(row, "/cholmod_ms"), number_of(row, "/ratio"));
  std::printf("\n");
}

// Through the C ABI: the factor saved as bytes, then hf_create with them, copied and read in place.
json store_and_load(const Mesh& mesh, const Run& run) {
  const SolverOptions options{ENGINE_GREEN, run.threads};
  const Solver maker(mesh, options);
  const hf_surface_statistics made = maker.surface_statistics();
  const double make_ms = made.ordering_ms + made.symbolic_ms + made.numeric_ms;
  hf_factor_desc saved = HF_INIT(hf_factor_desc);
  check(hf_surface_save(maker.surface(), HF_FIELD_HARMONIC, nullptr, 0, nullptr, &saved.byte_count));
  hf_inner::Memory memory;
  hf_inner::Buffer<uint8_t> bytes(memory, saved.byte_count);
  saved.bytes = bytes.data();
  const double save = time_ms([&] {
    check(hf_surface_save(maker.surface(), HF_FIELD_HARMONIC, nullptr, saved.byte_count, bytes.data(), nullptr));
  });
  std::vector<double> copied, borrowed;
  for (uint32_t r = 0; r < run.repetitions; ++r) {
    for (const int borrow : {0, 1}) {
      saved.borrow = borrow;
      SolverOptions loading = options;
      loading.saved_factor = &saved;
      (borrow ? borrowed : copied).push_back(Solver(mesh, loading).surface_statistics().load_ms);
    }
  }
  const double ratio = median(copied) / make_ms, in_place = median(borrowed) / make_ms;
  std::printf(
      "%-14s stored factor %.1f MB, save %.1f ms; load %.1f ms: %.3f of making it (%.0f ms), in place %.1f ms: "
      "%.3f\n",
      "", 1e-6 * static_cast<double>(saved.byte_count), save, median(copied), ratio, make_ms, median(borrowed),
      in_place);
  return {{"bytes", saved.byte_count},     {"make_ms", make_ms}, {"save_ms", save},         {"load_ms", median(copied)},
          {"borrow_ms", median(borrowed)}, {"ratio", ratio},     {"borrow_ratio", in_place}};
}

json run_mesh(const Mesh& mesh, const Run& run, Report* report) {
  const InnerSystem system(mesh, run.threads);
  const auto peer = CholmodPeer::make(system.peer_matrix(), run.threads);
  const uint32_t few = std::min(run.repetitions, 5u);
  json row = {{"name", mesh.name}, {"n", mesh.vertex_count()}};
  const Orderings orderings(system, peer.get(), few);
  const OrderResult &own = orderings.own, &degree = orderings.degree, &metis = orderings.metis;
  const Order& own_order = orderings.own_order;
  row["ordering"] = own.to_json();
  row["minimum_degree"] = degree.to_json();
  std::printf("%-14s ordering ours %.1f ms, %.3f M entries, %.3f GFlop; minimum degree %.1f ms, %.3f M, %.3f GFlop\n",
              mesh.name.c_str(), own.ms, 1e-6 * own.fill.entries, 1e-9 * own.fill.flops, degree.ms,
              1e-6 * degree.fill.entries, 1e-9 * degree.fill.flops);
  if (peer) {
    const OrderResult& amd = orderings.amd;
    row["amd"] = amd.to_json();
    std::printf("%-14s AMD %.1f ms, %.3f M, %.3f GFlop\n", mesh.name.c_str(), amd.ms, 1e-6 * amd.fill.entries,
                1e-9 * amd.fill.flops);
  }
  const double symbolic = time_symbolic(system, {own_order.data(), own_order.size()}, few);
  row["symbolic_ms"] = symbolic;
  hf_inner::factor::FactorOptions options;
  const auto make = [&](hf_inner::factor::Ordering ordering) {
    options.ordering = ordering;
    return std::static_pointer_cast<const hf_inner::factor::SupernodalFactor>(
        hf_inner::factor::Factor::make(system.matrix(), system.coordinates(), options, system.memory(), system.jobs()));
  };
  if (peer) {
    const double theirs = peer->analyse_given_ms(std::vector<int>(own_order.begin(), own_order.end()));
    row["metis"] = metis.to_json();
    row["cholmod_analyze_p_ms"] = theirs;
    std::printf(
        "%-14s METIS %.1f ms, %.3f M, %.3f GFlop: time %.2fx, fill %.3fx, flops %.3fx; symbolic %.1f ms, "
        "cholmod_analyze_p %.1f (%.2fx)\n",
        "", metis.ms, 1e-6 * metis.fill.entries, 1e-9 * metis.fill.flops, metis.ms / own.ms,
        own.fill.entries / metis.fill.entries, own.fill.flops / metis.fill.flops, symbolic, theirs, theirs / symbolic);
    row["numeric_metis"] = compare_numeric(system, *make(hf_inner::factor::Ordering::metis), peer.get(), run);
    print_numeric("METIS's", row["numeric_metis"]);
    if (report) {
      report->measure("ordering_time", mesh.name, run.threads, metis.ms / own.ms);
      report->measure("ordering_fill", mesh.name, run.threads, own.fill.entries / metis.fill.entries);
      report->measure("ordering_flops", mesh.name, run.threads, own.fill.flops / metis.fill.flops);
      report->measure("numeric", mesh.name, run.threads, number_of(row, "/numeric_metis/ratio"));
    }
  }
  const auto factor = make(hf_inner::factor::Ordering::nested_dissection);
  row["numeric_own"] = compare_numeric(system, *factor, peer.get(), run);
  print_numeric("ours", row["numeric_own"]);
  row["stored"] = store_and_load(mesh, run);
  if (report) report->measure("load", mesh.name, run.threads, number_of(row, "/stored/ratio"));
  std::fflush(stdout);
  return row;
}

}  // namespace

Rows run_factor(const Run& run, Report& report) { return run_meshes(run, report, run_mesh); }

void plot_factor(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"Ordering, analysis, numeric factorisation", "median milliseconds; numeric on METIS's permutation", "",
               "ms (logarithmic)"};
  plot.log_y = true;
  plot.format = "%.0f";
  write_rows(plot,
             {{"our ordering", "/ordering/ms"},
              {"METIS", "/metis/ms"},
              {"our symbolic analysis", "/symbolic_ms"},
              {"cholmod_analyze_p", "/cholmod_analyze_p_ms"},
              {"our numeric", "/numeric_metis/ms"},
              {"CHOLMOD supernodal + BLAS", "/numeric_metis/cholmod_ms"}},
             runs, file);
}

}  // namespace bench
