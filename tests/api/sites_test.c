/* Sites under edit and the fields that follow, with every engine of the build. */
#include "api_support.h"
#include "support/place_in.h"

enum { COLUMNS = 14, ROWS_ = 11, VERTICES = (COLUMNS + 1) * (ROWS_ + 1) };
static Surface sheet;

static const int32_t engines[] = {
    HF_ENGINE_GREEN,
    HF_ENGINE_REFACTOR,
    HF_ENGINE_UPDOWN,
};
static size_t engine_count; /* with the paper's engine, where the library has it */
/* The share of the value range to which an engine holds hard sites and fields. */
static double tolerance_of(int32_t engine) { return engine == HF_ENGINE_UPDOWN ? 1e-6 : 1e-11; }

static hf_solver solver_of(int32_t engine, uint32_t channels) {
  Options desc = options_of(&sheet);
  desc.solver.engine = engine;
  desc.solver.channel_count = channels;
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  return solver;
}

static hf_solver_statistics statistics_of(hf_solver solver) {
  hf_solver_statistics s = HF_INIT(hf_solver_statistics);
  assert_ok(hf_solver_get_statistics(solver, &s));
  return s;
}

static int create_sheet(void** state) {
  (void)state;
  sheet = surface_sheet(COLUMNS, ROWS_);
  return 0;
}
static int free_sheet(void** state) {
  (void)state;
  surface_free(&sheet);
  return 0;
}

/* A linear function is harmonic in the plane: with sites along the border it must come back. */
static void a_linear_function_on_the_border_is_continued_inside(void** state) {
  (void)state;
  for (uint32_t v = 0; v < VERTICES; ++v) sheet.positions[3 * v + 2] = 0; /* flat */
  for (size_t e = 0; e < engine_count; ++e) {
    hf_solver solver = solver_of(engines[e], 2);
    uint32_t border[2 * (COLUMNS + ROWS_)], n = 0;
    double values[2 * COUNT_OF(border)];
    for (uint32_t v = 0; v < VERTICES; ++v) {
      const uint32_t i = v % (COLUMNS + 1), j = v / (COLUMNS + 1);
      if (i != 0 && j != 0 && i != COLUMNS && j != ROWS_) continue;
      border[n] = v;
      values[2 * n] = 3.0 * i - 2.0 * j;
      values[2 * n + 1] = 1e4 + 0.5 * j;
      ++n;
    }
    assert_int_equal(n, COUNT_OF(border));
    const hf_sites_desc sites = sites_at(n, border, values);
    assert_ok(hf_add_sites(solver, &sites, NULL));
    double field[2 * VERTICES];
    assert_ok(hf_solver_solve_f64(solver, field, 0, NULL));
    for (uint32_t v = 0; v < VERTICES; ++v) {
      const uint32_t i = v % (COLUMNS + 1), j = v / (COLUMNS + 1);
      assert_true(fabs(field[2 * v] - (3.0 * i - 2.0 * j)) < 60 * tolerance_of(engines[e]));
      assert_true(fabs(field[2 * v + 1] - (1e4 + 0.5 * j)) < 1e4 * tolerance_of(engines[e]));
    }
    hf_solver_destroy(solver);
  }
  surface_free(&sheet);
  sheet = surface_sheet(COLUMNS, ROWS_);
}

static void hard_sites_are_exact_and_soft_ones_give_way(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1);
  const uint32_t vertices[3] = {0, 80, VERTICES - 1};
  const double values[3] = {0.1, 1.0 / 3.0, -7.7}, stiffness[3] = {0, 1e-3, 0};
  hf_sites_desc sites = sites_at(3, vertices, values);
  sites.stiffness = stiffness;
  assert_ok(hf_add_sites(solver, &sites, NULL));
  double* field = field_of(solver, VERTICES);
  assert_true(field[0] == 0.1 && field[VERTICES - 1] == -7.7);
  assert_true(field[80] < 1.0 / 3.0 - 0.1);
  /* w'u + lambda / alpha = s, and what flows in flows out: the fluxes sum to zero */
  double flux[3], held[3], stiff[3];
  uint32_t at[3], component[3];
  hf_sites_info info = HF_INIT(hf_sites_info);
  info.capacity = 3;
  info.flux = flux;
  info.values = held;
  info.stiffness = stiff;
  info.vertices = at;
  info.components = component;
  assert_ok(hf_solver_get_sites(solver, &info));
  assert_true(fabs(flux[0] + flux[1] + flux[2]) < 1e-12);
  assert_true(same_bits(held, values, sizeof held) && same_bits(stiff, stiffness, sizeof stiff) &&
              same_bits(at, vertices, sizeof at));
  assert_true(component[0] == 0 && component[1] == 0 && component[2] == 0);
  free(field);
  hf_solver_destroy(solver);
}

