// The paper's Figure 6: a region on a mesh of 115K vertices is enlarged, which takes 284 new boundary sites, and its
// membrane follows. hf_region_edit, all in it (rim, paths, dense system, membrane of three coordinates, areas), beside
// the same sites solved afresh: CHOLMOD's numeric factorisation with its analysis kept and three right-hand sides; our
// engine refactor, its ordering kept; a solver made anew. Thin plates beside a new bi-harmonic solver.
#include <cmath>
#include <cstdio>

#include "bench/bench_mesh.h"
#include "bench/commands.h"
#include "bench/peer_cholmod.h"

namespace bench {
namespace {

class Region {
 public:
  explicit Region(const Solver& solver) {
    hf_region_desc desc = HF_INIT(hf_region_desc);
    desc.base = HF_BASE_MEMBRANE;
    check(hf_region_create(solver.surface(), &desc, &handle_));
  }
  Region(const Region& other) { check(hf_region_clone(other.handle_, &handle_)); }
  Region& operator=(const Region&) = delete;
  ~Region() { hf_region_destroy(handle_); }
  void grow(int32_t rings) const {
    hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
    edit.ring_count = rings;
    check(hf_region_edit(handle_, &edit));
  }
  void add(const std::vector<uint32_t>& vertices) const {
    hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
    edit.add_count = static_cast<uint32_t>(vertices.size());
    edit.add_vertices = vertices.data();
    check(hf_region_edit(handle_, &edit));
  }
  hf_region_info info() const {
    hf_region_info info = HF_INIT(hf_region_info);
    check(hf_region_get_info(handle_, &info));
    return info;
  }
  hf_region_statistics statistics() const {
    hf_region_statistics statistics = HF_INIT(hf_region_statistics);
    check(hf_region_get_statistics(handle_, &statistics));
    return statistics;
  }
  std::vector<uint32_t> vertices(int32_t list) const {
    const hf_region_info counts = info();
    std::vector<uint32_t> found(list == HF_REGION_INSIDE ? counts.vertex_count
                                : list == HF_REGION_RIM  ? counts.rim_count
                                                         : counts.site_count);
    check(hf_region_get_vertices(handle_, list, static_cast<uint32_t>(found.size()), found.data(), nullptr));
    return found;
  }
  void morph(std::vector<float>& positions, std::vector<float>& normals) const {
    hf_morph_desc desc = HF_INIT(hf_morph_desc);
    desc.weight = 0.5;
    desc.positions = positions.data();
    desc.normals = normals.data();
    check(hf_region_morph(handle_, &desc));
  }

