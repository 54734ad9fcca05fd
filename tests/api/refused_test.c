/* Refused calls that once left something behind, each in its smallest form. reliability_unchanged finds such calls at
 * random. */
#include "api_support.h"
#include "support/place_in.h"

enum { AROUND = 8, RINGS = 9, COUNT = AROUND * RINGS };

static hf_surface counted_surface(CountingAllocator* memory) {
  memset(memory, 0, sizeof *memory);
  Surface tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&tube);
  desc.surface.allocator = counting_hooks(memory);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc.surface, &surface));
  surface_free(&tube);
  return surface;
}

/* Arms the allocator so that its n-th allocation from now, and all that follow, are refused. After a single one the
 * library gives blocks back that it kept, and asks again. */
static void refuse(CountingAllocator* memory, size_t n) {
  memory->refuse_at = memory->calls + n;
  memory->refuse_on = 1;
}

static void a_frame_without_pairs_keeps_no_normals(void** state) {
  (void)state;
  CountingAllocator memory;
  const hf_surface surface = counted_surface(&memory);
  hf_transfer transfer = NULL;
  assert_ok(hf_transfer_create(surface, surface, NULL, &transfer));
  float posed[3 * COUNT] = {0}, normals[3 * COUNT];
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, COUNT);
  frame.target_normals = ROWS_OUT(normals);
  const double before = memory_in_use(surface);
  assert_code(HF_ERROR_EMPTY, hf_transfer_apply(transfer, &frame));
  assert_true(memory_in_use(surface) == before);
  hf_transfer_destroy(transfer);
  hf_surface_destroy(surface);
  assert_int_equal(memory.live_blocks, 0);
}

static void a_factor_that_is_not_kept_leaves_nothing(void** state) {
  (void)state;
  CountingAllocator memory;
  const hf_surface surface = counted_surface(&memory);
  unsigned char bytes[8];
  size_t size = 0;
  for (int32_t kind = HF_FIELD_BIHARMONIC; kind <= HF_FIELD_BIHARMONIC_GRAPH; ++kind) {
    give_kept_back(surface);
    const double before = memory_in_use(surface);
    const size_t held = memory.live_bytes;
    assert_code(HF_ERROR_TOO_SMALL, hf_surface_save(surface, kind, NULL, sizeof bytes, bytes, &size));
    assert_true(memory_in_use(surface) == before);
    assert_ok(hf_surface_save(surface, kind, NULL, 0, NULL, &size));
    assert_true(memory_in_use(surface) == before);
    give_kept_back(surface);
    assert_int_equal(memory.live_bytes, held);
  }
  hf_surface_destroy(surface);
  assert_int_equal(memory.live_blocks, 0);
}

static void a_refused_edit_counts_no_factorisation(void** state) {
  (void)state;
  CountingAllocator memory;
  const hf_surface surface = counted_surface(&memory);
  hf_solver solver = NULL;
  assert_ok(hf_peer_refactor_create(surface, NULL, &solver));
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  const double weights[3] = {0.25, 0.25, 0.5};
  sites.site_count = 1;
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_place inside = place_in(tube.triangles, tube.triangle_count, 4, weights);
  sites.places = &inside;
  assert_ok(hf_add_sites(solver, &sites, NULL));
  const uint32_t second = add_site(solver, 60, 1);
  hf_solver_statistics before = HF_INIT(hf_solver_statistics), now = HF_INIT(hf_solver_statistics);
  assert_ok(hf_solver_get_statistics(solver, &before));
  for (size_t n = 1; n < 1000; ++n) {
    refuse(&memory, n);
    const hf_result result = hf_remove_sites(solver, 1, &second);
    assert_ok(hf_solver_get_statistics(solver, &now));
    if (result == HF_OK) break;
    assert_memory_equal(&now, &before, sizeof now);
  }
  assert_int_equal(now.factorisation_count, before.factorisation_count + 1);
  hf_solver_destroy(solver);
  surface_free(&tube);
  hf_surface_destroy(surface);
}