static void sites_in_triangles_hold_at_their_point(void** state) {
  (void)state;
  for (size_t e = 0; e < engine_count; ++e) {
    hf_solver solver = solver_of(engines[e], 1);
    const uint32_t triangles[2] = {30, 200};
    const double weights[6] = {0.2, 0.3, 0.5, 0.6, 0.4, 0.0}, values[2] = {4, -3};
    hf_sites_desc sites = HF_INIT(hf_sites_desc);
    sites.site_count = 2;
    hf_place places[2];
    for (int s = 0; s < 2; ++s)
      places[s] = place_in(sheet.triangles, sheet.triangle_count, triangles[s], weights + 3 * s);
    sites.places = places;
    sites.values = values;
    uint32_t numbers[2], at[2];
    assert_ok(hf_add_sites(solver, &sites, numbers));
    double* field = field_of(solver, VERTICES);
    for (int s = 0; s < 2; ++s) {
      double value = 0;
      for (int k = 0; k < 3; ++k) value += weights[3 * s + k] * field[sheet.triangles[3 * triangles[s] + (uint32_t)k]];
      assert_true(fabs(value - values[s]) < 10 * tolerance_of(engines[e]));
    }
    hf_sites_info info = HF_INIT(hf_sites_info);
    info.capacity = 2;
    info.vertices = at;
    assert_ok(hf_solver_get_sites(solver, &info));
    assert_true(at[0] == HF_NO_INDEX && at[1] == HF_NO_INDEX);
    free(field);
    hf_solver_destroy(solver);
  }
}

static void a_batch_is_the_same_as_its_single_calls(void** state) {
  (void)state;
  for (size_t e = 0; e < engine_count; ++e) {
    hf_solver one = solver_of(engines[e], 1), many = solver_of(engines[e], 1);
    const uint32_t start[4] = {3, 40, 77, 150};
    const double values[4] = {1, 2, 3, 4}, set_value = -5, new_value = 9;
    const hf_sites_desc sites = sites_at(4, start, values);
    uint32_t a[4], b[4], added_one, added_many;
    assert_ok(hf_add_sites(one, &sites, a));
    assert_ok(hf_add_sites(many, &sites, b));
    assert_true(same_bits(a, b, sizeof a));
    const uint32_t moved = 99, fresh = 120;
    const hf_sites_desc to = sites_at(1, &moved, NULL), more = sites_at(1, &fresh, &new_value);

    assert_ok(hf_remove_sites(one, 1, &a[0]));
    assert_ok(hf_solver_move_sites(one, 1, &a[1], &to));
    assert_ok(hf_solver_set_values(one, 1, &a[2], &set_value));
    assert_ok(hf_add_sites(one, &more, &added_one));

    hf_edit_desc edit = HF_INIT(hf_edit_desc);
    edit.remove_count = 1;
    edit.remove_sites = &b[0];
    edit.move_count = 1;
    edit.move_sites = &b[1];
    edit.move_to = &to;
    edit.set_count = 1;
    edit.set_sites = &b[2];
    edit.set_values = &set_value;
    edit.add = &more;
    assert_ok(hf_solver_edit_sites(many, &edit, &added_many));
    assert_int_equal(added_one, added_many);
    assert_int_equal(added_one, a[0]); /* numbers are reused */
    assert_int_equal(hf_solver_get_site_count(many), 4);
    double *x = field_of(one, VERTICES), *y = field_of(many, VERTICES);
    for (int v = 0; v < VERTICES; ++v) assert_true(fabs(x[v] - y[v]) < 14 * tolerance_of(engines[e]));
    assert_true(fabs(x[99] - 2) < 14 * tolerance_of(engines[e]) && fabs(x[77] + 5) < 14 * tolerance_of(engines[e]));
    free(x);
    free(y);
    hf_solver_destroy(one);
    hf_solver_destroy(many);
  }
}

