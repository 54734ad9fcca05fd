// Transfer: frames per second from a 4K-vertex horse to one target and to a crowd of eight of 10K vertices each. The
// targets are clones, so that all share one factor; each of the caller's threads plays its share of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/svg_plot.h"
#include "support/arrays.h"

namespace bench {
namespace {

constexpr uint32_t frame_count = 24, crowd = 8;

double distance2(const double* a, const double* b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

double diagonal_of(const Mesh& mesh) {
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
  }
  return std::sqrt(distance2(low, high));
}

// Balls round the same places on both meshes: the extremities of the source.
struct Places {
  std::vector<uint32_t> counts, vertices;
};

Places balls(const Mesh& mesh, const std::vector<hf_extremity>& tips) {
  Places out;
  const double radius = 0.03 * diagonal_of(mesh);
  for (const hf_extremity& tip : tips) {
    uint32_t nearest = 0, count = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
      if (distance2(&mesh.positions[3 * size_t{v}], tip.position) <
          distance2(&mesh.positions[3 * size_t{nearest}], tip.position))
        nearest = v;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      if (v != nearest && distance2(&mesh.positions[3 * size_t{v}], tip.position) > radius * radius) continue;
      out.vertices.push_back(v);
      ++count;
    }
    out.counts.push_back(count);
  }
  return out;
}

// The source bends from side to side and back.
std::vector<std::vector<float>> poses_of(const Mesh& mesh) {
  std::vector<std::vector<float>> out;
  const double box = diagonal_of(mesh);
  for (uint32_t f = 0; f < frame_count; ++f) {
    std::vector<float> posed(mesh.positions.size());
    for (size_t v = 0; v < mesh.positions.size(); v += 3) {
      const double angle = 0.6 * std::sin(6.283185307179586 * f / frame_count) * mesh.positions[v + 2] / box,
                   c = std::cos(angle), s = std::sin(angle);
      posed[v] = static_cast<float>(c * mesh.positions[v] + s * mesh.positions[v + 2]);
      posed[v + 1] = static_cast<float>(mesh.positions[v + 1]);
      posed[v + 2] = static_cast<float>(c * mesh.positions[v + 2] - s * mesh.positions[v]);
    }
    out.push_back(std::move(posed));
  }
  return out;
}

// One target of the crowd: its transfer and its positions, on the one surface.
struct Actor {
  hf_transfer transfer = nullptr;
  std::vector<float> positions;
  ~Actor() { hf_transfer_destroy(transfer); }
  void play(const std::vector<std::vector<float>>& poses) {
    for (const std::vector<float>& posed : poses) {
      hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
      frame.source_positions = HF_ARRAY(posed.data(), posed.size() / 3);
      frame.target_positions = ROWS_OUT(positions.data());
      check(hf_transfer_apply(transfer, &frame));
    }
  }
};

}  // namespace

Rows run_transfer(const Run& run, Report&) {
  Rows rows = Rows::array();
  const auto source = make_mesh(Family::creature, run.small ? 2000 : 4000),
             target = make_mesh(Family::creature, run.small ? 2500 : 10000);
  const Solver from(*source, own_defaults(1)), to(*target, own_defaults(1));
  std::vector<hf_extremity> tips(64);
  uint32_t tip_count = 0;
  check(hf_surface_find_extremities(from.surface(), nullptr, 64, tips.data(), &tip_count));
  tips.resize(std::min<uint32_t>(tip_count, 8));
  const Places on_source = balls(*source, tips), on_target = balls(*target, tips);
  // every other place leads, as feet and trunk do
  std::vector<uint32_t> flags(tips.size());
  for (size_t i = 0; i < flags.size(); ++i) flags[i] = i % 2 == 0 ? HF_PAIR_ANCHOR : 0;
  std::vector<Actor> actors(crowd);
  for (Actor& actor : actors) {
    check(hf_transfer_create(from.surface(), to.surface(), nullptr, &actor.transfer));
    hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
    pairs.pair_count = static_cast<uint32_t>(tips.size());
    pairs.flags = flags.data();
    pairs.source_counts = on_source.counts.data();
    pairs.source_vertices = on_source.vertices.data();
    pairs.target_counts = on_target.counts.data();
    pairs.target_vertices = on_target.vertices.data();
    check(hf_transfer_add_pairs(actor.transfer, &pairs, nullptr));
    actor.positions.resize(target->positions.size());
  }
  const std::vector<std::vector<float>> poses = poses_of(*source);
  for (const uint32_t targets : {1u, crowd}) {
    const std::string name = std::to_string(targets) + (targets == 1 ? " target" : " targets");
    if (!run.wants(name)) continue;
    const uint32_t threads = std::min(run.threads, targets);
    const auto play = [&] {
      std::vector<std::thread> others;
      for (uint32_t t = 1; t < threads; ++t)
        others.emplace_back([&, t] {
          for (uint32_t k = t; k < targets; k += threads) actors[k].play(poses);
        });
      for (uint32_t k = 0; k < targets; k += threads) actors[k].play(poses);
      for (std::thread& other : others) other.join();
    };
    play();  // fields and clusters are made at the first frame
    const double ms = median_ms(run.repetitions, play);
    const double per_second = 1000.0 * frame_count / ms;
    std::printf("%-10s %u vertices each, %u pairs: %8.0f frames a second for all, %8.0f posed targets a second\n",
                name.c_str(), target->vertex_count(), static_cast<uint32_t>(tips.size()), per_second,
                per_second * targets);
    std::fflush(stdout);
    rows.push_back({{"name", name},
                    {"n", target->vertex_count()},
                    {"targets", targets},
                    {"frames_per_second", per_second},
                    {"targets_per_second", per_second * targets}});
  }
  return rows;
}

void plot_transfer(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"Targets posed a second", "4K-vertex source, 10K-vertex targets, medians", "targets",
               "targets a second"};
  for (const nlohmann::json& run : runs) {
    Curve curve{threads_text(run.at("threads")), {}};
    for (const nlohmann::json& row : run.at("rows"))
      curve.points.emplace_back(number_of(row, "/targets"), number_of(row, "/targets_per_second"));
    plot.curves.push_back(curve);
  }
  write_svg(file, plot);
}

}  // namespace bench