/* Two handles of two rings, the upper one turned; one on a layer above if asked. */
static hf_pose posed(hf_surface surface, int layered, uint32_t handles[2]) {
  const hf_pose pose = tube_pose(surface, AROUND, RINGS, handles);
  const hf_transform turn = {{0, 0.3, 0.1, 0.9}, {0.5, 0.2, 0}};
  if (layered) {
    hf_handles_desc above = HF_INIT(hf_handles_desc);
    const double point[3] = {1, 4, 0}, radius = 0.1;
    uint32_t number = 0;
    above.handle_count = 1;
    above.points = point;
    above.radii = &radius;
    above.layer = 1;
    assert_ok(hf_pose_add_handles(pose, &above, &number));
    assert_ok(hf_pose_set_transform(pose, number, &turn));
  }
  assert_ok(hf_pose_set_transform(pose, handles[1], &turn));
  return pose;
}

static void a_refused_full_mesh_step_leaves_the_pose_where_it_was(void** state) {
  (void)state;
  CountingAllocator memory;
  for (int kind = 0; kind < 4; ++kind) {
    const int layered = kind % 2;
    const hf_surface surface = counted_surface(&memory);
    uint32_t handles[2], others[2];
    const hf_pose pose = posed(surface, layered, handles), twin = posed(surface, layered, others);
    float frame[3 * COUNT], expected[3 * COUNT];
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.positions = ROWS_OUT(frame);
    desc.refine = 1 + 2 * layered; /* several steps keep more */
    if (kind >= 2) {               /* the refused steps go on from another frame */
      desc.refine_from_last = 1;
      const hf_transform more = {{0, 0.4, 0.1, 0.8}, {0.6, 0.3, 0}};
      assert_ok(hf_pose_deform(pose, &desc, NULL));
      assert_ok(hf_pose_deform(twin, &desc, NULL));
      assert_ok(hf_pose_set_transform(pose, handles[1], &more));
      assert_ok(hf_pose_set_transform(twin, others[1], &more));
    }
    size_t n = 1;
    for (; n < 2000; ++n) {
      refuse(&memory, n);
      const hf_result result = hf_pose_deform(pose, &desc, NULL);
      memory.refuse_at = 0;
      if (result == HF_OK) break;
      assert_code(HF_ERROR_OUT_OF_MEMORY, result);
    }
    assert_true(n > 10);
    desc.positions = ROWS_OUT(expected);
    assert_ok(hf_pose_deform(twin, &desc, NULL)); /* the same frame, never refused */
    assert_memory_equal(frame, expected, sizeof frame);
    hf_pose_destroy(pose);
    hf_pose_destroy(twin);
    hf_surface_destroy(surface);
    assert_int_equal(memory.live_blocks, 0);
  }
}

/* A disc counts by its rim. The places behind it in a batch were not counted with it. */
static void a_batch_with_a_disc_keeps_to_the_limit(void** state) {
  (void)state;
  CountingAllocator memory;
  const hf_surface surface = counted_surface(&memory);
  uint32_t vertices[20];
  double radii[20] = {1.2};
  for (uint32_t i = 1; i < 20; ++i) vertices[i] = i < 9 ? i : COUNT - i;
  vertices[0] = 4 * AROUND;
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.site_limit = 12;
  hf_solver one = NULL, batch = NULL;
  assert_ok(hf_create(surface, &desc, &one));
  assert_ok(hf_create(surface, &desc, &batch));
  hf_sites_desc sites = sites_at(1, vertices, NULL);
  sites.radii = radii;
  assert_ok(hf_add_sites(one, &sites, NULL));
  uint32_t count = 1;
  while (hf_solver_add_site(one, vertices[count], NULL, NULL) == HF_OK) ++count;
  assert_true(count > 1 && count < 12); /* the rim takes the rest */
  sites.site_count = count + 1;
  assert_code(HF_ERROR_TOO_LARGE, hf_add_sites(batch, &sites, NULL));
  assert_int_equal(hf_solver_get_site_count(batch), 0);
  sites.site_count = count;
  assert_ok(hf_add_sites(batch, &sites, NULL));
  hf_solver_destroy(one);
  hf_solver_destroy(batch);
  hf_surface_destroy(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_frame_without_pairs_keeps_no_normals),
      cmocka_unit_test(a_factor_that_is_not_kept_leaves_nothing),
      cmocka_unit_test(a_refused_edit_counts_no_factorisation),
      cmocka_unit_test(a_refused_full_mesh_step_leaves_the_pose_where_it_was),
      cmocka_unit_test(a_batch_with_a_disc_keeps_to_the_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