static void an_empty_batch_changes_nothing(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1);
  add_site(solver, 3, 1);
  add_site(solver, 100, 2);
  double* before = field_of(solver, VERTICES);
  hf_edit_desc edit = HF_INIT(hf_edit_desc);
  assert_ok(hf_solver_edit_sites(solver, &edit, NULL));
  double* after = field_of(solver, VERTICES);
  assert_true(same_bits(before, after, sizeof(double) * VERTICES));
  free(before);
  free(after);
  hf_solver_destroy(solver);
}

static void sites_may_swap_places_in_one_move(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1);
  const uint32_t numbers[2] = {add_site(solver, 20, 1), add_site(solver, 130, 2)}, swapped[2] = {130, 20};
  const hf_sites_desc to = sites_at(2, swapped, NULL);
  assert_ok(hf_solver_move_sites(solver, 2, numbers, &to));
  double* field = field_of(solver, VERTICES);
  assert_true(field[20] == 2 && field[130] == 1);
  free(field);
  hf_solver_destroy(solver);
}

static void all_engines_agree_after_edits(void** state) {
  (void)state;
  double* reference = NULL;
  for (size_t e = 0; e < engine_count; ++e) {
    hf_solver solver = solver_of(engines[e], 1);
    uint32_t live[12], count = 0, seed = 12345;
    for (int step = 0; step < 60; ++step) {
      seed = seed * 1664525u + 1013904223u;
      if (count == 12 || (count > 3 && seed >> 31)) {
        assert_ok(hf_remove_sites(solver, 1, &live[0]));
        /* no memmove: valgrind takes its fortified form for memcpy, and reports that the ranges overlap */
        --count;
        for (uint32_t i = 0; i < count; ++i) live[i] = live[i + 1];
      } else {
        const uint32_t vertex = (seed >> 8) % VERTICES;
        const double value = (double)(step % 7);
        const hf_sites_desc site = sites_at(1, &vertex, &value);
        const hf_result result = hf_add_sites(solver, &site, &live[count]);
        assert_true(result == HF_OK || result == HF_ERROR_CONFLICT || result == HF_ERROR_DUPLICATE);
        count += result == HF_OK;
      }
    }
    double* field = field_of(solver, VERTICES);
    for (int v = 0; reference && v < VERTICES; ++v)
      assert_true(fabs(field[v] - reference[v]) < 6 * tolerance_of(engines[e]));
    if (reference)
      free(field);
    else
      reference = field;
    hf_solver_destroy(solver);
  }
  free(reference);
}

static void solving_at_vertices_equals_solving_everywhere(void** state) {
  (void)state;
  for (size_t e = 0; e < engine_count; ++e) {
    hf_solver solver = solver_of(engines[e], 3);
    const uint32_t at[3] = {2, 88, 160};
    const double values[9] = {1, 2, 3, 4, 5, 6, -7, 8, 1e3};
    const hf_sites_desc sites = sites_at(3, at, values);
    assert_ok(hf_add_sites(solver, &sites, NULL));
    double everywhere[3 * VERTICES], here[3 * 7];
    const uint32_t ask[7] = {0, 2, 88, 179, 50, 50, 7};
    assert_ok(hf_solver_solve_f64(solver, everywhere, 0, NULL));
    assert_ok(hf_solver_solve_at(solver, 7, ask, here));
    for (int i = 0; i < 7; ++i) {
      for (int c = 0; c < 3; ++c)
        assert_true(fabs(here[3 * i + c] - everywhere[3 * ask[i] + (uint32_t)c]) < 1e3 * tolerance_of(engines[e]));
    }
    hf_solver_destroy(solver);
  }
}

