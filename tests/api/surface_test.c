/* Surfaces: what is made on one outlives it, kinds of fields share it, factors of every kind are saved and loaded, and
 * getters tell what was asked for. */
#include <pthread.h>

#include "api_support.h"

enum { AROUND = 12, RINGS = 16, COUNT = AROUND * RINGS };
static const int32_t kinds[3] = {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC, HF_FIELD_BIHARMONIC_GRAPH};

static hf_solver solver_of_kind(hf_surface surface, int32_t kind) {
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.field_kind = kind;
  hf_solver solver = NULL;
  assert_ok(hf_create(surface, &desc, &solver));
  return solver;
}

static hf_surface surface_of_kind(const Surface* mesh, int32_t kind, CountingAllocator* memory) {
  hf_surface_desc desc = options_of(mesh).surface;
  desc.field_kind = kind;
  if (memory) desc.allocator = counting_hooks(memory);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  return surface;
}

static void add_some(hf_solver solver) {
  add_site(solver, 3, 1);
  add_site(solver, COUNT - 5, -2);
  add_site(solver, COUNT / 2, 0.5);
}

static double memory_of(hf_surface surface) {
  hf_surface_statistics s = HF_INIT(hf_surface_statistics);
  assert_ok(hf_surface_get_statistics(surface, &s));
  return s.memory_bytes;
}

/* One of everything that is made on a surface. */
enum { SURFACE, SOLVER, PLATE, POSE, TRANSFER, DIRECTION, REGION, DETAIL, GEODESICS, QUADS, FLOW, MEMBERS };
typedef struct Household {
  CountingAllocator memory;
  hf_surface surface;
  hf_solver solver, plate;
  hf_pose pose;
  hf_transfer transfer;
  hf_direction direction;
  hf_region region;
  hf_detail detail;
  hf_geodesics geodesics;
  hf_quads quads;
  hf_flow flow;
} Household;

static void create_all(Household* h, const Surface* tube) {
  memset(h, 0, sizeof *h);
  h->surface = surface_of_kind(tube, HF_FIELD_HARMONIC, &h->memory);
  h->solver = solver_on(h->surface);
  h->plate = solver_of_kind(h->surface, HF_FIELD_BIHARMONIC);
  uint32_t handles[2];
  h->pose = tube_pose(h->surface, AROUND, RINGS, handles);
  assert_ok(hf_transfer_create(h->surface, h->surface, NULL, &h->transfer));
  add_tube_pairs(h->transfer, AROUND, RINGS);
  const uint32_t inside[6] = {40, 41, 42, 52, 53, 54};
  const double up[3] = {0, 1, 0};
  assert_ok(hf_direction_create(h->surface, NULL, &h->direction));
  assert_ok(hf_direction_add_sites(h->direction, 1, inside, up, NULL));
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 6;
  edit.add_vertices = inside;
  assert_ok(hf_region_create(h->surface, NULL, &h->region));
  assert_ok(hf_region_edit(h->region, &edit));
  assert_ok(hf_detail_create(h->region, h->region, NULL, &h->detail));
  assert_ok(hf_geodesics_create(h->surface, NULL, &h->geodesics));
  hf_quads_desc quads = HF_INIT(hf_quads_desc);
  quads.edge_length = 2;
  quads.relax_count = 1;
  assert_ok(hf_quads_create(h->surface, &quads, &h->quads));
  assert_ok(hf_flow_create(h->surface, &h->flow));
}

static void solve_with(hf_solver solver) {
  double field[COUNT];
  const uint32_t site = add_site(solver, 50, 2);
  assert_ok(hf_solver_solve(solver, OUT(field), NULL));
  assert_true(field[50] == 2);
  assert_ok(hf_remove_sites(solver, 1, &site));
}

