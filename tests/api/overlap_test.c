/* Outputs that overlap inputs give what separate memory gives; absurd stiffness is clamped, as stated. */
#include "api_support.h"

enum { AROUND = 8, RINGS = 10, VERTICES = AROUND * RINGS };

static Surface tube;

static void new_sites_may_be_written_over_the_list_of_vertices(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  hf_solver solver = surface_solver(&tube), apart = surface_solver(&tube);
  uint32_t shared[4] = {70, 3, 40, 25}, vertices[4] = {70, 3, 40, 25}, numbers[4];
  const double values[4] = {1, 2, 3, 4};
  hf_sites_desc sites = sites_at(4, shared, values);
  assert_ok(hf_add_sites(solver, &sites, shared));
  sites.vertices = vertices;
  assert_ok(hf_add_sites(apart, &sites, numbers));
  assert_memory_equal(shared, numbers, sizeof numbers);
  /* a batch: what was removed and what is new in one array */
  uint32_t list[2] = {numbers[1], numbers[2]};
  const uint32_t fresh[2] = {50, 60};
  hf_sites_desc add = sites_at(2, fresh, values);
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  edit.remove_count = 2;
  edit.remove_sites = list;
  edit.add = &add;
  assert_ok(hf_solver_edit_sites(solver, &edit, list));
  edit.remove_sites = numbers + 1;
  uint32_t made[2];
  assert_ok(hf_solver_edit_sites(apart, &edit, made));
  assert_memory_equal(list, made, sizeof made);
  double *one = field_of(solver, VERTICES), *other = field_of(apart, VERTICES);
  assert_true(same_bits(one, other, sizeof(double) * VERTICES));
  free(one);
  free(other);
  hf_solver_destroy(solver);
  hf_solver_destroy(apart);
  surface_free(&tube);
}

static void values_may_be_written_over_the_list_they_were_asked_by(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  hf_surface surface = surface_on(&tube);
  hf_solver solver = solver_on(surface);
  add_site(solver, 0, 0);
  add_site(solver, VERTICES - 1, 1);
  double* field = field_of(solver, VERTICES);
  union {
    uint32_t vertices[2 * 6];
    double values[6];
  } shared;
  for (uint32_t i = 0; i < 6; ++i) shared.vertices[i] = 13 * i + 2;
  assert_ok(hf_solver_solve_at(solver, 6, shared.vertices, shared.values));
  for (uint32_t i = 0; i < 6; ++i) assert_true(shared.values[i] == field[13 * i + 2]);

  hf_geodesics geodesics = NULL;
  assert_ok(hf_geodesics_create(surface, NULL, &geodesics));
  double apart[VERTICES], over[VERTICES];
  const uint32_t sources[2] = {5, 66};
  assert_ok(hf_geodesics_solve(geodesics, 2, sources, OUT(apart)));
  memcpy(over, sources, sizeof sources);
  assert_ok(hf_geodesics_solve(geodesics, 2, (const uint32_t*)(const void*)over, OUT(over)));
  assert_true(same_bits(apart, over, sizeof over));
  hf_geodesics_destroy(geodesics);
  free(field);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void a_posed_source_may_become_the_target_in_place(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  hf_surface surface = surface_on(&tube);
  hf_transfer transfer = NULL;
  assert_ok(hf_transfer_create(surface, surface, NULL, &transfer));
  add_tube_pairs(transfer, AROUND, RINGS);
  float posed[3 * VERTICES], apart[3 * VERTICES];
  for (size_t v = 0; v < VERTICES; ++v) {
    const float y = tube.positions[3 * v + 1];
    memcpy(posed + 3 * v, tube.positions + 3 * v, 3 * sizeof(float));
    posed[3 * v] += 0.02f * y * y;
  }
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, VERTICES);
  frame.target_positions = ROWS_OUT(apart);
  assert_ok(hf_transfer_apply(transfer, &frame));
  frame.target_positions = ROWS_OUT(posed);
  assert_ok(hf_transfer_apply(transfer, &frame));
  assert_true(same_bits(posed, apart, sizeof apart));
  hf_transfer_destroy(transfer);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void absurd_stiffness_is_clamped_and_the_field_stays_finite(void** state) {
  (void)state;
  const double absurd[] = {5e-324, 1e-300, 1e-13, 1e13, 1e100, 1.7e308};
  for (size_t i = 0; i < COUNT_OF(absurd); ++i) {
    for (int engine = 0; engine <= ENGINE_REFACTOR; ++engine) {
      if (engine == ENGINE_UPDOWN) continue; /* its penalties have a limit of their own */
      tube = surface_tube(AROUND, RINGS);
      Options desc = options_of(&tube);
      desc.engine = engine;
      hf_solver solver = NULL;
      assert_ok(make(&desc, NULL, &solver));
      const uint32_t vertices[2] = {4, 71};
      const double values[2] = {0, 1}, stiffness[2] = {absurd[i], absurd[COUNT_OF(absurd) - 1 - i]};
      hf_sites_desc sites = sites_at(2, vertices, values);
      sites.stiffness = stiffness;
      assert_ok(hf_add_sites(solver, &sites, NULL));
      double held[2];
      hf_sites_info info = HF_INIT(hf_sites_info);
      info.capacity = 2;
      info.stiffness = held;
      assert_ok(hf_solver_get_sites(solver, &info));
      for (int s = 0; s < 2; ++s) assert_true(held[s] == (stiffness[s] < 1 ? 1e-12 : 1e12));
      double* field = field_of(solver, VERTICES);
      for (int v = 0; v < VERTICES; ++v) assert_true(field[v] >= -1e-9 && field[v] <= 1 + 1e-9);
      free(field);
      hf_solver_destroy(solver);
      surface_free(&tube);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(new_sites_may_be_written_over_the_list_of_vertices),
      cmocka_unit_test(values_may_be_written_over_the_list_they_were_asked_by),
      cmocka_unit_test(a_posed_source_may_become_the_target_in_place),
      cmocka_unit_test(absurd_stiffness_is_clamped_and_the_field_stays_finite),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
