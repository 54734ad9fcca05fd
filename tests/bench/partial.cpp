// Partial evaluation: the field at ten vertices under 100 sites, on meshes of growing size, beside the whole field. The
// first follows the length of an elimination path, the second the size of the factor.
#include <cstdio>

#include "assets/shapes.h"
#include "bench/bench_support.h"

namespace bench {

int partial(const Arguments& arguments) {
  nlohmann::json out = {{"machine", machine_name()}, {"threads", arguments.threads}, {"rows", nlohmann::json::array()}};
  std::printf("%s, %u thread%s; 100 sites, milliseconds\n", machine_name().c_str(), arguments.threads,
              arguments.threads == 1 ? "" : "s");
  for (const uint32_t side : {65u, 130u, 260u, 551u}) {
    const samples::ShapeMesh torus = samples::jittered_torus(side, side + 1);
    const Mesh mesh{"torus", torus.positions, torus.triangles};
    const Solver solver(mesh, HF_ENGINE_GREEN, arguments.threads);
    const std::vector<uint32_t> vertices = scattered_vertices(mesh.vertex_count(), 100, 21);
    std::vector<double> values;
    for (const uint32_t v : vertices) values.push_back(value_of(v));
    hf_sites_desc sites;
    HF_INIT(sites);
    sites.site_count = 100, sites.vertices = vertices.data(), sites.values = values.data();
    check(hf_add_sites(solver.handle(), &sites, nullptr));
    std::vector<double> at(10), whole(mesh.vertex_count());
    std::vector<double> at_times, whole_times;
    for (uint32_t r = 0; r < 5 * arguments.repetitions; ++r) {
      const std::vector<uint32_t> probes = scattered_vertices(mesh.vertex_count(), 10, 100 + r);
      Clock clock;
      check(hf_solve_at(solver.handle(), 10, probes.data(), at.data()));
      at_times.push_back(clock.milliseconds());
      clock = Clock();
      check(hf_solve_f64(solver.handle(), whole.data(), 0, nullptr));
      whole_times.push_back(clock.milliseconds());
    }
    std::printf("%8u vertices   at ten vertices %7.3f   everywhere %7.3f\n", mesh.vertex_count(), median(at_times),
                median(whole_times));
    out["rows"].push_back(
        {{"n", mesh.vertex_count()}, {"solve_at_ms", median(at_times)}, {"solve_ms", median(whole_times)}});
  }
  write_json(arguments.json_file, out);
  return 0;
}

}  // namespace bench
