// The library returns every result code that the headers name. Each is provoked once, by a short call, and the error
// detail must name it.
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

hf_surface_desc scene_desc(const Scene& s) {
  hf_surface_desc d = desc<hf_surface_desc>();
  d.positions = HF_ARRAY(s.positions.data(), s.vertex_count);
  d.triangles = HF_ARRAY(s.triangles.data(), s.triangle_count);
  return d;
}

hf_result add_one(hf_solver solver, std::uint32_t vertex, double value) {
  hf_sites_desc d = desc<hf_sites_desc>();
  d.site_count = 1;
  d.vertices = &vertex;
  d.values = &value;
  return hf_add_sites(solver, &d, nullptr);
}

void arguments(const Scene& s) {
  hf_surface surface = nullptr;
  hf_surface_desc d = scene_desc(s);
  provoke(hf_surface_create(nullptr, &surface), "no desc");
  provoke(hf_surface_get_report(nullptr, nullptr), "no surface");
  d.weld = 9;
  provoke(hf_surface_create(&d, &surface), "weld 9");
  d = scene_desc(s);
  d.struct_size = 1;
  provoke(hf_surface_create(&d, &surface), "struct_size 1");
  d = scene_desc(s);
  d.positions.count = 0;
  provoke(hf_surface_create(&d, &surface), "no vertices");
  d = scene_desc(s);
  d.vertex_limit = 1;
  provoke(hf_surface_create(&d, &surface), "vertex_limit 1");
  d = scene_desc(s);
  d.positions.count = 7;
  provoke(hf_surface_create(&d, &surface), "triangles beyond the vertices");
  d = scene_desc(s);
  d.positions.stride = 1;
  provoke(hf_surface_create(&d, &surface), "stride 1");
  std::vector<float> infinite = s.positions;
  infinite[5] = HUGE_VALF;
  d = scene_desc(s);
  d.positions = HF_ARRAY(infinite.data(), s.vertex_count);
  provoke(hf_surface_create(&d, &surface), "an infinite position");
  Mesh large;
  add_torus(large, 100, 80);
  d = surface_desc(large);
  d.memory_limit_mb = 1;
  provoke(hf_surface_create(&d, &surface), "a limit of one MiB");
}

void states(const Scene& s) {
  const hf_surface_desc d = scene_desc(s);
  const hf_surface surface = make_surface(d);
  hf_solver solver = nullptr;
  provoke(hf_create(surface, nullptr, &solver), "a solver");
  double value = 0;
  const std::uint32_t vertex = 3, none = 77;
  provoke(hf_solver_solve_at(solver, 1, &vertex, &value), "a field without sites");
  provoke(add_one(solver, 3, 1), "a site");
  provoke(add_one(solver, 3, 1), "the same again");
  provoke(add_one(solver, 3, 2), "another value there");
  provoke(hf_remove_sites(solver, 1, &none), "an absent site");
  hf_certificate certificate = desc<hf_certificate>();
  add_one(solver, 200, 2);
  certificate.tolerance = 1e-300;
  provoke(hf_solver_certify(solver, &certificate), "a tolerance no field can meet");

  hf_pose pose = nullptr;
  hf_transfer transfer = nullptr;
  must(hf_pose_create(surface, nullptr, &pose), "hf_pose_create");
  const std::uint32_t counts[2] = {1, 1}, same[2] = {9, 9};
  hf_handles_desc handles = desc<hf_handles_desc>();
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = same;
  provoke(hf_pose_add_handles(pose, &handles, nullptr), "two handles on one vertex");
  provoke(hf_pose_remove_handles(pose, 1, &none), "an absent handle");
  must(hf_transfer_create(surface, surface, nullptr, &transfer), "hf_transfer_create");
  provoke(hf_transfer_remove_pairs(transfer, 1, &none), "an absent pair");
  hf_pose_destroy(pose);
  hf_transfer_destroy(transfer);
  hf_solver_destroy(solver);

  solver = make_solver(surface, desc<hf_solver_desc>(), ENGINE_REFACTOR);
  add_one(solver, 3, 1);
  provoke(hf_solver_prepare_rebase(solver), "a rebase of a baseline");
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);

  hf_progress progress = nullptr;
  must(hf_progress_create(&progress), "hf_progress_create");
  must(hf_progress_cancel(progress), "hf_progress_cancel");
  hf_surface_desc cancelled = scene_desc(s);
  cancelled.progress = progress;
  hf_surface none_made = nullptr;
  provoke(hf_surface_create(&cancelled, &none_made), "cancelled before it began");
  hf_progress_destroy(progress);
}

