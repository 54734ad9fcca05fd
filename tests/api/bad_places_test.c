/* Places that no call can use, on a surface that has them: a vertex in no triangle, a triangle of equal corners, an
 * piece where the other component is meant; and lists that name a site twice, short and long. */
#include "api_support.h"

/* One refused call: the code, the index, the detail. */
#define REFUSED(what, expected, index, call) check_row(__LINE__, what, #call, (call), expected, index)

static void regions_name_points_that_are_no_surface(void** state) {
  (void)state;
  Surface cut = surface_cut();
  const hf_surface surface = surface_on(&cut);
  hf_region region = NULL;
  assert_ok(hf_region_create(surface, NULL, &region));
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.curve = &curve;
  uint32_t points[4] = {1, 3, CUT_ISOLATED, 15};
  curve.point_count = 4;
  curve.vertices = points;
  REFUSED("a point in no triangle", HF_ERROR_INVALID_ARGUMENT, 2, hf_region_edit(region, &edit));
  points[2] = CUT_ISLAND;
  REFUSED("a point on the piece", HF_ERROR_INVALID_ARGUMENT, 2, hf_region_edit(region, &edit));
  points[2] = 18;
  curve.side = HF_SIDE_SEED;
  curve.seed_vertex = CUT_ISOLATED;
  REFUSED("a seed in no triangle", HF_ERROR_INVALID_ARGUMENT, CUT_ISOLATED, hf_region_edit(region, &edit));
  edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 4;
  edit.add_vertices = points;
  points[3] = CUT_ISOLATED;
  REFUSED("added in no triangle", HF_ERROR_INVALID_ARGUMENT, 3, hf_region_edit(region, &edit));

  /* detail: pins */
  points[3] = 12;
  edit.add_count = 1;
  edit.add_vertices = points + 3;
  assert_ok(hf_region_edit(region, &edit));
  hf_detail_desc pins = HF_INIT(hf_detail_desc);
  hf_detail detail = NULL;
  const uint32_t good[1] = {11}, isolated[1] = {CUT_ISOLATED};
  pins.pair_count = 1;
  pins.source_vertices = good;
  pins.target_vertices = isolated;
  REFUSED("a pin in no triangle", HF_ERROR_INVALID_ARGUMENT, 0, hf_detail_create(region, region, &pins, &detail));
  pins.source_vertices = isolated;
  pins.target_vertices = good;
  REFUSED("a source pin in no triangle", HF_ERROR_INVALID_ARGUMENT, 0,
          hf_detail_create(region, region, &pins, &detail));
  assert_null(detail);
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  surface_free(&cut);
  finish_rows("regions");
}

static void pairs_name_vertices_that_are_no_surface(void** state) {
  (void)state;
  Surface cut = surface_cut();
  const hf_surface surface = surface_on(&cut);
  hf_transfer transfer = NULL;
  assert_ok(hf_transfer_create(surface, surface, NULL, &transfer));
  const uint32_t counts[1] = {3}, good[3] = {0, 1, 2}, bad[3] = {0, CUT_ISOLATED, 2};
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 1;
  pairs.source_counts = pairs.target_counts = counts;
  pairs.source_vertices = bad;
  pairs.target_vertices = good;
  REFUSED("a source vertex in no triangle", HF_ERROR_INVALID_ARGUMENT, 1,
          hf_transfer_add_pairs(transfer, &pairs, NULL));
  pairs.source_vertices = good;
  pairs.target_vertices = bad;
  REFUSED("a target vertex in no triangle", HF_ERROR_INVALID_ARGUMENT, 1,
          hf_transfer_add_pairs(transfer, &pairs, NULL));
  hf_transfer_destroy(transfer);
  hf_surface_destroy(surface);
  surface_free(&cut);
  finish_rows("pairs");
}

static void vectors_stay_on_their_component(void** state) {
  (void)state;
  Surface cut = surface_cut();
  Options desc = options_of(&cut);
  desc.solver.channel_count = 3;
  hf_surface surface = NULL;
  hf_solver solver = NULL;
  assert_ok(make(&desc, &surface, &solver));
  const uint32_t place[1] = {7}, isolated[1] = {CUT_ISOLATED}, piece[1] = {CUT_ISLAND};
  const double vector[3] = {1, 0, 0};
  const hf_sites_desc sites = sites_at(1, place, vector);
  uint32_t site = 0;
  assert_ok(hf_add_sites(solver, &sites, &site));
  double before[3 * CUT_VERTICES], after[3 * CUT_VERTICES];
  assert_ok(hf_solver_solve_vectors_f64(solver, before, 0, NULL, NULL));
  REFUSED("to a vertex in no triangle", HF_ERROR_INVALID_ARGUMENT, 0,
          hf_solver_move_vectors(solver, 1, &site, isolated));
  REFUSED("to another component", HF_ERROR_INVALID_ARGUMENT, 0, hf_solver_move_vectors(solver, 1, &site, piece));
  assert_ok(hf_solver_solve_vectors_f64(solver, after, 0, NULL, NULL));
  assert_true(same_bits(before, after, sizeof before));

  hf_direction direction = NULL;
  assert_ok(hf_direction_create(surface, NULL, &direction));
  const double huge[3] = {0, 1e150, 0};
  REFUSED("1e150 long", HF_ERROR_TOO_LARGE, 0, hf_direction_add_sites(direction, 1, place, huge, NULL));
  assert_int_equal(hf_direction_get_site_count(direction), 0);
  hf_direction_destroy(direction);
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
  surface_free(&cut);
  finish_rows("vectors");
}

