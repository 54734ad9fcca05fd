/* The host's allocator: every byte through it, every byte back, none while a pose is dragged, and no call from inside
 * it. Refused allocations: reliability_refuse refuses each of them, reliability_unchanged looks at the objects after
 * it. */
#include "api_support.h"

enum { AROUND = 8, RINGS = 10, VERTICES = AROUND * RINGS };

typedef struct World {
  CountingAllocator memory;
  Surface tube;
  hf_surface surface;
  hf_solver solver;
  hf_pose pose;
  uint32_t handles[2];
  float posed[3 * VERTICES];
  double field[VERTICES];
} World;

static void create_world(World* w) {
  memset(w, 0, sizeof *w);
  w->tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&w->tube);
  desc.surface.allocator = counting_hooks(&w->memory);
  assert_ok(make(&desc, &w->surface, &w->solver));
  add_site(w->solver, 0, 0);
  add_site(w->solver, VERTICES - 1, 1);
  w->pose = tube_pose(w->surface, AROUND, RINGS, w->handles);
}

static void destroy_world(World* w) {
  hf_surface_destroy(w->surface);
  hf_solver_destroy(w->solver);
  hf_pose_destroy(w->pose);
  assert_int_equal(w->memory.live_blocks, 0);
  assert_int_equal(w->memory.live_bytes, 0);
  assert_int_equal(w->memory.mismatches, 0);
  surface_free(&w->tube);
}

static void dragging_allocates_nothing(void** state) {
  (void)state;
  World world;
  create_world(&world);
  float normals[3 * VERTICES];
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = ROWS_OUT(world.posed);
  desc.normals = ROWS_OUT(normals);
  assert_ok(hf_pose_deform(world.pose, &desc, NULL));
  world.memory.calls = 0;
  for (int i = 0; i < 20; ++i) {
    const hf_transform moved = {{0, 0, 0, 0}, {0.1 * i, 0, 0}};
    assert_ok(hf_pose_set_transforms(world.pose, 1, world.handles, &moved));
    assert_ok(hf_pose_deform(world.pose, &desc, NULL));
  }
  assert_int_equal(world.memory.calls, 0);
  destroy_world(&world);
}

/* A drag leaves blocks for the next one. When an object goes they go back, too: the host has what the library counts.
 */
static void a_destroyed_object_leaves_no_block_behind(void** state) {
  (void)state;
  World world;
  create_world(&world);
  assert_ok(hf_deform(world.pose, world.posed, NULL));
  hf_pose copy = NULL;
  assert_ok(hf_pose_clone(world.pose, &copy));
  hf_pose_destroy(copy);
  hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(world.surface, &statistics));
  assert_true(world.memory.live_bytes < statistics.memory_bytes + 4096); /* the counter does not count itself */
  destroy_world(&world);
}

/* Sites that go the same way twice: the second time all blocks are those of the first. */
static void dragging_a_site_allocates_nothing(void** state) {
  (void)state;
  World world;
  create_world(&world);
  const uint32_t site = add_site(world.solver, 40, 1);
  for (int round = 0; round < 2; ++round) {
    world.memory.calls = 0;
    for (uint32_t i = 0; i < 30; ++i) {
      const uint32_t vertex = 41 + i;
      const double value = 0.5 * i;
      const hf_sites_desc to = sites_at(1, &vertex, NULL);
      assert_ok(hf_solver_move_sites(world.solver, 1, &site, &to));
      assert_ok(hf_solver_set_values(world.solver, 1, &site, &value));
      assert_ok(hf_solver_solve(world.solver, OUT(world.field), NULL));
    }
  }
  assert_int_equal(world.memory.calls, 0);
  destroy_world(&world);
}

static void repeated_fields_hold_no_more_memory(void** state) {
  (void)state;
  World world;
  create_world(&world);
  assert_ok(hf_solver_solve(world.solver, OUT(world.field), NULL));
  size_t blocks = 0;
  for (int i = 0; i < 200; ++i) {
    if (i == 100) blocks = world.memory.live_blocks;
    const uint32_t site = add_site(world.solver, 40, i);
    assert_ok(hf_solver_solve(world.solver, OUT(world.field), NULL));
    assert_ok(hf_remove_sites(world.solver, 1, &site));
    assert_ok(hf_solver_solve(world.solver, OUT(world.field), NULL));
  }
  assert_true(world.memory.live_blocks <= blocks + 8);
  destroy_world(&world);
}

/* A callback that calls back. */
typedef struct Reentrant {
  CountingAllocator memory;
  hf_allocator inner;
  hf_solver solver;
  int armed, expect_read;
  unsigned tried;
} Reentrant;
static void* reentrant_allocate(void* user, size_t size, size_t alignment) {
  Reentrant* r = user;
  if (r->armed) {
    r->armed = 0; /* once: what is called here allocates too */
    double value[2];
    const uint32_t vertex = 3, site = 0;
    const hf_sites_desc sites = sites_at(1, &vertex, NULL);
    assert_code(HF_ERROR_REENTRANT, hf_add_sites(r->solver, &sites, NULL));
    assert_code(HF_ERROR_REENTRANT, hf_remove_sites(r->solver, 1, &site));
    assert_code(HF_ERROR_REENTRANT, hf_solver_set_screening(r->solver, NULL, NULL));
    assert_code(r->expect_read, hf_solver_solve_at(r->solver, 1, &vertex, value));
    ++r->tried;
  }
  return r->inner.allocate(&r->memory, size, alignment);
}
static void reentrant_release(void* user, void* block, size_t size, size_t alignment) {
  Reentrant* r = user;
  r->inner.release(&r->memory, block, size, alignment);
}

static void a_callback_that_calls_back_is_refused(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  Reentrant r;
  memset(&r, 0, sizeof r);
  r.inner = counting_hooks(&r.memory);
  Options desc = options_of(&tube);
  desc.surface.allocator.allocate = reentrant_allocate;
  desc.surface.allocator.release = reentrant_release;
  desc.surface.allocator.user = &r;
  assert_ok(make(&desc, NULL, &r.solver));
  add_site(r.solver, 0, 0);
  r.armed = 1;
  r.expect_read = HF_ERROR_REENTRANT; /* inside a change nothing is allowed */
  add_site(r.solver, 50, 1);
  assert_int_equal(r.tried, 1);
  hf_certificate certificate = HF_INIT(hf_certificate); /* needs more than freed blocks */
  r.armed = 1;
  r.expect_read = HF_OK; /* inside a read, reading is */
  assert_ok(hf_solver_certify(r.solver, &certificate));
  assert_int_equal(r.tried, 2);
  assert_int_equal(hf_solver_get_site_count(r.solver), 2);
  hf_solver_destroy(r.solver);
  surface_free(&tube);
  assert_int_equal(r.memory.live_blocks, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(dragging_allocates_nothing),
      cmocka_unit_test(a_destroyed_object_leaves_no_block_behind),
      cmocka_unit_test(dragging_a_site_allocates_nothing),
      cmocka_unit_test(repeated_fields_hold_no_more_memory),
      cmocka_unit_test(a_callback_that_calls_back_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
