/* hf/analysis.h from the outside: levels and iso-lines in two calls, critical points, distances, extremities, and what
 * bad input is answered. */
#include "api_support.h"

#define assert_near(a, b, tolerance) assert_true(fabs((a) - (b)) <= (tolerance))

static hf_scalars scalars_f64(const double* values) {
  hf_scalars field = HF_INIT(hf_scalars);
  field.values_f64 = values;
  return field;
}
static hf_isolines no_lines(void) {
  hf_isolines lines = HF_INIT(hf_isolines);
  return lines;
}

/* A tube of 12 x 21 vertices, 20 high, its height as the field. */
enum { AROUND = 12, RINGS = 21, COUNT = AROUND * RINGS };
typedef struct Tube {
  Surface mesh;
  hf_surface surface;
  double height[COUNT];
  hf_scalars field;
} Tube;
static void tube_create(Tube* tube) {
  tube->mesh = surface_tube(AROUND, RINGS);
  tube->surface = surface_on(&tube->mesh);
  for (uint32_t v = 0; v < COUNT; ++v) tube->height[v] = (double)tube->mesh.positions[3 * v + 1];
  tube->field = scalars_f64(tube->height);
}
static void tube_destroy(Tube* tube) {
  hf_surface_destroy(tube->surface);
  surface_free(&tube->mesh);
}

static void iso_lines_come_in_two_calls_with_points_on_edges(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  double levels[3];
  assert_ok(hf_surface_space_levels(tube.surface, &tube.field, HF_LEVELS_VALUE, 3, levels));
  for (int k = 0; k < 3; ++k) assert_near(levels[k], 5.0 * (k + 1), 1e-12);
  levels[0] = 4.25;
  hf_isolines lines = no_lines();
  assert_ok(hf_surface_trace_isolines(tube.surface, &tube.field, 3, levels, &lines));
  assert_int_equal(lines.line_count, 3);
  uint32_t* edges = calloc(lines.point_count, 2 * sizeof *edges);
  double* parameters = calloc(lines.point_count, sizeof *parameters);
  double* positions = calloc(lines.point_count, 3 * sizeof *positions);
  uint32_t starts[4], of_level[3];
  int32_t closed[3];
  lines.point_capacity = lines.point_count;
  lines.line_capacity = 3;
  lines.point_edges = edges;
  lines.parameters = parameters;
  lines.positions = positions;
  lines.line_starts = starts;
  lines.line_levels = of_level;
  lines.line_closed = closed;
  assert_ok(hf_surface_trace_isolines(tube.surface, &tube.field, 3, levels, &lines));
  assert_int_equal(starts[0], 0);
  assert_int_equal(starts[3], lines.point_count);
  for (uint32_t l = 0; l < 3; ++l) {
    assert_int_equal(of_level[l], l);
    assert_int_equal(closed[l], 1);
    assert_true(starts[l + 1] - starts[l] >= AROUND);
    for (uint32_t i = starts[l]; i < starts[l + 1]; ++i) {
      const double t = parameters[i];
      const uint32_t a = edges[2 * i], b = edges[2 * i + 1];
      assert_true(a < COUNT && b < COUNT && t >= 0 && t <= 1);
      assert_near((1 - t) * tube.height[a] + t * tube.height[b], levels[l], 1e-12);
      for (int k = 0; k < 3; ++k) {
        const double p = (1 - t) * (double)tube.mesh.positions[3 * a + (uint32_t)k] +
                         t * (double)tube.mesh.positions[3 * b + (uint32_t)k];
        assert_near(positions[3 * i + (uint32_t)k], p, 1e-6);
      }
    }
  }
  /* too small: the counts are told, the arrays are left alone */
  hf_isolines small = no_lines();
  small.point_capacity = lines.point_count - 1;
  small.parameters = parameters;
  parameters[0] = 77;
  assert_code(HF_ERROR_TOO_SMALL, hf_surface_trace_isolines(tube.surface, &tube.field, 3, levels, &small));
  assert_int_equal(small.point_count, lines.point_count);
  assert_near(parameters[0], 77, 0);
  free(edges);
  free(parameters);
  free(positions);
  tube_destroy(&tube);
}

