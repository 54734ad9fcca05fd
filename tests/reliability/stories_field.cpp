// Solvers, sites, fields, factors.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "stories.h"

namespace refusal {
namespace {

struct Head {
  void* base;
  std::size_t size, alignment;
};

void* allocate(void* user, std::size_t size, std::size_t alignment) {
  Allocator& a = *static_cast<Allocator*>(user);
  ++a.calls;
  if (a.refuse_at && (a.calls == a.refuse_at || (a.refuse_on && a.calls > a.refuse_at))) return ++a.refused, nullptr;
  char* const base = static_cast<char*>(std::malloc(size + alignment + sizeof(Head)));
  if (!base) std::abort();
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(base + sizeof(Head));
  char* const block = base + sizeof(Head) + ((first + alignment - 1) / alignment * alignment - first);
  const Head head = {base, size, alignment};
  std::memcpy(block - sizeof head, &head, sizeof head);
  ++a.live_blocks, a.live_bytes += size;
  return block;
}

void release(void* user, void* block, std::size_t size, std::size_t alignment) {
  Allocator& a = *static_cast<Allocator*>(user);
  Head head;
  std::memcpy(&head, static_cast<char*>(block) - sizeof head, sizeof head);
  a.mismatches += head.size != size || head.alignment != alignment;
  --a.live_blocks, a.live_bytes -= head.size;
  std::free(head.base);
}

hf_sites_desc sites_at(std::uint32_t count, const std::uint32_t* vertices, const double* values) {
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  desc.site_count = count, desc.vertices = vertices, desc.values = values;
  return desc;
}

const double values[12] = {0, 1, 3, -2, 5, 4, 2, 2.5, -1, 7, 0.5, 6};

void take_field(Story& s, hf_solver solver, std::size_t channels = 1) {
  std::vector<double> field(Tube::vertices * channels);
  s.call("hf_solver_solve_f64", [&] { return hf_solver_solve_f64(solver, field.data(), 0, nullptr); });
  s.take(field.data(), field.size());
}

// Edits of every kind, undo, redo and a clone.
void edits(Story& s, hf_create_desc desc) {
  hf_solver solver = nullptr, copy = nullptr;
  s.make("hf_create", solver, [&] { return hf_create(&desc, &solver); });
  if (!solver) return;
  const std::uint32_t places[4] = {0, 30, 51, 79}, others[3] = {5, 44, 62};
  std::uint32_t numbers[4] = {0, 0, 0, 0};
  const hf_sites_desc first = sites_at(4, places, values), second = sites_at(3, others, values + 4);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &first, numbers); });
  s.call("hf_solver_record", [&] { return hf_solver_record(solver); });
  const std::uint32_t to = 20;
  const hf_sites_desc there = sites_at(1, &to, nullptr);
  s.call("hf_solver_move_sites", [&] { return hf_solver_move_sites(solver, 1, &numbers[1], &there); });
  s.call("hf_solver_set_values", [&] { return hf_solver_set_values(solver, 2, &numbers[2], values + 7); });
  take_field(s, solver);
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.remove_count = 1, edit.remove_sites = &numbers[0], edit.add = &second;
  s.call("hf_solver_edit_sites", [&] { return hf_solver_edit_sites(solver, &edit, nullptr); });
  s.make("hf_solver_clone", copy, [&] { return hf_solver_clone(solver, &copy); });
  take_field(s, solver);
  // a refused undo leaves nothing to redo
  s.call(
      "hf_solver_undo", [&] { return hf_solver_undo(solver); }, [&] { return hf_solver_redo(solver) == HF_ERROR_NO_RECORD; });
  take_field(s, solver);
  s.call("hf_solver_redo", [&] { return hf_solver_redo(solver); });
  s.call("hf_remove_sites", [&] { return hf_remove_sites(copy, 1, &numbers[3]); });
  take_field(s, copy);
  double some[2], flux[16];
  const std::uint32_t asked[2] = {7, 70};
  s.call("hf_solver_solve_at", [&] { return hf_solver_solve_at(solver, 2, asked, some); });
  s.take(some, 2);
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 16, info.flux = flux;
  s.call("hf_solver_get_sites", [&] { return hf_solver_get_sites(solver, &info); });
  s.take(flux, hf_solver_get_site_count(solver));
  hf_certificate certificate = HF_INIT(hf_certificate);
  s.call("hf_solver_certify", [&] { return hf_solver_certify(solver, &certificate); });
  s.call("hf_solver_undo", [&] { return hf_solver_undo(solver); });
  s.refused("hf_solver_undo", HF_ERROR_NO_RECORD, [&] { return hf_solver_undo(solver); });
  hf_solver_destroy(solver), hf_solver_destroy(copy);
}