static void the_list_of_solve_at_may_lie_in_its_output(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1);
  add_site(solver, 3, 1);
  add_site(solver, 100, 2);
  const uint32_t ask[6] = {5, 50, 99, 100, 3, 7};
  double apart[6];
  union {
    double values[6];
    uint32_t vertices[6];
  } shared;
  memcpy(shared.vertices, ask, sizeof ask);
  assert_ok(hf_solver_solve_at(solver, 6, ask, apart));
  assert_ok(hf_solver_solve_at(solver, 6, shared.vertices, shared.values));
  assert_true(same_bits(apart, shared.values, sizeof apart));
  hf_solver_destroy(solver);
}

static void float_and_double_outputs_agree_at_any_stride(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 2);
  const uint32_t at[2] = {0, VERTICES - 1};
  const double values[4] = {0, 10, 1, -10};
  const hf_sites_desc sites = sites_at(2, at, values);
  assert_ok(hf_add_sites(solver, &sites, NULL));
  double packed[2 * VERTICES];
  float packed_f32[2 * VERTICES];
  assert_ok(hf_solver_solve_f64(solver, packed, 0, NULL));
  assert_ok(hf_solve(solver, packed_f32, 0, NULL));
  for (int i = 0; i < 2 * VERTICES; ++i) assert_true(packed_f32[i] == (float)packed[i]);
  for (uint32_t stride = 16; stride <= 41; stride += 5) { /* unaligned rows too; bytes between the rows stay */
    unsigned char* wide = malloc((size_t)stride * VERTICES);
    memset(wide, 0x5A, (size_t)stride * VERTICES);
    assert_ok(hf_solver_solve_f64(solver, (double*)(void*)wide, stride, NULL));
    for (uint32_t v = 0; v < VERTICES; ++v) {
      assert_true(same_bits(wide + (size_t)stride * v, packed + 2 * v, 16));
      for (uint32_t k = 16; k < stride; ++k) assert_int_equal(wide[(size_t)stride * v + k], 0x5A);
    }
    memset(wide, 0x5A, (size_t)stride * VERTICES);
    assert_ok(hf_solve(solver, (float*)(void*)wide, stride, NULL));
    for (uint32_t v = 0; v < VERTICES; ++v) {
      assert_true(same_bits(wide + (size_t)stride * v, packed_f32 + 2 * v, 8));
      for (uint32_t k = 8; k < stride; ++k) assert_int_equal(wide[(size_t)stride * v + k], 0x5A);
    }
    free(wide);
  }
  hf_solver_destroy(solver);
}

static void vectors_are_tangent_and_follow_their_constraints(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 3);
  const uint32_t at[2] = {16, 150};
  const double values[6] = {1, 0, 0, 0, 1, 0};
  const hf_sites_desc sites = sites_at(2, at, values);
  assert_ok(hf_add_sites(solver, &sites, NULL));
  double vectors[3 * VERTICES], normals[3 * VERTICES], free_field[3 * VERTICES];
  float vectors_f32[3 * VERTICES];
  assert_ok(hf_solver_solve_vectors_f64(solver, vectors, 0, normals, NULL));
  assert_ok(hf_solver_solve_vectors(solver, vectors_f32, 0, NULL, NULL));
  assert_ok(hf_solver_solve_f64(solver, free_field, 0, NULL));
  for (int v = 0; v < VERTICES; ++v) {
    const double *x = vectors + 3 * v, *n = normals + 3 * v, *u = free_field + 3 * v;
    const double along = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
    assert_true(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-12);
    for (int c = 0; c < 3; ++c) {
      assert_true(fabs(x[c] - (u[c] - along * n[c])) < 1e-12);
      assert_true(vectors_f32[3 * v + c] == (float)x[c]);
    }
  }
  hf_solver_destroy(solver);
}