static void use_member(Household* h, int member, const Surface* tube) {
  float positions[3 * COUNT];
  double values[COUNT];
  const uint32_t vertex = 40;
  hf_morph_desc morph = HF_INIT(hf_morph_desc);
  morph.positions = ROWS_OUT(positions);
  morph.weight = 0.5;
  switch (member) {
    case SURFACE: {
      hf_solver more = solver_of_kind(h->surface, HF_FIELD_BIHARMONIC);
      solve_with(more);
      hf_solver_destroy(more);
      break;
    }
    case SOLVER:
      solve_with(h->solver);
      break;
    case PLATE:
      solve_with(h->plate);
      break;
    case POSE:
      assert_ok(hf_deform(h->pose, positions, NULL));
      break;
    case TRANSFER: {
      hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
      frame.source_positions = HF_ARRAY(tube->positions, COUNT);
      frame.target_positions = ROWS_OUT(positions);
      assert_ok(hf_transfer_apply(h->transfer, &frame));
      break;
    }
    case DIRECTION:
      assert_ok(hf_direction_solve(h->direction, OUT(positions), NULL));
      break;
    case REGION:
      assert_ok(hf_region_morph(h->region, &morph));
      break;
    case DETAIL:
      assert_ok(hf_detail_morph(h->detail, &morph));
      break;
    case GEODESICS:
      assert_ok(hf_geodesics_solve(h->geodesics, 1, &vertex, OUT(values)));
      break;
    case QUADS: {
      hf_quads_info info = HF_INIT(hf_quads_info);
      assert_ok(hf_quads_get_info(h->quads, &info));
      break;
    }
    default: {
      for (uint32_t v = 0; v < COUNT; ++v) values[v] = (double)tube->positions[3 * v + 1] + 1e-3 * (v % AROUND);
      const hf_array field = HF_ARRAY(values, COUNT);
      hf_streamlines lines = HF_INIT(hf_streamlines);
      lines.wanted_count = 4;
      assert_ok(hf_flow_trace(h->flow, &field, &lines));
    }
  }
}

static void destroy_member(Household* h, int member) {
  switch (member) {
    case SURFACE:
      hf_surface_destroy(h->surface);
      break;
    case SOLVER:
      hf_solver_destroy(h->solver);
      break;
    case PLATE:
      hf_solver_destroy(h->plate);
      break;
    case POSE:
      hf_pose_destroy(h->pose);
      break;
    case TRANSFER:
      hf_transfer_destroy(h->transfer);
      break;
    case DIRECTION:
      hf_direction_destroy(h->direction);
      break;
    case REGION:
      hf_region_destroy(h->region);
      break;
    case DETAIL:
      hf_detail_destroy(h->detail);
      break;
    case GEODESICS:
      hf_geodesics_destroy(h->geodesics);
      break;
    case QUADS:
      hf_quads_destroy(h->quads);
      break;
    default:
      hf_flow_destroy(h->flow);
  }
}

static void all_that_is_made_on_a_surface_may_be_destroyed_in_any_order(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  uint32_t seed = 7;
  for (int round = 0; round < 24; ++round) {
    Household h;
    int order[MEMBERS];
    create_all(&h, &tube);
    for (int i = 0; i < MEMBERS; ++i) order[i] = i;
    for (int i = MEMBERS - 1; i > 0; --i) {
      seed = seed * 1664525u + 1013904223u;
      const int j = (int)((seed >> 16) % (unsigned)(i + 1)), kept = order[i];
      order[i] = order[j];
      order[j] = kept;
    }
    if (round == 0) { /* the surface first */
      for (int i = 0; i < MEMBERS; ++i) order[i] = i;
    } else if (round == 1) { /* the surface last */
      for (int i = 0; i < MEMBERS; ++i) order[i] = MEMBERS - 1 - i;
    }
    for (int i = 0; i < MEMBERS; ++i) {
      destroy_member(&h, order[i]);
      for (int j = i + 1; j < MEMBERS; ++j) use_member(&h, order[j], &tube);
    }
    assert_int_equal(h.memory.live_blocks, 0);
    assert_int_equal(h.memory.live_bytes, 0);
    assert_int_equal(h.memory.mismatches, 0);
  }
  surface_free(&tube);
}

