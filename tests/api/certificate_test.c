/* The certificate of a field: small where the field is right, on every engine and operator, and HF_ERROR_INACCURATE
 * where it is not: a factor whose numbers were changed behind the library's back. */
#include "api_support.h"
#include "support/place_in.h"

enum { AROUND = 12, RINGS = 30, VERTICES = AROUND * RINGS };

static Surface tube;
static int create_tube(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  /* no two triangles alike */
  for (uint32_t i = 0; i < 3 * VERTICES; ++i) tube.positions[i] += 0.05f * sinf(7.3f * (float)i);
  return 0;
}
static int free_tube(void** state) {
  (void)state;
  surface_free(&tube);
  return 0;
}

static void add_sites(hf_solver solver, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) add_site(solver, (i * 97 + 5) % VERTICES, sin(2.0 * i) * 40 + 1000);
}

static void every_engine_and_operator_passes_with_its_own_tolerance(void** state) {
  (void)state;
  for (int32_t engine = 0; engine < 3; ++engine) {
    for (int32_t operator_kind = 0; operator_kind < 4; ++operator_kind) {
      for (int32_t field_kind = 0; field_kind < 3; ++field_kind) {
        Options desc = options_of(&tube);
        desc.solver.engine = engine;
        desc.surface.operator_kind = operator_kind;
        desc.surface.field_kind = field_kind;
        hf_solver solver = NULL;
        if (make(&desc, NULL, &solver) == HF_ERROR_UNSUPPORTED) continue; /* updown without HF_WITH_GPL */
        add_sites(solver, 9);
        hf_certificate found = HF_INIT(hf_certificate);
        assert_ok(hf_solver_certify(solver, &found));
        const int updown = engine == HF_ENGINE_UPDOWN;
        assert_true(found.tolerance == (updown ? 1e-5 : 1e-8));
        assert_true(found.value_range > 1 && found.value_range <= 80);
        assert_true(found.residual >= 0 && found.residual <= found.tolerance);
        assert_true(found.site_error <= found.tolerance && found.overshoot <= found.tolerance);
        if (!updown && field_kind == HF_FIELD_HARMONIC) assert_true(found.residual < 1e-12 && found.site_error == 0);
        if (operator_kind != HF_OPERATOR_COTANGENT)
          assert_int_equal(found.overshoot_checked, field_kind == HF_FIELD_HARMONIC);
        assert_true(found.worst_vertex < VERTICES);
        hf_solver_destroy(solver);
      }
    }
  }
}

static void points_soft_sites_discs_and_a_single_site_pass(void** state) {
  (void)state;
  hf_solver solver = surface_solver(&tube);
  add_site(solver, 7, 12345.0);
  hf_certificate found = HF_INIT(hf_certificate);
  assert_ok(hf_solver_certify(solver, &found));
  assert_true(found.value_range == 0 && found.residual < 1e-12 && found.overshoot_checked == 1);
  const uint32_t vertices[2] = {100, 200};
  const double weights[3] = {0.2, 0.3, 0.5}, values[2] = {12346, 12350}, stiffness[2] = {1e3, 1e-3},
               radii[2] = {1.5, 0};
  hf_sites_desc sites = sites_at(2, vertices, values);
  sites.stiffness = stiffness;
  assert_ok(hf_add_sites(solver, &sites, NULL));
  assert_ok(hf_solver_certify(solver, &found));
  assert_int_equal(found.overshoot_checked, 1);
  const uint32_t more[2] = {300, 330};
  sites = sites_at(2, more, values);
  sites.radii = radii;
  assert_ok(hf_add_sites(solver, &sites, NULL));
  assert_ok(hf_solver_certify(solver, &found));
  sites = HF_INIT(hf_sites_desc);
  sites.site_count = 1;
  const hf_place inside = place_in(tube.triangles, tube.triangle_count, 400, weights);
  sites.places = &inside;
  sites.values = values;
  assert_ok(hf_add_sites(solver, &sites, NULL));
  assert_ok(hf_solver_certify(solver, &found));
  assert_int_equal(found.overshoot_checked, 0); /* the corners of a point may lie beyond it */
  assert_true(found.residual < 1e-12 && found.site_error < 1e-12);
  hf_solver_destroy(solver);
}