static void edits_never_factorise_again(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1);
  const hf_solver_statistics before = statistics_of(solver);
  assert_int_equal(before.factorisation_count, 0); /* the surface's own is not counted */
  assert_int_equal(before.site_count, 0);
  uint32_t numbers[20];
  for (uint32_t i = 0; i < 20; ++i) numbers[i] = add_site(solver, 8 * i, i);
  for (uint32_t i = 0; i < 10; ++i) {
    const uint32_t vertex = 8 * i + 3;
    const double value = 2.0 * i;
    const hf_sites_desc to = sites_at(1, &vertex, NULL);
    assert_ok(hf_solver_move_sites(solver, 1, &numbers[i], &to));
    assert_ok(hf_solver_set_values(solver, 1, &numbers[i], &value));
  }
  assert_ok(hf_remove_sites(solver, 5, numbers + 10));
  const hf_solver_statistics edited = statistics_of(solver);
  assert_int_equal(edited.factorisation_count, 0);
  assert_int_equal(edited.site_count, 15);
  assert_int_equal(edited.sweep_count, before.sweep_count); /* values and edits wait for the solve */
  assert_true(edited.path_solve_count >= 30);
  assert_true(edited.site_memory_bytes > 0);
  double* field = field_of(solver, VERTICES);
  assert_true(statistics_of(solver).sweep_count > edited.sweep_count);
  assert_int_equal(statistics_of(solver).factorisation_count, 0);
  free(field);
  hf_solver_destroy(solver);
}

static void values_may_be_set_without_the_factor_being_touched(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1);
  const uint32_t numbers[2] = {add_site(solver, 0, 0), add_site(solver, VERTICES - 1, 1)};
  double* unit = field_of(solver, VERTICES);
  const uint32_t paths = statistics_of(solver).path_solve_count;
  const double values[2] = {-4, 16};
  assert_ok(hf_solver_set_values(solver, 2, numbers, values));
  assert_int_equal(statistics_of(solver).path_solve_count, paths);
  double* field = field_of(solver, VERTICES);
  for (int v = 0; v < VERTICES; ++v)
    assert_true(fabs(field[v] - (-4 + 20 * unit[v])) < 1e-11); /* fields are linear in the values */
  free(unit);
  free(field);
  hf_solver_destroy(solver);
}

static void values_around_a_million_lose_nothing(void** state) {
  (void)state;
  hf_solver solver = solver_of(HF_ENGINE_GREEN, 1), shifted = solver_of(HF_ENGINE_GREEN, 1);
  const uint32_t at[3] = {0, 80, VERTICES - 1};
  for (int i = 0; i < 3; ++i) {
    add_site(solver, at[i], i);
    add_site(shifted, at[i], 1e6 + i);
  }
  double *x = field_of(solver, VERTICES), *y = field_of(shifted, VERTICES);
  for (int v = 0; v < VERTICES; ++v) assert_true(fabs(y[v] - 1e6 - x[v]) < 2e-8);
  free(x);
  free(y);
  hf_solver_destroy(solver);
  hf_solver_destroy(shifted);
}

int main(void) {
  engine_count = has_peers() ? COUNT_OF(engines) : COUNT_OF(engines) - 1;
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_linear_function_on_the_border_is_continued_inside),
      cmocka_unit_test(hard_sites_are_exact_and_soft_ones_give_way),
      cmocka_unit_test(sites_in_triangles_hold_at_their_point),
      cmocka_unit_test(a_batch_is_the_same_as_its_single_calls),
      cmocka_unit_test(an_empty_batch_changes_nothing),
      cmocka_unit_test(sites_may_swap_places_in_one_move),
      cmocka_unit_test(all_engines_agree_after_edits),
      cmocka_unit_test(solving_at_vertices_equals_solving_everywhere),
      cmocka_unit_test(the_list_of_solve_at_may_lie_in_its_output),
      cmocka_unit_test(float_and_double_outputs_agree_at_any_stride),
      cmocka_unit_test(vectors_are_tangent_and_follow_their_constraints),
      cmocka_unit_test(edits_never_factorise_again),
      cmocka_unit_test(values_may_be_set_without_the_factor_being_touched),
      cmocka_unit_test(values_around_a_million_lose_nothing),
  };
  return cmocka_run_group_tests(tests, create_sheet, free_sheet);
}