static void a_kind_asked_for_later_gives_the_bits_of_a_surface_made_with_it(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_surface harmonic = surface_on(&tube);
  for (size_t k = 0; k < COUNT_OF(kinds); ++k) {
    const hf_surface own = surface_of_kind(&tube, kinds[k], NULL);
    const hf_surface surfaces[2] = {harmonic, own};
    double* fields[2];
    static double bases[2][3 * COUNT];
    for (int i = 0; i < 2; ++i) {
      hf_solver solver = solver_of_kind(surfaces[i], kinds[k]);
      add_some(solver);
      fields[i] = field_of(solver, COUNT);
      hf_region_desc desc = HF_INIT(hf_region_desc);
      desc.base = HF_BASE_MEMBRANE + kinds[k];
      hf_region region = NULL;
      const uint32_t inside[6] = {40, 41, 42, 52, 53, 54};
      hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
      edit.add_count = 6;
      edit.add_vertices = inside;
      assert_ok(hf_region_create(surfaces[i], &desc, &region));
      assert_ok(hf_region_edit(region, &edit));
      hf_morph_desc morph = HF_INIT(hf_morph_desc);
      morph.weight = 1;
      morph.positions = ROWS_OUT(bases[i]);
      assert_ok(hf_region_morph(region, &morph));
      hf_region_destroy(region);
      hf_solver_destroy(solver);
    }
    assert_true(same_bits(fields[0], fields[1], sizeof(double) * COUNT));
    assert_true(same_bits(bases[0], bases[1], sizeof bases[0]));
    free(fields[0]);
    free(fields[1]);
    hf_surface_destroy(own);
  }
  /* and poses, which take the harmonic factor, on a surface that was made without it */
  const hf_surface plate = surface_of_kind(&tube, HF_FIELD_BIHARMONIC, NULL);
  const hf_surface surfaces[2] = {harmonic, plate};
  static float posed[2][3 * COUNT];
  for (int i = 0; i < 2; ++i) {
    uint32_t handles[2];
    hf_pose pose = tube_pose(surfaces[i], AROUND, RINGS, handles);
    const hf_transform bent = {{0, 0, 0.38268343, 0.92387953}, {3, 1, 0}};
    assert_ok(hf_pose_set_transform(pose, handles[1], &bent));
    assert_ok(hf_deform(pose, posed[i], NULL));
    hf_pose_destroy(pose);
  }
  assert_true(same_bits(posed[0], posed[1], sizeof posed[0]));
  hf_surface_destroy(plate);
  hf_surface_destroy(harmonic);
  surface_free(&tube);
}