void green(Story& s, const Tube& tube, Allocator& memory) { edits(s, tube.desc(memory)); }
void refactor(Story& s, const Tube& tube, Allocator& memory) {
  hf_create_desc desc = tube.desc(memory);
  desc.engine = HF_ENGINE_REFACTOR;
  edits(s, desc);
}
#ifdef HF_WITH_GPL
void updown(Story& s, const Tube& tube, Allocator& memory) {
  hf_create_desc desc = tube.desc(memory);
  desc.engine = HF_ENGINE_UPDOWN;
  edits(s, desc);
}
#endif
void biharmonic(Story& s, const Tube& tube, Allocator& memory) {
  hf_create_desc desc = tube.desc(memory);
  desc.field_kind = HF_FIELD_BIHARMONIC, desc.ordering = HF_ORDERING_MINIMUM_DEGREE;
  edits(s, desc);
}

// Points, soft sites, discs, two channels.
void points_and_discs(Story& s, const Tube& tube, Allocator& memory) {
  hf_create_desc desc = tube.desc(memory);
  desc.channel_count = 2, desc.operator_kind = HF_OPERATOR_CLAMPED;
  hf_solver solver = nullptr;
  s.make("hf_create", solver, [&] { return hf_create(&desc, &solver); });
  if (!solver) return;
  const std::uint32_t triangles[2] = {10, 90}, places[2] = {36, 3};
  const double weights[6] = {0.25, 0.25, 0.5, 0.5, 0.25, 0.25}, stiffness[2] = {0, 40}, radii[2] = {1.2, 0};
  hf_sites_desc points = sites_at(2, nullptr, values), discs = sites_at(2, places, values + 4);
  points.triangles = triangles, points.barycentrics = weights, points.stiffness = stiffness;
  discs.radii = radii;
  std::uint32_t numbers[2];
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &points, nullptr); });
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &discs, numbers); });
  take_field(s, solver, 2);
  const std::uint32_t to = 60;
  const hf_sites_desc there = sites_at(1, &to, nullptr);
  s.call("hf_solver_move_sites", [&] { return hf_solver_move_sites(solver, 1, numbers, &there); });
  std::vector<float> field(2 * Tube::vertices);
  s.call("hf_solve", [&] { return hf_solve(solver, field.data(), 0, nullptr); });
  s.take(field.data(), field.size());
  hf_solver_destroy(solver);
}

// Sites moved into the factor.
void rebase(Story& s, const Tube& tube, Allocator& memory) {
  const hf_create_desc desc = tube.desc(memory);
  hf_solver solver = nullptr;
  s.make("hf_create", solver, [&] { return hf_create(&desc, &solver); });
  if (!solver) return;
  std::uint32_t places[12], numbers[12];
  for (std::uint32_t i = 0; i < 12; ++i) places[i] = 6 * i;
  const hf_sites_desc sites = sites_at(12, places, values);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &sites, numbers); });
  s.call("hf_solver_prepare_rebase", [&] { return hf_solver_prepare_rebase(solver); });
  s.call("hf_solver_set_values", [&] { return hf_solver_set_values(solver, 1, numbers, values + 3); });
  take_field(s, solver);
  s.call("hf_remove_sites", [&] { return hf_remove_sites(solver, 2, numbers + 4); });
  const std::uint32_t place = 33;
  const hf_sites_desc more = sites_at(1, &place, values + 9);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &more, nullptr); });
  take_field(s, solver);
  hf_solver_destroy(solver);
}

