/* Vector fields through the ABI: the paper's three channels with vectors carried and turned, direction objects, and
 * bi-harmonic solvers. */
#include "api_support.h"

enum { AROUND = 24, RINGS = 18, VERTICES = AROUND * RINGS };

static double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* The tube unrolled has no curvature: a field along it is known everywhere. Outward is +x at vertex 0 or inward, as the
 * triangles run; only lengths and heights are asked for. */
static hf_solver tube_solver(Surface* tube, uint32_t channels) {
  *tube = surface_tube(AROUND, RINGS);
  Options desc = options_of(tube);
  desc.solver.channel_count = channels;
  hf_solver solver;
  assert_ok(make(&desc, NULL, &solver));
  return solver;
}

static void a_vector_of_three_channels_is_carried_and_turned_without_touching_the_factor(void** state) {
  (void)state;
  Surface tube;
  const hf_solver solver = tube_solver(&tube, 3);
  const uint32_t ring = RINGS / 2 * AROUND, places[2] = {ring, ring + AROUND / 2};
  /* at `ring` straight up the tube and around it by as much: around is the tangent of the circle there */
  const float* p = tube.positions + 3 * ring;
  const double around[3] = {-p[2], 0, p[0]}, values[6] = {around[0], 1, around[2], 0, 1, 0};
  const hf_sites_desc batch = sites_at(2, places, values);
  uint32_t sites[2];
  assert_ok(hf_add_sites(solver, &batch, sites));
  static double field[3 * VERTICES], normals[3 * VERTICES];
  assert_ok(hf_solver_solve_vectors(solver, OUT(field), normals, NULL));
  for (uint32_t v = 0; v < VERTICES; ++v) {
    assert_true(fabs(dot3(field + 3 * v, normals + 3 * v)) <= 1e-12);
    assert_true(fabs(dot3(normals + 3 * v, normals + 3 * v) - 1) <= 1e-12);
  }

  hf_solver_statistics before, after;
  before = HF_INIT(hf_solver_statistics);
  after = HF_INIT(hf_solver_statistics);
  assert_ok(hf_solver_get_statistics(solver, &before));
  const double quarter = acos(0.0);
  assert_ok(hf_solver_rotate_vectors(solver, 1, sites + 1, &quarter));
  assert_ok(hf_solver_get_statistics(solver, &after));
  assert_int_equal(after.factorisation_count, before.factorisation_count);
  assert_int_equal(after.path_solve_count, before.path_solve_count);
  assert_ok(hf_solver_solve_vectors(solver, OUT(field), normals, NULL));
  const double up[3] = {0, 1, 0};
  assert_true(fabs(dot3(field + 3 * places[1], up)) <= 1e-9);
  assert_true(fabs(dot3(field + 3 * places[1], field + 3 * places[1]) - 1) <= 1e-9);

  /* a quarter of the way around: still as much up, and around */
  const uint32_t there = ring + AROUND / 4;
  assert_ok(hf_solver_move_vectors(solver, 1, sites, &there));
  assert_ok(hf_solver_get_statistics(solver, &after));
  assert_int_equal(after.factorisation_count, before.factorisation_count);
  assert_ok(hf_solver_solve_vectors(solver, OUT(field), normals, NULL));
  const float* q = tube.positions + 3 * there;
  const double along[3] = {-q[2], 0, q[0]};
  assert_true(fabs(dot3(field + 3 * there, up) - 1) <= 1e-6);
  assert_true(fabs(dot3(field + 3 * there, along) - 1) <= 1e-6);
  hf_solver_destroy(solver);
  surface_free(&tube);
}

/* One call that must be refused with this code and index. */
#define REFUSED(what, expected, index, call) check_row(__LINE__, what, #call, call, expected, index)