static void the_second_kind_is_made_once_and_shared(void** state) {
  (void)state;
  Surface sheet = surface_sheet(60, 60);
  const hf_surface surface = surface_on(&sheet);
  const double first = memory_of(surface);
  hf_solver harmonic = solver_on(surface);
  const double cheap = memory_of(surface) - first;
  hf_solver plates[3] = {solver_of_kind(surface, HF_FIELD_BIHARMONIC), NULL, NULL};
  const double with = memory_of(surface);
  assert_true(with - first > 5 * cheap + 1e5); /* a factor was made ... */
  plates[1] = solver_of_kind(surface, HF_FIELD_BIHARMONIC);
  plates[2] = solver_of_kind(surface, HF_FIELD_BIHARMONIC);
  const double added = memory_of(surface) - with;
  assert_true(added < 0.2 * (with - first)); /* ... and two more solvers share it */
  size_t size = 0;
  assert_ok(hf_surface_save(surface, HF_FIELD_BIHARMONIC, NULL, 0, NULL, &size));
  assert_true(size > 0 && memory_of(surface) - with < 0.2 * (with - first));
  for (int i = 0; i < 3; ++i) hf_solver_destroy(plates[i]);
  hf_solver_destroy(harmonic);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void every_kind_is_saved_and_loaded(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_surface surface = surface_on(&tube);
  for (size_t k = 0; k < COUNT_OF(kinds); ++k) {
    size_t size = 0, own_size = 0, again_size = 0;
    unsigned char* bytes = saved_bytes(surface, kinds[k], &size);
    const hf_surface own = surface_of_kind(&tube, kinds[k], NULL);
    unsigned char* own_bytes = saved_bytes(own, kinds[k], &own_size);
    assert_int_equal(size, own_size);
    assert_true(same_bits(bytes, own_bytes, size));
    hf_factor_desc factor = HF_INIT(hf_factor_desc);
    factor.bytes = bytes;
    factor.byte_count = size;
    hf_surface_desc desc = options_of(&tube).surface;
    desc.saved_factor = &factor;
    desc.field_kind = kinds[k];
    hf_surface loaded = NULL;
    assert_ok(hf_surface_create(&desc, &loaded));
    hf_surface_statistics s = HF_INIT(hf_surface_statistics);
    assert_ok(hf_surface_get_statistics(loaded, &s));
    assert_true(s.factor_loaded == 1 && s.numeric_ms == 0);
    unsigned char* again = saved_bytes(loaded, kinds[k], &again_size);
    assert_true(again_size == size && same_bits(again, bytes, size));
    hf_solver a = solver_of_kind(own, kinds[k]), b = solver_of_kind(loaded, kinds[k]);
    add_some(a);
    add_some(b);
    double *expected = field_of(a, COUNT), *field = field_of(b, COUNT);
    assert_true(same_bits(field, expected, sizeof(double) * COUNT));
    /* the factor of one kind is none of another */
    hf_surface out = surface;
    desc.field_kind = kinds[(k + 1) % 3];
    assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &out));
    assert_null(out);
    free(expected);
    free(field);
    free(bytes);
    free(own_bytes);
    free(again);
    hf_solver_destroy(a);
    hf_solver_destroy(b);
    hf_surface_destroy(own);
    hf_surface_destroy(loaded);
  }
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void getters_tell_what_was_asked_for(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  hf_surface_desc desc = options_of(&tube).surface;
  hf_surface_info info = HF_INIT(hf_surface_info);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  assert_ok(hf_surface_get_info(surface, &info));
  assert_true(info.vertex_count == COUNT && info.triangle_count == tube.triangle_count);
  assert_true(info.weld == 0 && info.weld_tolerance == 0 && info.operator_kind == 0 && info.field_kind == 0);
  assert_true(info.ordering == 0 && info.thread_count == 1 && info.vertex_limit == 20000000);
  assert_true(info.triangle_limit == 0 && info.memory_limit_mb == 0 && info.work_limit_gflop == 100000);
  hf_surface_destroy(surface);
  desc.weld = HF_WELD_TOLERANCE;
  desc.weld_tolerance = 0.01;
  desc.operator_kind = HF_OPERATOR_CLAMPED;
  desc.field_kind = HF_FIELD_BIHARMONIC;
  desc.ordering = HF_ORDERING_MINIMUM_DEGREE;
  desc.thread_count = 3;
  desc.vertex_limit = 5000;
  desc.triangle_limit = 9000;
  desc.memory_limit_mb = 200;
  desc.work_limit_gflop = 7;
  assert_ok(hf_surface_create(&desc, &surface));
  assert_ok(hf_surface_get_info(surface, &info));
  assert_true(info.weld == HF_WELD_TOLERANCE && info.weld_tolerance == desc.weld_tolerance);
  assert_true(info.operator_kind == HF_OPERATOR_CLAMPED && info.field_kind == HF_FIELD_BIHARMONIC);
  assert_true(info.ordering == HF_ORDERING_MINIMUM_DEGREE && info.thread_count == 3);
  assert_true(info.vertex_limit == 5000 && info.triangle_limit == 9000 && info.memory_limit_mb == 200 &&
              info.work_limit_gflop == 7);

  hf_solver_info made = HF_INIT(hf_solver_info);
  hf_solver solver = solver_on(surface);
  assert_ok(hf_solver_get_info(solver, &made));
  assert_true(made.field_kind == 0 && made.channel_count == 1 && made.site_limit == 100000);
  assert_true(made.site_count == 0 && made.vertex_count == COUNT);
  hf_solver_destroy(solver);
  hf_solver_desc asked = HF_INIT(hf_solver_desc);
  asked.field_kind = HF_FIELD_BIHARMONIC_GRAPH;
  asked.channel_count = 2;
  asked.site_limit = 17;
  assert_ok(hf_create(surface, &asked, &solver));
  const double values[2] = {3, 4};
  uint32_t site = NO_INDEX;
  assert_ok(hf_solver_add_site(solver, 9, values, &site));
  assert_ok(hf_solver_get_info(solver, &made));
  assert_int_equal(made.field_kind, HF_FIELD_BIHARMONIC_GRAPH);
  assert_true(made.channel_count == 2 && made.site_limit == 17 && made.site_count == 1);
  double at[2];
  const uint32_t vertex = 9;
  assert_ok(hf_solver_solve_at(solver, 1, &vertex, at));
  assert_true(at[0] == 3 && at[1] == 4 && site == 0);
  hf_solver_destroy(solver);

  hf_pose_info posed = HF_INIT(hf_pose_info);
  for (int32_t mode = POSE_SMOOTH; mode <= POSE_PAPER; ++mode) {
    hf_pose_desc plain = HF_INIT(hf_pose_desc);
    hf_pose pose = NULL;
    assert_ok(create_pose_with(mode, surface, &plain, &pose));
    const double top[3] = {1, RINGS - 1, 0};
    assert_ok(hf_pose_add_handle_at(pose, top, 1.1, NULL));
    assert_ok(hf_pose_get_info(pose, &posed));
    assert_true(posed.band_count == (mode ? 12 : 10) && posed.iteration_count == (mode ? 200 : 10));
    assert_true(posed.handle_count == 1 && posed.vertex_count == COUNT);
    if (mode == POSE_SMOOTH) assert_int_equal(posed.group_count, 250);
    hf_pose_destroy(pose);
    plain.band_count = 5;
    plain.iteration_count = 6;
    plain.group_count = 8;
    assert_ok(create_pose_with(mode, surface, &plain, &pose));
    assert_ok(hf_pose_get_info(pose, &posed));
    assert_true(posed.band_count == 5 && posed.iteration_count == 6);
    assert_true(posed.group_count == 8 && posed.handle_count == 0);
    hf_pose_destroy(pose);
  }
  hf_surface_destroy(surface);
  surface_free(&tube);
}

