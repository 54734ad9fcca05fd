/* Bad input to hf/field.h: one thing wrong per row; the field, the sites and the outputs stay as they were. */
#include "bad_scene.h"
#include "support/place_in.h"

static Scene scene;

/* The good input of every call; a row spoils one thing. */
static uint32_t places[3], out_sites[3], numbers[4];
static hf_place spots[3];
static double values[9], stiffness[3];
static hf_sites_desc sites, to;
static hf_edit_desc edit;
static hf_sites_info info;
static uint32_t info_sites[3];
static double points[CUT_VERTICES];
static float floats[CUT_VERTICES];
static double doubles[CUT_VERTICES];

static void good_input(void) {
  const uint32_t free_vertices[3] = {6, 7, 8}, free_triangles[3] = {10, 11, 12};
  memcpy(places, free_vertices, sizeof places);
  const double weights[3] = {0.5, 0.25, 0.25};
  for (int i = 0; i < 9; ++i) values[i] = i + 10.0;
  for (int i = 0; i < 3; ++i) {
    spots[i] = place_in(scene.cut.triangles, CUT_TRIANGLES, free_triangles[i], weights);
    stiffness[i] = i;
    out_sites[i] = 777;
    numbers[i] = scene.sites[i];
  }
  numbers[3] = 0;
  sites = sites_at(3, places, values);
  sites.stiffness = stiffness;
  to = sites_at(3, places, NULL);
  edit = HF_INIT(hf_edit_desc);
  info = HF_INIT(hf_sites_info);
  info.capacity = 3;
  info.sites = info_sites;
  info_sites[0] = floats[0] = doubles[0] = points[0] = 777;
}

static int as_before(void) {
  return out_sites[0] == 777 && info_sites[0] == 777 && floats[0] == 777 && doubles[0] == 777 && points[0] == 777 &&
         solver_unchanged(&scene);
}

#define GOOD good_input
#define UNCHANGED as_before
#define ADD(what, expected, index, change) \
  ROW(what, expected, index, change, hf_add_sites(scene.solver, &sites, out_sites))
#define REMOVE(what, expected, index, change) \
  ROW(what, expected, index, change, hf_remove_sites(scene.solver, 3, numbers))
#define MOVE(what, expected, index, change) \
  ROW(what, expected, index, change, hf_solver_move_sites(scene.solver, 3, numbers, &to))
#define SET(what, expected, index, change) \
  ROW(what, expected, index, change, hf_solver_set_values(scene.solver, 3, numbers, values))
#define EDIT(what, expected, index, change) \
  ROW(what, expected, index, change, hf_solver_edit_sites(scene.solver, &edit, out_sites))

static void between_corners(hf_sites_desc* d) {
  d->vertices = NULL;
  d->places = spots;
}

