/* A steady state asks the host for no memory. Each row is a frame of a game or a tool. The frames are run three times:
 * the first two times leave the blocks, the third time counts. With HF_STEADY_TABLE in the environment the counts are
 * printed; docs/guide.md has them. */
#include "api_support.h"
#include "support/stick_man.h"

/* Vectors over all vertices are larger than the blocks whose sizes are rounded. */
enum { AROUND = 24, RINGS = 420, VERTICES = AROUND * RINGS, FRAMES = 20, ROUNDS = 3 };

static struct World {
  CountingAllocator memory;
  Surface tube;
  hf_surface surface;
  hf_solver solver, vectors, edited;
  hf_pose pose, refined, edited_pose;
  hf_transfer transfer;
  hf_direction direction;
  hf_geodesics distances;
  hf_region region;
  hf_retarget retarget;
  StickMan man, other;
  uint32_t site, edited_site, direction_site, handles[2], edited_handles[2];
  double field[VERTICES];
  float values[3 * VERTICES], posed[3 * VERTICES], normals[3 * VERTICES];
} w;

static void sites_moved_and_valued(uint32_t frame) {
  const uint32_t vertex = 3000 + 7 * frame;
  const double value = 0.1 * frame;
  const hf_sites_desc to = sites_at(1, &vertex, NULL);
  assert_ok(hf_solver_move_sites(w.solver, 1, &w.site, &to));
  assert_ok(hf_solver_set_values(w.solver, 1, &w.site, &value));
  assert_ok(hf_solve(w.solver, w.values, 0, NULL));
}
static void a_site_added_and_removed(uint32_t frame) {
  const uint32_t site = add_site(w.solver, 5000 + 11 * frame, 0.5);
  assert_ok(hf_solver_solve(w.solver, OUT(w.field), NULL));
  assert_ok(hf_remove_sites(w.solver, 1, &site));
}
static void values_set(uint32_t frame) {
  const double value = 0.1 * frame;
  assert_ok(hf_solver_set_values(w.solver, 1, &w.site, &value));
  assert_ok(hf_solver_solve(w.solver, OUT(w.field), NULL));
}
static void a_field_at_some_vertices(uint32_t frame) {
  const uint32_t vertices[3] = {7000 + frame, 100, 8000 - frame};
  assert_ok(hf_solver_solve_at(w.solver, 3, vertices, w.field));
}
static void a_field_of_vectors(uint32_t frame) {
  const double value[3] = {0.1 * frame, 1, 0};
  const uint32_t site = 0;
  assert_ok(hf_solver_set_values(w.vectors, 1, &site, value));
  assert_ok(hf_solver_solve_vectors(w.vectors, OUT(w.values), NULL, NULL));
}
static void a_preview(uint32_t frame) {
  const uint32_t vertex = 3000 + 7 * frame;
  const hf_sites_desc to = sites_at(1, &vertex, NULL);
  assert_ok(hf_solver_move_sites(w.solver, 1, &w.site, &to));
  assert_ok(hf_solver_solve_preview(w.solver, OUT(w.values), 2, NULL));
}
static void a_site_on_an_edited_surface(uint32_t frame) {
  const uint32_t vertex = 3000 + 7 * frame; /* in and out of the stroke */
  const hf_sites_desc to = sites_at(1, &vertex, NULL);
  assert_ok(hf_solver_move_sites(w.edited, 1, &w.edited_site, &to));
  assert_ok(hf_solver_solve(w.edited, OUT(w.field), NULL));
}
static void an_edited_field_at_some_vertices(uint32_t frame) {
  const uint32_t vertices[3] = {7000 + frame, 3050, 8000 - frame};
  assert_ok(hf_solver_solve_at(w.edited, 3, vertices, w.field));
}
static void a_site_moved_to_a_point(uint32_t frame) {
  const float* const near = w.tube.positions + 3 * (3000 + 7 * frame);
  const double point[3] = {near[0] + 0.01, near[1] + 0.01, near[2]};
  hf_sites_desc to = HF_INIT(hf_sites_desc);
  to.site_count = 1;
  to.points = point;
  assert_ok(hf_solver_move_sites(w.solver, 1, &w.site, &to));
  assert_ok(hf_solve(w.solver, w.values, 0, NULL));
}
static void deform(hf_pose pose, uint32_t handle, uint32_t frame, int refine) {
  const hf_transform moved = {{0, 0, 0, 0}, {0.05 * frame, 0.02 * frame, 0}};
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = ROWS_OUT(w.posed);
  desc.normals = ROWS_OUT(w.normals);
  desc.refine = refine;
  assert_ok(hf_pose_set_transform(pose, handle, &moved));
  assert_ok(hf_pose_deform(pose, &desc, NULL));
}
static void a_pose_with_normals(uint32_t frame) { deform(w.pose, w.handles[0], frame, 0); }
static void a_pose_without_vertices(uint32_t frame) {
  const hf_transform moved = {{0, 0, 0, 1}, {0.01 * frame, 0, 0}};
  assert_ok(hf_pose_set_transform(w.pose, w.handles[0], &moved));
  assert_ok(hf_pose_solve(w.pose, 0, 0, NULL));
  assert_ok(hf_pose_get_blend_transforms(w.pose, COUNT_OF(w.values) / 12, w.values, NULL));
}
static void a_pose_with_a_full_mesh_step(uint32_t frame) { deform(w.refined, w.handles[0], frame, 1); }
static void a_pose_of_an_edited_surface(uint32_t frame) { deform(w.edited_pose, w.edited_handles[0], frame, 1); }
static void a_transfer_with_normals(uint32_t frame) {
  hf_transfer_frame desc = HF_INIT(hf_transfer_frame);
  for (uint32_t v = 0; v < VERTICES; ++v) w.posed[3 * v] = w.tube.positions[3 * v] + 0.001f * (float)frame;
  desc.source_positions = HF_ARRAY(w.posed, VERTICES);
  desc.target_positions = ROWS_OUT(w.values);
  desc.target_normals = ROWS_OUT(w.normals);
  assert_ok(hf_transfer_apply(w.transfer, &desc));
}
static void a_retarget(uint32_t frame) {
  float from[MAN_JOINTS][10], to[MAN_JOINTS][10];
  man_walk(&w.man, 0.1f * (float)frame, from);
  assert_ok(hf_retarget_solve(w.retarget, from[0], 0.03, to[0]));
}
static void a_direction_rotated(uint32_t frame) {
  const double angle = 0.1 * frame;
  assert_ok(hf_direction_rotate_sites(w.direction, 1, &w.direction_site, &angle));
  assert_ok(hf_direction_solve(w.direction, OUT(w.values), NULL));
}
static void a_direction_moved(uint32_t frame) {
  const uint32_t vertex = 3000 + 7 * frame;
  assert_ok(hf_direction_move_sites(w.direction, 1, &w.direction_site, &vertex));
  assert_ok(hf_direction_solve(w.direction, OUT(w.values), NULL));
}
static void a_region_morphed(uint32_t frame) {
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.weight = 0.05 * frame;
  desc.positions = ROWS_OUT(w.posed);
  desc.normals = ROWS_OUT(w.normals);
  assert_ok(hf_region_morph(w.region, &desc));
}
static void distances_from_a_vertex(uint32_t frame) {
  const uint32_t source = 3000 + 7 * frame;
  assert_ok(hf_geodesics_solve(w.distances, 1, &source, OUT(w.values)));
}

