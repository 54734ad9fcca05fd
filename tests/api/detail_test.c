/* Regions and carried detail through the C ABI: bits at weight 0, edits without a factorisation, clones, lifetimes, and
 * every bad argument named. */
#include "api_support.h"
#include "support/place_in.h"

enum { SIDE = 16, ROW = SIDE + 1, COUNT = ROW * ROW };

static uint32_t at(uint32_t i, uint32_t j) { return j * ROW + i; }

static const uint32_t square[4] = {3 * ROW + 3, 3 * ROW + 12, 12 * ROW + 12, 12 * ROW + 3};

static hf_curve_desc curve_of(uint32_t count, const uint32_t* vertices) {
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  curve.point_count = count;
  curve.vertices = vertices;
  return curve;
}

static hf_region_edit_desc edit_of(const hf_curve_desc* curve, int32_t rings) {
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.curve = curve;
  edit.ring_count = rings;
  return edit;
}

static hf_region_info info_of(hf_region region) {
  hf_region_info info = HF_INIT(hf_region_info);
  assert_ok(hf_region_get_info(region, &info));
  return info;
}

/* A region of 8 x 8 vertices on a bumpy sheet. */
static hf_region sheet_region(hf_surface surface, const Surface* sheet, int32_t base) {
  hf_region_desc desc = HF_INIT(hf_region_desc);
  desc.base = base;
  desc.positions = sheet->positions;
  hf_region region = NULL;
  assert_ok(hf_region_create(surface, &desc, &region));
  hf_curve_desc curve = curve_of(4, square);
  curve.kind = HF_CURVE_EDGES;
  const hf_region_edit_desc edit = edit_of(&curve, 0);
  assert_ok(hf_region_edit(region, &edit));
  return region;
}

static void morph_to(hf_region region, double weight, float* positions, double* positions_f64, float* normals) {
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.weight = weight;
  desc.positions = positions;
  desc.positions_f64 = positions_f64;
  desc.normals = normals;
  assert_ok(hf_region_morph(region, &desc));
}