/* Lists of up to 64 sites are compared pair by pair, longer ones by marks: the answer is the same. */
static void a_site_is_moved_once_in_a_list_of_any_length(void** state) {
  (void)state;
  enum { MANY = 70 };
  Surface sheet = surface_sheet(20, 20);
  const hf_solver solver = surface_solver(&sheet);
  uint32_t places[MANY], sites[MANY], to[MANY];
  double values[MANY];
  for (uint32_t i = 0; i < MANY; ++i) {
    places[i] = 3 * i;
    to[i] = 3 * i + 1;
    values[i] = i % 5;
  }
  const hf_sites_desc batch = sites_at(MANY, places, values);
  assert_ok(hf_add_sites(solver, &batch, sites));
  double* before = field_of(solver, sheet.vertex_count);
  for (uint32_t count = 2; count <= MANY; count += count == 2 ? 62 : 1) {
    for (uint32_t first = 0; first + 1 < count; first += count / 2) {
      const uint32_t kept = sites[count - 1];
      sites[count - 1] = sites[first];
      const hf_sites_desc there = sites_at(count, to, NULL);
      REFUSED("named twice", HF_ERROR_NOT_FOUND, count - 1, hf_solver_move_sites(solver, count, sites, &there));
      sites[count - 1] = kept;
    }
  }
  double* after = field_of(solver, sheet.vertex_count);
  assert_true(same_bits(before, after, sheet.vertex_count * sizeof(double)));
  /* and the whole list, once each, is fine */
  const hf_sites_desc there = sites_at(MANY, to, NULL);
  assert_ok(hf_solver_move_sites(solver, MANY, sites, &there));
  free(before);
  free(after);
  hf_solver_destroy(solver);
  surface_free(&sheet);
  finish_rows("lists");
}

static void singularities_need_their_room(void** state) {
  (void)state;
  /* a closed surface has singularities: an octahedron, cut finer once by its middle points */
  static const float corner[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  float positions[3 * 24];
  uint32_t triangles[3 * 32], middle[6][6], vertices = 6, count = 0;
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 3; ++k) positions[3 * i + k] = corner[i][k];
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) {
      if (j == (i ^ 1)) continue;
      for (int k = 0; k < 3; ++k) positions[3 * vertices + (uint32_t)k] = 0.75f * (corner[i][k] + corner[j][k]);
      middle[i][j] = middle[j][i] = vertices++;
    }
  }
  for (uint32_t s = 0; s < 8; ++s) {
    const uint32_t x = s & 1, y = 2 + (s >> 1 & 1), z = 4 + (s >> 2 & 1);
    const int turned = (s & 1) + (s >> 1 & 1) + (s >> 2 & 1);
    const uint32_t a = x, b = turned % 2 ? z : y, c = turned % 2 ? y : z;
    const uint32_t ab = middle[a][b], bc = middle[b][c], ca = middle[c][a];
    const uint32_t four[12] = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
    memcpy(triangles + 3 * count, four, sizeof four);
    count += 4;
  }
  const Surface ball = {vertices, count, positions, triangles};
  const hf_surface surface = surface_on(&ball);
  hf_direction direction = NULL;
  assert_ok(hf_direction_create(surface, NULL, &direction));
  const uint32_t place[1] = {0};
  const double vector[3] = {0, 1, 0};
  assert_ok(hf_direction_add_sites(direction, 1, place, vector, NULL));
  uint32_t found = 0, again = 77;
  assert_ok(hf_direction_get_singularities(direction, 0, NULL, &found));
  assert_true(found >= 1); /* indices sum to 2 on a sphere */
  hf_singularity list[32];
  REFUSED("room for none", HF_ERROR_TOO_SMALL, NO_INDEX, hf_direction_get_singularities(direction, 0, list, &again));
  assert_ok(hf_direction_get_singularities(direction, 32, list, &again));
  assert_int_equal(found, again);
  double sum = 0;
  for (uint32_t i = 0; i < found; ++i) sum += list[i].index;
  assert_true(fabs(sum - 2) < 1e-12);
  hf_direction_destroy(direction);
  hf_surface_destroy(surface);
  finish_rows("singularities");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(regions_name_points_that_are_no_surface),
      cmocka_unit_test(pairs_name_vertices_that_are_no_surface),
      cmocka_unit_test(vectors_stay_on_their_component),
      cmocka_unit_test(a_site_is_moved_once_in_a_list_of_any_length),
      cmocka_unit_test(singularities_need_their_room),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
