#include "bad_scene.h"

static void* copy_of(size_t size) {
  void* block = calloc(1, size);
  if (!block) exit(2);
  return block;
}

static hf_result deform_now(hf_pose pose, float* positions) {
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = ROWS_OUT(positions);
  desc.restart = 1;
  return hf_pose_deform(pose, &desc, NULL);
}

static hf_result transfer_now(const Scene* scene, float* positions) {
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(scene->posed, TUBE_VERTICES);
  frame.target_positions = ROWS_OUT(positions);
  return hf_transfer_apply(scene->transfer, &frame);
}

static void create_pose(Scene* s) {
  s->pose = tube_pose(s->body, TUBE_AROUND, TUBE_RINGS, s->handles);
  const hf_transform turned = {{0, 0, 0.38268343, 0.92387953}, {1.0, 0.5, 0.0}};
  assert_ok(hf_pose_set_transforms(s->pose, 1, &s->handles[1], &turned));
  s->deformed = copy_of(sizeof(float) * 3 * TUBE_VERTICES);
  s->posed = copy_of(sizeof(float) * 3 * TUBE_VERTICES);
  assert_ok(deform_now(s->pose, s->deformed));
  memcpy(s->posed, s->deformed, sizeof(float) * 3 * TUBE_VERTICES);
}

static void create_transfer(Scene* s) {
  const uint32_t counts[2] = {2 * TUBE_AROUND, 2 * TUBE_AROUND};
  hf_pairs_desc desc = HF_INIT(hf_pairs_desc);
  desc.pair_count = 2;
  desc.source_counts = desc.target_counts = counts;
  desc.source_vertices = desc.target_vertices = s->ends;
  assert_ok(hf_transfer_create(s->body, s->body, NULL, &s->transfer));
  assert_ok(hf_transfer_add_pairs(s->transfer, &desc, s->pairs));
  s->transferred = copy_of(sizeof(float) * 3 * TUBE_VERTICES);
  assert_ok(transfer_now(s, s->transferred));
}

hf_joints_desc scene_bones(void) {
  static const double heads[9] = {0, 0.5, 0, 0, 5, 0, 0, 9, 0}, tails[9] = {0, 5, 0, 0, 9, 0, 0, 12.5, 0};
  static const uint32_t parents[3] = {HF_NO_INDEX, 0, 1};
  hf_joints_desc desc = HF_INIT(hf_joints_desc);
  desc.joint_count = 3;
  desc.heads = heads;
  desc.tails = tails;
  desc.parents = parents;
  return desc;
}

static hf_result weights_now(const Scene* s, float* weights) {
  hf_weights_out out = HF_INIT(hf_weights_out);
  out.vertex_capacity = TUBE_VERTICES;
  out.weights = weights;
  return hf_weights_get(s->weights, &out);
}

static void create_weights(Scene* s) {
  const hf_joints_desc bones = scene_bones();
  assert_ok(hf_weights_create(s->body, &bones, 0, &s->weights));
  assert_ok(hf_weights_clone(s->weights, &s->stale_weights));
  hf_weights_destroy(s->stale_weights);
  s->skin = copy_of(sizeof(float) * 4 * TUBE_VERTICES);
  assert_ok(weights_now(s, s->skin));
}

