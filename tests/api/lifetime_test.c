/* Handles destroyed in any order, clones, progress objects. */
#include "api_support.h"

enum { AROUND = 12, RINGS = 16, VERTICES = AROUND * RINGS };

static void clones_are_independent(int32_t engine) {
  Surface tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(&tube);
  desc.engine = engine;
  hf_solver original = NULL, copy = NULL;
  assert_ok(make(&desc, NULL, &original));
  const uint32_t first = add_site(original, 0, 0);
  add_site(original, VERTICES - 1, 1);
  assert_ok(hf_solver_clone(original, &copy));
  double* before = field_of(original, VERTICES);
  double* same = field_of(copy, VERTICES);
  assert_true(same_bits(before, same, sizeof(double) * VERTICES));
  add_site(copy, 77, 5);
  assert_ok(hf_remove_sites(copy, 1, &first));
  assert_int_equal(hf_solver_get_site_count(original), 2);
  double* after = field_of(original, VERTICES);
  assert_true(same_bits(before, after, sizeof(double) * VERTICES));
  /* and the other way round */
  double* copied = field_of(copy, VERTICES);
  add_site(original, 30, -3);
  double* still = field_of(copy, VERTICES);
  assert_true(same_bits(copied, still, sizeof(double) * VERTICES));
  hf_solver_destroy(original);
  free(still);
  still = field_of(copy, VERTICES);
  assert_true(same_bits(copied, still, sizeof(double) * VERTICES));
  hf_solver_statistics statistics = HF_INIT(hf_solver_statistics);
  assert_ok(hf_solver_get_statistics(copy, &statistics));
  if (engine == ENGINE_GREEN) assert_int_equal(statistics.factorisation_count, 0);
  free(before);
  free(same);
  free(after);
  free(copied);
  free(still);
  hf_solver_destroy(copy);
  surface_free(&tube);
}

static void a_kept_clone_has_the_bits_of_then(void** state) {
  (void)state;
  clones_are_independent(ENGINE_GREEN);
  clones_are_independent(ENGINE_REFACTOR);
  if (has_gpl()) clones_are_independent(ENGINE_UPDOWN);
}

/* A family: a surface, a solver, two clones, a pose and its clone, a transfer. Each member does its work after any
 * other is gone.
 */
enum { SOLVER, CLONE, CLONE_OF_CLONE, POSE, POSE_CLONE, TRANSFER, SURFACE, MEMBERS };

typedef struct Family {
  CountingAllocator memory;
  hf_surface surface;
  hf_solver solvers[3];
  hf_pose poses[2];
  hf_transfer transfer;
} Family;

static void create_family(Family* f, const Surface* tube) {
  memset(f, 0, sizeof *f);
  Options desc = options_of(tube);
  desc.surface.allocator = counting_hooks(&f->memory);
  assert_ok(make(&desc, &f->surface, &f->solvers[0]));
  add_site(f->solvers[0], 0, 0);
  add_site(f->solvers[0], VERTICES - 1, 1);
  assert_ok(hf_solver_clone(f->solvers[0], &f->solvers[1]));
  assert_ok(hf_solver_clone(f->solvers[1], &f->solvers[2]));
  uint32_t handles[2];
  f->poses[0] = tube_pose(f->surface, AROUND, RINGS, handles);
  assert_ok(hf_pose_clone(f->poses[0], &f->poses[1]));
  assert_ok(hf_transfer_create(f->surface, f->surface, NULL, &f->transfer));
  add_tube_pairs(f->transfer, AROUND, RINGS);
}

static void use_member(Family* f, int member, const Surface* tube) {
  double field[VERTICES];
  float positions[3 * VERTICES];
  if (member < POSE) {
    const uint32_t site = add_site(f->solvers[member], 50, 2);
    assert_ok(hf_solver_solve(f->solvers[member], OUT(field), NULL));
    assert_true(field[50] == 2);
    assert_ok(hf_remove_sites(f->solvers[member], 1, &site));
  } else if (member < TRANSFER) {
    const uint32_t count = 1, vertex = 5 * AROUND;
    uint32_t handle;
    hf_handles_desc more = HF_INIT(hf_handles_desc);
    more.handle_count = 1;
    more.region_counts = &count;
    more.region_vertices = &vertex;
    assert_ok(hf_pose_add_handles(f->poses[member - POSE], &more, &handle));
    hf_deform_desc deform = HF_INIT(hf_deform_desc);
    deform.positions = ROWS_OUT(positions);
    assert_ok(hf_pose_deform(f->poses[member - POSE], &deform, NULL));
    assert_ok(hf_pose_remove_handles(f->poses[member - POSE], 1, &handle));
  } else if (member == SURFACE) {
    hf_solver more = solver_on(f->surface);
    add_site(more, 50, 2);
    hf_solver_destroy(more);
  } else {
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(tube->positions, tube->vertex_count);
    frame.target_positions = ROWS_OUT(positions);
    assert_ok(hf_transfer_apply(f->transfer, &frame));
  }
}

static void destroy_member(Family* f, int member) {
  if (member < POSE)
    hf_solver_destroy(f->solvers[member]);
  else if (member < TRANSFER)
    hf_pose_destroy(f->poses[member - POSE]);
  else if (member == TRANSFER)
    hf_transfer_destroy(f->transfer);
  else
    hf_surface_destroy(f->surface);
}

