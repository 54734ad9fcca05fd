// Walks that remove every site and add them again. A surface has one to five components. Each walk adds sites to some
// of them and removes them one by one in any order. Then it adds them again: the field must equal that of a new solver.
// On the way, three things report what no site reaches: the counts of hf_solve_info, values of 0, and
// HF_ERROR_EMPTY. The engines share 1,000 walks and the surface.
#include <algorithm>

#include "report.h"
#include "surfaces.h"
#include "support/arrays.h"

using namespace reliability;

namespace {

struct Walk {
  hf_solver solver;
  const Mesh& mesh;
  std::uint32_t components, size;  // vertices of a component
  std::mt19937& random;
  std::vector<std::uint32_t> vertices, sites;
  std::vector<double> values;
  unsigned wrong = 0;

  void choose() {
    vertices.clear();
    values.clear();
    for (std::uint32_t c = 0; c < components; ++c) {
      const unsigned count = c == 0 ? 1 + random() % 4 : random() % 4;
      for (unsigned i = 0; i < count; ++i) {
        const std::uint32_t v = c * size + static_cast<std::uint32_t>(random() % size);
        if (std::find(vertices.begin(), vertices.end(), v) != vertices.end()) continue;
        vertices.push_back(v);
        values.push_back(1e3 * c + std::uniform_real_distribution<double>(-1, 1)(random));
      }
    }
  }
  void add_all() {
    hf_sites_desc d = desc<hf_sites_desc>();
    sites.resize(vertices.size());
    d.site_count = static_cast<std::uint32_t>(vertices.size());
    d.vertices = vertices.data();
    d.values = values.data();
    must(hf_add_sites(solver, &d, sites.data()), "hf_add_sites");
  }
  std::vector<double> field() {
    std::vector<double> u(mesh.vertex_count(), 7e77);
    hf_solve_info info = desc<hf_solve_info>();
    const hf_result result = hf_solver_solve(solver, OUT(u.data()), &info);
    if (sites.empty()) {
      wrong += result != HF_ERROR_EMPTY || u[0] != 7e77;
      return u;
    }
    must(result, "hf_solver_solve");
    std::uint32_t unreached = 0, first = HF_NO_INDEX;
    for (std::uint32_t c = components; c-- > 0;) {
      const bool reached =
          std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return v / size == c; });
      if (reached) continue;
      ++unreached;
      first = c;
      for (std::uint32_t v = c * size; v < (c + 1) * size; ++v) wrong += u[v] != 0;
    }
    wrong += info.unreached_component_count != unreached || info.first_unreached_component != first;
    wrong += info.unreached_vertex_count != unreached * size;
    return u;
  }
  // Removes all sites, one by one.
  void empty() {
    const std::vector<std::uint32_t> kept = vertices;
    while (!sites.empty()) {
      const std::size_t at = random() % sites.size();
      must(hf_remove_sites(solver, 1, &sites[at]), "hf_remove_sites");
      sites.erase(sites.begin() + static_cast<std::ptrdiff_t>(at));
      vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(at));
      if (sites.empty() || random() % 3 == 0) field();
    }
    wrong += hf_solver_get_site_count(solver) != 0;
    vertices = kept;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const bool full = report_full(argc, argv);
  std::mt19937 random(3);
  double worst[3] = {0, 0, 0};
  unsigned wrong = 0, walks = 0;
  for (std::uint32_t components = 1; components <= 5; ++components) {
    Mesh mesh;
    for (std::uint32_t c = 0; c < components; ++c) add_torus(mesh, 14, 10, 20.0 * c, c + 1);
    const hf_surface surface = make_surface(surface_desc(mesh));
    for (std::int32_t engine = 0; engine < 3; ++engine) {
      hf_solver_desc d = desc<hf_solver_desc>();
      hf_solver solver = nullptr;
      const hf_result made = create_with(engine, surface, &d, &solver);
      if (made == HF_ERROR_UNSUPPORTED) continue;  // updown, without HF_WITH_GPL
      must(made, "hf_create");
      const int count = engine == ENGINE_GREEN ? (full ? 1000 : 200) : 20;
      Walk walk{solver, mesh, components, 140, random, {}, {}, {}};
      for (int i = 0; i < count; ++i, ++walks) {
        walk.choose();
        walk.add_all();
        walk.empty();
        walk.add_all();
        const std::vector<double> back = walk.field();
        const hf_solver fresh = make_solver(surface);
        Walk straight{fresh, mesh, components, 140, random, walk.vertices, {}, walk.values};
        straight.add_all();
        const std::vector<double> never_lost = straight.field();
        for (std::size_t v = 0; v < back.size(); ++v)
          worst[engine] =
              std::max(worst[engine], std::isfinite(back[v]) ? std::fabs(back[v] - never_lost[v]) : HUGE_VAL);
        hf_solver_destroy(fresh);
        walk.empty();
      }
      wrong += walk.wrong;
      hf_solver_destroy(solver);
    }
    hf_surface_destroy(surface);
  }
  report_at_least("WALKS", walks, 1000);
  report_at_most("WALKS_WRONG_ANSWERS", wrong, 0);
  report_at_most("WALKS_ERROR_GREEN", worst[ENGINE_GREEN], 1e-10);
  report_at_most("WALKS_ERROR_REFACTOR", worst[ENGINE_REFACTOR], 1e-10);
  report_at_most("WALKS_ERROR_UPDOWN", worst[ENGINE_UPDOWN], 1e-6);
  return report_status();
}
