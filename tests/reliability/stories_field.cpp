// Stories of surfaces, solvers, sites, fields and saved factors.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>

#include "../support/place_in.h"
#include "headed_blocks.h"
#include "stories.h"
#include "support/arrays.h"
#include "support/peers.h"

namespace refusal {
namespace {

void* allocate(void* user, std::size_t size, std::size_t alignment) {
  Allocator& a = *static_cast<Allocator*>(user);
  ++a.calls;
  // the library asks again for what it did not get, when it has given back the blocks it kept: that is the same refusal
  const bool again = a.refused > 0 && a.calls == a.refuse_at + 1 && size == a.refused_size;
  if (a.refuse_at && (a.calls == a.refuse_at || again || (a.refuse_on && a.calls > a.refuse_at))) {
    a.refused_size = size;
    return ++a.refused, nullptr;
  }
  ++a.live_blocks;
  a.live_bytes += size;
  return reliability::take_block(size, alignment);
}

void release(void* user, void* block, std::size_t size, std::size_t alignment) {
  Allocator& a = *static_cast<Allocator*>(user);
  const reliability::BlockHead head = reliability::give_block(block);
  a.mismatches += head.size != size || head.alignment != alignment;
  --a.live_blocks;
  a.live_bytes -= head.size;
}

hf_sites_desc sites_at(std::uint32_t count, const std::uint32_t* vertices, const double* values) {
  hf_sites_desc desc = HF_INIT(hf_sites_desc);
  desc.site_count = count;
  desc.vertices = vertices;
  desc.values = values;
  return desc;
}

const double values[12] = {0, 1, 3, -2, 5, 4, 2, 2.5, -1, 7, 0.5, 6};

void take_field(Story& s, hf_solver solver, std::size_t channels = 1) {
  std::vector<double> field(Tube::vertices * channels);
  s.call("hf_solver_solve", [&] { return hf_solver_solve(solver, OUT(field.data()), nullptr); });
  s.take(field.data(), field.size());
}

// A solver on a surface of its own, which is destroyed at once.
hf_solver made(Story& s, const hf_surface_desc& on, const hf_solver_desc& desc, std::int32_t engine = ENGINE_GREEN) {
  hf_surface surface = nullptr;
  hf_solver solver = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&on, &surface); });
  const char* const call = engine == ENGINE_UPDOWN     ? "hf_peer_updown_create"
                           : engine == ENGINE_REFACTOR ? "hf_peer_refactor_create"
                                                       : "hf_create";
  if (surface) s.make_factor(call, solver, [&] { return create_with(engine, surface, &desc, &solver); });
  hf_surface_destroy(surface);
  return solver;
}

// Edits of every kind, a clone from before them and one from after.
void edits(Story& s, const hf_surface_desc& on, const hf_solver_desc& desc, std::int32_t engine = ENGINE_GREEN) {
  const hf_solver solver = made(s, on, desc, engine);
  hf_solver before = nullptr, copy = nullptr;
  if (!solver) return;
  const std::uint32_t places[4] = {0, 30, 51, 79}, others[3] = {5, 44, 62};
  std::uint32_t numbers[4] = {0, 0, 0, 0};
  const hf_sites_desc first = sites_at(4, places, values), second = sites_at(3, others, values + 4);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &first, numbers); });
  s.make("hf_solver_clone", before, [&] { return hf_solver_clone(solver, &before); });
  const std::uint32_t to = 20;
  const hf_sites_desc there = sites_at(1, &to, nullptr);
  s.call("hf_solver_move_sites", [&] { return hf_solver_move_sites(solver, 1, &numbers[1], &there); });
  s.call("hf_solver_set_values", [&] { return hf_solver_set_values(solver, 2, &numbers[2], values + 7); });
  take_field(s, solver);
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.remove_count = 1;
  edit.remove_sites = &numbers[0];
  edit.add = &second;
  s.call("hf_solver_edit_sites", [&] { return hf_solver_edit_sites(solver, &edit, nullptr); });
  s.make("hf_solver_clone", copy, [&] { return hf_solver_clone(solver, &copy); });
  take_field(s, solver);
  take_field(s, before);
  if (engine == ENGINE_GREEN && desc.field_kind == HF_FIELD_HARMONIC) {
    const std::vector<double> screening(Tube::vertices, 0.5), targets(Tube::vertices, 2.0);
    s.call("hf_solver_set_screening",
           [&] { return hf_solver_set_screening(solver, screening.data(), targets.data()); });
    take_field(s, solver);
    s.call("hf_solver_set_screening", [&] { return hf_solver_set_screening(solver, nullptr, nullptr); });
  }
  s.call("hf_remove_sites", [&] { return hf_remove_sites(copy, 1, &numbers[3]); });
  take_field(s, copy);
  double some[2], flux[16];
  const std::uint32_t asked[2] = {7, 70};
  s.call("hf_solver_solve_at", [&] { return hf_solver_solve_at(solver, 2, asked, some); });
  s.take(some, 2);
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 16;
  info.flux = flux;
  s.call("hf_solver_get_sites", [&] { return hf_solver_get_sites(solver, &info); });
  s.take(flux, hf_solver_get_site_count(solver));
  hf_certificate certificate = HF_INIT(hf_certificate);
  s.call("hf_solver_certify", [&] { return hf_solver_certify(solver, &certificate); });
  hf_solver_destroy(solver);
  take_field(s, before);
  hf_solver_destroy(before);
  hf_solver_destroy(copy);
}

