// Thousands of sites at once: our own route against our own refactorisation with the sites eliminated and its two
// sweeps (engine refactor).
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "assets/shapes.h"
#include "bench/bench_support.h"

namespace bench {

int large_sites(const Arguments& arguments) {
  const samples::ShapeMesh torus = samples::jittered_torus(551, 552);
  const Mesh mesh{"torus", torus.positions, torus.triangles};
  const Solver green(mesh, HF_ENGINE_GREEN, arguments.threads), refactor(mesh, HF_ENGINE_REFACTOR, arguments.threads);
  std::vector<float> field(mesh.vertex_count());
  const auto run = [&](const Solver& solver, uint32_t count) {
    const std::vector<uint32_t> vertices = scattered_vertices(mesh.vertex_count(), count, 11);
    std::vector<uint32_t> numbers(count);
    std::vector<double> values, times;
    for (const uint32_t v : vertices) values.push_back(value_of(v));
    hf_sites_desc sites;
    HF_INIT(sites);
    sites.site_count = count, sites.vertices = vertices.data(), sites.values = values.data();
    for (uint32_t r = 0; r < arguments.repetitions; ++r) {
      const Clock clock;
      check(hf_add_sites(solver.handle(), &sites, numbers.data()));
      check(hf_solve(solver.handle(), field.data(), 0, nullptr));
      times.push_back(clock.milliseconds());
      check(hf_remove_sites(solver.handle(), count, numbers.data()));
    }
    return median(times);
  };
  nlohmann::json out = {{"machine", machine_name()}, {"threads", arguments.threads}, {"rows", nlohmann::json::array()}};
  std::printf("%s, %u thread%s, 304152 vertices; all sites at once and the whole field, ms\n", machine_name().c_str(),
              arguments.threads, arguments.threads == 1 ? "" : "s");
  for (const uint32_t count : {100u, 300u, 1000u, 2000u, 10000u}) {
    const uint32_t before = green.statistics().factorisation_count;
    const double ours = run(green, count), theirs = run(refactor, count);
    const bool rebased = green.statistics().factorisation_count > before;
    std::printf("%6u sites  green %8.1f (%s)   refactor %8.1f   ratio %.2f\n", count, ours,
                rebased ? "rebased" : "dense", theirs, ours / theirs);
    std::fflush(stdout);
    out["rows"].push_back({{"sites", count},
                           {"green_ms", ours},
                           {"rebased", rebased},
                           {"refactor_ms", theirs},
                           {"ratio", ours / theirs}});
  }
  write_json(arguments.json_file, out);
  return 0;
}

}  // namespace bench
