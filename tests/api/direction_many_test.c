/* Very many constraints of a direction object, and few of them again. */
#include "api_support.h"

/* Constraints on every step-th vertex of `count`, pointing about; out_sites as hf_direction_add_sites. */
static void constrain(hf_direction direction, uint32_t count, uint32_t step, uint32_t first, uint32_t* out_sites) {
  uint32_t* places = malloc(count * sizeof *places);
  double* vectors = malloc(3 * count * sizeof *vectors);
  for (uint32_t i = 0; i < count; ++i) {
    places[i] = first + i * step;
    vectors[3 * i] = 1, vectors[3 * i + 1] = (double)(places[i] % 7) - 3, vectors[3 * i + 2] = 0.25;
  }
  assert_ok(hf_direction_add_sites(direction, count, places, vectors, out_sites));
  free(places), free(vectors);
}

/* Two sheets, the second flat: without constraints its operator is singular but for the ground. So many constraints
 * that the dead rows are tidied away, so many that they go into the factor, and few again: each time the field is that
 * of an object which never had others. */
static void many_constraints_come_and_go_without_a_trace(void** state) {
  (void)state;
  enum { SIDE = 50, HALF = (SIDE + 1) * (SIDE + 1), ALL = 2 * HALF, MANY = 1000 };
  Surface sheet = surface_sheet(SIDE, SIDE), two = {ALL, 2 * sheet.triangle_count, NULL, NULL};
  two.positions = malloc(sizeof(float) * 3 * ALL), two.triangles = malloc(sizeof(uint32_t) * 3 * two.triangle_count);
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
  const hf_solver solver = surface_solver(&two);
  double* got = malloc(sizeof(double) * 3 * ALL);
  double* right = malloc(sizeof(double) * 3 * ALL);
  uint32_t sites[MANY];
  for (int round = 0; round < 3; ++round) {
    /* 120 of which 30 stay; 1,000 into the factor, with the other sheet unreached; the same with it reached */
    const uint32_t count = round == 0 ? 120 : MANY, step = 2, keep = round == 0 ? 4 : 3;
    hf_direction direction = NULL, fresh = NULL;
    assert_ok(hf_direction_create(solver, NULL, &direction));
    assert_ok(hf_direction_create(solver, NULL, &fresh));
    if (round == 2) constrain(direction, 3, 700, HALF, NULL), constrain(fresh, 3, 700, HALF, NULL);
    constrain(direction, count, step, 0, sites);
    hf_direction_statistics statistics;
    HF_INIT(statistics);
    assert_ok(hf_direction_get_statistics(direction, &statistics));
    assert_int_equal(statistics.sites_eliminated, round > 0);
    uint32_t leaving = 0, list[MANY];
    for (uint32_t i = 0; i < count; ++i)
      if (i % keep != 0) list[leaving++] = sites[i];
    /* in several calls: rows die a few at a time */
    for (uint32_t i = 0; i < leaving; i += 20)
      assert_ok(hf_direction_remove_sites(direction, leaving - i < 20 ? leaving - i : 20, list + i));
    constrain(fresh, (count + keep - 1) / keep, step * keep, 0, NULL);
    hf_solve_info info;
    HF_INIT(info);
    assert_ok(hf_direction_solve_f64(direction, got, 0, &info));
    assert_ok(hf_direction_solve_f64(fresh, right, 0, NULL));
    assert_int_equal(info.unreached_vertex_count, round == 2 ? 0 : HALF);
    for (uint32_t i = 0; i < 3 * ALL; ++i) assert_true(fabs(got[i] - right[i]) <= 1e-9);
    if (round == 1) {
      /* the sheet that was left out of the factor is reached late: it was grounded there */
      constrain(direction, 3, 700, HALF, NULL), constrain(fresh, 3, 700, HALF, NULL);
      assert_ok(hf_direction_solve_f64(direction, got, 0, &info));
      assert_ok(hf_direction_solve_f64(fresh, right, 0, NULL));
      assert_int_equal(info.unreached_vertex_count, 0);
      for (uint32_t i = 0; i < 3 * ALL; ++i) assert_true(fabs(got[i] - right[i]) <= 1e-9);
    }
    hf_direction_destroy(direction), hf_direction_destroy(fresh);
  }
  free(got), free(right);
  hf_destroy(solver);
  surface_free(&sheet), surface_free(&two);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(many_constraints_come_and_go_without_a_trace)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