static void levels_of_equal_area_and_length_are_even_on_a_tube(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  double squared[COUNT], levels[4];
  for (int v = 0; v < COUNT; ++v) squared[v] = tube.height[v] * tube.height[v];
  const hf_scalars field = scalars_f64(squared);
  for (int32_t spacing = HF_LEVELS_AREA; spacing <= HF_LEVELS_LENGTH; ++spacing) {
    assert_ok(hf_surface_space_levels(tube.surface, &field, spacing, 4, levels));
    for (int k = 0; k < 4; ++k) assert_near(sqrt(levels[k]), 4.0 * (k + 1), 0.05);
  }
  tube_destroy(&tube);
}

static void critical_points_sum_to_the_euler_characteristic(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  for (uint32_t v = 0; v < COUNT; ++v) tube.height[v] = sin(0.9 * v) + 0.01 * v;
  hf_critical_info info = HF_INIT(hf_critical_info);
  assert_ok(hf_surface_find_critical_points(tube.surface, &tube.field, 0, NULL, &info));
  assert_int_equal(info.euler_characteristic, 0);
  assert_int_equal(info.index_sum, 0);
  assert_int_equal(info.point_count, info.minimum_count + info.maximum_count + info.saddle_count);
  hf_critical_point points[COUNT];
  assert_code(HF_ERROR_TOO_SMALL,
              hf_surface_find_critical_points(tube.surface, &tube.field, info.point_count - 1, points, NULL));
  assert_ok(hf_surface_find_critical_points(tube.surface, &tube.field, COUNT, points, NULL));
  int32_t sum = 0;
  for (uint32_t i = 0; i < info.point_count; ++i) {
    sum += points[i].index;
    assert_int_equal(points[i].component, 0);
    assert_near(points[i].value, tube.height[points[i].vertex], 0);
  }
  assert_int_equal(sum, 0);
  tube_destroy(&tube);
}

static void distances_are_along_the_surface_and_minus_one_where_nothing_is_reached(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_surface surface = surface_on(&cut);
  hf_geodesics made[4] = {NULL, NULL, NULL, NULL};
  for (int method = 0; method < 4; ++method) {
    hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
    desc.method = method;
    assert_ok(hf_geodesics_create(surface, &desc, &made[method]));
  }
  hf_surface_destroy(surface); /* the children keep what they need */
  for (int method = 0; method < 4; ++method) {
    const hf_geodesics geodesics = made[method];
    float distance[CUT_VERTICES];
    double precise[CUT_VERTICES];
    const uint32_t sources[2] = {CUT_LEFT, CUT_LEFT};
    assert_ok(hf_geodesics_solve(geodesics, 2, sources, distance, 0));
    assert_ok(hf_geodesics_solve_f64(geodesics, 1, sources, precise, 0));
    assert_true(distance[CUT_LEFT] == 0.0f);
    assert_true(distance[CUT_SEAM_LEFT] == distance[CUT_SEAM_RIGHT]);
    assert_true(distance[CUT_ISLAND] == -1.0f && distance[CUT_ISOLATED] == -1.0f);
    assert_true(distance[CUT_RIGHT] > distance[CUT_SEAM_LEFT] && distance[CUT_SEAM_LEFT] > 2.0f);
    for (int v = 0; v < CUT_VERTICES; ++v) assert_near(precise[v], (double)distance[v], 1e-5);
    hf_geodesics_destroy(geodesics);
  }
  surface_free(&cut);
}