static void vectors_are_refused_with_their_place_in_the_list(void** state) {
  (void)state;
  Surface tube;
  const hf_solver solver = tube_solver(&tube, 3), flat = surface_solver(&tube);
  const uint32_t places[2] = {3, 90}, far[2] = {100, VERTICES}, taken[1] = {90}, absent[2] = {0, 7};
  const double values[6] = {1, 0, 0, 0, 1, 0}, angles[2] = {1, HUGE_VAL};
  const hf_sites_desc batch = sites_at(2, places, values);
  uint32_t sites[2];
  assert_ok(hf_add_sites(solver, &batch, sites));
  add_site(flat, 3, 1);
  REFUSED("past the end", HF_ERROR_OUT_OF_RANGE, 1, hf_solver_move_vectors(solver, 2, sites, far));
  REFUSED("taken", HF_ERROR_CONFLICT, 0, hf_solver_move_vectors(solver, 1, sites, taken));
  REFUSED("absent", HF_ERROR_NOT_FOUND, 1, hf_solver_move_vectors(solver, 2, absent, places));
  REFUSED("none", HF_ERROR_EMPTY, NO_INDEX, hf_solver_move_vectors(solver, 0, sites, places));
  REFUSED("NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_solver_move_vectors(solver, 1, NULL, places));
  REFUSED("NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_solver_move_vectors(solver, 1, sites, NULL));
  REFUSED("one channel", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_solver_move_vectors(flat, 1, sites, places));
  REFUSED("infinite", HF_ERROR_NON_FINITE, 1, hf_solver_rotate_vectors(solver, 2, sites, angles));
  REFUSED("absent", HF_ERROR_NOT_FOUND, 1, hf_solver_rotate_vectors(solver, 2, absent, values));
  REFUSED("too many", HF_ERROR_NOT_FOUND, 2, hf_solver_rotate_vectors(solver, 1000000, sites, angles));
  REFUSED("one channel", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_solver_rotate_vectors(flat, 1, sites, angles));
  double now[6];
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 2;
  info.values = now;
  assert_ok(hf_solver_get_sites(solver, &info));
  row_holds(__LINE__, "values", "are as they were", same_bits(now, values, sizeof now));
  finish_rows("vectors");
  hf_solver_destroy(solver);
  hf_solver_destroy(flat);
  surface_free(&tube);
}

static void a_direction_field_follows_its_constraints(void** state) {
  (void)state;
  Surface tube;
  tube = surface_tube(AROUND, RINGS);
  const hf_surface surface = surface_on(&tube);
  for (uint32_t degree = 1; degree <= 4; degree *= 2) {
    hf_direction_desc desc = HF_INIT(hf_direction_desc);
    desc.degree = degree;
    hf_direction direction;
    assert_ok(hf_direction_create(surface, &desc, &direction));
    const uint32_t places[2] = {3 * AROUND, 9 * AROUND + 5};
    const double up[6] = {0, 1, 0, 0, 2, 0};
    uint32_t sites[2], numbers[2], vertices[2];
    static float field[3 * VERTICES];
    static double exact[3 * VERTICES];
    check_row(__LINE__, "no constraint", "hf_direction_solve", hf_direction_solve(direction, OUT(field), NULL),
              HF_ERROR_EMPTY, NO_INDEX);
    assert_ok(hf_direction_add_sites(direction, 1, places, up, sites));
    assert_ok(hf_direction_solve(direction, OUT(field), NULL));
    for (uint32_t v = 0; v < VERTICES; ++v) { /* flat in itself: the field is parallel */
      const double length =
          sqrt((double)field[3 * v] * (double)field[3 * v] + (double)field[3 * v + 1] * (double)field[3 * v + 1] +
               (double)field[3 * v + 2] * (double)field[3 * v + 2]);
      assert_true(fabs(length - 1) <= 1e-5);
      if (degree == 1) assert_true((double)field[3 * v + 1] >= 0.95);
    }
    assert_ok(hf_direction_add_sites(direction, 1, places + 1, up + 3, sites + 1));
    assert_int_equal(hf_direction_get_site_count(direction), 2);
    hf_solve_info info = HF_INIT(hf_solve_info);
    assert_ok(hf_direction_solve(direction, OUT(exact), &info));
    assert_int_equal(info.unreached_component_count, 0);
    double vectors[6];
    assert_ok(hf_direction_get_sites(direction, 2, numbers, vertices, vectors, NULL));
    for (int i = 0; i < 2; ++i) {
      assert_int_equal(numbers[i], sites[i]);
      assert_int_equal(vertices[i], places[i]);
      for (int k = 0; k < 3; ++k) assert_true(exact[3 * places[i] + (uint32_t)k] == vectors[3 * i + k]);
    }
    hf_direction_statistics before, after;
    before = HF_INIT(hf_direction_statistics);
    after = HF_INIT(hf_direction_statistics);
    assert_ok(hf_direction_get_statistics(direction, &before));
    assert_int_equal(before.unknown_count, 2 * VERTICES);
    assert_int_equal(before.path_solve_count, 4);
    assert_int_equal(before.irregular_vertex_count, 0);
    const double half = 2 * acos(0.0), other[3] = {0, -3, 0};
    assert_ok(hf_direction_rotate_sites(direction, 1, sites, &half));
    assert_ok(hf_direction_set_vectors(direction, 1, sites + 1, other));
    assert_ok(hf_direction_solve(direction, OUT(exact), NULL));
    assert_ok(hf_direction_get_statistics(direction, &after));
    assert_int_equal(after.factorisation_count, before.factorisation_count);
    assert_int_equal(after.path_solve_count, before.path_solve_count);
    assert_true(fabs(exact[3 * places[0] + 1] + 1) <= 1e-12 && fabs(exact[3 * places[1] + 1] + 3) <= 1e-12);
    const uint32_t there = 12 * AROUND + 7;
    assert_ok(hf_direction_move_sites(direction, 1, sites, &there));
    assert_ok(hf_direction_get_sites(direction, 2, NULL, vertices, vectors, NULL));
    assert_int_equal(vertices[0], there);
    assert_true(fabs(dot3(vectors, vectors) - 1) <= 1e-12 && vectors[1] <= -0.99);
    uint32_t count = 99;
    assert_ok(hf_direction_get_singularities(direction, 0, NULL, &count));
    hf_singularity* found = calloc(count + 1, sizeof *found);
    assert_non_null(found);
    assert_ok(hf_direction_get_singularities(direction, count, found, &count));
    for (uint32_t i = 0; i < count; ++i)
      assert_true(found[i].triangle < tube.triangle_count && found[i].vertex < VERTICES && found[i].index != 0);
    free(found);
    assert_ok(hf_direction_remove_sites(direction, 1, sites + 1));
    assert_int_equal(hf_direction_get_site_count(direction), 1);
    hf_direction_destroy(direction);
  }
  finish_rows("direction");
  /* children keep what they share */
  hf_direction direction;
  assert_ok(hf_direction_create(surface, NULL, &direction));
  hf_surface_destroy(surface);
  const uint32_t vertex = 5;
  const double vector[3] = {0, 1, 0};
  assert_ok(hf_direction_add_sites(direction, 1, &vertex, vector, NULL));
  static float field[3 * VERTICES];
  assert_ok(hf_direction_solve(direction, OUT(field), NULL));
  hf_direction_destroy(direction);
  surface_free(&tube);
}

static void a_direction_object_refuses_bad_input_and_stays_as_it_was(void** state) {
  (void)state;
  Surface cut = surface_cut();
  const hf_surface surface = surface_on(&cut);
  hf_direction_desc desc = HF_INIT(hf_direction_desc);
  hf_direction direction;
  desc.degree = 3;
  check_row(__LINE__, "degree 3", "hf_direction_create", hf_direction_create(surface, &desc, &direction),
            HF_ERROR_INVALID_ARGUMENT, NO_INDEX);
  desc.degree = 0;
  desc.reserved = 1;
  check_row(__LINE__, "reserved", "hf_direction_create", hf_direction_create(surface, &desc, &direction),
            HF_ERROR_INVALID_DESC, NO_INDEX);
  check_row(__LINE__, "NULL", "hf_direction_create", hf_direction_create(surface, NULL, NULL), HF_ERROR_NULL_POINTER,
            NO_INDEX);
  desc.reserved = 0;
  desc.site_limit = 3;
  assert_ok(hf_direction_create(surface, &desc, &direction));
  const uint32_t places[2] = {CUT_LEFT, CUT_SEAM_LEFT};
  const double vectors[12] = {1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 0};
  uint32_t sites[2];
  assert_ok(hf_direction_add_sites(direction, 2, places, vectors, sites));
  static double before[3 * CUT_VERTICES], now[3 * CUT_VERTICES];
  hf_solve_info info = HF_INIT(hf_solve_info);
  assert_ok(hf_direction_solve(direction, OUT(before), &info));
  assert_int_equal(info.unreached_component_count, 1); /* the piece */
  assert_int_equal(info.unreached_vertex_count, 10);
  assert_true(same_bits(before + 3 * CUT_SEAM_LEFT, before + 3 * CUT_SEAM_RIGHT, 3 * sizeof(double)));

  const uint32_t copy[2] = {10, CUT_SEAM_RIGHT}, isolated[1] = {CUT_ISOLATED}, piece[1] = {CUT_ISLAND},
                 past[2] = {10, CUT_VERTICES};
  const uint32_t twice[2] = {0, 0}, absent[1] = {9};
  const double bad[6] = {1, 0, 0, 0, NAN, 0};
  REFUSED("a welded copy", HF_ERROR_TOO_LARGE, NO_INDEX, hf_direction_add_sites(direction, 2, copy, vectors, NULL));
  REFUSED("a welded copy", HF_ERROR_DUPLICATE, 0, hf_direction_add_sites(direction, 1, copy + 1, vectors, NULL));
  REFUSED("isolated", HF_ERROR_INVALID_ARGUMENT, 0, hf_direction_add_sites(direction, 1, isolated, vectors, NULL));
  REFUSED("past the end", HF_ERROR_OUT_OF_RANGE, 0, hf_direction_add_sites(direction, 1, past + 1, vectors, NULL));
  REFUSED("none", HF_ERROR_EMPTY, NO_INDEX, hf_direction_add_sites(direction, 0, copy, vectors, NULL));
  REFUSED("NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_direction_add_sites(direction, 1, NULL, vectors, NULL));
  REFUSED("NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_direction_add_sites(direction, 1, copy, NULL, NULL));
  REFUSED("another component", HF_ERROR_INVALID_ARGUMENT, 0, hf_direction_move_sites(direction, 1, sites, piece));
  REFUSED("twice", HF_ERROR_NOT_FOUND, 1, hf_direction_move_sites(direction, 2, twice, places));
  REFUSED("taken", HF_ERROR_DUPLICATE, 0, hf_direction_move_sites(direction, 1, sites, copy + 1));
  REFUSED("past the end", HF_ERROR_OUT_OF_RANGE, 1, hf_direction_move_sites(direction, 2, sites, past));
  REFUSED("not finite", HF_ERROR_NON_FINITE, 1, hf_direction_set_vectors(direction, 2, sites, bad));
  REFUSED("not finite", HF_ERROR_NON_FINITE, 0, hf_direction_rotate_sites(direction, 1, sites, bad + 4));
  REFUSED("absent", HF_ERROR_NOT_FOUND, 0, hf_direction_rotate_sites(direction, 1, absent, vectors));
  REFUSED("absent", HF_ERROR_NOT_FOUND, 0, hf_direction_remove_sites(direction, 1, absent));
  REFUSED("twice", HF_ERROR_NOT_FOUND, 1, hf_direction_remove_sites(direction, 2, twice));
  REFUSED("too many", HF_ERROR_NOT_FOUND, 2, hf_direction_remove_sites(direction, 3000000000u, twice));
  REFUSED("room for one", HF_ERROR_TOO_SMALL, NO_INDEX, hf_direction_get_sites(direction, 1, sites, NULL, NULL, NULL));
  REFUSED("narrow", HF_ERROR_TOO_SMALL, NO_INDEX, hf_direction_solve(direction, OUT_ROWS(now, 16), NULL));
  REFUSED("NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_direction_solve(direction, NULL, NULL));
  REFUSED("NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_direction_get_singularities(direction, 0, NULL, NULL));
  assert_ok(hf_direction_solve(direction, OUT(now), NULL));
  row_holds(__LINE__, "the field", "is as it was", same_bits(before, now, sizeof now));
  finish_rows("direction input");
  hf_direction_destroy(direction);
  hf_surface_destroy(surface);
  surface_free(&cut);
}

/* A walk of edits with a clone kept before each. The clones are then edited and destroyed from the last to the first.
 */
static void a_kept_clone_has_the_bits_of_then(void** state) {
  (void)state;
  enum { STEPS = 12, SIZE = 3 * VERTICES };
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_surface surface = surface_on(&tube);
  for (uint32_t degree = 1; degree <= 4; degree *= 2) {
    hf_direction_desc desc = HF_INIT(hf_direction_desc);
    desc.degree = degree;
    hf_direction direction, kept[STEPS];
    static double fields[STEPS][SIZE], now[SIZE];
    uint32_t numbers[STEPS + 1], counts[STEPS];
    const double angle = 0.7;
    assert_ok(hf_direction_create(surface, &desc, &direction));
    for (uint32_t step = 0; step < STEPS; ++step) {
      const uint32_t vertex = (7 * step + 5) % VERTICES, to = vertex + AROUND, edit = step < 3 ? 0 : step % 4;
      const double vector[3] = {sin(step), cos(step), 0.4};
      if (edit == 0) assert_ok(hf_direction_add_sites(direction, 1, &vertex, vector, NULL));
      assert_ok(hf_direction_get_sites(direction, STEPS + 1, numbers, NULL, NULL, NULL));
      if (edit == 1) assert_ok(hf_direction_rotate_sites(direction, 1, numbers, &angle));
      if (edit == 2) assert_ok(hf_direction_move_sites(direction, 1, numbers, &to));
      if (edit == 3) assert_ok(hf_direction_remove_sites(direction, 1, numbers));
      counts[step] = hf_direction_get_site_count(direction);
      assert_ok(hf_direction_solve(direction, OUT(fields[step]), NULL));
      assert_ok(hf_direction_clone(direction, &kept[step]));
    }
    hf_direction_destroy(direction);
    for (uint32_t step = STEPS; step-- > 0;) {
      assert_int_equal(hf_direction_get_site_count(kept[step]), counts[step]);
      assert_ok(hf_direction_solve(kept[step], OUT(now), NULL));
      assert_memory_equal(now, fields[step], sizeof now);
      hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
      assert_ok(hf_direction_get_statistics(kept[step], &statistics));
      assert_int_equal(statistics.path_solve_count, 0);
      assert_ok(hf_direction_get_sites(kept[step], STEPS + 1, numbers, NULL, NULL, NULL));
      assert_ok(hf_direction_rotate_sites(kept[step], 1, numbers, &angle));
      hf_direction_destroy(kept[step]);
    }
  }
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void a_biharmonic_solver_takes_the_same_edits_and_overshoots(void** state) {
  (void)state;
  Surface sheet = surface_sheet(20, 20);
  for (int32_t kind = HF_FIELD_BIHARMONIC; kind <= HF_FIELD_BIHARMONIC_GRAPH; ++kind) {
    static const int32_t engines[] = {ENGINE_GREEN, ENGINE_REFACTOR};
    double* fields[2];
    for (int e = 0; e < 2; ++e) {
      Options desc = options_of(&sheet);
      desc.surface.field_kind = kind;
      desc.engine = engines[e];
      hf_solver solver;
      assert_ok(make(&desc, NULL, &solver));
      const uint32_t row = 10 * 21;
      add_site(solver, row + 2, 0);
      add_site(solver, row + 6, 1);
      const uint32_t gone = add_site(solver, 5, 9);
      add_site(solver, row + 10, 0);
      add_site(solver, 6 * 21 + 6, 1);
      add_site(solver, 14 * 21 + 6, 1);
      assert_ok(hf_remove_sites(solver, 1, &gone));
      fields[e] = field_of(solver, sheet.vertex_count);
      hf_solver_destroy(solver);
    }
    double low = 0, high = 0;
    for (uint32_t v = 0; v < sheet.vertex_count; ++v) {
      low = fmin(low, fields[0][v]);
      high = fmax(high, fields[0][v]);
      assert_true(fabs(fields[0][v] - fields[1][v]) <= 1e-8);
    }
    assert_true(low < -0.05 || high > 1.05);
    free(fields[0]);
    free(fields[1]);
  }
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_vector_of_three_channels_is_carried_and_turned_without_touching_the_factor),
      cmocka_unit_test(vectors_are_refused_with_their_place_in_the_list),
      cmocka_unit_test(a_direction_field_follows_its_constraints),
      cmocka_unit_test(a_direction_object_refuses_bad_input_and_stays_as_it_was),
      cmocka_unit_test(a_kept_clone_has_the_bits_of_then),
      cmocka_unit_test(a_biharmonic_solver_takes_the_same_edits_and_overshoots),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
