// hf_factor_probe: medians of ordering, symbolic analysis, numeric factorisation, sweeps and paths beside CHOLMOD
// (supernodal, OpenBLAS) in one process. Not a test. Arguments: torus NU NV | mesh FILE.ply [repetitions] [what]
#include <cholmod.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>

#include "base/error.h"
#include "factor/factor_bytes.h"
#include "factor/numeric.h"
#include "factor/ordering.h"
#include "factor/preview.h"
#include "factor/supernodal_factor.h"
#include "unit/factor/matrices.h"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int repetitions = 5;
bool wants(const std::string& list, const char* what) { return list.empty() || list.find(what) != std::string::npos; }

double median(const std::function<void()>& work, int count = 0) {
  std::vector<double> times;
  for (int r = 0; r < (count ? count : repetitions); ++r) {
    const double start = now_ms();
    work();
    times.push_back(now_ms() - start);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

// Binary little-endian PLY with float positions and int triangles.
hf_test::TriangleMesh read_ply(const char* path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  std::size_t vertices = 0, faces = 0;
  while (std::getline(in, line) && line != "end_header") {
    if (line.rfind("element vertex ", 0) == 0) vertices = std::stoul(line.substr(15));
    if (line.rfind("element face ", 0) == 0) faces = std::stoul(line.substr(13));
  }
  hf_test::TriangleMesh mesh;
  for (std::size_t v = 0; v < vertices; ++v) {
    float p[3];
    in.read(reinterpret_cast<char*>(p), sizeof p);
    mesh.points.insert(mesh.points.end(), p, p + 3);
  }
  for (std::size_t f = 0; f < faces; ++f) {
    unsigned char count = 0;
    std::int32_t t[3];
    in.read(reinterpret_cast<char*>(&count), 1);
    in.read(reinterpret_cast<char*>(t), sizeof t);
    mesh.triangles.insert(mesh.triangles.end(), t, t + 3);
  }
  if (!in) std::fprintf(stderr, "cannot read %s\n", path), std::exit(1);
  return mesh;
}

struct Peer {
  Peer(const hf::SymmetricMatrix& a) {
    cholmod_start(&common);
    view = cholmod_sparse{};
    view.nrow = view.ncol = static_cast<std::size_t>(a.size());
    view.nzmax = a.row.size();
    view.p = const_cast<std::int32_t*>(a.column_start.data());
    view.i = const_cast<std::int32_t*>(a.row.data());
    view.x = const_cast<double*>(a.value.data());
    view.stype = 1, view.itype = CHOLMOD_INT, view.xtype = CHOLMOD_REAL, view.dtype = CHOLMOD_DOUBLE, view.sorted = 1,
    view.packed = 1;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
  }
  ~Peer() {
    if (factor) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  void analyze(int ordering, std::int32_t* order) {
    if (factor) cholmod_free_factor(&factor, &common);
    common.method[0].ordering = ordering;
    factor = order ? cholmod_analyze_p(&view, order, nullptr, 0, &common) : cholmod_analyze(&view, &common);
  }
  cholmod_common common;
  cholmod_sparse view;
  cholmod_factor* factor = nullptr;
};

volatile double sink;

void run(const char* name, const hf_test::TriangleMesh& mesh, bool bend, const std::string& what) {
  hf::Memory memory;
  hf::SymmetricMatrix a = hf_test::cotangent_matrix(memory, mesh);
  if (bend) {
    hf::SymmetricMatrix k = hf_test::squared(memory, a, 1.0);
    a.column_start.swap(k.column_start), a.row.swap(k.row), a.value.swap(k.value);
  }
  std::vector<float> points(mesh.points.begin(), mesh.points.end());
  const hf::Coordinates coordinates(points.data(), points.size());
  const std::int32_t n = a.size();
  hf::JobRunner one(1), two(2);
  hf::JobRunner* runners[2] = {&one, &two};
  std::printf("== %s: n %d, entries %zu, kernels %s\n", name, n, a.row.size(), hf::choose_kernels().name);
  Peer peer(a);
  if (wants(what, "order")) {
    const double metis = median([&] { peer.analyze(CHOLMOD_METIS, nullptr); }, 3);
    hf::Buffer<std::int32_t> order;
    const double given = median(
        [&] {
          if (order.empty()) hf::make_order(a, coordinates, hf::Ordering::metis, memory, one, nullptr, order);
          peer.analyze(CHOLMOD_GIVEN, order.data());
        },
        5);
    const auto show = [&](const char* label, hf::Ordering kind, hf::JobRunner& jobs) {
      const double ms = median([&] { hf::make_order(a, coordinates, kind, memory, jobs, nullptr, order); }, 3);
      const hf::FillEstimate fill = hf::estimate_fill(a, {order.data(), order.size()}, memory);
      std::printf("order %-12s %8.1f ms  lnz %.3f M  flops %.3f G\n", label, ms, fill.entries * 1e-6,
                  fill.flops * 1e-9);
      return ms;
    };
    std::printf("analyze METIS %.1f ms (analyze_p %.1f, net %.1f)\n", metis, given, metis - given);
    show("metis", hf::Ordering::metis, one);
    show("amd", hf::Ordering::minimum_degree, one);
    const double own1 = show("own 1", hf::Ordering::nested_dissection, one),
                 own2 = show("own 2", hf::Ordering::nested_dissection, two);
    std::printf("ordering ratio to METIS (net): %.2f / %.2f\n", (metis - given) / own1, (metis - given) / own2);
    hf::make_order(a, coordinates, hf::Ordering::metis, memory, one, nullptr, order);
    const double own = median([&] {
      hf::Symbolic symbolic;
      hf::analyse(a, {order.data(), order.size()}, memory, symbolic);
    });
    std::printf("symbolic %.1f ms, cholmod_analyze_p %.1f: %.2fx\n", own, given, given / own);
  }
  hf::FactorOptions options;
  options.ordering = wants(what, "own") && !what.empty() ? hf::Ordering::nested_dissection : hf::Ordering::metis;
  memory.reset_peak();
  const std::uint64_t before = memory.live_bytes();
  double start = now_ms();
  const auto made = hf::Factor::make(a, coordinates, options, memory, two);
  const double first = now_ms() - start;
  const auto& factor = static_cast<const hf::SupernodalFactor&>(*made);
  const hf::FactorStatistics& s = factor.statistics();
  std::printf(
      "make %.0f ms (order %.0f symbolic %.0f numeric %.0f): lnz %.3f M, stored %.3f (%.3f), flops %.3f G, supernodes "
      "%d, bytes %.1f M, peak %.2fx\n",
      first, s.ordering_ms, s.symbolic_ms, s.numeric_ms, s.entries * 1e-6, s.stored_entries * 1e-6,
      s.stored_entries / s.entries, s.flops * 1e-9, s.supernodes, s.bytes * 1e-6,
      static_cast<double>(memory.peak_bytes() - before) / s.bytes);
  std::printf(
      "plan: %d tasks, %zu top in %d waves, task panel %.2f stacks %.2f+%.2f, top panel %.2f, shared %.2f M doubles\n",
      factor.plan().tasks, factor.plan().top.size(), factor.plan().waves, 1e-6 * factor.plan().in_task.panel,
      1e-6 * factor.plan().in_task.stack[0], 1e-6 * factor.plan().in_task.stack[1], 1e-6 * factor.plan().in_top.panel,
      1e-6 * factor.plan().shared_size);
  hf::Buffer<std::int32_t> order(memory, static_cast<std::size_t>(n));
  std::copy(factor.order().begin(), factor.order().end(), order.begin());
  std::vector<double> b(static_cast<std::size_t>(n)), z(static_cast<std::size_t>(n) * 8 + 8);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = std::sin(0.1 * static_cast<double>(i));
  peer.analyze(CHOLMOD_GIVEN, order.data());
  if (wants(what, "numeric")) {
    double theirs[2], ours[2];
    hf::Buffer<double> values(memory, factor.values().size());
    std::memset(values.data(), 0, values.size() * sizeof(double));
    for (int t = 0; t < 2; ++t) {
      if (openblas_set_num_threads) openblas_set_num_threads(t + 1);
      theirs[t] = median([&] { cholmod_factorize(&peer.view, peer.factor, &peer.common); });
      if (openblas_set_num_threads) openblas_set_num_threads(1);
      ours[t] = median([&] {
        hf::factorise(factor.symbolic(), factor.plan(), factor.kernels(), a, {}, values.data(), memory, *runners[t],
                      nullptr);
      });
      std::printf("numeric %d thr: cholmod %.1f ms, own %.1f ms (%.1f GF/s): %.2fx\n", t + 1, theirs[t], ours[t],
                  s.flops * 1e-6 / ours[t], theirs[t] / ours[t]);
    }
    std::printf("numeric 2-thread scaling %.2fx\n", ours[0] / ours[1]);
    if (const hf::Kernels* narrow = hf::avx2_kernels()) {
      const double ms = median([&] {
        hf::factorise(factor.symbolic(), factor.plan(), *narrow, a, {}, values.data(), memory, one, nullptr);
      });
      std::printf("numeric 1 thr avx2: %.1f ms: %.2fx\n", ms, theirs[0] / ms);
    }
  } else {
    cholmod_factorize(&peer.view, peer.factor, &peer.common);
  }
  if (wants(what, "sweep")) {
    const double* values = factor.values().data();
    const std::size_t count = factor.values().size() / 64 * 64;
    const double read[2] = {median([&] {
                              double sum[8] = {};
                              for (std::size_t i = 0; i < count; i += 8) {
                                for (int k = 0; k < 8; ++k) sum[k] += values[i + k];
                              }
                              sink = sum[0] + sum[1] + sum[2] + sum[3] + sum[4] + sum[5] + sum[6] + sum[7];
                            }),
                            median([&] {
                              two.for_each(2, [&](std::uint32_t part) {
                                double sum[8] = {};
                                for (std::size_t i = part * (count / 2); i + 8 <= (part + 1) * (count / 2); i += 8) {
                                  for (int k = 0; k < 8; ++k) sum[k] += values[i + k];
                                }
                                sink = sum[0] + sum[1] + sum[2] + sum[3] + sum[4] + sum[5] + sum[6] + sum[7];
                              });
                            })};
    std::printf("read the values once %.2f / %.2f ms (%.1f GB/s)\n", read[0], read[1],
                8e-6 * static_cast<double>(count) / read[0]);
    double single[2] = {0, 0};
    for (const std::int32_t channels : {1, 3, 8}) {
      std::vector<double> right(static_cast<std::size_t>(n) * channels);
      for (std::size_t i = 0; i < right.size(); ++i) right[i] = b[i % b.size()];
      cholmod_dense* dense = cholmod_allocate_dense(n, channels, n, CHOLMOD_REAL, &peer.common);
      std::memcpy(dense->x, right.data(), right.size() * sizeof(double));
      cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
      if (openblas_set_num_threads) openblas_set_num_threads(1);
      const double theirs =
          median([&] { cholmod_solve2(CHOLMOD_A, peer.factor, dense, nullptr, &x, nullptr, &y, &e, &peer.common); });
      cholmod_free_dense(&x, &peer.common), cholmod_free_dense(&y, &peer.common), cholmod_free_dense(&e, &peer.common),
          cholmod_free_dense(&dense, &peer.common);
      for (int t = 0; t < 2; ++t) {
        const double back = median([&] {
          std::memcpy(z.data(), right.data(), right.size() * sizeof(double));
          factor.backward(z.data(), channels, *runners[t]);
        });
        const double fore = median([&] {
          std::memcpy(z.data(), right.data(), right.size() * sizeof(double));
          factor.forward(z.data(), channels, *runners[t]);
        });
        if (channels == 1) single[t] = back;
        std::printf(
            "sweep %d rhs %d thr: backward %.2f (%.2f of read, %.2f of one), forward %.2f; cholmod_solve %.2f: %.2fx\n",
            channels, t + 1, back, back / read[t], back / single[t], fore, theirs, theirs / back);
      }
    }
  }
  if (wants(what, "float")) {
    const auto preview = hf::PreviewFactor::make(factor, memory, two);
    std::vector<float> start_value(b.begin(), b.end()), x(b.size());
    for (int t = 0; t < 2; ++t) {
      const double full = median([&] {
        std::memcpy(z.data(), b.data(), b.size() * sizeof(double));
        factor.backward(z.data(), 1, *runners[t]);
      });
      const double half = median([&] {
        x = start_value;
        preview->backward(x.data(), 1, *runners[t]);
      });
      std::printf("float32 sweep %d thr: %.2f ms against %.2f: %.2f\n", t + 1, half, full, half / full);
    }
    std::vector<std::uint8_t> bytes(hf::saved_factor_size(factor));
    const double saved = median([&] { hf::save_factor(factor, {bytes.data(), bytes.size()}); }, 3);
    std::shared_ptr<const hf::Factor> loaded;
    const double load = median([&] { loaded = hf::load_factor({bytes.data(), bytes.size()}, n, memory, &two); }, 3);
    std::printf("save %.1f ms, load %.1f ms, %.1f MB\n", saved, load, 1e-6 * static_cast<double>(bytes.size()));
  }
  if (wants(what, "path")) {
    for (const int k : {1, 8, 60, 100, 200, 300}) {
      std::vector<std::int32_t> first, rows;
      std::vector<double> ones(static_cast<std::size_t>(k), 1.0);
      std::mt19937 random(3);
      for (int i = 0; i <= k; ++i) first.push_back(i);
      for (int i = 0; i < k; ++i) rows.push_back(static_cast<std::int32_t>(random() % static_cast<unsigned>(n)));
      const hf::SparseColumns columns{
          {first.data(), first.size()}, {rows.data(), rows.size()}, {ones.data(), ones.size()}};
      std::vector<std::int32_t> group(static_cast<std::size_t>(k)), column(static_cast<std::size_t>(k));
      hf::Vector<std::shared_ptr<const hf::PathGroup>> groups(&memory);
      double path[2], gram[2], bytes = 0;
      for (int t = 0; t < 2; ++t) {
        path[t] = median([&] {
          factor.solve_paths(columns, memory, *runners[t], groups, {group.data(), group.size()},
                             {column.data(), column.size()});
        });
        std::vector<double> tile(32 * 32);
        gram[t] = median([&] {
          for (std::size_t i = 0; i < groups.size(); ++i) {
            for (std::size_t j = 0; j <= i; ++j) factor.gram(*groups[i], *groups[j], tile.data(), 32);
          }
        });
      }
      for (const auto& g : groups) bytes += g->bytes();
      const auto& blocks = static_cast<const hf::PathBlocks&>(*groups[0]);
      double entries = 0;
      for (const auto& block : blocks.blocks) {
        const double width = factor.symbolic().columns(block.supernode);
        entries += width * (width / 2 + factor.symbolic().below(block.supernode)) * block.used;
      }
      std::printf("paths %3d: %.2f / %.2f ms, gram %.2f; %.1f KB a site; group 0: %zu blocks, %.2f M entries x sites\n",
                  k, path[0], path[1], gram[0], bytes / k / 1024, blocks.blocks.size(), entries * 1e-6);
    }
  }
  // residual
  std::vector<double> x(static_cast<std::size_t>(n));
  for (std::int32_t k = 0; k < n; ++k) z[static_cast<std::size_t>(k)] = b[static_cast<std::size_t>(factor.order()[k])];
  factor.forward(z.data(), 1, two), factor.backward(z.data(), 1, two);
  for (std::int32_t k = 0; k < n; ++k) x[static_cast<std::size_t>(factor.order()[k])] = z[static_cast<std::size_t>(k)];
  const std::vector<double> ax = hf_test::multiply(a, x);
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    worst = std::max(worst, std::abs(ax[i] - b[i])), size = std::max(size, std::abs(x[i]));
  std::printf("residual max|Ax-b| %.2e, max|x| %.2e, relative %.2e\n", worst, size, worst / size);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "torus";
  const bool is_mesh = kind == "mesh" && argc > 2;
  const int rest = is_mesh ? 3 : 4;
  if (argc > rest) repetitions = std::atoi(argv[rest]);
  const std::string what = argc > rest + 1 ? argv[rest + 1] : "";
  const bool bend = what.find("bend") != std::string::npos;
  try {
    if (is_mesh) {
      run(argv[2], read_ply(argv[2]), bend, what);
    } else {
      const int nu = argc > 2 ? std::atoi(argv[2]) : 872, nv = argc > 3 ? std::atoi(argv[3]) : 349;
      run("torus", hf_test::torus(nu, nv, 0.25), bend, what);
    }
  } catch (const hf::Error& error) {
    std::printf("error: %s\n", error.what());
    return 1;
  }
  return 0;
}