static void create_world(void) {
  memset(&w, 0, sizeof w);
  w.tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&w.tube);
  desc.surface.allocator = counting_hooks(&w.memory);
  assert_ok(make(&desc, &w.surface, &w.solver));
  add_site(w.solver, 0, 0);
  add_site(w.solver, VERTICES - 1, 1);
  w.site = add_site(w.solver, VERTICES / 2, 2);
  hf_solver_desc three = HF_INIT(hf_solver_desc);
  three.channel_count = 3;
  assert_ok(hf_create(w.surface, &three, &w.vectors));
  const double across[3] = {0, 1, 0}, along[3] = {0.1, 0.2, 1};
  assert_ok(hf_solver_add_site(w.vectors, 9, across, NULL));
  assert_ok(hf_solver_add_site(w.vectors, VERTICES - 9, along, NULL));
  w.pose = tube_pose(w.surface, AROUND, RINGS, w.handles);
  w.refined = tube_pose(w.surface, AROUND, RINGS, w.handles);
  uint32_t stroke[200];
  double stiffness[200];
  for (uint32_t i = 0; i < 200; ++i) {
    stroke[i] = 3000 + i;
    stiffness[i] = 50;
  }
  hf_surface_edit_desc stiff = HF_INIT(hf_surface_edit_desc);
  stiff.vertex_count = 200;
  stiff.vertices = stroke;
  stiff.stiffness = stiffness;
  const hf_link link = {10, {VERTICES / 3, NO_INDEX, NO_INDEX}, {1, 0, 0}, 0, 1, 0, 0};
  stiff.link_count = 1;
  stiff.links = &link;
  hf_surface edited;
  assert_ok(hf_surface_edit(w.surface, &stiff, &edited));
  assert_ok(hf_create(edited, NULL, &w.edited));
  add_site(w.edited, 0, 0);
  add_site(w.edited, VERTICES - 1, 1);
  w.edited_site = add_site(w.edited, VERTICES / 2, 2);
  w.edited_pose = tube_pose(edited, AROUND, RINGS, w.edited_handles);
  hf_surface_destroy(edited);
  assert_ok(hf_transfer_create(w.surface, w.surface, NULL, &w.transfer));
  uint32_t* ends = tube_ends(AROUND, RINGS);
  const uint32_t counts[2] = {2 * AROUND, 2 * AROUND};
  add_own_pairs(w.transfer, counts, ends);
  memcpy(w.posed, w.tube.positions, sizeof w.posed);
  const uint32_t vertex = VERTICES / 2;
  assert_ok(hf_direction_create(w.surface, NULL, &w.direction));
  assert_ok(hf_direction_add_sites(w.direction, 1, &vertex, along, &w.direction_site));
  assert_ok(hf_geodesics_create(w.surface, NULL, &w.distances));
  assert_ok(hf_region_create(w.surface, NULL, &w.region));
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 2 * AROUND;
  edit.add_vertices = ends;
  assert_ok(hf_region_edit(w.region, &edit));
  free(ends);
  w.man = stick_man(1, 0);
  w.other = stick_man(1.4f, 40);
  const StickMan* const men[2] = {&w.man, &w.other};
  hf_skeleton known[2];
  for (int k = 0; k < 2; ++k) {
    const hf_skin_desc skin = man_skin(men[k]);
    hf_skeleton_desc of = man_desc(men[k], &skin);
    of.allocator = counting_hooks(&w.memory);
    assert_ok(hf_skeleton_create(&of, &known[k]));
  }
  assert_ok(hf_retarget_create(known[0], known[1], NULL, &w.retarget));
  for (int k = 0; k < 2; ++k) hf_skeleton_destroy(known[k]);
}

