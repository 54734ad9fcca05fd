// How fast long calls heed a cancel, and what their progress says. Every case is run whole a few times with a thread
// that reads the fraction, then it is cancelled at random moments. Prints for every case the worst wait after a cancel,
// and checks that the fraction never falls, that less than a third of the time is spent at 100 %, and that a cancelled
// call leaves memory and results as they were.
//
// --names lists the cases, --once NAME makes one call and no more (costs.sh).
//
// Quick form: small meshes; waits are printed and not judged, since other programs run beside it. --full: the sizes of
// docs/promises.md, 50 moments a case, at most 100 ms.
#include "cancel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "report.h"
#include "support/arrays.h"

namespace {

using namespace reliability;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

// Triangles between random vertices: the factor of such a soup is dense.
Mesh make_soup(std::uint32_t vertices, std::uint32_t triangles) {
  Mesh mesh;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 1);
  for (std::uint32_t i = 0; i < 3 * vertices; ++i) mesh.positions.push_back(place(random));
  for (std::uint32_t i = 0; i < 3 * triangles; ++i) mesh.triangles.push_back(random() % vertices);
  return mesh;
}

// The call alone, by a name that a profiler can find (costs.sh).
extern "C" hf_result watched_call(const Case& c, hf_progress progress) { return c.call(progress); }
hf_result (*volatile not_inlined)(const Case&, hf_progress) = watched_call;

// What a run without a cancel shows.
struct Run {
  double total_ms = 0, full_ms = 0;  // the whole call; from the first reading of 1 on
  bool fell = false;
};

