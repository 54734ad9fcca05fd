// Every result code that the headers name is really returned: each is provoked once, by the shortest call that earns
// it, and the error detail of that call names it.
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "report.h"
#include "surfaces.h"
#include "whole_api.h"

using namespace reliability;

namespace {

std::map<hf_result, std::string> seen;
unsigned wrong_details;

void provoke(hf_result got, const char* how) {
  if (!seen.emplace(got, how).second || got == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  const bool named = detail.code == got && std::strlen(detail.function) > 0 && std::strlen(detail.message) > 0;
  if (!named) fprintf(stderr, "%s: the detail says %s\n", how, hf_result_get_name(detail.code));
  wrong_details += !named;
}

hf_create_desc scene_desc(const Scene& s) {
  hf_create_desc d = desc<hf_create_desc>();
  d.vertex_count = s.vertex_count, d.triangle_count = s.triangle_count;
  d.positions = s.positions.data(), d.triangles = s.triangles.data();
  return d;
}

hf_result add_one(hf_solver solver, std::uint32_t vertex, double value) {
  hf_sites_desc d = desc<hf_sites_desc>();
  d.site_count = 1, d.vertices = &vertex, d.values = &value;
  return hf_add_sites(solver, &d, nullptr);
}

void arguments(const Scene& s) {
  hf_solver solver = nullptr;
  hf_create_desc d = scene_desc(s);
  provoke(hf_create(nullptr, &solver), "no desc");
  provoke(hf_surface_get_report(nullptr, nullptr), "no solver");
  d.weld = 9, provoke(hf_create(&d, &solver), "weld 9");
  d = scene_desc(s), d.struct_size = 1, provoke(hf_create(&d, &solver), "struct_size 1");
  d = scene_desc(s), d.vertex_count = 0, provoke(hf_create(&d, &solver), "no vertices");
  d = scene_desc(s), d.vertex_limit = 1, provoke(hf_create(&d, &solver), "vertex_limit 1");
  d = scene_desc(s), d.vertex_count = 7, provoke(hf_create(&d, &solver), "triangles beyond the vertices");
  d = scene_desc(s), d.position_stride = 1, provoke(hf_create(&d, &solver), "stride 1");
  std::vector<float> infinite = s.positions;
  infinite[5] = HUGE_VALF;
  d = scene_desc(s), d.positions = infinite.data(), provoke(hf_create(&d, &solver), "an infinite position");
  Surface large;
  add_torus(large, 100, 80);
  d = create_desc(large), d.memory_limit_mb = 1;
  provoke(hf_create(&d, &solver), "a limit of one MiB");
}

void states(const Scene& s) {
  const hf_create_desc d = scene_desc(s);
  hf_solver solver = nullptr, copy = nullptr;
  provoke(hf_create(&d, &solver), "a solver");
  double value = 0;
  const std::uint32_t vertex = 3, none = 77;
  provoke(hf_solver_solve_at(solver, 1, &vertex, &value), "a field without sites");
  provoke(add_one(solver, 3, 1), "a site"), provoke(add_one(solver, 3, 1), "the same again");
  provoke(add_one(solver, 3, 2), "another value there");
  provoke(hf_remove_sites(solver, 1, &none), "an absent site"), provoke(hf_solver_undo(solver), "nothing to undo");
  hf_certificate certificate = desc<hf_certificate>();
  add_one(solver, 200, 2), certificate.tolerance = 1e-300;
  provoke(hf_solver_certify(solver, &certificate), "a tolerance no field can meet");

  hf_pose pose = nullptr;
  hf_transfer transfer = nullptr;
  must(hf_pose_create(solver, nullptr, &pose), "hf_pose_create");
  const std::uint32_t counts[2] = {1, 1}, same[2] = {9, 9};
  hf_handles_desc handles = desc<hf_handles_desc>();
  handles.handle_count = 2, handles.region_counts = counts, handles.region_vertices = same;
  provoke(hf_pose_add_handles(pose, &handles, nullptr), "two handles on one vertex");
  provoke(hf_pose_remove_handles(pose, 1, &none), "an absent handle");
  must(hf_transfer_create(solver, solver, nullptr, &transfer), "hf_transfer_create");
  provoke(hf_transfer_remove_pairs(transfer, 1, &none), "an absent pair");
  hf_pose_destroy(pose), hf_transfer_destroy(transfer), hf_solver_destroy(solver);

  hf_create_desc bent = scene_desc(s);
  bent.field_kind = HF_FIELD_BIHARMONIC;
  must(hf_create(&bent, &solver), "hf_create");
  provoke(hf_pose_create(solver, nullptr, &pose), "a pose on a bi-harmonic solver");
  hf_solver_destroy(solver);

  hf_progress progress = nullptr;
  must(hf_progress_create(&progress), "hf_progress_create"), must(hf_progress_cancel(progress), "hf_progress_cancel");
  hf_create_desc cancelled = scene_desc(s);
  cancelled.progress = progress;
  provoke(hf_create(&cancelled, &copy), "cancelled before it began");
  hf_progress_destroy(progress);
}

// A host whose hooks call the library, hold it up, or throw.
struct Hooks {
  enum { plain, call_back, hold, wreck } mode = plain;
  hf_solver solver = nullptr;
  hf_result answer = HF_OK;
};
void* allocate(void* user, std::size_t size, std::size_t alignment) {
  Hooks& hooks = *static_cast<Hooks*>(user);
  const auto mode = hooks.mode;
  hooks.mode = Hooks::plain;
  if (mode == Hooks::call_back) provoke(hooks.answer = hf_solver_record(hooks.solver), "a call from a callback");
  if (mode == Hooks::hold)
    std::thread([&] { provoke(hooks.answer = hf_solver_record(hooks.solver), "a call beside a change"); }).join();
  if (mode == Hooks::wreck) throw std::runtime_error("a fault of the host");
  const std::size_t step = alignment < 16 ? 16 : alignment;
  return aligned_alloc(step, (size + step - 1) / step * step);
}
void release(void*, void* block, std::size_t, std::size_t) { free(block); }

void callbacks(const Scene& s) {
  Hooks hooks;
  hf_create_desc d = scene_desc(s);
  d.allocator = {allocate, release, &hooks};
  must(hf_create(&d, &hooks.solver), "hf_create");
  for (const auto mode : {Hooks::call_back, Hooks::hold, Hooks::wreck}) {
    hooks.mode = mode;
    provoke(add_one(hooks.solver, 20 + static_cast<std::uint32_t>(mode), 1), "an edit with a faulty hook");
  }
  hf_solver_destroy(hooks.solver);
}

// Two needles of 1e34 with nearly all of their length in common: a solver takes them, the heat of distances, which has
// next to no area there, loses a pivot.
void indefinite() {
  const double positions[] = {0, 0, 0, -1.0384593717069655e34, 0, 0, 0, 1, 0, -1.038467170729213e34, 0, 0, 0, 0, 1};
  const std::uint32_t triangles[] = {0, 1, 3, 1, 2, 4};
  hf_create_desc d = desc<hf_create_desc>();
  d.vertex_count = 5, d.triangle_count = 2;
  d.positions_f64 = positions, d.triangles = triangles;
  d.operator_kind = HF_OPERATOR_COTANGENT;
  hf_solver solver = nullptr;
  provoke(hf_create(&d, &solver), "two needles");
  const hf_geodesics_desc g = desc<hf_geodesics_desc>();
  hf_geodesics geodesics = nullptr;
  provoke(hf_geodesics_create(solver, &g, &geodesics), "the heat on two needles");
  hf_geodesics_destroy(geodesics);
  hf_solver_destroy(solver);
}

}  // namespace

int main() {
  const Scene scene = make_scene();
  arguments(scene), states(scene), callbacks(scene), indefinite();
  unsigned named = 0, missing = 0;
  for (hf_result code = -400; code <= 0; ++code) {
    if (std::strcmp(hf_result_get_name(code), "unknown") == 0) continue;
    ++named;
    if (seen.count(code)) continue;
    ++missing, fprintf(stderr, "never returned: %s\n", hf_result_get_name(code));
  }
  report_at_least("RESULT_CODES", named, 25);
  report_at_most("RESULT_CODES_NEVER_RETURNED", missing, 0);
  report_at_most("RESULT_CODES_WITH_A_WRONG_DETAIL", wrong_details, 0);
  return report_status();
}