static void destroy_world(void) {
  hf_surface_destroy(w.surface);
  hf_solver_destroy(w.solver);
  hf_solver_destroy(w.vectors);
  hf_solver_destroy(w.edited);
  hf_pose_destroy(w.pose);
  hf_pose_destroy(w.refined);
  hf_pose_destroy(w.edited_pose);
  hf_transfer_destroy(w.transfer);
  hf_direction_destroy(w.direction);
  hf_geodesics_destroy(w.distances);
  hf_region_destroy(w.region);
  hf_retarget_destroy(w.retarget);
  assert_int_equal(w.memory.live_blocks, 0);
  assert_int_equal(w.memory.mismatches, 0);
  surface_free(&w.tube);
}

static const struct Row {
  const char* name;
  void (*frame)(uint32_t frame);
  int steady; /* 0: the guide says that it allocates */
} rows_of_frames[] = {
    {"a site moved and valued, and the field", sites_moved_and_valued, 1},
    {"a site added and removed, and the field", a_site_added_and_removed, 1},
    {"a value set, and the field", values_set, 1},
    {"the field at some vertices", a_field_at_some_vertices, 1},
    {"a field of vectors", a_field_of_vectors, 1},
    {"a site moved, and a preview", a_preview, 1},
    {"a pose, with normals", a_pose_with_normals, 1},
    {"a pose without vertices", a_pose_without_vertices, 1},
    {"a pose with a full-mesh step", a_pose_with_a_full_mesh_step, 1},
    {"a transfer, with normals", a_transfer_with_normals, 1},
    {"a retarget", a_retarget, 1},
    {"a direction turned, and the field", a_direction_rotated, 1},
    {"a direction moved, and the field", a_direction_moved, 1},
    {"a morph of a region, with normals", a_region_morphed, 1},
    {"distances from a moving vertex", distances_from_a_vertex, 1},
    {"a site moved on an edited surface, and the field", a_site_on_an_edited_surface, 1},
    {"the field at some vertices of an edited surface", an_edited_field_at_some_vertices, 1},
    {"a pose of an edited surface, with a full-mesh step", a_pose_of_an_edited_surface, 1},
    {"a site moved to a point in space, and the field", a_site_moved_to_a_point, 1},
};

static void a_steady_state_asks_the_host_for_no_memory(void** state) {
  (void)state;
  create_world();
  const int prints = getenv("HF_STEADY_TABLE") != NULL;
  unsigned failures = 0;
  for (size_t r = 0; r < sizeof rows_of_frames / sizeof rows_of_frames[0]; ++r) {
    const struct Row* row = &rows_of_frames[r];
    size_t first = 0, most = 0;
    for (int round = 0; round < ROUNDS; ++round) {
      for (uint32_t f = 0; f < FRAMES; ++f) {
        w.memory.calls = 0;
        row->frame(f);
        if (round == 0 && f == 0) first = w.memory.calls;
        if (round == ROUNDS - 1 && w.memory.calls > most) most = w.memory.calls;
      }
    }
    if (prints) printf("| %s | %zu | %zu |\n", row->name, first, most);
    if (row->steady && most > 0) {
      ++failures;
      printf("%s: %zu allocations in a frame\n", row->name, most);
    }
  }
  assert_int_equal(failures, 0);
  destroy_world();
}

int main(void) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0; /* freed blocks are not kept, so that the sanitizer sees who uses them */
#else
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_steady_state_asks_the_host_for_no_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
#endif
}