// The factor as bytes, previews.
void bytes(Story& s, const Tube& tube, Allocator& memory) {
  hf_create_desc desc = tube.desc(memory);
  hf_solver solver = nullptr, loaded = nullptr;
  s.make("hf_create", solver, [&] { return hf_create(&desc, &solver); });
  if (!solver) return;
  std::size_t size = 0;
  s.call("hf_get_factor_size", [&] { return hf_get_factor_size(solver, &size); });
  std::vector<char> saved(size);
  s.call("hf_surface_save", [&] { return hf_surface_save(solver, saved.data(), size); });
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = saved.data(), factor.byte_count = size;
  desc.saved_factor = &factor;
  s.make("hf_create", loaded, [&] { return hf_create(&desc, &loaded); });
  hf_solver_destroy(solver);
  if (!loaded) return;
  const std::uint32_t places[3] = {2, 40, 77};
  const hf_sites_desc sites = sites_at(3, places, values + 1);
  s.call("hf_add_sites", [&] { return hf_add_sites(loaded, &sites, nullptr); });
  std::vector<double> field(Tube::vertices);
  s.call("hf_solver_solve_preview_f64", [&] { return hf_solver_solve_preview_f64(loaded, field.data(), 0, 2, nullptr); });
  s.take(field.data(), field.size());
  s.call("hf_solver_release_preview", [&] { return hf_solver_release_preview(loaded); });
  hf_solver_destroy(loaded);
}

// Tangent vectors by three channels.
void vectors(Story& s, const Tube& tube, Allocator& memory) {
  hf_create_desc desc = tube.desc(memory);
  desc.channel_count = 3;
  hf_solver solver = nullptr;
  s.make("hf_create", solver, [&] { return hf_create(&desc, &solver); });
  if (!solver) return;
  const std::uint32_t places[3] = {1, 35, 78}, to = 50;
  std::uint32_t numbers[3] = {0, 0, 0};
  const hf_sites_desc sites = sites_at(3, places, values);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &sites, numbers); });
  s.call("hf_solver_move_vectors", [&] { return hf_solver_move_vectors(solver, 1, numbers + 1, &to); });
  const double angle = 0.7;
  s.call("hf_solver_rotate_vectors", [&] { return hf_solver_rotate_vectors(solver, 1, numbers, &angle); });
  std::vector<double> field(3 * Tube::vertices), normals(3 * Tube::vertices);
  s.call("hf_solver_solve_vectors_f64",
         [&] { return hf_solver_solve_vectors_f64(solver, field.data(), 0, normals.data(), nullptr); });
  s.take(field.data(), field.size()), s.take(normals.data(), normals.size());
  hf_solver_destroy(solver);
}

}  // namespace

hf_allocator Allocator::hooks() { return {allocate, release, this}; }

void Story::check_detail(const char* function) {
  hf_error_detail detail;
  if (hf_error_get_detail(&detail) != HF_OK || detail.code != HF_ERROR_OUT_OF_MEMORY ||
      std::strcmp(detail.function, function) != 0)
    wrong(std::string(function) + ": the detail speaks of " + detail.function + ", " + hf_result_get_name(detail.code));
}

Tube::Tube() {
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const double ring = v / around, turn = 6.283185307179586 * (v % around) / around,
                 bump = 1 + 0.1 * std::sin(1.7 * ring);
    positions.insert(positions.end(), {bump * std::cos(turn), 0.8 * ring, bump * std::sin(turn)});
    height.push_back(0.8 * ring + 0.01 * std::sin(2.3 * v));
  }
  for (std::uint32_t a = 0; a + around < vertices; ++a) {
    const std::uint32_t b = a / around * around + (a + 1) % around;
    triangles.insert(triangles.end(), {a, a + around, b, b, a + around, b + around});
  }
  for (std::uint32_t i = 0; i < 2 * around; ++i) ends.push_back(i);
  for (std::uint32_t i = 0; i < 2 * around; ++i) ends.push_back((rings - 2) * around + i);
}

hf_create_desc Tube::desc(Allocator& memory) const {
  hf_create_desc d = HF_INIT(hf_create_desc);
  d.vertex_count = vertices, d.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
  d.positions_f64 = positions.data(), d.triangles = triangles.data(), d.allocator = memory.hooks();
  return d;
}

std::vector<Chapter> field_chapters() {
  return {{"green", green},           {"refactor", refactor},
#ifdef HF_WITH_GPL
          {"updown", updown},
#endif
          {"biharmonic", biharmonic}, {"points_and_discs", points_and_discs},
          {"rebase", rebase},         {"bytes", bytes},
          {"vectors", vectors}};
}

}  // namespace refusal
