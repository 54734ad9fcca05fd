/* The baselines of hf/peers.h through the ABI: they give the results of hf's own methods, and refuse bad calls. */
#include "api_support.h"

enum { AROUND = 12, RINGS = 16, VERTICES = AROUND * RINGS };
static Surface tube;

static int create_tube(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  return 0;
}
static int free_tube(void** state) {
  (void)state;
  surface_free(&tube);
  return 0;
}

/* A code and index, and no object. */
#define REFUSED(code, call)  \
  do {                       \
    out = (void*)&tube;      \
    assert_code(code, call); \
    assert_null(out);        \
  } while (0)

static void solvers_give_the_field_of_hf_create(void** state) {
  (void)state;
  hf_surface surface = surface_on(&tube);
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.channel_count = 1;
  double* fields[3] = {NULL, NULL, NULL};
  for (int32_t engine = ENGINE_GREEN; engine <= ENGINE_REFACTOR; ++engine) {
    hf_solver solver = NULL;
    if (engine == ENGINE_UPDOWN && !has_gpl()) continue;
    assert_ok(create_with(engine, surface, &desc, &solver));
    add_site(solver, 3, -1);
    add_site(solver, 100, 2);
    add_site(solver, VERTICES - 2, 5);
    fields[engine] = field_of(solver, VERTICES);
    hf_solver_destroy(solver);
  }
  for (int v = 0; v < VERTICES; ++v) {
    assert_true(fabs(fields[ENGINE_GREEN][v] - fields[ENGINE_REFACTOR][v]) < 1e-11);
    if (fields[ENGINE_UPDOWN]) assert_true(fabs(fields[ENGINE_GREEN][v] - fields[ENGINE_UPDOWN][v]) < 1e-6);
  }
  for (int i = 0; i < 3; ++i) free(fields[i]);
  hf_surface_destroy(surface);
}

static void the_penalty_says_how_far_a_site_gives_way(void** state) {
  (void)state;
  if (!has_gpl()) {
    print_message("no engine updown in this build (HF_WITH_GPL): skipped\n");
    skip();
  }
  hf_surface surface = surface_on(&tube);
  double missed[2];
  const double penalties[2] = {1e2, 1e10}; /* the largest there is */
  for (int i = 0; i < 2; ++i) {
    hf_solver solver = NULL;
    assert_ok(hf_peer_updown_create(surface, NULL, penalties[i], &solver));
    add_site(solver, 3, -1);
    add_site(solver, 100, 2);
    double* field = field_of(solver, VERTICES);
    missed[i] = fabs(field[100] - 2);
    free(field);
    hf_solver_destroy(solver);
  }
  assert_true(missed[0] > 1e-4 && missed[1] < 1e-7);
  hf_surface_destroy(surface);
}

/* With the same handles both poses put their regions exactly where the transforms say. */
static void a_pose_of_the_paper_places_its_handles_and_refuses_free_rotations(void** state) {
  (void)state;
  hf_surface surface = surface_on(&tube);
  hf_pose pose = NULL;
  assert_ok(hf_peer_pose_create(surface, NULL, 6, &pose));
  hf_pose_info info = HF_INIT(hf_pose_info);
  assert_ok(hf_pose_get_info(pose, &info));
  assert_true(info.band_count == 12 && info.iteration_count == 200);
  uint32_t* ends = tube_ends(AROUND, RINGS);
  const uint32_t counts[2] = {2 * AROUND, 2 * AROUND};
  uint32_t handles[2];
  hf_handles_desc regions = HF_INIT(hf_handles_desc);
  regions.handle_count = 2;
  regions.region_counts = counts;
  regions.region_vertices = ends;
  regions.free_rotation = 1;
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_add_handles(pose, &regions, handles));
  regions.free_rotation = 0;
  assert_ok(hf_pose_add_handles(pose, &regions, handles));
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_set_free_rotations(pose, 1, handles, 1));
  hf_handle_info handle = HF_INIT(hf_handle_info);
  assert_ok(hf_pose_get_handle(pose, handles[0], &handle));
  assert_true(handle.site_count == 6 && handle.leak > 0);
  const hf_transform lifted = {{0, 0, 0, 1}, {1, 2, 3}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &lifted));
  static float posed[3 * VERTICES];
  assert_ok(hf_deform(pose, posed, NULL));
  for (uint32_t i = 0; i < 2 * AROUND; ++i) {
    const uint32_t v = ends[2 * AROUND + i];
    for (int k = 0; k < 3; ++k)
      assert_true(fabs((double)(posed[3 * v + k] - tube.positions[3 * v + k]) - (k + 1)) < 1e-4);
  }
  free(ends);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
}