Run watch(const Case& c, hf_progress progress) {
  Run run;
  std::atomic<bool> over{false};
  const auto read = [&] {
    double fraction = 0;
    must(hf_progress_get_fraction(progress, &fraction), "hf_progress_get_fraction");
    return fraction;
  };
  // An earlier call may have left this progress anywhere. The call itself begins at 0, which is no fall.
  const double before = read();
  double last = 0;
  Clock::time_point full;
  const Clock::time_point begin = Clock::now();
  std::thread watcher([&] {
    bool begun = before <= 0;
    while (!over) {
      const double fraction = read();
      begun = begun || fraction != before;
      if (begun) {
        if (fraction < last) run.fell = true;
        if (fraction >= 1 && last < 1) full = Clock::now();
        last = fraction;
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  });
  const hf_result result = c.call(progress);
  const Clock::time_point end = Clock::now();
  over = true;
  watcher.join();
  must(result, c.name.c_str());
  run.total_ms = milliseconds(begin, end);
  if (last >= 1 && full > begin) run.full_ms = std::max(0.0, milliseconds(full, end));
  return run;
}

// A cancel before the call stops it at once.
bool heeds_an_early_cancel(const Case& c, hf_progress progress) {
  must(hf_progress_cancel(progress), "hf_progress_cancel");
  return c.call(progress) == HF_ERROR_CANCELLED;
}

struct Waits {
  double worst_ms = 0;
  int cancelled = 0, wrong = 0;
};

Waits cancel_at_random(const Case& c, hf_progress progress, double total_ms, int moments, std::mt19937& random) {
  Waits waits;
  for (int i = 0; i < moments; ++i) {
    const std::uint64_t before = c.state ? c.state() : 0;
    // the first moment is early: then the call has dropped what it makes anew, and made nothing yet
    const double moment = total_ms * std::uniform_real_distribution<double>(0, i == 0 ? 0.02 : 0.95)(random);
    std::atomic<std::int64_t> asked{0};
    std::thread canceller([&] {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(moment));
      asked = Clock::now().time_since_epoch().count();
      must(hf_progress_cancel(progress), "hf_progress_cancel");
    });
    const hf_result result = c.call(progress);
    const Clock::time_point end = Clock::now();
    canceller.join();
    if (result == HF_ERROR_CANCELLED) {
      ++waits.cancelled;
      const Clock::time_point from{Clock::duration(asked.load())};
      waits.worst_ms = std::max(waits.worst_ms, milliseconds(from, end));
      if (c.state && c.state() != before) ++waits.wrong;
    } else if (result == HF_OK) {
      // the call ended before the cancel, which stops the next call instead
      if (c.call(progress) != HF_ERROR_CANCELLED) ++waits.wrong;
    } else {
      ++waits.wrong;
    }
  }
  return waits;
}

// ---- the cases ----

struct World {
  World(bool full, Mesh given_big, Mesh given_small) : big(std::move(given_big)), small(std::move(given_small)) {
    soup = full ? make_soup(20000, 40000) : make_soup(600, 1200);
    dense = full ? make_soup(1800, 160000) : make_soup(300, 6000);
    hf_surface_desc d = surface_desc(small);
    surface = make_surface(d);
    size_t size = 0;
    const hf_surface made = make_surface(surface_desc(big));
    must(hf_surface_save(made, HF_FIELD_HARMONIC, nullptr, 0, nullptr, &size), "hf_surface_save");
    saved.resize(size);
    must(hf_surface_save(made, HF_FIELD_HARMONIC, nullptr, size, saved.data(), nullptr), "hf_surface_save");
    big_surface = made;
    must(hf_pose_create(big_surface, nullptr, &pose), "hf_pose_create");
    must(hf_transfer_create(big_surface, big_surface, nullptr, &transfer), "hf_transfer_create");
  }
  ~World() {
    hf_transfer_destroy(transfer);
    hf_pose_destroy(pose);
    hf_surface_destroy(surface);
    hf_surface_destroy(big_surface);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  Mesh big, small, soup, dense;
  std::uint32_t small_around = 0;  // vertices around the small torus
  hf_surface surface = nullptr, big_surface = nullptr;
  std::vector<unsigned char> saved;
  hf_pose pose = nullptr;
  hf_transfer transfer = nullptr;
};

hf_result make_and_destroy(hf_surface_desc d, hf_progress progress) {
  d.progress = progress;
  hf_surface made = nullptr;
  const hf_result result = hf_surface_create(&d, &made);
  hf_surface_destroy(made);
  return result;
}

void add_surface_cases(World& w, std::vector<Case>& cases) {
  cases.push_back({"create", [&](hf_progress p) { return make_and_destroy(surface_desc(w.big), p); }, {}});
  cases.push_back({"create_soup", [&](hf_progress p) { return make_and_destroy(surface_desc(w.soup), p); }, {}});
  cases.push_back({"create_weld_tolerance",
                   [&](hf_progress p) {
                     hf_surface_desc d = surface_desc(w.big);
                     d.weld = HF_WELD_TOLERANCE;
                     d.weld_tolerance = 1e-4;
                     return make_and_destroy(d, p);
                   },
                   {}});
  cases.push_back({"create_biharmonic",
                   [&](hf_progress p) {
                     hf_surface_desc d = surface_desc(w.small);
                     d.field_kind = HF_FIELD_BIHARMONIC;
                     return make_and_destroy(d, p);
                   },
                   {}});
  cases.push_back({"create_biharmonic_soup",
                   [&](hf_progress p) {
                     hf_surface_desc d = surface_desc(w.dense);
                     d.field_kind = HF_FIELD_BIHARMONIC;
                     return make_and_destroy(d, p);
                   },
                   {}});
  cases.push_back({"load",
                   [&](hf_progress p) {
                     hf_surface_desc d = surface_desc(w.big);
                     hf_factor_desc f = desc<hf_factor_desc>();
                     f.bytes = w.saved.data();
                     f.byte_count = w.saved.size();
                     d.saved_factor = &f;
                     return make_and_destroy(d, p);
                   },
                   {}});
  cases.push_back({"save",
                   [&](hf_progress p) {
                     return hf_surface_save(w.big_surface, HF_FIELD_HARMONIC, p, w.saved.size(), w.saved.data(),
                                            nullptr);
                   },
                   [&] { return memory_of(w.big_surface); }});
}

// The call that makes an object on a surface with that desc.
template <class Desc, class Object>
Case making(const char* name, hf_surface surface, Desc d, hf_result (*create)(hf_surface, const Desc*, Object*),
            void (*destroy)(Object)) {
  return {name,
          [=](hf_progress p) {
            Desc with = d;
            with.progress = p;
            Object made = nullptr;
            const hf_result result = create(surface, &with, &made);
            destroy(made);
            return result;
          },
          [=] { return memory_of(surface); }};
}

// The first update of quads.
Case updates(const char* name, hf_surface surface, hf_quads_desc d) {
  struct Made {
    hf_quads object = nullptr;
    ~Made() { hf_quads_destroy(object); }
  };
  const auto made = std::make_shared<Made>();
  Case c{name,
         [=](hf_progress p) {
           hf_quads_desc with = d;
           with.progress = p;
           return hf_quads_update(made->object, &with);
         },
         [=] { return memory_of(surface); }};
  c.prepare = [=](hf_progress) {
    hf_quads_desc coarse = d;
    coarse.face_count = 100;
    coarse.relax_count = HF_NO_INDEX;
    hf_quads_destroy(made->object);
    must(hf_quads_create(surface, &coarse, &made->object), "hf_quads_create");
  };
  return c;
}

// Distances from one vertex. An object of distances reports to the progress that it is made with.
Case distances(const char* name, std::int32_t method, hf_surface surface, std::size_t vertices) {
  struct Made {
    hf_geodesics object = nullptr;
    ~Made() { hf_geodesics_destroy(object); }
  };
  const auto made = std::make_shared<Made>();
  Case c{name,
         [=](hf_progress) {
           std::vector<float> out(vertices);
           const std::uint32_t source = 0;
           return hf_geodesics_solve(made->object, 1, &source, OUT(out.data()));
         },
         [=] { return memory_of(surface); }};
  c.prepare = [=](hf_progress p) {
    hf_geodesics_desc d = desc<hf_geodesics_desc>();
    d.method = method;
    d.progress = p;
    hf_geodesics_destroy(made->object);
    must(hf_geodesics_create(surface, &d, &made->object), "hf_geodesics_create");
  };
  return c;
}

// A region inside a straight curve through three points that lie an eighth of the torus apart. around: its nv.
Case region_curve(hf_surface surface, std::uint32_t vertices, std::uint32_t around) {
  struct Made {
    hf_region object = nullptr;
    ~Made() { hf_region_destroy(object); }
  };
  const auto made = std::make_shared<Made>();
  hf_region_desc membrane = desc<hf_region_desc>();
  membrane.base = HF_BASE_MEMBRANE;
  must(hf_region_create(surface, &membrane, &made->object), "hf_region_create");
  return {"region_curve",
          [=](hf_progress p) {
            const std::uint32_t along = vertices / around;
            const std::uint32_t points[3] = {0, along / 8 * around, along / 16 * around + around / 4};
            hf_curve_desc curve = desc<hf_curve_desc>();
            curve.point_count = 3;
            curve.vertices = points;
            hf_region_edit_desc edit = desc<hf_region_edit_desc>();
            edit.curve = &curve;
            edit.progress = p;
            hf_region copy = nullptr;
            must(hf_region_clone(made->object, &copy), "hf_region_clone");
            const hf_result result = hf_region_edit(copy, &edit);
            hf_region_destroy(copy);
            return result;
          },
          [=] { return memory_of(surface); }};
}

void add_field_cases(World& w, std::vector<Case>& cases) {
  hf_solver_desc bent = desc<hf_solver_desc>();
  bent.field_kind = HF_FIELD_BIHARMONIC;
  hf_region_desc plate = desc<hf_region_desc>();
  plate.base = HF_BASE_THIN_PLATE;
  cases.push_back(making("solver_of_another_kind", w.surface, bent, hf_create, hf_solver_destroy));
  cases.push_back(making("region", w.surface, plate, hf_region_create, hf_region_destroy));
  cases.push_back(region_curve(w.surface, w.small.vertex_count(), w.small_around));
  cases.push_back(
      making("geodesics", w.big_surface, desc<hf_geodesics_desc>(), hf_geodesics_create, hf_geodesics_destroy));
  cases.push_back(distances("distances_front", HF_GEODESICS_FRONT, w.big_surface, w.big.vertex_count()));
  cases.push_back(distances("distances_heat", HF_GEODESICS_HEAT, w.big_surface, w.big.vertex_count()));
  cases.push_back(distances("distances_exact", HF_GEODESICS_EXACT, w.surface, w.small.vertex_count()));
  cases.push_back(
      making("directions", w.big_surface, desc<hf_direction_desc>(), hf_direction_create, hf_direction_destroy));
  hf_quads_desc quads = desc<hf_quads_desc>();
  cases.push_back(making("quads", w.surface, quads, hf_quads_create, hf_quads_destroy));
  cases.push_back(updates("quads_update", w.surface, quads));
  quads.symmetry_plane[0] = 1;
  cases.push_back(updates("quads_update_symmetric", w.surface, quads));
  cases.push_back(making("quads_symmetric", w.surface, quads, hf_quads_create, hf_quads_destroy));
  cases.push_back({"propose_handles",
                   [&w](hf_progress p) {
                     hf_handle_proposals_desc d = desc<hf_handle_proposals_desc>();
                     d.progress = p;
                     std::uint32_t count = 0;
                     return hf_surface_propose_handles(w.surface, &d, 0, nullptr, &count);
                   },
                   [&] { return memory_of(w.surface); }});
  for (const std::int32_t kind : {HF_EXTREMITIES_POISSON, HF_EXTREMITIES_GEODESIC}) {
    cases.push_back({kind == HF_EXTREMITIES_POISSON ? "extremities_poisson" : "extremities_geodesic",
                     [&w, kind](hf_progress p) {
                       hf_extremities_desc d = desc<hf_extremities_desc>();
                       d.kind = kind;
                       d.progress = p;
                       std::uint32_t count = 0;
                       return hf_surface_find_extremities(w.surface, &d, 0, nullptr, &count);
                     },
                     [&] { return memory_of(w.surface); }});
  }
}

// Four small discs of the grid the torus is.
constexpr int handle_count = 4;
std::vector<double> places(const Mesh& mesh) {
  std::vector<double> points;
  for (int k = 0; k < handle_count; ++k) {
    const std::size_t v = mesh.vertex_count() / handle_count * static_cast<std::size_t>(k);
    for (std::size_t i = 0; i < 3; ++i) points.push_back(static_cast<double>(mesh.positions[3 * v + i]));
  }
  return points;
}

// Adds pairs of a surface with itself: bands of the torus, thousands of vertices each.
hf_result add_pairs(const World& w, hf_progress progress, std::uint32_t* numbers) {
  const std::uint32_t step = w.big.vertex_count() / handle_count, width = step / 20;
  std::vector<std::uint32_t> counts(handle_count, width), vertices;
  for (std::uint32_t k = 0; k < handle_count; ++k) {
    for (std::uint32_t i = 0; i < width; ++i) vertices.push_back(k * step + i);
  }
  hf_pairs_desc d = desc<hf_pairs_desc>();
  d.pair_count = handle_count;
  d.source_counts = d.target_counts = counts.data();
  d.source_vertices = d.target_vertices = vertices.data();
  d.progress = progress;
  return hf_transfer_add_pairs(w.transfer, &d, numbers);
}

void add_pose_cases(World& w, std::vector<Case>& cases) {
  const auto pose_state = [&w] {
    hf_pose_info info = desc<hf_pose_info>();
    must(hf_pose_get_info(w.pose, &info), "hf_pose_get_info");
    return mixed(info.handle_count, memory_of(w.big_surface));
  };
  cases.push_back({"first_handles",
                   [&w](hf_progress p) {
                     const std::vector<double> points = places(w.big), radii(handle_count, 0.3);
                     hf_handles_desc d = desc<hf_handles_desc>();
                     d.handle_count = handle_count;
                     d.points = points.data();
                     d.radii = radii.data();
                     d.progress = p;
                     std::uint32_t numbers[handle_count];
                     const hf_result result = hf_pose_add_handles(w.pose, &d, numbers);
                     if (result == HF_OK) must(hf_pose_remove_handles(w.pose, handle_count, numbers), "remove handles");
                     return result;
                   },
                   pose_state});
  cases.push_back({"pairs",
                   [&w](hf_progress p) {
                     std::uint32_t pairs[handle_count];
                     const hf_result result = add_pairs(w, p, pairs);
                     if (result == HF_OK)
                       must(hf_transfer_remove_pairs(w.transfer, handle_count, pairs), "hf_transfer_remove_pairs");
                     return result;
                   },
                   [&w] {
                     // A transfer that has no pair says so.
                     hf_transfer_info info = desc<hf_transfer_info>();
                     const hf_result result = hf_transfer_get_info(w.transfer, &info);
                     return mixed(mixed(static_cast<std::uint64_t>(-result), info.pair_count),
                                  memory_of(w.big_surface));
                   }});
}

}  // namespace

int main(int argc, char** argv) {
  const auto given = [&](const char* option) {
    return std::any_of(argv + 1, argv + argc, [&](const char* a) { return std::string(a) == option; });
  };
  const bool full = report_full(argc, argv) != 0, once = given("--once"), names = given("--names");
  const std::string only = argc > 1 && argv[argc - 1][0] != '-' ? argv[argc - 1] : "";
  const int moments = full ? 50 : 5;
  Mesh big, small;
  add_torus(big, full ? 1000 : 80, full ? 500 : 40);
  add_torus(small, full ? 400 : 60, full ? 200 : 30);
  World world(full, std::move(big), std::move(small));
  world.small_around = full ? 200 : 30;
  std::vector<Case> cases;
  add_surface_cases(world, cases);
  add_field_cases(world, cases);
  add_pose_cases(world, cases);
  add_weights_cases(world.surface, world.small, cases);
  for (const Case& c : cases) {
    if (names) std::printf("%s\n", c.name.c_str());
    if (!once || c.name != only) continue;
    hf_progress progress = nullptr;
    must(hf_progress_create(&progress), "hf_progress_create");
    if (c.prepare) c.prepare(progress);
    must(not_inlined(c, progress), c.name.c_str());
    hf_progress_destroy(progress);
  }
  if (names || once) return 0;
  std::mt19937 random(1);
  int fell = 0, late = 0, wrong = 0, missed = 0;
  for (const Case& c : cases) {
    if (!only.empty() && c.name != only) continue;
    hf_progress progress = nullptr;  // of its own for every case, so that the watched call begins at 0
    must(hf_progress_create(&progress), "hf_progress_create");
    if (c.prepare) c.prepare(progress);
    c.call(nullptr);  // what is made once is made
    const Run run = watch(c, progress);
    fell += run.fell;
    // a short call may be read only once at the end
    const bool ends_late = run.total_ms > 20 && run.full_ms > run.total_ms / 3;
    late += ends_late;
    const Waits waits = cancel_at_random(c, progress, run.total_ms, moments, random);
    wrong += waits.wrong;
    missed += !heeds_an_early_cancel(c, progress);
    std::printf("%-22s %8.1f ms, %4.0f %% of it at 100 %%; %2d cancelled, worst wait %6.1f ms%s%s\n", c.name.c_str(),
                run.total_ms, 100 * run.full_ms / run.total_ms, waits.cancelled, waits.worst_ms,
                run.fell ? "; the fraction fell" : "", waits.wrong ? "; wrong" : "");
    std::fflush(stdout);
    hf_progress_destroy(progress);
    if (full) report_at_most(("cancel_wait_ms_" + c.name).c_str(), waits.worst_ms, 100);
  }
  report_at_most("cancel_fraction_falls", fell, 0);
  report_at_most("cancel_spent_at_100_percent", late, 0);
  report_at_most("cancel_changed_or_unknown", wrong, 0);
  report_at_most("cancel_never_heeded", missed, 0);
  return report_status();
}
