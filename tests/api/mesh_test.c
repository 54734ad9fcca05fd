/* Surfaces as they come: seams, pieces, isolated vertices, any unit and offset. */
#include "api_support.h"

static hf_surface_report report_of(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  return report;
}

static void welded_copies_get_the_same_value(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_solver solver = surface_solver(&cut);
  add_site(solver, CUT_LEFT, 0);
  add_site(solver, CUT_RIGHT, 1);
  double* field = field_of(solver, CUT_VERTICES);
  for (uint32_t j = 0; j < 5; ++j) {
    const double left = field[CUT_SEAM_LEFT + 5 * j], right = field[CUT_SEAM_RIGHT + 5 * j];
    assert_true(same_bits(&left, &right, sizeof left));
    assert_true(left > 0 && left < 1);
  }
  /* a site on one copy holds at the other */
  add_site(solver, CUT_SEAM_RIGHT + 10, 7);
  free(field);
  field = field_of(solver, CUT_VERTICES);
  assert_true(field[CUT_SEAM_LEFT + 10] == 7 && field[CUT_SEAM_RIGHT + 10] == 7);
  free(field);
  hf_solver_destroy(solver);
  surface_free(&cut);
}

static void the_report_counts_what_was_found(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_surface surface = surface_on(&cut);
  const hf_surface_report r = report_of(surface);
  assert_int_equal(r.vertex_count, CUT_VERTICES);
  assert_int_equal(r.triangle_count, CUT_TRIANGLES);
  assert_int_equal(r.welded_vertex_count, CUT_VERTICES - 5);
  assert_int_equal(r.component_count, 2);
  assert_int_equal(r.isolated_vertex_count, 1);
  assert_int_equal(r.collapsed_triangle_count, 1);
  assert_int_equal(r.duplicate_triangle_count, 0);
  assert_int_equal(r.degenerate_triangle_count, 0);
  assert_int_equal(r.non_manifold_edge_count, 0);
  assert_int_equal(r.flipped_edge_count, 0);
  assert_int_equal(r.boundary_edge_count, 2 * (8 + 4) + 2 * (2 + 2));
  hf_mesh_statistics s = HF_INIT(hf_mesh_statistics);
  assert_ok(hf_surface_get_mesh_statistics(surface, &s));
  assert_true(s.smallest_angle > 0.1 && s.smallest_angle < 1.0472);
  assert_true(r.bounding_box_diagonal > 22 && r.bounding_box_diagonal < 23); /* the isolated vertex lies at 30 */
  hf_surface_destroy(surface);
  surface_free(&cut);
}

