/* Very many constraints of a direction object, and few of them again. */
#include "api_support.h"

/* Constraints on every step-th vertex of `count`, pointing about; out_sites as hf_direction_add_sites. */
static void constrain(hf_direction direction, uint32_t count, uint32_t step, uint32_t first, uint32_t* out_sites) {
  uint32_t* places = malloc(count * sizeof *places);
  double* vectors = malloc(3 * count * sizeof *vectors);
  for (uint32_t i = 0; i < count; ++i) {
    places[i] = first + i * step;
    vectors[3 * i] = 1;
    vectors[3 * i + 1] = (double)(places[i] % 7) - 3;
    vectors[3 * i + 2] = 0.25;
  }
  assert_ok(hf_direction_add_sites(direction, count, places, vectors, out_sites));
  free(places);
  free(vectors);
}

/* Two sheets, the second flat: without constraints its operator is singular but for the ground. So many constraints
 * that the dead rows are tidied away, so many that they go into the factor, and few again: each time the field is that
 * of an object which never had others. */
static void many_constraints_come_and_go_without_a_trace(void** state) {
  (void)state;
  enum { SIDE = 50, HALF = (SIDE + 1) * (SIDE + 1), ALL = 2 * HALF, MANY = 1000 };
  Surface sheet = surface_sheet(SIDE, SIDE), two = {ALL, 2 * sheet.triangle_count, NULL, NULL};
  two.positions = malloc(sizeof(float) * 3 * ALL);
  two.triangles = malloc(sizeof(uint32_t) * 3 * two.triangle_count);
  for (uint32_t i = 0; i < 3 * HALF; ++i) {
    two.positions[i] = sheet.positions[i];
    two.positions[3 * HALF + i] = i % 3 == 0   ? sheet.positions[i] + 2.0f * SIDE
                                  : i % 3 == 1 ? sheet.positions[i]
                                               : 0.0f;
  }
  for (uint32_t i = 0; i < 3 * sheet.triangle_count; ++i) {
    two.triangles[i] = sheet.triangles[i];
    two.triangles[3 * sheet.triangle_count + i] = sheet.triangles[i] + HALF;
  }
  const hf_surface surface = surface_on(&two);
  double* got = malloc(sizeof(double) * 3 * ALL);
  double* right = malloc(sizeof(double) * 3 * ALL);
  uint32_t sites[MANY];
  for (int round = 0; round < 3; ++round) {
    /* 120 of which 30 stay; 1,000 into the factor, with the other sheet unreached; the same with it reached */
    const uint32_t count = round == 0 ? 120 : MANY, step = 2, keep = round == 0 ? 4 : 3;
    hf_direction direction = NULL, fresh = NULL;
    assert_ok(hf_direction_create(surface, NULL, &direction));
    assert_ok(hf_direction_create(surface, NULL, &fresh));
    if (round == 2) {
      constrain(direction, 3, 700, HALF, NULL);
      constrain(fresh, 3, 700, HALF, NULL);
    }
    constrain(direction, count, step, 0, sites);
    hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
    assert_ok(hf_direction_get_statistics(direction, &statistics));
    assert_int_equal(statistics.eliminated_count > 0, round > 0);
    uint32_t leaving = 0, list[MANY];
    for (uint32_t i = 0; i < count; ++i)
      if (i % keep != 0) list[leaving++] = sites[i];
    /* in several calls: rows die a few at a time */
    for (uint32_t i = 0; i < leaving; i += 20)
      assert_ok(hf_direction_remove_sites(direction, leaving - i < 20 ? leaving - i : 20, list + i));
    constrain(fresh, (count + keep - 1) / keep, step * keep, 0, NULL);
    hf_solve_info info = HF_INIT(hf_solve_info);
    assert_ok(hf_direction_solve(direction, OUT(got), &info));
    assert_ok(hf_direction_solve(fresh, OUT(right), NULL));
    assert_int_equal(info.unreached_vertex_count, round == 2 ? 0 : HALF);
    for (uint32_t i = 0; i < 3 * ALL; ++i) assert_true(fabs(got[i] - right[i]) <= 1e-9);
    hf_direction_destroy(direction);
    hf_direction_destroy(fresh);
  }
  free(got);
  free(right);
  hf_surface_destroy(surface);
  surface_free(&sheet);
  surface_free(&two);
}

/* Single triangles beside a sheet whose constraints go into the factor: each is singular but for its ground, and half
 * of them would be refused for a pivot that rounding leaves at nothing or less. */
static void triangles_that_nothing_reaches_do_not_matter(void** state) {
  (void)state;
  enum { SIDE = 50, HALF = (SIDE + 1) * (SIDE + 1), LOOSE = 24, ALL = HALF + 3 * LOOSE, MANY = 1000 };
  Surface sheet = surface_sheet(SIDE, SIDE), all = {ALL, sheet.triangle_count + LOOSE, NULL, NULL};
  all.positions = calloc(3 * ALL, sizeof(float));
  all.triangles = malloc(sizeof(uint32_t) * 3 * all.triangle_count);
  memcpy(all.positions, sheet.positions, sizeof(float) * 3 * HALF);
  memcpy(all.triangles, sheet.triangles, sizeof(uint32_t) * 3 * sheet.triangle_count);
  for (uint32_t t = 0; t < LOOSE; ++t) {
    float* p = all.positions + 3 * (HALF + 3 * t);
    const float x = (float)(2 * SIDE + 3 * t), length = 1.0f + 0.1f * (float)t;
    p[0] = x;
    p[3] = x + length;
    p[6] = x + 0.03f * (float)t;
    p[7] = 1;
    for (uint32_t k = 0; k < 3; ++k) all.triangles[3 * (sheet.triangle_count + t) + k] = HALF + 3 * t + k;
  }
  const hf_surface surface = surface_on(&all);
  double* got = malloc(sizeof(double) * 3 * ALL);
  hf_direction direction = NULL;
  assert_ok(hf_direction_create(surface, NULL, &direction));
  constrain(direction, MANY, 2, 0, NULL);
  hf_direction_statistics statistics = HF_INIT(hf_direction_statistics);
  assert_ok(hf_direction_get_statistics(direction, &statistics));
  assert_int_equal(statistics.eliminated_count, MANY);
  hf_solve_info info = HF_INIT(hf_solve_info);
  assert_ok(hf_direction_solve(direction, OUT(got), &info));
  assert_int_equal(info.unreached_vertex_count, 3 * LOOSE);
  for (uint32_t i = 0; i < 3 * HALF; ++i) assert_true(fabs(got[i]) <= 10);
  for (uint32_t i = 3 * HALF; i < 3 * ALL; ++i) assert_true(got[i] == 0);
  free(got);
  hf_direction_destroy(direction);
  hf_surface_destroy(surface);
  surface_free(&sheet);
  surface_free(&all);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(many_constraints_come_and_go_without_a_trace),
                                     cmocka_unit_test(triangles_that_nothing_reaches_do_not_matter)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