static void weight_0_gives_the_bits_and_1_the_base(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  sheet.positions[3 * at(6, 6)] += 1e-6f; /* a place that doubles in units of the box do not hit */
  sheet.positions[3 * at(7, 7)] = -0.0f;  /* p + 0 (base - p) would be +0 */
  sheet.positions[3 * at(0, 0)] = 1e-30f;
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  float p[3 * COUNT], q[3 * COUNT], normals[3 * COUNT];
  double base[3 * COUNT], half[3 * COUNT], other[3 * COUNT];
  morph_to(region, 0, p, NULL, NULL);
  assert_true(same_bits(p, sheet.positions, sizeof p));
  morph_to(region, 1, NULL, base, NULL);
  morph_to(region, 0.5, NULL, half, normals);
  morph_to(region, -2, NULL, other, NULL);
  morph_to(region, 1, q, NULL, NULL);
  double moved = 0;
  for (int i = 0; i < 3 * COUNT; ++i) {
    const double original = (double)sheet.positions[i];
    assert_true(fabs(half[i] - (original + 0.5 * (base[i] - original))) < 1e-12);
    assert_true(fabs(other[i] - (original - 2 * (base[i] - original))) < 1e-12);
    assert_true(q[i] == (float)base[i]);
    moved = fmax(moved, fabs(base[i] - original));
  }
  assert_true(moved > 0.01);
  uint32_t inside[64];
  assert_int_equal(info_of(region).vertex_count, 64);
  assert_ok(hf_region_get_vertices(region, HF_REGION_INSIDE, 64, inside, NULL));
  assert_int_equal(inside[0], at(4, 4));
  assert_int_equal(inside[63], at(11, 11));
  for (uint32_t v = 0; v < COUNT; ++v) {
    const uint32_t i = v % ROW, j = v / ROW;
    const int in = i > 3 && i < 12 && j > 3 && j < 12;
    if (!in) assert_true(same_bits(p + 3 * v, sheet.positions + 3 * v, 3 * sizeof(float)));
    const double length = sqrt((double)(normals[3 * v] * normals[3 * v] + normals[3 * v + 1] * normals[3 * v + 1] +
                                        normals[3 * v + 2] * normals[3 * v + 2]));
    assert_true(fabs(length - 1) < 1e-5);
  }
  /* strides: other bytes stay */
  struct {
    float p[3], guard;
  } rows_of_four[COUNT];
  memset(rows_of_four, 0x5a, sizeof rows_of_four);
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.weight = 1;
  desc.positions = rows_of_four[0].p;
  desc.position_stride = sizeof rows_of_four[0];
  assert_ok(hf_region_morph(region, &desc));
  for (uint32_t v = 0; v < COUNT; ++v) {
    assert_true(same_bits(rows_of_four[v].p, q + 3 * v, 3 * sizeof(float)));
    assert_true(same_bits(&rows_of_four[v].guard, &rows_of_four[0].guard, sizeof(float)));
  }
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void edits_keep_the_factor_and_a_kept_clone_has_the_bits_of_then(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  hf_region copy = NULL;
  double first[3 * COUNT], now[3 * COUNT];
  morph_to(region, 1, NULL, first, NULL);
  assert_ok(hf_region_clone(region, &copy));
  hf_region_edit_desc edit = edit_of(NULL, 1);
  assert_ok(hf_region_edit(region, &edit));
  hf_region_info info = info_of(region);
  hf_region_statistics work = HF_INIT(hf_region_statistics);
  assert_ok(hf_region_get_statistics(region, &work));
  assert_int_equal(work.factorisation_count, 0);
  assert_int_equal(work.kept_count + work.inserted_count, info.site_count);
  assert_true(info.vertex_count > 64 && work.inserted_count > 0 && work.removed_count > 0);
  assert_true(info.base_area > 0 && info.area > info.base_area);
  assert_int_equal(info.field_kind, HF_FIELD_HARMONIC);
  const uint32_t out = at(7, 7);
  edit = HF_INIT(hf_region_edit_desc);
  edit.remove_count = 1;
  edit.remove_vertices = &out;
  assert_ok(hf_region_edit(region, &edit));
  assert_int_equal(info_of(region).vertex_count, info.vertex_count - 1);
  assert_ok(hf_region_get_statistics(region, &work));
  assert_int_equal(work.inserted_count, 1);
  assert_int_equal(work.removed_count, 0);
  morph_to(region, 1, NULL, now, NULL);
  assert_true(fabs(now[3 * out + 2] - (double)sheet.positions[3 * out + 2]) == 0);
  morph_to(copy, 1, NULL, now, NULL);
  assert_true(same_bits(now, first, sizeof now));
  hf_region_destroy(region);
  morph_to(copy, 1, NULL, now, NULL);
  assert_true(same_bits(now, first, sizeof now));
  hf_region_destroy(copy);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void a_point_in_a_triangle_stands_for_its_nearest_corner(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  hf_place places[4];
  for (uint32_t k = 0; k < 4; ++k) {
    for (uint32_t t = 0; t < sheet.triangle_count; ++t) {
      for (uint32_t c = 0; c < 3; ++c) {
        if (sheet.triangles[3 * t + c] != square[k]) continue;
        const double weights[3] = {c == 0 ? 0.5 : 0.25, c == 1 ? 0.5 : 0.25, c == 2 ? 0.5 : 0.25};
        places[k] = place_in(sheet.triangles, sheet.triangle_count, t, weights);
      }
    }
  }
  hf_region other = NULL;
  hf_region_desc desc = HF_INIT(hf_region_desc);
  desc.positions = sheet.positions;
  desc.base = HF_BASE_MEMBRANE;
  assert_ok(hf_region_create(surface, &desc, &other));
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  curve.point_count = 4;
  curve.places = places;
  curve.kind = HF_CURVE_EDGES;
  const hf_region_edit_desc edit = edit_of(&curve, 0);
  assert_ok(hf_region_edit(other, &edit));
  double a[3 * COUNT], b[3 * COUNT];
  morph_to(region, 1, NULL, a, NULL);
  morph_to(other, 1, NULL, b, NULL);
  assert_true(same_bits(a, b, sizeof a));
  hf_region_destroy(region);
  hf_region_destroy(other);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

/* Points at vertices and in triangles, joined straight: a square turned by 45 degrees, whose corners lie on vertices.
 */
static void a_straight_curve_cuts_through_triangles(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  for (uint32_t v = 0; v < COUNT; ++v)
    for (uint32_t k = 0; k < 3; ++k) sheet.positions[3 * v + k] = (float)(k == 0 ? v % ROW : k == 1 ? v / ROW : 0);
  const hf_surface surface = surface_on(&sheet);
  hf_region region = NULL;
  assert_ok(hf_region_create(surface, NULL, &region));
  assert_int_equal(info_of(region).field_kind, HF_FIELD_BIHARMONIC);
  uint32_t count = 7;
  assert_ok(hf_region_get_curve(region, 0, NULL, &count));
  assert_int_equal(count, 0);
  const uint32_t points[4] = {at(8, 3), at(13, 8), at(8, 13), at(3, 8)};
  const hf_curve_desc curve = curve_of(4, points);
  const hf_region_edit_desc edit = edit_of(&curve, 0);
  assert_ok(hf_region_edit(region, &edit));
  uint32_t inside[COUNT], found = 0;
  assert_ok(hf_region_get_vertices(region, HF_REGION_INSIDE, COUNT, inside, &found));
  assert_int_equal(found, 41); /* |x - 8| + |y - 8| < 5 */
  for (uint32_t i = 0; i < found; ++i)
    assert_true(abs((int)(inside[i] % ROW) - 8) + abs((int)(inside[i] / ROW) - 8) < 5);
  assert_ok(hf_region_get_curve(region, 0, NULL, &count));
  assert_true(count >= 20); /* each side crosses a vertex in each row; half of them edges between */
  double corners[3 * COUNT];
  assert_code(HF_ERROR_TOO_SMALL, hf_region_get_curve(region, count - 1, corners, NULL));
  assert_ok(hf_region_get_curve(region, count, corners, NULL));
  for (int k = 0; k < 3; ++k)
    assert_true(fabs(corners[k] - (double)sheet.positions[3 * at(8, 3) + (uint32_t)k]) < 1e-6);
  hf_region_edit_desc ring = edit_of(NULL, 1);
  assert_ok(hf_region_edit(region, &ring));
  uint32_t still = 0;
  assert_ok(hf_region_get_curve(region, 0, NULL, &still));
  assert_int_equal(still, count);
  /* its points in another order: an eight. The line after point 2 crosses the one after point 0 */
  const uint32_t eight[4] = {at(8, 3), at(8, 13), at(13, 8), at(3, 8)};
  const hf_curve_desc crossing = curve_of(4, eight);
  const hf_region_edit_desc bad_edit = edit_of(&crossing, 0);
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_region_edit(region, &bad_edit));
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  assert_int_equal(detail.index, 2);
  /* corners of no triangle: a straight curve has no place there, a curve along edges takes the nearest corner */
  const hf_place far[3] = {{{at(2, 2), at(3, 2), at(2, 9)}, 0, {0.4, 0.3, 0.3}},
                           {{at(9, 2), at(9, 3), at(8, 2)}, 0, {1, 0, 0}},
                           {{at(5, 9), at(6, 9), at(5, 10)}, 0, {1, 0, 0}}};
  hf_curve_desc loose = HF_INIT(hf_curve_desc);
  loose.point_count = 3;
  loose.places = far;
  const hf_region_edit_desc loose_edit = edit_of(&loose, 0);
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_region_edit(region, &loose_edit));
  hf_error_get_detail(&detail);
  assert_int_equal(detail.index, 0);
  loose.kind = HF_CURVE_EDGES;
  assert_ok(hf_region_edit(region, &loose_edit));
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void a_thin_plate_is_a_region_of_a_biharmonic_kind(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_THIN_PLATE);
  const hf_region_info info = info_of(region);
  assert_int_equal(info.field_kind, HF_FIELD_BIHARMONIC);
  assert_true(info.site_count > info.rim_count);
  uint32_t sites[COUNT], rim[COUNT];
  assert_ok(hf_region_get_vertices(region, HF_REGION_SITES, COUNT, sites, NULL));
  assert_ok(hf_region_get_vertices(region, HF_REGION_RIM, COUNT, rim, NULL));
  for (uint32_t i = 0, k = 0; i < info.rim_count; ++i) {
    const uint32_t column = rim[i] % ROW, row = rim[i] / ROW;
    assert_true(column == 3 || column == 12 || row == 3 || row == 12); /* on the curve */
    while (k < info.site_count && sites[k] < rim[i]) ++k;
    assert_true(k < info.site_count && sites[k] == rim[i]);
  }
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void detail_onto_itself_is_the_surface_and_outlives_all_else(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  double base[3 * COUNT], carried[3 * COUNT];
  morph_to(region, 1, NULL, base, NULL);
  hf_detail detail = NULL;
  assert_ok(hf_detail_create(region, region, NULL, &detail));
  const hf_region_edit_desc edit = edit_of(NULL, 1);
  assert_ok(hf_region_edit(region, &edit)); /* a later edit changes nothing */
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  hf_morph_desc desc = HF_INIT(hf_morph_desc);
  desc.positions_f64 = carried;
  assert_ok(hf_detail_morph(detail, &desc));
  assert_true(same_bits(carried, base, sizeof base));
  desc.weight = 1;
  assert_ok(hf_detail_morph(detail, &desc));
  for (int i = 0; i < 3 * COUNT; ++i) assert_true(fabs(carried[i] - (double)sheet.positions[i]) < 1e-6);
  desc.weight = 3;
  assert_ok(hf_detail_morph(detail, &desc));
  for (int i = 0; i < 3 * COUNT; ++i)
    assert_true(fabs(carried[i] - (base[i] + 3 * ((double)sheet.positions[i] - base[i]))) < 1e-5);
  hf_detail_destroy(detail);
  hf_detail_destroy(detail);
  assert_code(HF_ERROR_INVALID_OBJECT, hf_detail_morph(detail, &desc));
  surface_free(&sheet);
}

static void an_empty_region_gives_the_surface(void** state) {
  (void)state;
  Surface sheet = surface_cut(); /* with an isolated vertex and welded copies */
  const hf_surface surface = surface_on(&sheet);
  hf_region region = NULL;
  assert_ok(hf_region_create(surface, NULL, &region));
  float p[3 * CUT_VERTICES];
  morph_to(region, 0.7, p, NULL, NULL);
  for (int i = 0; i < 3 * CUT_VERTICES; ++i) assert_true(fabsf(p[i] - sheet.positions[i]) < 1e-6f);
  assert_int_equal(info_of(region).vertex_count, 0);
  uint32_t none;
  assert_ok(hf_region_get_vertices(region, HF_REGION_INSIDE, 0, &none, NULL));
  /* both copies of a seam vertex go to one base */
  const uint32_t seam = CUT_SEAM_RIGHT;
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 1;
  edit.add_vertices = &seam;
  assert_ok(hf_region_edit(region, &edit));
  morph_to(region, 1, p, NULL, NULL);
  assert_true(same_bits(p + 3 * CUT_SEAM_LEFT, p + 3 * CUT_SEAM_RIGHT, 3 * sizeof(float)));
  assert_true(fabsf(p[3 * CUT_SEAM_LEFT + 2] - sheet.positions[3 * CUT_SEAM_LEFT + 2]) > 1e-4f ||
              fabsf(p[3 * CUT_SEAM_LEFT] - sheet.positions[3 * CUT_SEAM_LEFT]) > 1e-4f);
  const uint32_t isolated = CUT_ISOLATED;
  edit.add_vertices = &isolated;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_region_edit(region, &edit));
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void cancelling_leaves_all_as_it_was_and_stops_one_call(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  hf_progress progress = NULL;
  assert_ok(hf_progress_create(&progress));
  assert_ok(hf_progress_cancel(progress));
  hf_region_edit_desc edit = edit_of(NULL, 1);
  edit.progress = progress;
  assert_code(HF_ERROR_CANCELLED, hf_region_edit(region, &edit));
  assert_int_equal(info_of(region).vertex_count, 64);
  assert_ok(hf_region_edit(region, &edit));
  double done = 0;
  assert_ok(hf_progress_get_fraction(progress, &done));
  assert_true(done == 1);
  assert_ok(hf_progress_cancel(progress));
  hf_detail_desc desc = HF_INIT(hf_detail_desc);
  desc.progress = progress;
  hf_detail detail = (hf_detail)(uintptr_t)1;
  assert_code(HF_ERROR_CANCELLED, hf_detail_create(region, region, &desc, &detail));
  assert_null(detail);
  assert_ok(hf_detail_create(region, region, &desc, &detail));
  hf_detail_destroy(detail);
  hf_progress_destroy(progress);
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

/* One row of bad input: code and index. */
static void bad(int line, hf_result got, const char* call, hf_result expected, uint32_t index) {
  check_row(line, "detail", call, got, expected, index);
}
#define BAD(expected, index, call) bad(__LINE__, call, #call, expected, index)

static void bad_regions_are_named(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  double before[3 * COUNT], after[3 * COUNT];
  morph_to(region, 1, NULL, before, NULL);
  hf_region made = NULL;
  hf_region_desc desc = HF_INIT(hf_region_desc);
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_create(surface, NULL, NULL));
  BAD(HF_ERROR_INVALID_OBJECT, NO_INDEX, hf_region_create(NULL, NULL, &made));
  desc.struct_size = 4;
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_create(surface, &desc, &made));
  desc = HF_INIT(hf_region_desc);
  desc.positions = sheet.positions;
  desc.positions_f64 = before;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_create(surface, &desc, &made));
  desc.positions = NULL;
  desc.position_stride = 8;
  BAD(HF_ERROR_TOO_SMALL, NO_INDEX, hf_region_create(surface, &desc, &made));
  desc.position_stride = 0;
  before[3 * 40 + 1] = NAN;
  BAD(HF_ERROR_NON_FINITE, 40, hf_region_create(surface, &desc, &made));
  desc = HF_INIT(hf_region_desc);
  desc.base = 4;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_create(surface, &desc, &made));
  desc.base = 0;
  desc.reserved = 1;
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_create(surface, &desc, &made));
  assert_null(made);
  morph_to(region, 1, NULL, before, NULL);

  hf_region_edit_desc edit;
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_edit(region, NULL));
  edit = edit_of(NULL, 1);
  BAD(HF_ERROR_INVALID_OBJECT, NO_INDEX, hf_region_edit((hf_region)surface, &edit));
  edit.struct_size = 8;
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_edit(region, &edit));
  edit = edit_of(NULL, 1);
  edit.progress = (hf_progress)region;
  BAD(HF_ERROR_INVALID_OBJECT, NO_INDEX, hf_region_edit(region, &edit));
  edit = edit_of(NULL, -99);
  BAD(HF_ERROR_EMPTY, NO_INDEX, hf_region_edit(region, &edit));
  edit = edit_of(NULL, 99);
  BAD(HF_ERROR_INVALID_ARGUMENT, COUNT - 1, hf_region_edit(region, &edit));
  hf_curve_desc curve = curve_of(2, square);
  edit = edit_of(&curve, 0);
  BAD(HF_ERROR_EMPTY, 2, hf_region_edit(region, &edit));
  curve = curve_of(4, NULL);
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_edit(region, &edit));
  curve = curve_of(COUNT + 1, square);
  BAD(HF_ERROR_TOO_LARGE, NO_INDEX, hf_region_edit(region, &edit));
  curve = curve_of(4, square);
  curve.side = 3;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_edit(region, &edit));
  curve = curve_of(4, square);
  curve.kind = 2;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_edit(region, &edit));
  curve = curve_of(4, square);
  curve.reserved = 1;
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_edit(region, &edit));
  curve = curve_of(4, square);
  curve.struct_size = 12;
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_edit(region, &edit));
  const uint32_t beyond[4] = {square[0], square[1], COUNT, square[3]}, line[3] = {at(2, 2), at(9, 2), at(5, 2)};
  curve = curve_of(4, beyond);
  BAD(HF_ERROR_OUT_OF_RANGE, 2, hf_region_edit(region, &edit));
  curve = curve_of(3, line);
  curve.kind = HF_CURVE_EDGES;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_edit(region, &edit));
  curve = curve_of(4, square);
  curve.kind = HF_CURVE_EDGES;
  curve.side = HF_SIDE_SEED;
  curve.seed_vertex = COUNT;
  BAD(HF_ERROR_OUT_OF_RANGE, COUNT, hf_region_edit(region, &edit));
  curve.seed_vertex = at(3, 7);
  BAD(HF_ERROR_INVALID_ARGUMENT, at(3, 7), hf_region_edit(region, &edit));
  hf_place places[3] = {{{at(2, 2), at(3, 2), at(2, 3)}, 0, {1, 0, 0}},
                        {{at(9, 2), at(9, 3), at(8, 2)}, 0, {1, 0, 0}},
                        {{at(5, 9), at(6, 9), at(5, 8)}, 0, {1, 0, 0}}};
  curve = HF_INIT(hf_curve_desc);
  curve.point_count = 3;
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_edit(region, &edit));
  curve.places = places;
  places[1].corners[0] = COUNT;
  BAD(HF_ERROR_OUT_OF_RANGE, 1, hf_region_edit(region, &edit));
  places[1].corners[0] = at(9, 2);
  places[2].barycentrics[1] = 0.5;
  BAD(HF_ERROR_INVALID_ARGUMENT, 2, hf_region_edit(region, &edit));
  places[2].barycentrics[1] = INFINITY;
  BAD(HF_ERROR_NON_FINITE, 2, hf_region_edit(region, &edit));
  places[2].barycentrics[0] = 2;
  places[2].barycentrics[1] = -1;
  BAD(HF_ERROR_INVALID_ARGUMENT, 2, hf_region_edit(region, &edit));
  curve.vertices = square;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_edit(region, &edit));
  edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 3;
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_edit(region, &edit));
  edit.add_vertices = beyond;
  BAD(HF_ERROR_OUT_OF_RANGE, 2, hf_region_edit(region, &edit));
  edit = HF_INIT(hf_region_edit_desc);
  edit.remove_count = COUNT + 1;
  edit.remove_vertices = beyond;
  BAD(HF_ERROR_TOO_LARGE, NO_INDEX, hf_region_edit(region, &edit));

  uint32_t found[64] = {7};
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_get_vertices(region, 3, 64, found, NULL));
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_get_vertices(region, 0, 64, NULL, NULL));
  BAD(HF_ERROR_TOO_SMALL, NO_INDEX, hf_region_get_vertices(region, 0, 63, found, NULL));
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_get_curve(region, 64, NULL, NULL));
  BAD(HF_ERROR_TOO_SMALL, NO_INDEX, hf_region_get_curve(region, 3, before, NULL));
  assert_int_equal(found[0], 7);
  hf_morph_desc morph = HF_INIT(hf_morph_desc);
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_morph(region, &morph));
  morph.positions_f64 = after;
  morph.weight = INFINITY;
  BAD(HF_ERROR_NON_FINITE, NO_INDEX, hf_region_morph(region, &morph));
  morph.weight = 1;
  morph.position_stride = 12;
  BAD(HF_ERROR_TOO_SMALL, NO_INDEX, hf_region_morph(region, &morph));
  morph.position_stride = 0;
  morph.reserved = 1;
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_morph(region, &morph));
  morph.reserved = 0;
  morph.positions = (float*)found;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_region_morph(region, &morph));
  hf_region_info info;
  memset(&info, 0, sizeof info);
  BAD(HF_ERROR_INVALID_DESC, NO_INDEX, hf_region_get_info(region, &info));
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_region_get_info(region, NULL));
  BAD(HF_ERROR_INVALID_OBJECT, NO_INDEX, hf_region_clone(NULL, &made));
  morph_to(region, 1, NULL, after, NULL);
  assert_true(same_bits(before, after, sizeof before)); /* whatever failed, the region is as it was */
  finish_rows("regions");
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void bad_details_are_named(void** state) {
  (void)state;
  Surface sheet = surface_sheet(SIDE, SIDE);
  const hf_surface surface = surface_on(&sheet);
  const hf_region region = sheet_region(surface, &sheet, HF_BASE_MEMBRANE);
  hf_region empty = NULL;
  assert_ok(hf_region_create(surface, NULL, &empty));
  hf_detail detail = NULL;
  hf_detail_desc desc = HF_INIT(hf_detail_desc);
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_detail_create(region, region, NULL, NULL));
  BAD(HF_ERROR_INVALID_OBJECT, NO_INDEX, hf_detail_create(NULL, region, NULL, &detail));
  BAD(HF_ERROR_INVALID_OBJECT, NO_INDEX, hf_detail_create(region, (hf_region)surface, NULL, &detail));
  BAD(HF_ERROR_EMPTY, NO_INDEX, hf_detail_create(empty, region, NULL, &detail));
  BAD(HF_ERROR_EMPTY, NO_INDEX, hf_detail_create(region, empty, NULL, &detail));
  desc.scale = -1;
  BAD(HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_detail_create(region, region, &desc, &detail));
  desc.scale = NAN;
  BAD(HF_ERROR_NON_FINITE, NO_INDEX, hf_detail_create(region, region, &desc, &detail));
  desc = HF_INIT(hf_detail_desc);
  desc.pair_count = 2;
  desc.source_vertices = square;
  BAD(HF_ERROR_NULL_POINTER, NO_INDEX, hf_detail_create(region, region, &desc, &detail));
  const uint32_t off[2] = {square[0], at(8, 8)}, beyond[2] = {square[0], COUNT}, twice[2] = {square[0], square[0]};
  desc.target_vertices = off;
  BAD(HF_ERROR_INVALID_ARGUMENT, 1, hf_detail_create(region, region, &desc, &detail));
  desc.target_vertices = beyond;
  BAD(HF_ERROR_OUT_OF_RANGE, 1, hf_detail_create(region, region, &desc, &detail));
  desc.target_vertices = twice;
  BAD(HF_ERROR_INVALID_ARGUMENT, 1, hf_detail_create(region, region, &desc, &detail));
  desc.pair_count = COUNT + 1;
  BAD(HF_ERROR_TOO_LARGE, NO_INDEX, hf_detail_create(region, region, &desc, &detail));
  /* with a square in its middle taken out it is no disc any more */
  const uint32_t hole[4] = {at(7, 7), at(8, 7), at(7, 8), at(8, 8)};
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.remove_count = 4;
  edit.remove_vertices = hole;
  assert_ok(hf_region_edit(region, &edit));
  assert_code(HF_ERROR_UNSUPPORTED, hf_detail_create(region, region, NULL, &detail));
  assert_null(detail);
  finish_rows("details");
  hf_region_destroy(empty);
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weight_0_gives_the_bits_and_1_the_base),
      cmocka_unit_test(edits_keep_the_factor_and_a_kept_clone_has_the_bits_of_then),
      cmocka_unit_test(a_point_in_a_triangle_stands_for_its_nearest_corner),
      cmocka_unit_test(a_straight_curve_cuts_through_triangles),
      cmocka_unit_test(a_thin_plate_is_a_region_of_a_biharmonic_kind),
      cmocka_unit_test(detail_onto_itself_is_the_surface_and_outlives_all_else),
      cmocka_unit_test(an_empty_region_gives_the_surface),
      cmocka_unit_test(cancelling_leaves_all_as_it_was_and_stops_one_call),
      cmocka_unit_test(bad_regions_are_named),
      cmocka_unit_test(bad_details_are_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