static void adding_bad_sites_is_refused(void** state) {
  (void)state;
  scene_create(&scene);
  ADD("no site", HF_ERROR_EMPTY, NO_INDEX, sites.site_count = 0);
  ADD("no form of places", HF_ERROR_NULL_POINTER, NO_INDEX, sites.vertices = NULL);
  ADD("both vertices and places", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, sites.places = spots);
  ADD("both vertices and points", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, sites.points = values);
  ADD("both places and points", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (between_corners(&sites), sites.points = values));
  ADD("vertex = vertex_count", HF_ERROR_OUT_OF_RANGE, 2, places[2] = CUT_VERTICES);
  ADD("vertex UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 0, places[0] = UINT32_MAX);
  ADD("vertex 2^31", HF_ERROR_OUT_OF_RANGE, 1, places[1] = 0x80000000u);
  ADD("isolated vertex", HF_ERROR_INVALID_ARGUMENT, 1, places[1] = CUT_ISOLATED);
  ADD("reserved set", HF_ERROR_INVALID_DESC, 2, (between_corners(&sites), spots[2].reserved = 1));
  ADD("weight NaN", HF_ERROR_NON_FINITE, 1, (between_corners(&sites), spots[1].barycentrics[1] = (double)NAN));
  ADD("weight infinite", HF_ERROR_NON_FINITE, 2, (between_corners(&sites), spots[2].barycentrics[2] = HUGE_VAL));
  ADD("weight negative", HF_ERROR_INVALID_ARGUMENT, 0,
      (between_corners(&sites), spots[0].barycentrics[0] = 1.25, spots[0].barycentrics[1] = -0.5));
  ADD("weights sum to 0.999", HF_ERROR_INVALID_ARGUMENT, 2,
      (between_corners(&sites), spots[2].barycentrics[0] = 0.499));
  ADD("weights sum to 1.001", HF_ERROR_INVALID_ARGUMENT, 1,
      (between_corners(&sites), spots[1].barycentrics[0] = 0.501));
  ADD("weights are all 0", HF_ERROR_INVALID_ARGUMENT, 0,
      (between_corners(&sites), memset(spots[0].barycentrics, 0, sizeof spots[0].barycentrics)));
  ADD("corner = vertex_count", HF_ERROR_OUT_OF_RANGE, 1, (between_corners(&sites), spots[1].corners[2] = CUT_VERTICES));
  ADD("corner UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 2, (between_corners(&sites), spots[2].corners[0] = UINT32_MAX));
  ADD("isolated corner", HF_ERROR_INVALID_ARGUMENT, 0, (between_corners(&sites), spots[0].corners[1] = CUT_ISOLATED));
  ADD("corners of two components", HF_ERROR_INVALID_ARGUMENT, 2,
      (between_corners(&sites), spots[2].corners[2] = CUT_ISLAND));
  ADD("point NaN", HF_ERROR_NON_FINITE, 0, (sites.vertices = NULL, sites.points = values, values[1] = (double)NAN));
  ADD("point far away", HF_ERROR_TOO_LARGE, 0, (sites.vertices = NULL, sites.points = values, values[2] = -1e6));
  ADD("value NaN", HF_ERROR_NON_FINITE, 1, values[1] = (double)NAN);
  ADD("value infinite", HF_ERROR_NON_FINITE, 0, values[0] = -HUGE_VAL);
  ADD("value beyond 1e200", HF_ERROR_TOO_LARGE, 1, values[1] = 1.01e200);
  ADD("the largest value there is", HF_ERROR_TOO_LARGE, 2, values[2] = -1.7e308);
  ADD("stiffness NaN", HF_ERROR_NON_FINITE, 2, stiffness[2] = (double)NAN);
  ADD("stiffness infinite", HF_ERROR_NON_FINITE, 1, stiffness[1] = HUGE_VAL);
  ADD("stiffness negative", HF_ERROR_INVALID_ARGUMENT, 0, stiffness[0] = -1e-9);
  ADD("the vertex has a site with the same value", HF_ERROR_DUPLICATE, 0, (places[0] = CUT_RIGHT, values[0] = 1));
  ADD("the vertex has a site with another value", HF_ERROR_CONFLICT, 0, places[0] = CUT_RIGHT);
  ADD("the vertex has a site with another stiffness", HF_ERROR_CONFLICT, 1, (places[1] = CUT_RIGHT, values[1] = 1));
  ADD("a welded copy has a site with the same value", HF_ERROR_DUPLICATE, 0,
      (places[0] = CUT_SEAM_RIGHT, values[0] = 5));
  ADD("a welded copy has a site with another value", HF_ERROR_CONFLICT, 0, places[0] = CUT_SEAM_RIGHT);
  ADD("twice in one batch, same values", HF_ERROR_DUPLICATE, 2,
      (places[2] = places[0], values[2] = values[0], stiffness[2] = 0));
  ADD("twice in one batch, other values", HF_ERROR_CONFLICT, 2, (places[2] = places[0]));
  ADD("both copies in one batch, other values", HF_ERROR_CONFLICT, 1,
      (places[0] = CUT_SEAM_LEFT + 5, places[1] = CUT_SEAM_RIGHT + 5));
  ADD("a corner of a triangle that has a site", HF_ERROR_CONFLICT, 0,
      (between_corners(&sites), spots[0] = (hf_place){{0, 1, 2}, 0, {1, 0, 0}}));
  ADD("site_limit", HF_ERROR_TOO_LARGE, NO_INDEX, sites.site_count = 100001);
  ADD("2^31 sites", HF_ERROR_TOO_LARGE, NO_INDEX, sites.site_count = 0x80000000u);
  ADD("2^32 - 1 sites", HF_ERROR_TOO_LARGE, NO_INDEX, sites.site_count = UINT32_MAX);
  scene_destroy(&scene);
  finish_rows("adding sites");
}

static void linearly_dependent_points_are_refused(void** state) {
  (void)state;
  scene_create(&scene);
  /* the corners of triangle 10 are hard sites; any further hard point in it depends on them */
  hf_solver solver = NULL;
  assert_ok(hf_solver_clone(scene.solver, &solver));
  const double value = 2;
  for (int k = 0; k < 3; ++k) {
    const hf_sites_desc corner = sites_at(1, &scene.cut.triangles[3 * 10 + k], &value);
    assert_ok(hf_add_sites(solver, &corner, NULL));
  }
  double before[CUT_VERTICES], after[CUT_VERTICES];
  assert_ok(hf_solver_solve(solver, OUT(before), NULL));
  GOOD();
  between_corners(&sites);
  sites.site_count = 1;
  sites.stiffness = NULL;
  check_row(__LINE__, "a point between three hard sites", "hf_add_sites", hf_add_sites(solver, &sites, NULL),
            HF_ERROR_CONFLICT, 0);
  sites.site_count = 2;
  const double weights[3] = {0.5, 0.25, 0.25};
  spots[0] = place_in(scene.cut.triangles, CUT_TRIANGLES, 20, weights);
  spots[1] = place_in(scene.cut.triangles, CUT_TRIANGLES, 10, weights);
  check_row(__LINE__, "the second of a batch", "hf_add_sites", hf_add_sites(solver, &sites, NULL), HF_ERROR_CONFLICT,
            1);
  hf_sites_desc there = sites;
  there.values = NULL;
  there.site_count = 1;
  there.places = spots + 1;
  check_row(__LINE__, "a move to such a point", "hf_solver_move_sites",
            hf_solver_move_sites(solver, 1, scene.sites, &there), HF_ERROR_CONFLICT, 0);
  assert_ok(hf_solver_solve(solver, OUT(after), NULL));
  assert_true(same_bits(before, after, sizeof before));
  const double soft = 3;
  sites.site_count = 1;
  spots[0] = spots[1];
  sites.stiffness = &soft; /* soft points are never dependent */
  assert_ok(hf_add_sites(solver, &sites, NULL));
  hf_solver_destroy(solver);
  scene_destroy(&scene);
  finish_rows("dependent points");
}

static void removing_moving_and_setting_bad_sites_is_refused(void** state) {
  (void)state;
  scene_create(&scene);
  ROW("no site", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_remove_sites(scene.solver, 0, numbers));
  ROW("no list", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_remove_sites(scene.solver, 3, NULL));
  REMOVE("no such number", HF_ERROR_NOT_FOUND, 2, numbers[2] = 3);
  REMOVE("number UINT32_MAX", HF_ERROR_NOT_FOUND, 1, numbers[1] = UINT32_MAX);
  REMOVE("number 2^31", HF_ERROR_NOT_FOUND, 0, numbers[0] = 0x80000000u);
  REMOVE("named twice", HF_ERROR_NOT_FOUND, 2, numbers[2] = numbers[0]);
  ROW("more than there are", HF_ERROR_NOT_FOUND, 3, (void)0, hf_remove_sites(scene.solver, 4, numbers));
  ROW("2^31 of them", HF_ERROR_NOT_FOUND, 3, (void)0, hf_remove_sites(scene.solver, 0x80000000u, numbers));
  ROW("2^32 - 1 of them", HF_ERROR_NOT_FOUND, 3, (void)0, hf_remove_sites(scene.solver, UINT32_MAX, numbers));

  ROW("no site", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_move_sites(scene.solver, 0, numbers, &to));
  ROW("no list", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_move_sites(scene.solver, 3, NULL, &to));
  ROW("no places", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_move_sites(scene.solver, 3, numbers, NULL));
  MOVE("fewer places than sites", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.site_count = 2);
  MOVE("more places than sites", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.site_count = UINT32_MAX);
  MOVE("places empty", HF_ERROR_EMPTY, NO_INDEX, to.site_count = 0);
  MOVE("with values", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.values = values);
  MOVE("with stiffness", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.stiffness = stiffness);
  MOVE("no form of places", HF_ERROR_NULL_POINTER, NO_INDEX, to.vertices = NULL);
  MOVE("both vertices and places", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.places = spots);
  MOVE("no such number", HF_ERROR_NOT_FOUND, 1, numbers[1] = 17);
  MOVE("named twice", HF_ERROR_NOT_FOUND, 2, numbers[2] = numbers[1]);
  MOVE("vertex = vertex_count", HF_ERROR_OUT_OF_RANGE, 0, places[0] = CUT_VERTICES);
  MOVE("isolated vertex", HF_ERROR_INVALID_ARGUMENT, 2, places[2] = CUT_ISOLATED);
  MOVE("two to one place", HF_ERROR_CONFLICT, 1, places[1] = places[0]);
  MOVE("two to copies of one place", HF_ERROR_CONFLICT, 2,
       (places[0] = CUT_SEAM_LEFT + 10, places[2] = CUT_SEAM_RIGHT + 10));
  MOVE("weight NaN", HF_ERROR_NON_FINITE, 0, (between_corners(&to), spots[0].barycentrics[1] = (double)NAN));
  MOVE("weights sum to 2", HF_ERROR_INVALID_ARGUMENT, 1, (between_corners(&to), spots[1].barycentrics[0] = 1.5));
  ROW("to the place of a site that stays", HF_ERROR_CONFLICT, 0, places[0] = CUT_RIGHT,
      hf_solver_move_sites(scene.solver, 1, numbers, (to.site_count = 1, &to)));
  ROW("2^31 of them", HF_ERROR_NOT_FOUND, 3, to.site_count = 0x80000000u,
      hf_solver_move_sites(scene.solver, 0x80000000u, numbers, &to));

  ROW("no site", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_set_values(scene.solver, 0, numbers, values));
  ROW("no list", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_set_values(scene.solver, 3, NULL, values));
  ROW("no values", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_set_values(scene.solver, 3, numbers, NULL));
  SET("no such number", HF_ERROR_NOT_FOUND, 1, numbers[1] = 3);
  SET("number UINT32_MAX", HF_ERROR_NOT_FOUND, 0, numbers[0] = UINT32_MAX);
  SET("value NaN", HF_ERROR_NON_FINITE, 2, values[2] = (double)NAN);
  SET("value beyond 1e200", HF_ERROR_TOO_LARGE, 1, values[1] = -1.7e308);
  SET("value infinite", HF_ERROR_NON_FINITE, 0, values[0] = HUGE_VAL);
  scene_destroy(&scene);
  finish_rows("removing, moving, setting");
}

/* Screening is copied: H at every vertex, p in one channel. */
static double strengths[CUT_VERTICES], wishes[CUT_VERTICES];
static void good_screening(void) {
  good_input();
  for (int i = 0; i < CUT_VERTICES; ++i) {
    strengths[i] = 1;
    wishes[i] = i;
  }
}
#undef GOOD
#define GOOD good_screening

static void bad_screening_is_refused(void** state) {
  (void)state;
  scene_create(&scene);
  ROW("H is NaN", HF_ERROR_NON_FINITE, 4, strengths[4] = (double)NAN,
      hf_solver_set_screening(scene.solver, strengths, wishes));
  ROW("H is negative", HF_ERROR_INVALID_ARGUMENT, 3, strengths[3] = -1,
      hf_solver_set_screening(scene.solver, strengths, NULL));
  ROW("H is too large", HF_ERROR_TOO_LARGE, 2, strengths[2] = 1e201,
      hf_solver_set_screening(scene.solver, strengths, NULL));
  ROW("H is far above the operator", HF_ERROR_TOO_LARGE, 2, strengths[2] = 1e190,
      hf_solver_set_screening(scene.solver, strengths, NULL));
  ROW("p is infinite", HF_ERROR_NON_FINITE, 5, wishes[5] = (double)INFINITY,
      hf_solver_set_screening(scene.solver, strengths, wishes));
  ROW("p is too large", HF_ERROR_TOO_LARGE, 1, wishes[1] = -1e201,
      hf_solver_set_screening(scene.solver, strengths, wishes));
  GOOD();
  hf_certificate certificate = HF_INIT(hf_certificate);
  hf_solver copy;
  assert_ok(hf_solver_clone(scene.solver, &copy));
  assert_ok(hf_solver_set_screening(copy, strengths, wishes));
  assert_ok(hf_solver_certify(copy, &certificate));
  assert_ok(hf_solve(copy, floats, 0, NULL));
  const uint32_t all[3] = {scene.sites[0], scene.sites[1], scene.sites[2]};
  assert_ok(hf_remove_sites(copy, 3, all));
  assert_ok(hf_solve(copy, floats, 0, NULL));
  assert_ok(hf_solver_set_screening(copy, NULL, NULL));
  assert_int_equal(hf_solve(copy, floats, 0, NULL), HF_ERROR_EMPTY);
  hf_solver_destroy(copy);
  scene_destroy(&scene);
  finish_rows("screening");
}

static void good_edit(void) {
  good_input();
  edit.remove_count = 1;
  edit.remove_sites = numbers;
  edit.move_count = 1;
  edit.move_sites = numbers + 1;
  edit.move_to = &to;
  to.site_count = 1;
  edit.set_count = 1;
  edit.set_sites = numbers + 2;
  edit.set_values = values;
  edit.add = &sites;
  sites.site_count = 2;
  sites.vertices = places + 1;
}
#undef GOOD
#define GOOD good_edit

static void a_batch_with_one_bad_part_changes_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  EDIT("remove_sites NULL", HF_ERROR_NULL_POINTER, NO_INDEX, edit.remove_sites = NULL);
  EDIT("move_sites NULL", HF_ERROR_NULL_POINTER, NO_INDEX, edit.move_sites = NULL);
  EDIT("move_to NULL", HF_ERROR_NULL_POINTER, NO_INDEX, edit.move_to = NULL);
  EDIT("set_sites NULL", HF_ERROR_NULL_POINTER, NO_INDEX, edit.set_sites = NULL);
  EDIT("set_values NULL", HF_ERROR_NULL_POINTER, NO_INDEX, edit.set_values = NULL);
  EDIT("removes what is not there", HF_ERROR_NOT_FOUND, 0, numbers[0] = 99);
  EDIT("removes twice", HF_ERROR_NOT_FOUND, 1, (edit.remove_count = 2, numbers[1] = numbers[0]));
  EDIT("moves what it removes", HF_ERROR_NOT_FOUND, 0, numbers[1] = numbers[0]);
  EDIT("moves out of range", HF_ERROR_OUT_OF_RANGE, 0, places[0] = CUT_VERTICES);
  EDIT("move counts differ", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.site_count = 2);
  EDIT("moves with values", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, to.values = values);
  EDIT("sets what it removes", HF_ERROR_NOT_FOUND, 0, numbers[2] = numbers[0]);
  EDIT("sets NaN", HF_ERROR_NON_FINITE, 0, values[0] = (double)NAN);
  EDIT("adds nothing", HF_ERROR_EMPTY, NO_INDEX, sites.site_count = 0);
  EDIT("adds out of range", HF_ERROR_OUT_OF_RANGE, 1, places[2] = UINT32_MAX);
  EDIT("adds where it moves to", HF_ERROR_CONFLICT, 0, places[1] = places[0]);
  EDIT("adds on the site it keeps", HF_ERROR_CONFLICT, 1, places[2] = CUT_SEAM_RIGHT);
  EDIT("adds 2^31", HF_ERROR_TOO_LARGE, NO_INDEX, sites.site_count = 0x80000000u);
  EDIT("removes 2^31", HF_ERROR_NOT_FOUND, 3, edit.remove_count = 0x80000000u);
  EDIT("moves 2^31", HF_ERROR_NOT_FOUND, 2, (edit.move_count = to.site_count = 0x80000000u));
  EDIT("adds stiffness NaN", HF_ERROR_NON_FINITE, 1, stiffness[1] = (double)NAN);
  scene_destroy(&scene);
  finish_rows("batches");
}
#undef GOOD
#define GOOD good_input

static void reading_with_bad_arguments_is_refused(void** state) {
  (void)state;
  scene_create(&scene);
  uint32_t list[2] = {3, 4};
  ROW("no room", HF_ERROR_TOO_SMALL, NO_INDEX, info.capacity = 2, hf_solver_get_sites(scene.solver, &info));
  ROW("capacity 0", HF_ERROR_TOO_SMALL, NO_INDEX, info.capacity = 0, hf_solver_get_sites(scene.solver, &info));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solve(scene.solver, NULL, 0, NULL));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_solve(scene.solver, NULL, NULL));
  ROW("stride 1", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_solve(scene.solver, floats, 1, NULL));
  ROW("stride 3", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_solve(scene.solver, floats, 3, NULL));
  ROW("stride of floats", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_solver_solve(scene.solver, OUT_ROWS(doubles, 4), NULL));
  ROW("stride of two of three channels", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_solver_solve(scene.three, OUT_ROWS(doubles, 16), NULL));
  ROW("no sites", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solve(scene.three, floats, 0, NULL));
  ROW("no sites", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_solve(scene.three, OUT(doubles), NULL));
  ROW("no sites", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_solve_at(scene.three, 1, list, points));
  ROW("no sites", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_solve_vectors(scene.three, OUT(floats), NULL, NULL));
  ROW("no sites", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_solve_vectors(scene.three, OUT(doubles), NULL, NULL));
  ROW("one channel", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0,
      hf_solver_solve_vectors(scene.solver, OUT(floats), NULL, NULL));
  ROW("one channel", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0,
      hf_solver_solve_vectors(scene.solver, OUT(doubles), NULL, NULL));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_solve_vectors(scene.three, NULL, doubles, NULL));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_solve_vectors(scene.three, NULL, doubles, NULL));
  ROW("stride 11", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_solver_solve_vectors(scene.three, OUT_ROWS(floats, 11), NULL, NULL));
  ROW("stride 23", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_solver_solve_vectors(scene.three, OUT_ROWS(doubles, 23), NULL, NULL));
  ROW("no vertex", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_solver_solve_at(scene.solver, 0, list, points));
  ROW("no list", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_solve_at(scene.solver, 2, NULL, points));
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_solver_solve_at(scene.solver, 2, list, NULL));
  ROW("vertex = vertex_count", HF_ERROR_OUT_OF_RANGE, 1, list[1] = CUT_VERTICES,
      hf_solver_solve_at(scene.solver, 2, list, points));
  ROW("vertex UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 0, list[0] = UINT32_MAX,
      hf_solver_solve_at(scene.solver, 2, list, points));
  ROW("2^31 vertices", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0,
      hf_solver_solve_at(scene.solver, 0x80000000u, list, points));
  scene_destroy(&scene);
  finish_rows("reading");
}