static void a_transfer_of_the_paper_has_bands_for_each_pair(void** state) {
  (void)state;
  hf_surface surface = surface_on(&tube);
  hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
  hf_transfer out = NULL;
  desc.mode = HF_TRANSFER_STRETCH;
  REFUSED(HF_ERROR_INVALID_ARGUMENT, hf_peer_transfer_create(surface, surface, &desc, &out));
  assert_ok(hf_peer_transfer_create(surface, surface, NULL, &out));
  add_tube_pairs(out, AROUND, RINGS);
  hf_transfer_info info = HF_INIT(hf_transfer_info);
  assert_ok(hf_transfer_get_info(out, &info));
  assert_true(info.cluster_count > 2 && info.cluster_count <= 16 && info.aligned_count == 0);
  hf_transfer_destroy(out);
  hf_surface_destroy(surface);
}

static void bad_calls_are_refused_and_make_nothing(void** state) {
  (void)state;
  hf_surface surface = surface_on(&tube);
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.channel_count = 65;
  hf_solver out = NULL;
  REFUSED(HF_ERROR_INVALID_OBJECT, hf_peer_refactor_create(NULL, NULL, &out));
  REFUSED(HF_ERROR_INVALID_OBJECT, hf_peer_updown_create(NULL, NULL, 0, &out));
  REFUSED(HF_ERROR_INVALID_ARGUMENT, hf_peer_refactor_create(surface, &desc, &out));
  const double bad[] = {-1, 1.0001e10, HUGE_VAL, (double)NAN};
  for (size_t i = 0; i < COUNT_OF(bad); ++i)
    REFUSED(HF_ERROR_INVALID_ARGUMENT, hf_peer_updown_create(surface, NULL, bad[i], &out));
  assert_code(HF_ERROR_NULL_POINTER, hf_peer_refactor_create(surface, NULL, NULL));
  assert_code(HF_ERROR_NULL_POINTER, hf_peer_updown_create(surface, NULL, 0, NULL));
  hf_pose pose = NULL;
  assert_code(HF_ERROR_INVALID_OBJECT, hf_peer_pose_create(NULL, NULL, 0, &pose));
  assert_code(HF_ERROR_NULL_POINTER, hf_peer_pose_create(surface, NULL, 0, NULL));
  hf_transfer transfer = NULL;
  assert_code(HF_ERROR_INVALID_OBJECT, hf_peer_transfer_create(surface, NULL, NULL, &transfer));
  assert_code(HF_ERROR_NULL_POINTER, hf_peer_transfer_create(surface, surface, NULL, NULL));
  if (!has_gpl()) REFUSED(HF_ERROR_UNSUPPORTED, hf_peer_updown_create(surface, NULL, 0, &out));
  hf_surface_destroy(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solvers_give_the_field_of_hf_create),
      cmocka_unit_test(the_penalty_says_how_far_a_site_gives_way),
      cmocka_unit_test(a_pose_of_the_paper_places_its_handles_and_refuses_free_rotations),
      cmocka_unit_test(a_transfer_of_the_paper_has_bands_for_each_pair),
      cmocka_unit_test(bad_calls_are_refused_and_make_nothing),
  };
  return cmocka_run_group_tests(tests, create_tube, free_tube);
}