// A stroke of stiffness: fields and a pose move to the edited surface and back.
void edited(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface_desc on = tube.desc(memory);
  hf_surface surface = nullptr, stiff = nullptr;
  hf_solver solver = nullptr;
  hf_pose pose = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&on, &surface); });
  if (surface) s.make("hf_create", solver, [&] { return hf_create(surface, nullptr, &solver); });
  if (surface) s.make("hf_pose_create", pose, [&] { return hf_pose_create(surface, nullptr, &pose); });
  if (!solver || !pose) return;
  const std::uint32_t places[3] = {0, 40, 79}, counts[2] = {2 * Tube::around, 2 * Tube::around};
  const hf_sites_desc sites = sites_at(3, places, values);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &sites, nullptr); });
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = tube.ends.data();
  s.call("hf_pose_add_handles", [&] { return hf_pose_add_handles(pose, &handles, nullptr); });
  const std::uint32_t belt[4] = {30, 31, 32, 33};
  const double stiffness[4] = {20, 20, 0.5, 20};
  hf_surface_edit_desc edit = HF_INIT(hf_surface_edit_desc);
  edit.vertex_count = 4;
  edit.vertices = belt;
  edit.stiffness = stiffness;
  const hf_link link = {50, {2, HF_NO_INDEX, HF_NO_INDEX}, {1, 0, 0}, 0, 2, 0, 0};
  edit.link_count = 1;
  edit.links = &link;
  s.make("hf_surface_edit", stiff, [&] { return hf_surface_edit(surface, &edit, &stiff); });
  const hf_surface way[2] = {stiff, surface};
  for (const hf_surface to : way) {
    s.call("hf_solver_move_to", [&] { return hf_solver_move_to(solver, to); });
    take_field(s, solver);
    std::vector<double> posed(3 * Tube::vertices);
    hf_deform_desc deform = HF_INIT(hf_deform_desc);
    deform.positions = ROWS_OUT(posed.data());
    deform.restart = 1;
    s.call("hf_pose_move_to", [&] { return hf_pose_move_to(pose, to); });
    s.call("hf_pose_deform", [&] { return hf_pose_deform(pose, &deform, nullptr); });
    s.take(posed.data(), posed.size());
  }
  hf_surface_destroy(stiff);
  // triangles go and come beside the factor, and a slit opens
  const std::uint32_t gone[4] = {60, 61, 62, 63}, slit[4] = {20, 21, 21, 22};
  std::vector<std::uint32_t> fans;
  std::vector<double> middles;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t* const v = &tube.triangles[3 * gone[i]];
    for (std::size_t x = 0; x < 3; ++x) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(tube.positions[3 * v[k] + x]) / 3;
      middles.push_back(sum);
    }
    for (std::size_t k = 0; k < 3; ++k) fans.insert(fans.end(), {v[k], v[(k + 1) % 3], Tube::vertices + i});
  }
  hf_patch_desc patches[2] = {HF_INIT(hf_patch_desc), HF_INIT(hf_patch_desc)};
  patches[0].removed_triangle_count = patches[0].new_vertex_count = 4;
  patches[0].removed_triangles = gone;
  patches[0].new_positions = middles.data();
  patches[0].new_triangle_count = 12;
  patches[0].new_triangles = fans.data();
  patches[1].cut_edge_count = 2;
  patches[1].cut_edges = slit;
  for (const hf_patch_desc& patch : patches) {
    edit = HF_INIT(hf_surface_edit_desc);
    edit.patch = &patch;
    hf_surface made = nullptr;
    s.make("hf_surface_edit", made, [&] { return hf_surface_edit(surface, &edit, &made); });
    if (!made) break;
    s.call("hf_solver_move_to", [&] { return hf_solver_move_to(solver, made); });
    std::vector<double> field(Tube::vertices + 4);
    s.call("hf_solver_solve", [&] { return hf_solver_solve(solver, OUT(field.data()), nullptr); });
    s.take(field.data(), field.size());
    hf_surface_report report = HF_INIT(hf_surface_report);
    s.call("hf_surface_get_report", [&] { return hf_surface_get_report(made, &report); });
    hf_surface_destroy(surface);
    surface = made;
  }
  hf_surface_destroy(surface);
  hf_solver_destroy(solver);
  hf_pose_destroy(pose);
}