static void extremities_of_a_tube_are_at_its_ends(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  hf_geodesics geodesics = NULL;
  assert_ok(hf_geodesics_create(tube.surface, NULL, &geodesics));
  for (int way = 0; way < 3; ++way) {
    hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
    double field[COUNT];
    desc.kind = way > 0;
    desc.geodesics = way == 2 ? geodesics : NULL;
    desc.least_length_share = 0.1;
    desc.out_field = field;
    hf_extremity found[8];
    uint32_t count = 0;
    assert_ok(hf_surface_find_extremities(tube.surface, &desc, 8, found, &count));
    assert_int_equal(count, 2);
    assert_near(fabs(found[0].position[1] - found[1].position[1]), 20, 1e-4);
    assert_true(found[0].length >= found[1].length && found[1].length > 4 && found[0].length < 11);
    for (int k = 0; k < 2; ++k) {
      for (int v = 0; v < COUNT; ++v) assert_true(field[v] <= field[found[0].vertex] + 1e-6 * fabs(field[v]));
    }
    uint32_t again = 0;
    assert_code(HF_ERROR_TOO_SMALL, hf_surface_find_extremities(tube.surface, &desc, 1, found, &again));
    assert_int_equal(again, 2);
  }
  hf_geodesics_destroy(geodesics);
  tube_destroy(&tube);
}

static void a_cancelled_search_leaves_the_outputs_alone_and_the_next_one_runs(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  hf_progress progress = NULL;
  assert_ok(hf_progress_create(&progress));
  for (int32_t kind = 0; kind < 2; ++kind) {
    hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
    desc.kind = kind;
    desc.progress = progress;
    uint32_t count = 77;
    assert_ok(hf_progress_cancel(progress));
    assert_code(HF_ERROR_CANCELLED, hf_surface_find_extremities(tube.surface, &desc, 0, NULL, &count));
    assert_int_equal(count, 77);
    assert_ok(hf_surface_find_extremities(tube.surface, &desc, 0, NULL, &count));
    double done = 0;
    assert_ok(hf_progress_get_fraction(progress, &done));
    assert_true(done == 1);
  }
  hf_progress_destroy(progress);
  tube_destroy(&tube);
}

#define BAD(what, expected, index, call) check_row(__LINE__, what, #call, (call), expected, index)

static void a_surface_of_another_kind_gives_the_same_distances_and_tips(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  hf_surface_desc desc = options_of(&tube.mesh).surface;
  desc.field_kind = HF_FIELD_BIHARMONIC; /* no harmonic factor is made before one is asked for */
  hf_surface plate = NULL;
  assert_ok(hf_surface_create(&desc, &plate));
  const hf_surface surfaces[2] = {tube.surface, plate};
  static double distances[2][COUNT];
  hf_extremity tips[2][8];
  uint32_t counts[2];
  memset(tips, 0, sizeof tips);
  for (int i = 0; i < 2; ++i) {
    const uint32_t source = 5;
    hf_geodesics geodesics = NULL;
    assert_ok(hf_geodesics_create(surfaces[i], NULL, &geodesics));
    assert_ok(hf_geodesics_solve_f64(geodesics, 1, &source, distances[i], 0));
    assert_ok(hf_surface_find_extremities(surfaces[i], NULL, 8, tips[i], &counts[i]));
    hf_geodesics_destroy(geodesics);
  }
  assert_true(same_bits(distances[0], distances[1], sizeof distances[0]));
  assert_int_equal(counts[0], counts[1]);
  assert_true(same_bits(tips[0], tips[1], sizeof tips[0]));
  hf_surface_destroy(plate);
  tube_destroy(&tube);
}