void scene_create(Scene* s) {
  memset(s, 0, sizeof *s);
  s->cut = surface_cut();
  s->tube = surface_tube(TUBE_AROUND, TUBE_RINGS);
  s->ends = tube_ends(TUBE_AROUND, TUBE_RINGS);

  s->sheet = surface_on(&s->cut);
  s->body = surface_on(&s->tube);
  s->solver = solver_on(s->sheet);
  s->sites[0] = add_site(s->solver, CUT_LEFT, 0.0);
  s->sites[1] = add_site(s->solver, CUT_RIGHT, 1.0);
  s->sites[2] = add_site(s->solver, CUT_SEAM_LEFT, 5.0);
  s->field = field_of(s->solver, CUT_VERTICES);
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.channel_count = 3;
  assert_ok(hf_create(s->sheet, &desc, &s->three));
  create_pose(s);
  create_transfer(s);
  create_weights(s);
  assert_ok(hf_progress_create(&s->progress));
  assert_ok(hf_geodesics_create(s->body, NULL, &s->geodesics));

  s->stale_surface = surface_on(&s->cut);
  hf_surface_destroy(s->stale_surface);
  assert_ok(hf_solver_clone(s->solver, &s->stale_solver));
  assert_ok(hf_pose_clone(s->pose, &s->stale_pose));
  assert_ok(hf_transfer_create(s->body, s->body, NULL, &s->stale_transfer));
  assert_ok(hf_progress_create(&s->stale_progress));
  assert_ok(hf_geodesics_create(s->body, NULL, &s->stale_geodesics));
  hf_geodesics_destroy(s->stale_geodesics);
  const uint32_t corners[2] = {CUT_LEFT, CUT_RIGHT};
  const double vectors[6] = {1, 0, 0, 0, 1, 0};
  assert_ok(hf_direction_create(s->sheet, NULL, &s->direction));
  assert_ok(hf_direction_add_sites(s->direction, 2, corners, vectors, NULL));
  assert_ok(hf_direction_create(s->sheet, NULL, &s->stale_direction));
  hf_direction_destroy(s->stale_direction);
  const uint32_t middle[2] = {5 * TUBE_AROUND, 5 * TUBE_AROUND + 1};
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 2;
  edit.add_vertices = middle;
  assert_ok(hf_region_create(s->body, NULL, &s->region));
  assert_ok(hf_region_edit(s->region, &edit));
  assert_ok(hf_region_clone(s->region, &s->stale_region));
  hf_region_destroy(s->stale_region);
  hf_solver_destroy(s->stale_solver);
  hf_pose_destroy(s->stale_pose);
  hf_transfer_destroy(s->stale_transfer);
  hf_progress_destroy(s->stale_progress);
}

void scene_destroy(Scene* s) {
  hf_solver_destroy(s->solver);
  hf_solver_destroy(s->three);
  hf_surface_destroy(s->sheet);
  hf_surface_destroy(s->body);
  hf_region_destroy(s->region);
  hf_weights_destroy(s->weights);
  free(s->skin);
  hf_pose_destroy(s->pose);
  hf_transfer_destroy(s->transfer);
  hf_progress_destroy(s->progress);
  hf_geodesics_destroy(s->geodesics);
  hf_direction_destroy(s->direction);
  surface_free(&s->cut);
  surface_free(&s->tube);
  free(s->ends);
  free(s->posed);
  free(s->field);
  free(s->deformed);
  free(s->transferred);
}

int solver_unchanged(const Scene* s) {
  double field[CUT_VERTICES];
  uint32_t sites[3] = {0}, vertices[3] = {0};
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 3;
  info.sites = sites;
  info.vertices = vertices;
  if (hf_solver_get_site_count(s->solver) != 3 || hf_solver_get_site_count(s->three) != 0) return 0;
  if (hf_solver_get_sites(s->solver, &info) != HF_OK || !same_bits(sites, s->sites, sizeof sites)) return 0;
  if (vertices[0] != CUT_LEFT || vertices[1] != CUT_RIGHT || vertices[2] != CUT_SEAM_LEFT) return 0;
  return hf_solver_solve(s->solver, OUT(field), NULL) == HF_OK && same_bits(field, s->field, sizeof field);
}

int pose_unchanged(const Scene* s) {
  float positions[3 * TUBE_VERTICES];
  if (hf_pose_get_handle_count(s->pose) != 2) return 0;
  return deform_now(s->pose, positions) == HF_OK && same_bits(positions, s->deformed, sizeof positions);
}

int transfer_unchanged(const Scene* s) {
  float positions[3 * TUBE_VERTICES];
  return transfer_now(s, positions) == HF_OK && same_bits(positions, s->transferred, sizeof positions);
}

int weights_unchanged(const Scene* s) {
  float weights[4 * TUBE_VERTICES];
  hf_weights_info info = HF_INIT(hf_weights_info);
  if (hf_weights_get_info(s->weights, &info) != HF_OK || info.joint_count != 3 || info.pin_count + info.lock_count != 0)
    return 0;
  return weights_now(s, weights) == HF_OK && same_bits(weights, s->skin, sizeof weights);
}