// A host whose hooks call the library, or throw.
struct Hooks {
  enum { plain, call_back, hold, wreck } mode = plain;
  hf_solver solver = nullptr;
  hf_result answer = HF_OK;
};
void* allocate(void* user, std::size_t size, std::size_t alignment) {
  Hooks& hooks = *static_cast<Hooks*>(user);
  const auto mode = hooks.mode;
  hooks.mode = Hooks::plain;
  if (mode == Hooks::call_back)
    provoke(hooks.answer = hf_solver_set_screening(hooks.solver, nullptr, nullptr), "a call from a callback");
  if (mode == Hooks::hold)
    std::thread([&] {
      provoke(hooks.answer = hf_solver_set_screening(hooks.solver, nullptr, nullptr), "a call beside a change");
    }).join();
  if (mode == Hooks::wreck) throw std::runtime_error("a fault of the host");
  const std::size_t step = alignment < 16 ? 16 : alignment;
  return aligned_alloc(step, (size + step - 1) / step * step);
}
void release(void*, void* block, std::size_t, std::size_t) { free(block); }

void callbacks(const Scene& s) {
  Hooks hooks;
  hf_surface_desc d = scene_desc(s);
  d.allocator = {allocate, release, &hooks};
  hooks.solver = make_solver(d);
  for (const auto mode : {Hooks::call_back, Hooks::hold, Hooks::wreck}) {
    hooks.mode = mode;
    provoke(add_one(hooks.solver, 20 + static_cast<std::uint32_t>(mode), 1), "an edit with a faulty hook");
  }
  hf_solver_destroy(hooks.solver);
}

// Two needles of length 1e34 that overlap for nearly all of it. The surface is accepted. The heat method for distances
// finds next to no area there, and its factor has a failed pivot.
void indefinite() {
  const double positions[] = {0, 0, 0, -1.0384593717069655e34, 0, 0, 0, 1, 0, -1.038467170729213e34, 0, 0, 0, 0, 1};
  const std::uint32_t triangles[] = {0, 1, 3, 1, 2, 4};
  hf_surface_desc d = desc<hf_surface_desc>();
  d.positions = HF_ARRAY(positions, 5);
  d.triangles = HF_ARRAY(triangles, 2);
  d.operator_kind = HF_OPERATOR_COTANGENT;
  hf_surface surface = nullptr;
  provoke(hf_surface_create(&d, &surface), "two needles");
  hf_geodesics geodesics = nullptr;
  hf_geodesics_desc heat = HF_INIT(hf_geodesics_desc);
  heat.method = HF_GEODESICS_HEAT;
  provoke(hf_geodesics_create(surface, &heat, &geodesics), "the heat on two needles");
  hf_geodesics_destroy(geodesics);
  hf_surface_destroy(surface);
}

}  // namespace

int main() {
  const Scene scene = make_scene();
  arguments(scene);
  states(scene);
  callbacks(scene);
  indefinite();
  unsigned named = 0, missing = 0;
  for (hf_result code = -400; code <= 0; ++code) {
    if (std::strcmp(hf_result_get_name(code), "unknown") == 0) continue;
    ++named;
    if (seen.count(code)) continue;
    ++missing;
    fprintf(stderr, "never returned: %s\n", hf_result_get_name(code));
  }
  report_at_least("RESULT_CODES", named, 21);
  report_at_most("RESULT_CODES_NEVER_RETURNED", missing, 0);
  report_at_most("RESULT_CODES_WITH_A_WRONG_DETAIL", wrong_details, 0);
  return report_status();
}