void green(Story& s, const Tube& tube, Allocator& memory) { edits(s, tube.desc(memory), HF_INIT(hf_solver_desc)); }
void refactor(Story& s, const Tube& tube, Allocator& memory) {
  edits(s, tube.desc(memory), HF_INIT(hf_solver_desc), ENGINE_REFACTOR);
}
void updown(Story& s, const Tube& tube, Allocator& memory) {
  edits(s, tube.desc(memory), HF_INIT(hf_solver_desc), ENGINE_UPDOWN);
}
void biharmonic(Story& s, const Tube& tube, Allocator& memory) {
  hf_surface_desc on = tube.desc(memory);
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  on.field_kind = desc.field_kind = HF_FIELD_BIHARMONIC;
  on.ordering = HF_ORDERING_MINIMUM_DEGREE;
  edits(s, on, desc);
}

// Points in triangles, soft sites and discs, with two channels.
void points_and_discs(Story& s, const Tube& tube, Allocator& memory) {
  hf_surface_desc on = tube.desc(memory);
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.channel_count = 2;
  on.operator_kind = HF_OPERATOR_CLAMPED;
  const hf_solver solver = made(s, on, desc);
  if (!solver) return;
  const std::uint32_t places[2] = {36, 3};
  const double weights[6] = {0.25, 0.25, 0.5, 0.5, 0.25, 0.25}, stiffness[2] = {0, 40}, radii[2] = {1.2, 0};
  hf_sites_desc points = sites_at(2, nullptr, values), discs = sites_at(2, places, values + 4);
  const auto inside_of = [&](std::uint32_t t, const double* w) {
    return place_in(tube.triangles.data(), static_cast<std::uint32_t>(tube.triangles.size() / 3), t, w);
  };
  const hf_place inside[2] = {inside_of(10, weights), inside_of(90, weights + 3)};
  points.places = inside;
  points.stiffness = stiffness;
  discs.radii = radii;
  std::uint32_t numbers[2];
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &points, nullptr); });
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &discs, numbers); });
  take_field(s, solver, 2);
  const double in_space[6] = {0.9, 2.3, 0.5, -0.8, 6.6, 0.7}, elsewhere[3] = {0.2, 4.4, -1};
  hf_sites_desc nearest = sites_at(2, nullptr, values + 8), there = sites_at(1, nullptr, nullptr);
  nearest.points = in_space;
  there.points = elsewhere;
  const auto same_count = [&] { return hf_solver_get_site_count(solver) == 4; };
  s.call(
      "hf_add_sites", [&] { return hf_add_sites(solver, &nearest, nullptr); }, same_count);
  s.call("hf_solver_move_sites", [&] { return hf_solver_move_sites(solver, 1, numbers, &there); });
  std::vector<float> field(2 * Tube::vertices);
  s.call("hf_solve", [&] { return hf_solve(solver, field.data(), 0, nullptr); });
  s.take(field.data(), field.size());
  hf_solver_destroy(solver);
}