static void sites_in_the_factor_and_several_channels_pass(void** state) {
  (void)state;
  Options desc = options_of(&tube);
  desc.solver.channel_count = 3;
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  uint32_t vertices[60], sites[60];
  double values[180];
  for (uint32_t i = 0; i < 60; ++i) vertices[i] = i * 6;
  for (uint32_t i = 0; i < 180; ++i) values[i] = cos(3.0 * i) + (i % 3 == 1 ? 1e4 : 0);
  const hf_sites_desc batch = sites_at(60, vertices, values);
  assert_ok(hf_add_sites(solver, &batch, sites));
  assert_ok(hf_solver_prepare_rebase(solver));
  assert_ok(hf_remove_sites(solver, 5, sites + 10));
  hf_certificate found = HF_INIT(hf_certificate);
  assert_ok(hf_solver_certify(solver, &found));
  assert_true(found.residual < 1e-11 && found.overshoot_checked == 1);
  hf_solver_destroy(solver);
}

/* The numbers of a borrowed factor lie in the host's memory. Changed there, every field is wrong, and only the
 * certificate can tell. */
static void a_factor_that_changed_behind_the_library_is_found_out(void** state) {
  (void)state;
  hf_surface surface = surface_on(&tube);
  hf_solver solver = solver_on(surface), loaded = NULL;
  size_t size = 0;
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, 0, NULL, &size));
  unsigned char* block = malloc(size + HF_FACTOR_ALIGNMENT);
  assert_non_null(block);
  unsigned char* bytes = block + HF_FACTOR_ALIGNMENT - (uintptr_t)block % HF_FACTOR_ALIGNMENT;
  assert_ok(hf_surface_save(surface, HF_FIELD_HARMONIC, NULL, size, bytes, NULL));
  hf_surface_destroy(surface);
  hf_factor_desc factor = HF_INIT(hf_factor_desc);
  factor.borrow = 1;
  factor.bytes = bytes;
  factor.byte_count = size;
  Options desc = options_of(&tube);
  desc.surface.saved_factor = &factor;
  assert_ok(make(&desc, NULL, &loaded));
  add_sites(solver, 6);
  add_sites(loaded, 6);
  double* right = field_of(solver, VERTICES);
  hf_certificate found = HF_INIT(hf_certificate);
  assert_ok(hf_solver_certify(loaded, &found));

  /* the largest part of the file are numbers: scale one per 64 in its last quarter, by a little and by much */
  const double scales[3] = {1 + 1e-4, 3, 1e200};
  for (size_t s = 0; s < COUNT_OF(scales); ++s) {
    unsigned char* kept = malloc(size);
    assert_non_null(kept);
    memcpy(kept, bytes, size);
    unsigned changed = 0;
    for (size_t i = (size / 4 * 3 + 7) / 8 * 8; i + 8 <= size; i += 512) {
      double number;
      memcpy(&number, bytes + i, sizeof number);
      if (number == 0 || !isfinite(number)) continue;
      number *= scales[s];
      ++changed;
      memcpy(bytes + i, &number, sizeof number);
    }
    assert_true(changed > 0);
    double* wrong = field_of(loaded, VERTICES);
    double largest = 0;
    for (int v = 0; v < VERTICES; ++v) largest = fmax(largest, isfinite(wrong[v]) ? fabs(wrong[v] - right[v]) : 1e300);
    assert_true(largest > 1e-5); /* the fault matters */
    found = HF_INIT(hf_certificate);
    assert_code(HF_ERROR_INACCURATE, hf_solver_certify(loaded, &found));
    assert_true(found.residual > 1e-8 && found.tolerance == 1e-8 && found.worst_vertex < VERTICES);
    hf_error_detail detail;
    assert_ok(hf_error_get_detail(&detail));
    assert_int_equal(detail.index, found.worst_vertex);
    /* the solver stands: its bytes restored, it is right again */
    memcpy(bytes, kept, size);
    found = HF_INIT(hf_certificate);
    assert_ok(hf_solver_certify(loaded, &found));
    free(wrong);
    free(kept);
  }
  hf_solver_destroy(solver);
  hf_solver_destroy(loaded);
  free(right);
  free(block);
}