/* Holds threads until `missing` of them have come; macOS has no pthread_barrier_t. */
typedef struct Start {
  pthread_mutex_t mutex;
  pthread_cond_t complete;
  int missing;
} Start;

static void wait_for_all(Start* start) {
  pthread_mutex_lock(&start->mutex);
  if (--start->missing == 0) pthread_cond_broadcast(&start->complete);
  while (start->missing > 0) pthread_cond_wait(&start->complete, &start->mutex);
  pthread_mutex_unlock(&start->mutex);
}

/* Eight threads ask for a kind that is missing, all at once. */
typedef struct Asker {
  pthread_t thread;
  Start* start;
  hf_surface surface;
  int32_t kind;
  double field[COUNT];
  int wrong;
} Asker;

static void* ask(void* data) {
  Asker* a = data;
  hf_solver_desc desc = HF_INIT(hf_solver_desc);
  desc.field_kind = a->kind;
  hf_solver solver = NULL;
  wait_for_all(a->start);
  a->wrong += hf_create(a->surface, &desc, &solver) != HF_OK;
  const double values[3] = {1, -2, 0.5};
  const uint32_t vertices[3] = {3, COUNT - 5, COUNT / 2};
  for (int i = 0; i < 3; ++i) a->wrong += hf_solver_add_site(solver, vertices[i], values + i, NULL) != HF_OK;
  a->wrong += hf_solver_solve(solver, OUT(a->field), NULL) != HF_OK;
  hf_solver_destroy(solver);
  return NULL;
}

static void eight_threads_may_ask_for_a_missing_kind_at_once(void** state) {
  (void)state;
  enum { THREADS = 8 };
  Surface tube = surface_tube(AROUND, RINGS);
  static Asker askers[THREADS];
  for (int round = 0; round < 10; ++round) {
    const hf_surface surface = surface_on(&tube);
    Start start = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, THREADS};
    for (int i = 0; i < THREADS; ++i) {
      askers[i].start = &start;
      askers[i].surface = surface;
      askers[i].wrong = 0;
      askers[i].kind = round % 2 ? kinds[1 + i % 2] : kinds[1];
      assert_int_equal(pthread_create(&askers[i].thread, NULL, ask, &askers[i]), 0);
    }
    for (int i = 0; i < THREADS; ++i) assert_int_equal(pthread_join(askers[i].thread, NULL), 0);
    for (int i = 0; i < THREADS; ++i) {
      assert_int_equal(askers[i].wrong, 0);
      hf_solver solver = solver_of_kind(surface, askers[i].kind);
      add_some(solver);
      double* expected = field_of(solver, COUNT);
      assert_true(same_bits(askers[i].field, expected, sizeof(double) * COUNT));
      free(expected);
      hf_solver_destroy(solver);
    }
    pthread_cond_destroy(&start.complete);
    pthread_mutex_destroy(&start.mutex);
    hf_surface_destroy(surface);
  }
  surface_free(&tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_that_is_made_on_a_surface_may_be_destroyed_in_any_order),
      cmocka_unit_test(a_kind_asked_for_later_gives_the_bits_of_a_surface_made_with_it),
      cmocka_unit_test(the_second_kind_is_made_once_and_shared),
      cmocka_unit_test(every_kind_is_saved_and_loaded),
      cmocka_unit_test(getters_tell_what_was_asked_for),
      cmocka_unit_test(eight_threads_may_ask_for_a_missing_kind_at_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