// A rebase, and edits after it.
void rebase(Story& s, const Tube& tube, Allocator& memory) {
  const hf_solver solver = made(s, tube.desc(memory), HF_INIT(hf_solver_desc));
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

// Factors of two kinds saved, one loaded, and previews. The surface lacks the first kind, so saving makes it.
void bytes(Story& s, const Tube& tube, Allocator& memory) {
  hf_surface_desc desc = tube.desc(memory);
  hf_surface surface = nullptr, again = nullptr;
  hf_solver loaded = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&desc, &surface); });
  if (!surface) return;
  std::vector<char> saved;
  for (const int kind : {HF_FIELD_BIHARMONIC_GRAPH, HF_FIELD_HARMONIC}) {
    std::size_t size = 0;
    s.call("hf_surface_save", [&] { return hf_surface_save(surface, kind, nullptr, 0, nullptr, &size); });
    saved.resize(size);
    s.call("hf_surface_save", [&] { return hf_surface_save(surface, kind, nullptr, size, saved.data(), nullptr); });
    s.take(static_cast<double>(size));
  }
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.bytes = saved.data();
  factor.byte_count = saved.size();
  desc.saved_factor = &factor;
  s.make_factor("hf_surface_create", again, [&] { return hf_surface_create(&desc, &again); });
  hf_surface_destroy(surface);
  if (again) s.make_factor("hf_create", loaded, [&] { return hf_create(again, nullptr, &loaded); });
  hf_surface_destroy(again);
  if (!loaded) return;
  const std::uint32_t places[3] = {2, 40, 77};
  const hf_sites_desc sites = sites_at(3, places, values + 1);
  s.call("hf_add_sites", [&] { return hf_add_sites(loaded, &sites, nullptr); });
  std::vector<double> field(Tube::vertices);
  s.call("hf_solver_solve_preview", [&] { return hf_solver_solve_preview(loaded, OUT(field.data()), 2, nullptr); });
  s.take(field.data(), field.size());
  s.call("hf_solver_release_preview", [&] { return hf_solver_release_preview(loaded); });
  hf_solver_destroy(loaded);
}

// A surface that two solvers and a pose share, picked, and destroyed before they are used.
void shared(Story& s, const Tube& tube, Allocator& memory) {
  const hf_surface_desc desc = tube.desc(memory);
  hf_surface surface = nullptr;
  hf_solver first = nullptr, second = nullptr;
  hf_pose pose = nullptr;
  s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&desc, &surface); });
  if (!surface) return;
  std::vector<std::uint32_t> components(Tube::vertices);
  s.call("hf_surface_get_components",
         [&] { return hf_surface_get_components(surface, Tube::vertices, components.data(), nullptr); });
  const double origin[3] = {5, 2.1, 0.1}, along[3] = {-1, 0, 0};
  hf_hit hit = HF_INIT(hf_hit);
  s.call("hf_surface_cast_ray", [&] { return hf_surface_cast_ray(surface, origin, along, nullptr, &hit); });
  s.take(hit.triangle);
  s.take(hit.place.barycentrics, 3);
  s.take(hit.distance);
  std::uint32_t vertex = HF_NO_INDEX;
  s.call("hf_surface_find_vertex", [&] { return hf_surface_find_vertex(surface, origin, nullptr, &vertex, nullptr); });
  s.make_factor("hf_create", first, [&] { return hf_create(surface, nullptr, &first); });
  s.make_factor("hf_create", second, [&] { return hf_create(surface, nullptr, &second); });
  s.make_factor("hf_pose_create", pose, [&] { return hf_pose_create(surface, nullptr, &pose); });
  hf_surface_destroy(surface);
  s.refused("hf_surface_get_components", HF_ERROR_INVALID_OBJECT,
            [&] { return hf_surface_get_components(surface, 0, nullptr, nullptr); });
  for (const hf_solver solver : {first, second}) {
    const double value = solver == first ? 1 : -1;
    s.call("hf_solver_add_site", [&] { return hf_solver_add_site(solver, vertex, &value, nullptr); });
    s.call("hf_solver_add_site", [&] { return hf_solver_add_site(solver, 3, nullptr, nullptr); });
    take_field(s, solver);
  }
  std::uint32_t handle = 0;
  s.call("hf_pose_add_handle_at", [&] { return hf_pose_add_handle_at(pose, tube.positions.data(), 1, &handle); });
  const hf_transform moved = {{0, 0, 0, 1}, {0.5, 1, 0}};
  s.call("hf_pose_set_transform", [&] { return hf_pose_set_transform(pose, handle, &moved); });
  std::vector<float> posed(3 * Tube::vertices);
  s.call("hf_deform", [&] { return hf_deform(pose, posed.data(), nullptr); });
  s.take(posed.data(), posed.size());
  hf_solver_destroy(first);
  hf_solver_destroy(second);
  hf_pose_destroy(pose);
}