/* Values as large as they may be, on a mesh of needles, whose weights are large too. */
static void the_largest_values_stay_finite_on_needles(void** state) {
  (void)state;
  Surface needles = surface_tube(AROUND, RINGS);
  for (uint32_t v = 0; v < VERTICES; ++v)
    if (v % 5 == 0 && v + 1 < VERTICES)
      for (int c = 0; c < 3; ++c)
        needles.positions[3 * v + c] = needles.positions[3 * v + 3 + c] + (c == 1 ? 1e-6f : 0);
  for (int32_t operator_kind = 0; operator_kind < 4; ++operator_kind) {
    Options desc = options_of(&needles);
    desc.surface.operator_kind = operator_kind;
    hf_solver solver = NULL;
    assert_ok(make(&desc, NULL, &solver));
    add_site(solver, 0, 1e200);
    add_site(solver, 9, -1e200);
    add_site(solver, VERTICES - 1, 1e200);
    double* field = field_of(solver, VERTICES);
    for (int v = 0; v < VERTICES; ++v) assert_true(isfinite(field[v]));
    hf_certificate found = HF_INIT(hf_certificate);
    assert_ok(hf_solver_certify(solver, &found));
    free(field);
    hf_solver_destroy(solver);
  }
  surface_free(&needles);
}

/* The exact field of right triangles in a row, each joined to the next at a vertex, is linear. */
static void a_long_chain_is_right_to_rounding(void** state) {
  (void)state;
  enum { CHAIN = 20000 };
  double* positions = calloc(3 * (2 * CHAIN + 1), sizeof(double));
  uint32_t* triangles = malloc(3 * CHAIN * sizeof(uint32_t));
  assert_non_null(positions);
  assert_non_null(triangles);
  for (uint32_t i = 0; i <= CHAIN; ++i) positions[3 * i] = i;
  for (uint32_t i = 0; i < CHAIN; ++i) {
    const uint32_t apex = CHAIN + 1 + i;
    positions[3 * apex] = i;
    positions[3 * apex + 1] = 1;
    triangles[3 * i] = i;
    triangles[3 * i + 1] = i + 1;
    triangles[3 * i + 2] = apex;
  }
  Options desc = options_of(&tube);
  desc.surface.positions = NULL;
  desc.surface.positions_f64 = positions;
  desc.surface.vertex_count = 2 * CHAIN + 1;
  desc.surface.triangles = triangles;
  desc.surface.triangle_count = CHAIN;
  for (int32_t engine = HF_ENGINE_GREEN; engine <= HF_ENGINE_REFACTOR; engine += HF_ENGINE_REFACTOR) {
    hf_solver solver = NULL;
    desc.solver.engine = engine;
    assert_ok(make(&desc, NULL, &solver));
    add_site(solver, 0, 0);
    add_site(solver, CHAIN, 1);
    double* field = field_of(solver, 2 * CHAIN + 1);
    double worst = 0;
    for (int i = 0; i < CHAIN; ++i) { /* not with fmax: GCC 12 for ARM fails on that */
      const double error = fabs(field[i] - (double)i / CHAIN);
      if (!(error <= worst)) worst = error;
    }
    assert_true(worst < 1e-13); /* 6e-10 without corrections */
    hf_certificate found = HF_INIT(hf_certificate);
    assert_ok(hf_solver_certify(solver, &found));
    assert_true(found.error_estimate < 1e-13);
    free(field);
    hf_solver_destroy(solver);
  }
  free(positions);
  free(triangles);
}

