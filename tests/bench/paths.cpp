// What one edit costs inside: the path solves y_i = G^-1 P w_i of a batch of sites, and the Gram matrix of all of them,
// on the library's own factor. Sites per millisecond and kilobytes per site.
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/inner_factor.h"
#include "bench/svg_plot.h"

namespace bench {
namespace {

using Groups = hf_inner::Vector<std::shared_ptr<const hf_inner::factor::PathGroup>>;

// A batch of vertex sites as columns of W.
struct PathBatch {
  PathBatch(const InnerSystem& system, uint32_t count) : ones(count, 1.0), group(count), column(count) {
    const uint32_t n = static_cast<uint32_t>(system.matrix().size());
    for (const uint32_t v : scattered_vertices(n, count, 3)) row.push_back(static_cast<int32_t>(v));
    for (uint32_t i = 0; i <= count; ++i) start.push_back(static_cast<int32_t>(i));
  }
  hf_inner::factor::SparseColumns columns() const {
    return {{start.data(), start.size()}, {row.data(), row.size()}, {ones.data(), ones.size()}};
  }
  std::vector<int32_t> start, row;
  std::vector<double> ones;
  std::vector<int32_t> group, column;
};

double gram_all(const hf_inner::factor::Factor& factor, const Groups& groups) {
  std::vector<double> tile(size_t{hf_inner::factor::PathGroup::capacity} * hf_inner::factor::PathGroup::capacity);
  return time_ms([&] {
    for (size_t i = 0; i < groups.size(); ++i) {
      for (size_t j = 0; j <= i; ++j)
        factor.gram(*groups[i], *groups[j], tile.data(), hf_inner::factor::PathGroup::capacity);
    }
  });
}

Rows run_mesh(const Mesh& mesh, const Run& run) {
  Rows rows = Rows::array();
  const InnerSystem system(mesh, run.threads);
  const auto factor =
      hf_inner::factor::Factor::make(system.matrix(), system.coordinates(), {}, system.memory(), system.jobs());
  for (const uint32_t count : {1u, 8u, 60u, 100u, 200u, 300u}) {
    const std::string name = std::to_string(count) + "_sites_" + mesh.name;
    if (!run.wants(name)) continue;
    PathBatch batch(system, count);
    Groups groups(&system.memory());
    const auto path = [&] {
      return time_ms([&] {
        factor->solve_paths(batch.columns(), system.memory(), system.jobs(), groups,
                            {batch.group.data(), batch.group.size()}, {batch.column.data(), batch.column.size()});
      });
    };
    auto medians =
        take_turns({{"paths_ms", path}, {"gram_ms", [&] { return gram_all(*factor, groups); }}}, run.repetitions);
    double bytes = 0;
    for (const auto& group : groups) bytes += group->bytes();
    std::printf("%-24s paths %7.2f ms, Gram (one thread) %6.2f ms, %.1f KB a site\n", name.c_str(), medians["paths_ms"],
                medians["gram_ms"], bytes / count / 1024);
    rows.push_back({{"name", name},
                    {"mesh", mesh.name},
                    {"sites", count},
                    {"paths_ms", medians["paths_ms"]},
                    {"gram_ms", medians["gram_ms"]},
                    {"bytes_per_site", bytes / count}});
  }
  std::fflush(stdout);
  return rows;
}

}  // namespace

Rows run_paths(const Run& run, Report&) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    for (auto& row : run_mesh(*make_mesh(family, Size::k304, run.small), run)) rows.push_back(std::move(row));
  }
  return rows;
}

void plot_paths(const Runs& runs, const std::string& file) {
  CurvePlot plot;
  plot.text = {"Path solves of a batch of sites", "what an insertion costs before the dense part; medians", "sites",
               "ms"};
  for (const nlohmann::json& run : runs) {
    for (const Family family : families) {
      Curve curve{std::string(family_name(family)) + ", " + threads_text(run.at("threads")), {}};
      for (const nlohmann::json& row : run.at("rows")) {
        if (row.at("mesh").get<std::string>().find(family_name(family)) != std::string::npos)
          curve.points.emplace_back(number_of(row, "/sites"), number_of(row, "/paths_ms"));
      }
      if (!curve.points.empty()) plot.curves.push_back(curve);
    }
  }
  write_svg(file, plot);
}

}  // namespace bench