static void the_site_limit_of_the_desc_is_kept(void** state) {
  (void)state;
  Surface sheet = surface_sheet(4, 4);
  Options desc = options_of(&sheet);
  desc.solver.site_limit = 2;
  hf_solver solver = NULL;
  assert_ok(make(&desc, NULL, &solver));
  add_site(solver, 0, 0);
  const uint32_t list[2] = {3, 9};
  const hf_sites_desc two = sites_at(2, list, NULL), single = sites_at(1, list, NULL);
  assert_code(HF_ERROR_TOO_LARGE, hf_add_sites(solver, &two, NULL));
  assert_int_equal(hf_solver_get_site_count(solver), 1);
  assert_ok(hf_add_sites(solver, &single, NULL));
  assert_code(HF_ERROR_TOO_LARGE, hf_add_sites(solver, &single, NULL));
  hf_solver_destroy(solver);
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(adding_bad_sites_is_refused),
      cmocka_unit_test(linearly_dependent_points_are_refused),
      cmocka_unit_test(removing_moving_and_setting_bad_sites_is_refused),
      cmocka_unit_test(bad_screening_is_refused),
      cmocka_unit_test(a_batch_with_one_bad_part_changes_nothing),
      cmocka_unit_test(reading_with_bad_arguments_is_refused),
      cmocka_unit_test(the_site_limit_of_the_desc_is_kept),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