/* A bi-harmonic operator is not formed around a vertex of more than 1,000 neighbours. */
static void biharmonic_fans_are_right_and_cost_what_the_mesh_costs(void** state) {
  (void)state;
  enum { FAN = 3000 };
  Surface fan = surface_fan(FAN);
  Options desc = options_of(&fan);
  for (int32_t kind = HF_FIELD_BIHARMONIC; kind <= HF_FIELD_BIHARMONIC_GRAPH; ++kind) {
    desc.surface.field_kind = kind;
    desc.surface.saved_factor = NULL;
    desc.solver.engine = HF_ENGINE_GREEN;
    hf_surface surface = NULL;
    hf_solver solver = NULL, loaded = NULL;
    assert_ok(make(&desc, &surface, &solver));
    hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
    assert_ok(hf_surface_get_statistics(surface, &statistics));
    assert_true(statistics.peak_memory_bytes < 5e6);
    add_site(solver, 1, 1);
    add_site(solver, 1 + FAN / 3, 1e3);
    add_site(solver, 1 + FAN / 2, -2);
    double* field = field_of(solver, FAN + 1);
    hf_certificate found = HF_INIT(hf_certificate);
    assert_ok(hf_solver_certify(solver, &found));
    assert_true(found.error_estimate < 1e-12 && found.site_error == 0);

    size_t size = 0;
    unsigned char* bytes = saved_bytes(surface, kind, &size);
    hf_factor_desc factor = HF_INIT(hf_factor_desc);
    factor.bytes = bytes;
    factor.byte_count = size;
    desc.surface.saved_factor = &factor;
    assert_ok(make(&desc, NULL, &loaded));
    add_site(loaded, 1, 1);
    add_site(loaded, 1 + FAN / 3, 1e3);
    add_site(loaded, 1 + FAN / 2, -2);
    double* again = field_of(loaded, FAN + 1);
    assert_memory_equal(field, again, (FAN + 1) * sizeof *field);
    hf_solver_destroy(loaded);

    desc.solver.engine = HF_ENGINE_REFACTOR;
    desc.surface.saved_factor = NULL;
    assert_code(HF_ERROR_UNSUPPORTED, make(&desc, NULL, &loaded));
    free(field);
    free(again);
    free(bytes);
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
  surface_free(&fan);
}

/* Soft sites pull with what they miss: the engine refactor lost it to rounding and refused its own field. */
static void very_soft_sites_pass(void** state) {
  (void)state;
  for (int32_t engine = HF_ENGINE_GREEN; engine <= HF_ENGINE_REFACTOR; engine += HF_ENGINE_REFACTOR) {
    Options desc = options_of(&tube);
    desc.solver.engine = engine;
    hf_solver solver = NULL;
    assert_ok(make(&desc, NULL, &solver));
    const uint32_t vertices[2] = {0, VERTICES / 2};
    const double values[2] = {0, 1}, stiffness[2] = {1e-10, 1e-10};
    hf_sites_desc sites = sites_at(2, vertices, values);
    sites.stiffness = stiffness;
    assert_ok(hf_add_sites(solver, &sites, NULL));
    hf_certificate found = HF_INIT(hf_certificate);
    assert_ok(hf_solver_certify(solver, &found));
    assert_true(found.error_estimate < 1e-10 && found.site_error < 1e-10);
    hf_solver_destroy(solver);
  }
}

static void weights_that_a_rule_set_are_counted(void** state) {
  (void)state;
  hf_surface surface = surface_on(&tube);
  hf_mesh_statistics found = HF_INIT(hf_mesh_statistics);
  assert_ok(hf_surface_get_mesh_statistics(surface, &found));
  assert_int_equal(found.changed_vertex_count, 0);
  assert_int_equal(found.first_changed_vertex, NO_INDEX);
  hf_surface_destroy(surface);
  /* two unit squares with a column of this width between them */
  const double widths[2] = {1e-9, 1e-12};
  for (int w = 0; w < 2; ++w) {
    const double x[4] = {0, 1, 1 + widths[w], 2};
    double positions[24];
    for (int i = 0; i < 8; ++i) {
      positions[3 * i] = x[i % 4];
      positions[3 * i + 1] = i / 4;
      positions[3 * i + 2] = 0;
    }
    const uint32_t triangles[18] = {0, 1, 4, 1, 5, 4, 1, 2, 5, 2, 6, 5, 2, 3, 6, 3, 7, 6};
    for (int32_t operator_kind = 0; operator_kind < 4; ++operator_kind) {
      Options desc = options_of(&tube);
      desc.surface.positions = NULL;
      desc.surface.positions_f64 = positions;
      desc.surface.vertex_count = 8;
      desc.surface.triangles = triangles;
      desc.surface.triangle_count = 6;
      desc.surface.operator_kind = operator_kind;
      assert_ok(hf_surface_create(&desc.surface, &surface));
      assert_ok(hf_surface_get_mesh_statistics(surface, &found));
      const int kept = operator_kind == HF_OPERATOR_UNIFORM || w == 0;
      assert_true(kept ? found.changed_vertex_count == 0 : found.changed_vertex_count >= 4);
      assert_int_equal(found.first_changed_vertex, kept ? NO_INDEX : 1);
      hf_surface_destroy(surface);
    }
  }
}

static void nothing_is_changed(void** state) {
  (void)state;
  hf_solver solver = surface_solver(&tube);
  add_sites(solver, 5);
  double* before = field_of(solver, VERTICES);
  hf_certificate found = HF_INIT(hf_certificate);
  assert_ok(hf_solver_certify(solver, &found));
  double* after = field_of(solver, VERTICES);
  assert_true(same_bits(before, after, sizeof(double) * VERTICES));
  free(before);
  free(after);
  hf_solver_destroy(solver);
}

#define CERTIFY(what, expected, ...)                                                                       \
  do {                                                                                                     \
    hf_certificate found = HF_INIT(hf_certificate);                                                        \
    __VA_ARGS__;                                                                                           \
    check_row(__LINE__, what, "hf_solver_certify", hf_solver_certify(solver, &found), expected, NO_INDEX); \
  } while (0)

static void bad_arguments_are_answered(void** state) {
  (void)state;
  hf_solver solver = NULL;
  CERTIFY("no solver", HF_ERROR_INVALID_OBJECT, (void)0);
  solver = surface_solver(&tube);
  CERTIFY("no sites", HF_ERROR_EMPTY, (void)0);
  add_sites(solver, 4);
  CERTIFY("tolerance below 0", HF_ERROR_INVALID_ARGUMENT, found.tolerance = -1e-9);
  CERTIFY("tolerance infinite", HF_ERROR_INVALID_ARGUMENT, found.tolerance = HUGE_VAL);
  CERTIFY("tolerance no number", HF_ERROR_INVALID_ARGUMENT, found.tolerance = NAN);
  CERTIFY("struct_size 0", HF_ERROR_INVALID_DESC, found.struct_size = 0);
  CERTIFY("struct_size one short", HF_ERROR_INVALID_DESC, --found.struct_size);
  check_row(__LINE__, "no certificate", "hf_solver_certify", hf_solver_certify(solver, NULL), HF_ERROR_NULL_POINTER,
            NO_INDEX);
  hf_certificate found = HF_INIT(hf_certificate);
  found.tolerance = 1e-300;
  assert_code(HF_ERROR_INACCURATE, hf_solver_certify(solver, &found));
  assert_true(found.tolerance == 1e-300);
  hf_solver_destroy(solver);
  CERTIFY("a destroyed solver", HF_ERROR_INVALID_OBJECT, (void)0);
  finish_rows("certificate");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_engine_and_operator_passes_with_its_own_tolerance),
      cmocka_unit_test(points_soft_sites_discs_and_a_single_site_pass),
      cmocka_unit_test(sites_in_the_factor_and_several_channels_pass),
      cmocka_unit_test(a_factor_that_changed_behind_the_library_is_found_out),
      cmocka_unit_test(the_largest_values_stay_finite_on_needles),
      cmocka_unit_test(a_long_chain_is_right_to_rounding),
      cmocka_unit_test(biharmonic_fans_are_right_and_cost_what_the_mesh_costs),
      cmocka_unit_test(very_soft_sites_pass),
      cmocka_unit_test(weights_that_a_rule_set_are_counted),
      cmocka_unit_test(nothing_is_changed),
      cmocka_unit_test(bad_arguments_are_answered),
  };
  return cmocka_run_group_tests(tests, create_tube, free_tube);
}