static void dirty_triangles_are_counted_and_the_field_is_finite(void** state) {
  (void)state;
  Surface sheet = surface_sheet(4, 4);
  uint32_t dirty[3 * 36];
  memcpy(dirty, sheet.triangles, sizeof(uint32_t) * 3 * 32);
  const uint32_t more[12] = {dirty[0], dirty[1], dirty[2], /* a duplicate */
                             dirty[3], dirty[5], dirty[4], /* a duplicate turned round */
                             0,        1,        2,        /* three vertices on the border: zero area when flat */
                             0,        24,       12};      /* a flap across the sheet */
  memcpy(dirty + 96, more, sizeof more);
  Options desc = options_of(&sheet);
  desc.surface.triangles = dirty;
  desc.surface.triangle_count = 36;
  hf_surface surface = NULL;
  hf_solver solver = NULL;
  assert_ok(make(&desc, &surface, &solver));
  const hf_surface_report r = report_of(surface);
  assert_int_equal(r.duplicate_triangle_count, 2);
  assert_true(r.flipped_edge_count > 0);
  assert_int_equal(r.non_manifold_edge_count, 0); /* doubled triangles do not count in edges */
  add_site(solver, 0, 0);
  add_site(solver, 24, 1);
  double* field = field_of(solver, 25);
  for (int v = 0; v < 25; ++v) assert_true(isfinite(field[v]));
  free(field);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

/* Two tetrahedra of their own vertices; either can be turned, and the second can lack a triangle. */
static hf_surface_report report_of_tetrahedra(int first_turned, int second_turned, int second_open) {
  float positions[24];
  for (uint32_t i = 0; i < 24; ++i) positions[i] = (i / 12 ? 5.0f : 0) + (i % 12 > 2 && i % 4 == 3 ? 1.0f : 0);
  uint32_t triangles[24] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  for (uint32_t i = 0; i < 12; ++i) triangles[12 + i] = triangles[i] + 4;
  for (uint32_t t = 0; t < 8; ++t) {
    if (!(t < 4 ? first_turned : second_turned)) continue;
    const uint32_t v = triangles[3 * t];
    triangles[3 * t] = triangles[3 * t + 1];
    triangles[3 * t + 1] = v;
  }
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = 8;
  desc.positions = positions;
  desc.triangle_count = second_open ? 7 : 8;
  desc.triangles = triangles;
  hf_surface surface;
  assert_ok(hf_surface_create(&desc, &surface));
  const hf_surface_report report = report_of(surface);
  hf_surface_destroy(surface);
  return report;
}

static void closed_pieces_that_face_inwards_are_counted(void** state) {
  (void)state;
  const struct {
    int first, second, open;
    uint32_t count, vertex;
  } cases[] = {{0, 0, 0, 0, HF_NO_INDEX}, {1, 0, 0, 1, 0}, {0, 1, 0, 1, 4}, {1, 1, 0, 2, 0}, {0, 1, 1, 0, HF_NO_INDEX}};
  for (uint32_t i = 0; i < 5; ++i) {
    const hf_surface_report report = report_of_tetrahedra(cases[i].first, cases[i].second, cases[i].open);
    assert_int_equal(report.component_count, 2);
    assert_int_equal(report.inside_out_count, cases[i].count);
    assert_int_equal(report.first_inside_out_vertex, cases[i].vertex);
  }
}

static void components_are_numbered_by_their_smallest_vertex(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_surface surface = surface_on(&cut);
  uint32_t component[CUT_VERTICES];
  assert_ok(hf_surface_get_components(surface, CUT_VERTICES, component, NULL));
  for (uint32_t v = 0; v < CUT_VERTICES; ++v)
    assert_int_equal(component[v], v == CUT_ISOLATED ? HF_NO_INDEX : v >= CUT_ISLAND);
  hf_surface_destroy(surface);
  surface_free(&cut);
}

static void what_no_site_reaches_is_zero_and_counted(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_solver solver = surface_solver(&cut);
  double field[CUT_VERTICES];
  hf_solve_info info = HF_INIT(hf_solve_info);
  const uint32_t first = add_site(solver, CUT_LEFT, 3);
  assert_ok(hf_solver_solve_f64(solver, field, 0, &info));
  assert_int_equal(info.unreached_component_count, 1);
  assert_int_equal(info.first_unreached_component, 1);
  assert_int_equal(info.unreached_vertex_count, 9 + 1);
  for (uint32_t v = 0; v < CUT_VERTICES; ++v) assert_true(v < CUT_ISLAND ? fabs(field[v] - 3) < 1e-12 : field[v] == 0);
  /* a site on the piece reaches it; the isolated vertex stays */
  const uint32_t second = add_site(solver, CUT_ISLAND + 4, -2);
  assert_ok(hf_solver_solve_f64(solver, field, 0, &info));
  assert_int_equal(info.unreached_component_count, 0);
  assert_int_equal(info.first_unreached_component, HF_NO_INDEX);
  assert_int_equal(info.unreached_vertex_count, 1);
  for (uint32_t v = CUT_ISLAND; v < CUT_ISOLATED; ++v) assert_true(fabs(field[v] + 2) < 1e-12);
  assert_true(field[CUT_ISOLATED] == 0);
  /* the last site of the first component leaves: it is unreached, and exact again after another comes */
  assert_ok(hf_remove_sites(solver, 1, &first));
  assert_ok(hf_solver_solve_f64(solver, field, 0, &info));
  assert_int_equal(info.first_unreached_component, 0);
  assert_int_equal(info.unreached_vertex_count, 50 + 1);
  for (uint32_t v = 0; v < CUT_ISLAND; ++v) assert_true(field[v] == 0);
  add_site(solver, CUT_RIGHT, 11);
  assert_ok(hf_solver_solve_f64(solver, field, 0, &info));
  for (uint32_t v = 0; v < CUT_ISLAND; ++v) assert_true(fabs(field[v] - 11) < 1e-11);
  assert_ok(hf_remove_sites(solver, 1, &second));
  double at[2];
  const uint32_t ask[2] = {CUT_ISLAND, CUT_ISOLATED};
  assert_ok(hf_solver_solve_at(solver, 2, ask, at));
  assert_true(at[0] == 0 && at[1] == 0);
  hf_solver_destroy(solver);
  surface_free(&cut);
}

static void weld_none_keeps_the_cut_and_a_tolerance_closes_a_gap(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_surface_desc desc = options_of(&cut).surface;
  hf_surface surface = NULL;
  desc.weld = HF_WELD_NONE;
  assert_ok(hf_surface_create(&desc, &surface));
  assert_int_equal(report_of(surface).component_count, 3);
  hf_surface_destroy(surface);
  /* the right sheet a thousandth away: cut for exact welding, closed within a tolerance */
  for (uint32_t v = CUT_SEAM_RIGHT; v < CUT_ISLAND; ++v) cut.positions[3 * v] += 0.001f;
  desc.weld = HF_WELD_EXACT;
  assert_ok(hf_surface_create(&desc, &surface));
  assert_int_equal(report_of(surface).component_count, 3);
  hf_surface_destroy(surface);
  desc.weld = HF_WELD_TOLERANCE;
  desc.weld_tolerance = 0.002;
  assert_ok(hf_surface_create(&desc, &surface));
  assert_int_equal(report_of(surface).component_count, 2);
  assert_int_equal(report_of(surface).welded_vertex_count, CUT_VERTICES - 5);
  hf_surface_destroy(surface);
  surface_free(&cut);
}

static void minus_zero_and_zero_are_one_place(void** state) {
  (void)state;
  Surface cut = surface_cut();
  for (uint32_t v = 0; v < CUT_ISLAND; ++v) cut.positions[3 * v] -= 4.0f; /* the seam at x = 0 */
  for (uint32_t j = 0; j < 5; ++j) cut.positions[3 * (CUT_SEAM_RIGHT + 5 * j)] = -0.0f;
  hf_surface surface = surface_on(&cut);
  assert_int_equal(report_of(surface).component_count, 2);
  hf_surface_destroy(surface);
  surface_free(&cut);
}

/* The field of the sheet at p -> scale p + offset, in double. */
static double* moved_field(const Surface* sheet, double scale, double offset, int as_float) {
  const size_t n = 3 * (size_t)sheet->vertex_count;
  double* doubles = malloc(sizeof(double) * n);
  float* floats = malloc(sizeof(float) * n);
  for (size_t i = 0; i < n; ++i) {
    doubles[i] = scale * (double)sheet->positions[i] + offset;
    floats[i] = (float)doubles[i];
  }
  Options desc = options_of(sheet);
  desc.surface.positions = as_float ? floats : NULL;
  desc.surface.positions_f64 = as_float ? NULL : doubles;
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  add_site(solver, 0, -1e6);
  add_site(solver, sheet->vertex_count - 1, 1e6);
  add_site(solver, sheet->vertex_count / 2, 5e5);
  double* field = field_of(solver, sheet->vertex_count);
  hf_solver_destroy(solver);
  free(doubles);
  free(floats);
  return field;
}

static void unit_and_offset_do_not_matter(void** state) {
  (void)state;
  Surface sheet = surface_sheet(12, 9);
  double* expected = moved_field(&sheet, 1, 0, 0);
  const struct {
    double scale, offset, tolerance;
    int as_float;
  } moves[] = {{0.001, 0, 1e-12, 0}, {1000, 0, 1e-12, 0},   {1e-30, 0, 1e-12, 0}, {1e30, 0, 1e-12, 0},
               {1e100, 0, 1e-12, 0}, {1e-100, 0, 1e-12, 0}, {1, 1e6, 1e-9, 0},    {1, -1e9, 1e-6, 0},
               {1000, 1e6, 1e-9, 0}, {1e-3, 1, 1e-12, 0},   {1024, 0, 1e-12, 1},  {0.001, 0, 1e-6, 1},
               {1e30, 0, 1e-6, 1},   {1e-30, 0, 1e-6, 1}};
  for (size_t m = 0; m < COUNT_OF(moves); ++m) {
    double* field = moved_field(&sheet, moves[m].scale, moves[m].offset, moves[m].as_float);
    double worst = 0;
    for (uint32_t v = 0; v < sheet.vertex_count; ++v) worst = fmax(worst, fabs(field[v] - expected[v]) / 2e6);
    if (!(worst <= moves[m].tolerance))
      fail_msg("scale %g, offset %g, %s: the field differs by %g of its range", moves[m].scale, moves[m].offset,
               moves[m].as_float ? "float" : "double", worst);
    free(field);
  }
  free(expected);
  surface_free(&sheet);
}

static void interleaved_vertices_are_read_by_their_stride(void** state) {
  (void)state;
  Surface sheet = surface_sheet(5, 5);
  enum { RECORD = 37 }; /* odd: rows are not even aligned */
  unsigned char* records = malloc((size_t)RECORD * sheet.vertex_count);
  memset(records, 0xEE, (size_t)RECORD * sheet.vertex_count);
  for (uint32_t v = 0; v < sheet.vertex_count; ++v) memcpy(records + (size_t)RECORD * v, sheet.positions + 3 * v, 12);
  Options desc = options_of(&sheet);
  hf_solver plain = surface_solver(&sheet), strided = NULL;
  desc.surface.positions = (const float*)(const void*)records;
  desc.surface.position_stride = RECORD;
  assert_ok(make(&desc, NULL, &strided));
  hf_solver both[2] = {plain, strided};
  double* field[2];
  for (int i = 0; i < 2; ++i) {
    add_site(both[i], 0, 0);
    add_site(both[i], 20, 1);
    field[i] = field_of(both[i], sheet.vertex_count);
  }
  assert_true(same_bits(field[0], field[1], sizeof(double) * sheet.vertex_count));
  free(field[0]);
  free(field[1]);
  free(records);
  hf_solver_destroy(plain);
  hf_solver_destroy(strided);
  surface_free(&sheet);
}

static void triangles_of_16_bits_and_any_stride_give_the_same_bits(void** state) {
  (void)state;
  Surface sheet = surface_sheet(9, 7);
  enum { WIDE = 23, NARROW = 11 }; /* odd: rows are not even aligned */
  unsigned char *wide = malloc((size_t)WIDE * sheet.triangle_count),
                *narrow = malloc((size_t)NARROW * sheet.triangle_count);
  uint16_t* packed = malloc(sizeof(uint16_t) * 3 * sheet.triangle_count);
  memset(wide, 0xEE, (size_t)WIDE * sheet.triangle_count);
  memset(narrow, 0xEE, (size_t)NARROW * sheet.triangle_count);
  for (uint32_t t = 0; t < sheet.triangle_count; ++t) {
    for (uint32_t k = 0; k < 3; ++k) packed[3 * t + k] = (uint16_t)sheet.triangles[3 * t + k];
    memcpy(wide + (size_t)WIDE * t, sheet.triangles + 3 * t, 12);
    memcpy(narrow + (size_t)NARROW * t, packed + 3 * t, 6);
  }
  const struct {
    const void *triangles, *triangles_u16;
    uint32_t stride;
  } forms[4] = {{sheet.triangles, NULL, 0}, {wide, NULL, WIDE}, {NULL, packed, 0}, {NULL, narrow, NARROW}};
  double* fields[4];
  unsigned char* factors[4];
  size_t sizes[4];
  for (int i = 0; i < 4; ++i) {
    Options desc = options_of(&sheet);
    desc.surface.triangles = forms[i].triangles;
    desc.surface.triangles_u16 = forms[i].triangles_u16;
    desc.surface.triangle_stride = forms[i].stride;
    hf_surface surface = NULL;
    hf_solver solver = NULL;
    assert_ok(make(&desc, &surface, &solver));
    add_site(solver, 0, 0);
    add_site(solver, 40, 1);
    fields[i] = field_of(solver, sheet.vertex_count);
    factors[i] = saved_bytes(surface, HF_FIELD_HARMONIC, &sizes[i]);
    assert_true(same_bits(fields[i], fields[0], sizeof(double) * sheet.vertex_count));
    assert_true(sizes[i] == sizes[0] && same_bits(factors[i], factors[0], sizes[0]));
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
  for (int i = 0; i < 4; ++i) {
    free(fields[i]);
    free(factors[i]);
  }
  free(wide);
  free(narrow);
  free(packed);
  surface_free(&sheet);
}

static void the_mesh_is_copied(void** state) {
  (void)state;
  Surface sheet = surface_sheet(5, 5);
  hf_solver solver = surface_solver(&sheet);
  add_site(solver, 0, 0);
  add_site(solver, 35, 1);
  double* before = field_of(solver, 36);
  memset(sheet.positions, 0xFF, sizeof(float) * 3 * sheet.vertex_count);
  memset(sheet.triangles, 0xFF, sizeof(uint32_t) * 3 * sheet.triangle_count);
  surface_free(&sheet);
  add_site(solver, 17, 0.5);
  const uint32_t last = 2;
  assert_ok(hf_remove_sites(solver, 1, &last));
  double* after = field_of(solver, 36);
  for (int v = 0; v < 36; ++v) assert_true(fabs(before[v] - after[v]) < 1e-12);
  free(before);
  free(after);
  hf_solver_destroy(solver);
}

static void limits_that_are_just_met_are_no_obstacle(void** state) {
  (void)state;
  Surface cut = surface_cut();
  Options desc = options_of(&cut);
  desc.surface.vertex_limit = CUT_VERTICES;
  desc.surface.triangle_limit = CUT_TRIANGLES;
  desc.surface.memory_limit_mb = 64;
  desc.solver.site_limit = 2;
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  add_site(solver, CUT_LEFT, 0);
  add_site(solver, CUT_RIGHT, 1);
  const uint32_t vertex = CUT_ISLAND;
  const double value = 2;
  const hf_sites_desc third = sites_at(1, &vertex, &value);
  assert_code(HF_ERROR_TOO_LARGE, hf_add_sites(solver, &third, NULL));
  assert_int_equal(hf_solver_get_site_count(solver), 2);
  hf_solver_destroy(solver);
  surface_free(&cut);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(welded_copies_get_the_same_value),
      cmocka_unit_test(the_report_counts_what_was_found),
      cmocka_unit_test(dirty_triangles_are_counted_and_the_field_is_finite),
      cmocka_unit_test(closed_pieces_that_face_inwards_are_counted),
      cmocka_unit_test(components_are_numbered_by_their_smallest_vertex),
      cmocka_unit_test(what_no_site_reaches_is_zero_and_counted),
      cmocka_unit_test(weld_none_keeps_the_cut_and_a_tolerance_closes_a_gap),
      cmocka_unit_test(minus_zero_and_zero_are_one_place),
      cmocka_unit_test(unit_and_offset_do_not_matter),
      cmocka_unit_test(interleaved_vertices_are_read_by_their_stride),
      cmocka_unit_test(triangles_of_16_bits_and_any_stride_give_the_same_bits),
      cmocka_unit_test(the_mesh_is_copied),
      cmocka_unit_test(limits_that_are_just_met_are_no_obstacle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