 private:
  hf_region handle_ = nullptr;
};

constexpr int32_t step = 10;  // rings that the region grows by

// Grown from one vertex until `step` rings more take about `wanted` new sites.
void prepare(const Region& region, uint32_t vertex, uint32_t wanted) {
  region.add({vertex});
  for (int32_t ring = 0; ring < 2000; ++ring) {
    const Region probe(region);
    probe.grow(step);
    if (probe.statistics().inserted_count >= wanted) return;
    region.grow(ring == 0 ? 4 : 1);
  }
}

struct Growth {
  double update_ms = 0, morph_ms = 0;
  hf_region_info info{};
  hf_region_statistics work{};
  std::vector<uint32_t> before, after;  // rims
  std::vector<uint32_t> inside;
};

Growth measure(const Solver& solver, uint32_t vertex, uint32_t wanted, uint32_t repetitions) {
  Growth growth;
  const Region region(solver);
  prepare(region, vertex, wanted);
  std::vector<double> update, morph;
  std::vector<float> positions(size_t{solver.vertex_count()} * 3), normals(positions.size());
  for (uint32_t r = 0; r <= repetitions; ++r) {
    const Region copy(region);
    const double ms = time_ms([&] { copy.grow(step); });
    const double drawn = time_ms([&] { copy.morph(positions, normals); });
    if (r > 0) {
      update.push_back(ms);
      morph.push_back(drawn);
    }  // the first one warms
    growth.info = copy.info();
    growth.work = copy.statistics();
    growth.after = copy.vertices(HF_REGION_RIM);
    growth.inside = copy.vertices(HF_REGION_INSIDE);
  }
  growth.before = region.vertices(HF_REGION_RIM);
  growth.update_ms = median(update);
  growth.morph_ms = median(morph);
  return growth;
}

// The sites of the grown rim by engine refactor: its edit factorises.
double refactor_ms(const Mesh& mesh, const Growth& growth, uint32_t threads, uint32_t repetitions) {
  SolverOptions options = own_defaults(threads);
  options.engine = HF_ENGINE_REFACTOR;
  options.channels = 3;
  const Solver solver(mesh, options);
  std::vector<double> field, times;
  for (uint32_t r = 0; r < repetitions; ++r) {
    Sites sites(solver);
    sites.edit(growth.before, {});
    const double edit = sites.edit(growth.after, growth.before);
    times.push_back(edit + time_ms([&] { solver.solve(field); }));
    sites.clear();
  }
  return median(times);
}

double fresh_ms(const Mesh& mesh, const Growth& growth, const SolverOptions& options, uint32_t repetitions) {
  return median_ms(repetitions, [&] {
    const Solver solver(mesh, options);
    Region(solver).add(growth.inside);
  });
}

}  // namespace

Rows run_detail(const Run& run, Report& report) {
  Rows rows = Rows::array();
  for (const Family family : families) {
    const auto mesh = make_mesh(family, run.small ? 4000 : 115000);
    if (!run.wants(mesh->name)) continue;
    const uint32_t wanted = run.small ? 60 : 284, middle = mesh->vertex_count() / 2;
    const Solver solver(*mesh, own_defaults(run.threads));
    const Growth grown = measure(solver, middle, wanted, run.repetitions);
    double recompute = 0;
    if (const auto peer = CholmodPeer::make(cotangent_matrix(*mesh), run.threads)) {
      peer->analyse_ms();
      std::vector<double> times;
      for (uint32_t r = 0; r <= run.repetitions; ++r) {
        peer->set_sites(grown.after);
        const double ms = peer->factorise_ms() + peer->solve_kept_ms(3);
        if (r > 0) times.push_back(ms);
      }
      recompute = median(times);
    }
    const double refactor = refactor_ms(*mesh, grown, run.threads, run.repetitions);
    const double fresh = fresh_ms(*mesh, grown, own_defaults(run.threads), run.repetitions);
    SolverOptions bent = own_defaults(run.threads);
    bent.field_kind = HF_FIELD_BIHARMONIC;
    const Solver plate_solver(*mesh, bent);
    const Growth plate = measure(plate_solver, middle, 2 * wanted, run.repetitions);
    const double fresh_plate = fresh_ms(*mesh, plate, bent, 1);
    std::printf(
        "%-14s membrane of %u vertices, %u sites in, %u out: %6.2f ms (drawn with normals %5.2f)   CHOLMOD again %7.1f "
        "= "
        "%4.1f x   engine refactor %6.1f = %4.1f x   new solver %7.1f = %5.1f x\n",
        mesh->name.c_str(), grown.info.vertex_count, grown.work.inserted_count, grown.work.removed_count,
        grown.update_ms, grown.morph_ms, recompute, recompute / grown.update_ms, refactor, refactor / grown.update_ms,
        fresh, fresh / grown.update_ms);
    std::printf("%-14s thin plate of %u vertices, %u sites in, %u out: %6.2f ms   new solver %7.1f = %5.1f x\n", "",
                plate.info.vertex_count, plate.work.inserted_count, plate.work.removed_count, plate.update_ms,
                fresh_plate, fresh_plate / plate.update_ms);
    std::fflush(stdout);
    if (!run.small && recompute > 0)
      report.measure("region_grown", mesh->name, run.threads, recompute / grown.update_ms);
    rows.push_back({{"name", mesh->name},
                    {"n", mesh->vertex_count()},
                    {"inserted", grown.work.inserted_count},
                    {"removed", grown.work.removed_count},
                    {"factorisations", grown.work.factorisation_count},
                    {"update_ms", grown.update_ms},
                    {"morph_ms", grown.morph_ms},
                    {"recompute_ms", recompute},
                    {"refactor_ms", refactor},
                    {"fresh_ms", fresh},
                    {"plate_ms", plate.update_ms},
                    {"plate_fresh_ms", fresh_plate}});
  }
  return rows;
}

void plot_detail(const Runs& runs, const std::string& file) {
  BarPlot plot;
  plot.text = {"A region grows by 284 boundary sites, 115K vertices", "membrane included, medians", "", "milliseconds"};
  plot.log_y = true;
  write_rows(plot,
             {{"update", "/update_ms"},
              {"CHOLMOD again", "/recompute_ms"},
              {"engine refactor", "/refactor_ms"},
              {"new solver", "/fresh_ms"}},
             runs, file);
}

}  // namespace bench