// Factors that the surface lacks, made by a solver, a region and a pose. A refused making must leave the surface and
// its memory as they were; the second try makes the factor.
void missing_kinds(Story& s, const Tube& tube, Allocator& memory) {
  const int turns = memory.refuse_at ? 3 : 6;  // the second time round, memory must not grow
  for (const int own : {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC}) {
    hf_surface_desc desc = tube.desc(memory);
    desc.field_kind = own;
    hf_surface surface = nullptr;
    s.make_factor("hf_surface_create", surface, [&] { return hf_surface_create(&desc, &surface); });
    if (!surface) return;
    for (int turn = 0; turn < turns; ++turn) {
      const int kind = turn % 3;
      const std::size_t bytes = memory.live_bytes;
      hf_solver_desc wanted = HF_INIT(hf_solver_desc);
      wanted.field_kind = kind;
      hf_solver solver = nullptr;
      s.make_factor("hf_create", solver, [&] { return hf_create(surface, &wanted, &solver); });
      const std::uint32_t places[3] = {2, 40, 77};
      const hf_sites_desc sites = sites_at(3, places, values + 1);
      s.call("hf_add_sites", [&] { return hf_add_sites(solver, &sites, nullptr); });
      if (turn < 3) take_field(s, solver);
      hf_solver_destroy(solver);
      // the first turns leave workspaces for later ones
      s.holds(turn < 3 || memory.live_bytes <= bytes, "a factor that no object uses is still there");
      hf_region_desc bare = HF_INIT(hf_region_desc);
      bare.base = HF_BASE_MEMBRANE + kind;
      hf_region region = nullptr;
      s.make_factor("hf_region_create", region, [&] { return hf_region_create(surface, &bare, &region); });
      hf_region_destroy(region);
      hf_pose pose = nullptr;
      s.make_factor("hf_pose_create", pose, [&] { return hf_pose_create(surface, nullptr, &pose); });
      hf_pose_destroy(pose);
    }
    hf_surface_destroy(surface);
  }
}

// Tangent vectors by three channels.
void vectors(Story& s, const Tube& tube, Allocator& memory) {
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.channel_count = 3;
  const hf_solver solver = made(s, tube.desc(memory), desc);
  if (!solver) return;
  const std::uint32_t places[3] = {1, 35, 78}, to = 50;
  std::uint32_t numbers[3] = {0, 0, 0};
  const hf_sites_desc sites = sites_at(3, places, values);
  s.call("hf_add_sites", [&] { return hf_add_sites(solver, &sites, numbers); });
  s.call("hf_solver_move_vectors", [&] { return hf_solver_move_vectors(solver, 1, numbers + 1, &to); });
  const double angle = 0.7;
  s.call("hf_solver_rotate_vectors", [&] { return hf_solver_rotate_vectors(solver, 1, numbers, &angle); });
  std::vector<double> field(3 * Tube::vertices), normals(3 * Tube::vertices);
  s.call("hf_solver_solve_vectors",
         [&] { return hf_solver_solve_vectors(solver, OUT(field.data()), normals.data(), nullptr); });
  s.take(field.data(), field.size());
  s.take(normals.data(), normals.size());
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

hf_surface_desc Tube::desc(Allocator& memory) const {
  hf_surface_desc d = HF_INIT(hf_surface_desc);
  d.positions = HF_ARRAY(positions.data(), vertices);
  d.triangles = HF_ARRAY(triangles.data(), triangles.size() / 3);
  d.allocator = memory.hooks();
  return d;
}

std::vector<Chapter> field_chapters() {
  std::vector<Chapter> chapters;
  if (has_gpl()) chapters.push_back({"updown", updown});
  const Chapter others[] = {{"green", green},
                            {"edited", edited},
                            {"refactor", refactor},
                            {"biharmonic", biharmonic},
                            {"points_and_discs", points_and_discs},
                            {"rebase", rebase},
                            {"bytes", bytes},
                            {"vectors", vectors},
                            {"shared", shared},
                            {"missing_kinds", missing_kinds}};
  chapters.insert(chapters.end(), std::begin(others), std::end(others));
  return chapters;
}

}  // namespace refusal