static void a_family_may_be_destroyed_in_any_order(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  uint32_t seed = 1;
  for (int round = 0; round < 40; ++round) {
    Family family;
    int order[MEMBERS];
    create_family(&family, &tube);
    for (int i = 0; i < MEMBERS; ++i) order[i] = i;
    for (int i = MEMBERS - 1; i > 0; --i) {
      seed = seed * 1664525u + 1013904223u;
      const int j = (int)((seed >> 16) % (unsigned)(i + 1)), kept = order[i];
      order[i] = order[j];
      order[j] = kept;
    }
    for (int gone = 0; gone < MEMBERS; ++gone) {
      for (int i = gone; i < MEMBERS; ++i) use_member(&family, order[i], &tube);
      assert_true(family.memory.live_blocks > 0);
      destroy_member(&family, order[gone]);
      destroy_member(&family, order[gone]); /* twice is once */
    }
    assert_int_equal(family.memory.live_blocks, 0);
    assert_int_equal(family.memory.live_bytes, 0);
    assert_int_equal(family.memory.mismatches, 0);
  }
  surface_free(&tube);
}

/* An allocator that cancels a progress object at a chosen allocation: a cancel in the middle of a call, without a
 * second thread. */
typedef struct Canceller {
  CountingAllocator memory;
  hf_allocator inner;
  hf_progress progress;
  size_t at;
  double seen; /* the fraction at that moment */
} Canceller;

static void* cancelling_allocate(void* user, size_t size, size_t alignment) {
  Canceller* c = user;
  void* block = c->inner.allocate(&c->memory, size, alignment);
  if (c->memory.calls == c->at) {
    assert_ok(hf_progress_get_fraction(c->progress, &c->seen));
    assert_ok(hf_progress_cancel(c->progress));
  }
  return block;
}
static void cancelling_release(void* user, void* block, size_t size, size_t alignment) {
  Canceller* c = user;
  c->inner.release(&c->memory, block, size, alignment);
}

static hf_result create_cancelled_at(size_t at, const Surface* surface, Canceller* c, hf_solver* solver) {
  memset(c, 0, sizeof *c);
  c->inner = counting_hooks(&c->memory);
  c->at = at;
  assert_ok(hf_progress_create(&c->progress));
  Options desc = options_of(surface);
  desc.surface.allocator.allocate = cancelling_allocate;
  desc.surface.allocator.release = cancelling_release;
  desc.surface.allocator.user = c;
  desc.surface.progress = c->progress;
  return make(&desc, NULL, solver);
}

static void a_cancel_in_the_middle_leaves_nothing_and_the_object_may_be_used_again(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  Canceller c;
  hf_solver solver = NULL;
  assert_ok(create_cancelled_at(0, &tube, &c, &solver));
  double fraction = -1;
  assert_ok(hf_progress_get_fraction(c.progress, &fraction));
  assert_true(fraction == 1);
  const size_t calls = c.memory.calls;
  hf_solver_destroy(solver);
  hf_progress_destroy(c.progress);
  assert_int_equal(c.memory.live_blocks, 0);
  double last = 0;
  for (size_t at = 1; at + 8 < calls; at += 1 + calls / 50) {
    const hf_result result = create_cancelled_at(at, &tube, &c, &solver);
    assert_true(c.seen >= last && c.seen <= 1);
    last = c.seen;
    if (result == HF_OK) { /* after the last phase it is too late: the next call is stopped */
      assert_true(at > calls / 2);
      hf_solver_destroy(solver);
    } else {
      assert_code(HF_ERROR_CANCELLED, result);
      assert_null(solver);
      assert_int_equal(c.memory.live_blocks, 0);
      assert_ok(hf_progress_get_fraction(c.progress, &fraction));
      assert_true(fraction >= c.seen); /* it does not fall back */
      Options again = options_of(&tube);
      again.surface.progress = c.progress;
      assert_ok(make(&again, NULL, &solver));
      hf_solver_destroy(solver);
    }
    hf_progress_destroy(c.progress);
  }
  surface_free(&tube);
}

static void a_cancel_before_the_call_stops_one_call(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  hf_progress progress = NULL;
  double fraction = -1;
  assert_ok(hf_progress_create(&progress));
  assert_ok(hf_progress_get_fraction(progress, &fraction));
  assert_true(fraction == 0);
  assert_ok(hf_progress_cancel(progress));
  Options desc = options_of(&tube);
  desc.surface.progress = progress;
  hf_solver solver = NULL;
  assert_code(HF_ERROR_CANCELLED, make(&desc, NULL, &solver));
  assert_null(solver);
  assert_ok(make(&desc, NULL, &solver));
  /* the solver does not need the progress object */
  hf_progress_destroy(progress);
  add_site(solver, 0, 1);
  free(field_of(solver, VERTICES));
  hf_solver_destroy(solver);
  surface_free(&tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_kept_clone_has_the_bits_of_then),
      cmocka_unit_test(a_family_may_be_destroyed_in_any_order),
      cmocka_unit_test(a_cancel_in_the_middle_leaves_nothing_and_the_object_may_be_used_again),
      cmocka_unit_test(a_cancel_before_the_call_stops_one_call),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