/* A path over the tube and the map around its start: lengths agree with the distances, refused calls write nothing. */
static void paths_and_maps_agree_with_distances(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
  desc.method = HF_GEODESICS_EXACT;
  hf_geodesics geodesics = NULL;
  assert_ok(hf_geodesics_create(tube.surface, &desc, &geodesics));
  static double distance[COUNT], map[COUNT][2], positions[COUNT][3], parameters[COUNT], frame[6];
  static uint32_t edges[COUNT][2];
  const uint32_t source = 5;
  assert_ok(hf_geodesics_solve_f64(geodesics, 1, &source, distance, 0));
  hf_place from = {{5, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}};
  assert_ok(hf_geodesics_get_map(geodesics, &from, 0, &map[0][0], frame));
  assert_near(frame[0] * frame[3] + frame[1] * frame[4] + frame[2] * frame[5], 0, 1e-12);
  hf_path path = HF_INIT(hf_path);
  for (uint32_t v = 0; v < COUNT; v += 17) {
    const hf_place to = {{HF_NO_INDEX, v, HF_NO_INDEX}, 0, {0, 1, 0}};
    assert_near(hypot(map[v][0], map[v][1]), distance[v], 1e-9);
    path.point_capacity = 0;
    path.positions = NULL;
    path.parameters = NULL;
    path.point_edges = NULL;
    assert_ok(hf_geodesics_find_path(geodesics, &from, &to, &path));
    assert_near(path.length, distance[v], 1e-9);
    assert_true(path.point_count <= COUNT);
    path.point_capacity = path.point_count;
    path.positions = &positions[0][0];
    path.parameters = parameters;
    path.point_edges = &edges[0][0];
    assert_ok(hf_geodesics_find_path(geodesics, &from, &to, &path));
    double sum = 0;
    for (uint32_t i = 1; i < path.point_count; ++i) {
      double square = 0;
      for (int k = 0; k < 3; ++k) {
        const double step = positions[i][k] - positions[i - 1][k];
        square += step * step;
      }
      sum += sqrt(square);
    }
    assert_near(sum, distance[v], 1e-7);
    assert_int_equal(edges[path.point_count - 1][0], v);
  }
  /* a radius leaves out what is farther */
  assert_ok(hf_geodesics_get_map(geodesics, &from, distance[COUNT / 2] / 2, &map[0][0], NULL));
  for (int v = 0; v < COUNT; ++v) {
    assert_true((map[v][0] != map[v][0]) == (distance[v] > distance[COUNT / 2] / 2));
    map[v][0] = 7;
  }
#define BAD_POINT(what, code, at, change)                                                          \
  do {                                                                                             \
    hf_place to = {{5, 6, HF_NO_INDEX}, 0, {0.5, 0.5, 0}};                                         \
    change;                                                                                        \
    const hf_path before = path;                                                                   \
    BAD(what, code, at, hf_geodesics_find_path(geodesics, &from, &to, &path));                     \
    assert_true(memcmp(&before, &path, sizeof path) == 0);                                         \
    BAD(what, code, at == 1 ? 0 : at, hf_geodesics_get_map(geodesics, &to, 0, &map[0][0], frame)); \
    assert_true(map[3][0] == 7);                                                                   \
  } while (0)
  BAD_POINT("reserved set", HF_ERROR_INVALID_DESC, 1, to.reserved = 1);
  BAD_POINT("corner out of range", HF_ERROR_OUT_OF_RANGE, 1, to.corners[1] = COUNT);
  BAD_POINT("corner NO_INDEX", HF_ERROR_OUT_OF_RANGE, 1, to.corners[0] = HF_NO_INDEX);
  BAD_POINT("corners far apart", HF_ERROR_INVALID_ARGUMENT, 1, to.corners[1] = COUNT - 1);
  BAD_POINT("barycentric NaN", HF_ERROR_NON_FINITE, 1, to.barycentrics[0] = NAN);
  BAD_POINT("barycentric below 0", HF_ERROR_INVALID_ARGUMENT, 1, (to.barycentrics[0] = -0.5, to.barycentrics[1] = 1.5));
  BAD_POINT("sum 0.9", HF_ERROR_INVALID_ARGUMENT, 1, to.barycentrics[0] = 0.4);
#undef BAD_POINT
  BAD("radius -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_get_map(geodesics, &from, -1, &map[0][0], NULL));
  BAD("radius NaN", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_get_map(geodesics, &from, NAN, &map[0][0], NULL));
  BAD("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_get_map(geodesics, &from, 0, NULL, NULL));
  BAD("centre NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_get_map(geodesics, NULL, 0, &map[0][0], NULL));
  BAD("from NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_find_path(geodesics, NULL, &from, &path));
  BAD("path NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_find_path(geodesics, &from, &from, NULL));
  path.reserved = 1;
  BAD("reserved set", HF_ERROR_INVALID_DESC, NO_INDEX, hf_geodesics_find_path(geodesics, &from, &from, &path));
  path.reserved = 0;
  path.point_capacity = 1;
  const hf_place far_end = {{COUNT - 1, HF_NO_INDEX, HF_NO_INDEX}, 0, {1, 0, 0}};
  BAD("no room", HF_ERROR_TOO_SMALL, NO_INDEX, hf_geodesics_find_path(geodesics, &from, &far_end, &path));
  hf_geodesics_destroy(geodesics);
  tube_destroy(&tube);
}

static void bad_input_is_named(void** state) {
  (void)state;
  Tube tube;
  tube_create(&tube);
  Surface cut = surface_cut();
  hf_surface other = surface_on(&cut);
  hf_geodesics geodesics = NULL, of_other = NULL;
  assert_ok(hf_geodesics_create(tube.surface, NULL, &geodesics));
  assert_ok(hf_geodesics_create(other, NULL, &of_other));
  double levels[2] = {1, 2}, out[COUNT];
  float floats[COUNT] = {0};
  hf_isolines lines = no_lines();
  hf_critical_info info = HF_INIT(hf_critical_info);
  hf_surface s = tube.surface;

  hf_scalars f = tube.field;
  f.values = floats;
  BAD("both kinds of values", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_surface_space_levels(s, &f, 0, 2, levels));
  f.values = NULL;
  f.values_f64 = NULL;
  BAD("no values", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_trace_isolines(s, &f, 2, levels, &lines));
  f = tube.field;
  f.value_stride = 4;
  BAD("stride 4 for doubles", HF_ERROR_TOO_SMALL, NO_INDEX, hf_surface_find_critical_points(s, &f, 0, NULL, &info));
  tube.height[17] = HUGE_VAL;
  BAD("an infinite value", HF_ERROR_NON_FINITE, 17, hf_surface_space_levels(s, &tube.field, 0, 2, levels));
  BAD("an infinite value", HF_ERROR_NON_FINITE, 17, hf_surface_trace_isolines(s, &tube.field, 2, levels, &lines));
  BAD("an infinite value", HF_ERROR_NON_FINITE, 17, hf_surface_find_critical_points(s, &tube.field, 0, NULL, &info));
  for (int v = 0; v < COUNT; ++v) tube.height[v] = 3;
  BAD("a constant field", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_surface_space_levels(s, &tube.field, 1, 2, levels));
  for (int v = 0; v < COUNT; ++v) tube.height[v] = (double)NAN;
  BAD("no value at all", HF_ERROR_EMPTY, NO_INDEX, hf_surface_space_levels(s, &tube.field, 2, 2, levels));
  for (int v = 0; v < COUNT; ++v) tube.height[v] = v;

  BAD("spacing 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_surface_space_levels(s, &tube.field, 3, 2, levels));
  BAD("spacing -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_surface_space_levels(s, &tube.field, -1, 2, levels));
  BAD("no level", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_surface_space_levels(s, &tube.field, 0, 0, levels));
  BAD("2^32 - 1 levels", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
      hf_surface_space_levels(s, &tube.field, 0, UINT32_MAX, levels));
  BAD("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_space_levels(s, &tube.field, 0, 2, NULL));
  BAD("no level", HF_ERROR_EMPTY, NO_INDEX, hf_surface_trace_isolines(s, &tube.field, 0, levels, &lines));
  BAD("levels NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_trace_isolines(s, &tube.field, 2, NULL, &lines));
  levels[1] = (double)NAN;
  BAD("a level NaN", HF_ERROR_NON_FINITE, 1, hf_surface_trace_isolines(s, &tube.field, 2, levels, &lines));
  levels[1] = 2;
  lines.reserved = 1;
  BAD("reserved set", HF_ERROR_INVALID_DESC, NO_INDEX, hf_surface_trace_isolines(s, &tube.field, 2, levels, &lines));
  BAD("no output", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_find_critical_points(s, &tube.field, 0, NULL, NULL));

  hf_geodesics_desc g = HF_INIT(hf_geodesics_desc);
  hf_geodesics made = geodesics;
  g.smoothing = -1;
  BAD("smoothing -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_create(s, &g, &made));
  assert_null(made);
  g.smoothing = 20000;
  BAD("smoothing 20000", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_create(s, &g, &made));
  g.smoothing = NAN;
  BAD("smoothing NaN", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_create(s, &g, &made));
  g.smoothing = 0;
  g.method = 4;
  BAD("method 4", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_create(s, &g, &made));
  g.method = -1;
  BAD("method -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_geodesics_create(s, &g, &made));
  g.method = 0;
  BAD("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_create(s, NULL, NULL));
  uint32_t source[2] = {0, COUNT};
  BAD("no source", HF_ERROR_EMPTY, NO_INDEX, hf_geodesics_solve(geodesics, 0, source, floats, 0));
  BAD("sources NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_solve(geodesics, 1, NULL, floats, 0));
  BAD("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_geodesics_solve_f64(geodesics, 1, source, NULL, 0));
  BAD("source out of range", HF_ERROR_OUT_OF_RANGE, 1, hf_geodesics_solve_f64(geodesics, 2, source, out, 0));
  BAD("stride 3", HF_ERROR_TOO_SMALL, NO_INDEX, hf_geodesics_solve(geodesics, 1, source, floats, 3));
  BAD("too many", HF_ERROR_TOO_LARGE, NO_INDEX, hf_geodesics_solve(geodesics, UINT32_MAX, source, floats, 0));
  source[0] = CUT_ISOLATED;
  BAD("isolated", HF_ERROR_INVALID_ARGUMENT, 0, hf_geodesics_solve(of_other, 1, source, floats, 0));

  hf_extremities_desc e;
  uint32_t count = 0;
#define EXTREMITIES(what, expected, change) \
  e = HF_INIT(hf_extremities_desc), change, \
  BAD(what, expected, NO_INDEX, hf_surface_find_extremities(s, &e, 0, NULL, &count))
  EXTREMITIES("reserved set", HF_ERROR_INVALID_DESC, e.reserved = 1);
  EXTREMITIES("kind 2", HF_ERROR_INVALID_ARGUMENT, e.kind = 2);
  EXTREMITIES("least_length_share NaN", HF_ERROR_INVALID_ARGUMENT, e.least_length_share = NAN);
  EXTREMITIES("least_length_share -1", HF_ERROR_INVALID_ARGUMENT, e.least_length_share = -1);
  EXTREMITIES("least_length_share 11", HF_ERROR_INVALID_ARGUMENT, e.least_length_share = 11);
  EXTREMITIES("1001 sources", HF_ERROR_INVALID_ARGUMENT, e.source_count = 1001);
  EXTREMITIES("geodesics of another mesh", HF_ERROR_INVALID_ARGUMENT, (e.kind = 1, e.geodesics = of_other));
  BAD("no output", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_find_extremities(s, NULL, 0, NULL, NULL));

  finish_rows("analysis");
  hf_geodesics_destroy(geodesics);
  hf_geodesics_destroy(of_other);
  hf_surface_destroy(other);
  surface_free(&cut);
  tube_destroy(&tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(iso_lines_come_in_two_calls_with_points_on_edges),
      cmocka_unit_test(levels_of_equal_area_and_length_are_even_on_a_tube),
      cmocka_unit_test(critical_points_sum_to_the_euler_characteristic),
      cmocka_unit_test(distances_are_along_the_surface_and_minus_one_where_nothing_is_reached),
      cmocka_unit_test(extremities_of_a_tube_are_at_its_ends),
      cmocka_unit_test(a_cancelled_search_leaves_the_outputs_alone_and_the_next_one_runs),
      cmocka_unit_test(a_surface_of_another_kind_gives_the_same_distances_and_tips),
      cmocka_unit_test(paths_and_maps_agree_with_distances),
      cmocka_unit_test(bad_input_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
