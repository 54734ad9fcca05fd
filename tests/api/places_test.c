/* One place on a surface, whatever names it: sites, pins, curves, handles, paths and maps read the same forms, and
 * refuse the same places with the same code and index. */
#include "bad_scene.h"
#include "support/place_in.h"

enum { V = 63, COUNT = TUBE_VERTICES };
static Scene scene;
static double points[9];

static void position_of(uint32_t vertex, double* out) {
  for (int k = 0; k < 3; ++k) out[k] = (double)scene.tube.positions[3 * vertex + (uint32_t)k];
}

static void position_in(const hf_place* place, double* out) {
  for (int k = 0; k < 3; ++k) {
    out[k] = 0;
    for (int c = 0; c < 3; ++c)
      out[k] += place->barycentrics[c] * (double)scene.tube.positions[3 * place->corners[c] + (uint32_t)k];
  }
}

/* What a ray hits that comes from outside the tube, along the axis's normal through a point. */
static hf_place hit_at(const double* point) {
  const double from[3] = {5 * point[0], point[1], 5 * point[2]}, to[3] = {-point[0], 0, -point[2]};
  hf_hit hit = HF_INIT(hf_hit);
  assert_ok(hf_surface_cast_ray(scene.body, from, to, NULL, &hit));
  assert_int_equal(hit.found, 1);
  return hit.place;
}

/* ---- the same place ---- */

typedef struct Form {
  const uint32_t* vertices;
  const hf_place* places;
  const double* points;
} Form;

static double* field_with(Form form) {
  hf_solver solver = solver_on(scene.body);
  add_site(solver, 0, 0);
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  const double value = 1;
  sites.site_count = 1;
  sites.vertices = form.vertices;
  sites.places = form.places;
  sites.points = form.points;
  sites.values = &value;
  assert_ok(hf_add_sites(solver, &sites, NULL));
  double* field = field_of(solver, COUNT);
  hf_solver_destroy(solver);
  return field;
}

static float* weights_with(Form form) {
  hf_weights weights = NULL;
  assert_ok(hf_weights_clone(scene.weights, &weights));
  const uint32_t joint = 2;
  const float share = 1;
  hf_pins_desc pins = HF_INIT(hf_pins_desc);
  pins.pin_count = 1;
  pins.influence_count = 1;
  pins.joints = &joint;
  pins.weights = &share;
  pins.vertices = form.vertices;
  pins.places = form.places;
  pins.points = form.points;
  assert_ok(hf_weights_set_pins(weights, &pins));
  hf_weights_out out = HF_INIT(hf_weights_out);
  float* found = calloc(4 * COUNT, sizeof(float));
  out.vertex_capacity = COUNT;
  out.weights = found;
  assert_ok(hf_weights_get(weights, &out));
  hf_weights_destroy(weights);
  return found;
}

static float* pose_with(Form form) {
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(scene.body, NULL, &pose));
  assert_ok(hf_pose_add_handle_at(pose, (const double[]){0, 0, 0}, 1.2, NULL));
  const double radius = 1.1;
  uint32_t handle = 0;
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 1;
  handles.radii = &radius;
  handles.vertices = form.vertices;
  handles.places = form.places;
  handles.points = form.points;
  assert_ok(hf_pose_add_handles(pose, &handles, &handle));
  const hf_transform moved = {{0, 0, 0, 1}, {0.5, 0, 0}};
  assert_ok(hf_pose_set_transform(pose, handle, &moved));
  float* positions = calloc(3 * COUNT, sizeof(float));
  assert_ok(hf_deform(pose, positions, NULL));
  hf_pose_destroy(pose);
  return positions;
}

static double length_to(const hf_place* place) {
  const hf_place from = {{0, NO_INDEX, NO_INDEX}, 0, {1, 0, 0}};
  hf_path path = HF_INIT(hf_path);
  assert_ok(hf_geodesics_find_path(scene.geodesics, &from, place, &path));
  return path.length;
}

static double largest_difference(const double* a, const double* b) {
  double worst = 0;
  for (int v = 0; v < COUNT; ++v) worst = fmax(worst, fabs(a[v] - b[v]));
  return worst;
}

static void a_vertex_is_the_same_in_every_form(void** state) {
  (void)state;
  scene_create(&scene);
  const uint32_t vertex = V;
  double point[3];
  position_of(V, point);
  /* beside it a corner that counts 0 and one that does not exist, and the vertex named three times */
  const hf_place alone = {{NO_INDEX, V, 5}, 0, {0, 1, 0}}, thrice = {{V, V, V}, 0, {0.25, 0.25, 0.5}};
  const Form forms[4] = {{&vertex, NULL, NULL}, {NULL, &alone, NULL}, {NULL, &thrice, NULL}, {NULL, NULL, point}};
  double* field = field_with(forms[0]);
  float *weights = weights_with(forms[0]), *posed = pose_with(forms[0]);
  for (int f = 1; f < 4; ++f) {
    double* other = field_with(forms[f]);
    float *more = weights_with(forms[f]), *moved = pose_with(forms[f]);
    assert_true(same_bits(field, other, sizeof(double) * COUNT));
    assert_true(same_bits(weights, more, sizeof(float) * 4 * COUNT));
    assert_true(same_bits(posed, moved, sizeof(float) * 3 * COUNT));
    free(other);
    free(more);
    free(moved);
  }
  assert_true(length_to(&alone) == length_to(&thrice));
  free(field);
  free(weights);
  free(posed);
  scene_destroy(&scene);
}

static void a_point_in_a_triangle_is_the_same_in_every_form(void** state) {
  (void)state;
  scene_create(&scene);
  for (uint32_t t = 0; t < scene.tube.triangle_count; t += 7) {
    const double shares[3] = {0.2, 0.3, 0.5};
    const hf_place place = place_in(scene.tube.triangles, scene.tube.triangle_count, t, shares);
    const hf_place turned = {{place.corners[2], place.corners[0], place.corners[1]}, 0, {0.5, 0.2, 0.3}};
    double point[3];
    position_in(&place, point);
    const hf_place hit = hit_at(point);
    double *field = field_with((Form){NULL, &place, NULL}), *other = field_with((Form){NULL, &turned, NULL}),
           *nearest = field_with((Form){NULL, NULL, point}), *ray = field_with((Form){NULL, &hit, NULL});
    assert_true(largest_difference(field, other) < 1e-12);
    assert_true(largest_difference(field, nearest) < 1e-6);
    assert_true(largest_difference(field, ray) < 1e-6);
    double there = 0;
    for (int k = 0; k < 3; ++k) there += shares[k] * field[place.corners[k]];
    assert_true(fabs(there - 1) < 1e-12);
    assert_true(fabs(length_to(&place) - length_to(&hit)) < 1e-6);
    free(field);
    free(other);
    free(nearest);
    free(ray);
  }
  scene_destroy(&scene);
}

static void a_curve_takes_every_form(void** state) {
  (void)state;
  scene_create(&scene);
  uint32_t ring[TUBE_AROUND];
  hf_place places[TUBE_AROUND];
  double at[3 * TUBE_AROUND];
  for (uint32_t i = 0; i < TUBE_AROUND; ++i) {
    ring[i] = 6 * TUBE_AROUND + i;
    places[i] = (hf_place){{ring[i], NO_INDEX, NO_INDEX}, 0, {1, 0, 0}};
    position_of(ring[i], at + 3 * i);
  }
  uint32_t lists[3][COUNT], counts[3];
  for (int form = 0; form < 3; ++form) {
    hf_region region = NULL;
    assert_ok(hf_region_create(scene.body, NULL, &region));
    hf_curve_desc curve = HF_INIT(hf_curve_desc);
    curve.point_count = TUBE_AROUND;
    if (form == 0) curve.vertices = ring;
    if (form == 1) curve.places = places;
    if (form == 2) curve.points = at;
    hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
    edit.curve = &curve;
    assert_ok(hf_region_edit(region, &edit));
    assert_ok(hf_region_get_vertices(region, HF_REGION_INSIDE, COUNT, lists[form], &counts[form]));
    hf_region_destroy(region);
  }
  assert_true(counts[0] > 0 && counts[1] == counts[0] && counts[2] == counts[0]);
  assert_memory_equal(lists[1], lists[0], sizeof(uint32_t) * counts[0]);
  assert_memory_equal(lists[2], lists[0], sizeof(uint32_t) * counts[0]);
  scene_destroy(&scene);
}

/* ---- the same refusals ---- */

enum { SITES, MOVES, PINS, CURVES, HANDLES, NOUNS };

static hf_result call(int noun, uint32_t count, Form form) {
  static const double values[3] = {1, 2, 3}, radii[3] = {1.5, 1.5, 1.5};
  static const uint32_t joints[3] = {0, 1, 2};
  static const float shares[3] = {1, 1, 1};
  hf_sites_desc sites = HF_INIT(hf_sites_desc);
  hf_pins_desc pins = HF_INIT(hf_pins_desc);
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  sites.site_count = pins.pin_count = curve.point_count = handles.handle_count = count;
  sites.vertices = pins.vertices = curve.vertices = handles.vertices = form.vertices;
  sites.places = pins.places = curve.places = handles.places = form.places;
  sites.points = pins.points = curve.points = handles.points = form.points;
  hf_solver solver = NULL;
  hf_pose pose = NULL;
  uint32_t numbers[3] = {0, 0, 0};
  hf_result got = HF_OK;
  switch (noun) {
    case SITES:
    case MOVES:
      solver = solver_on(scene.body);
      for (uint32_t s = 0; s < 3; ++s) numbers[s] = add_site(solver, 20 + s, s);
      if (noun == SITES) sites.values = values;
      got = noun == SITES ? hf_add_sites(solver, &sites, NULL) : hf_solver_move_sites(solver, 3, numbers, &sites);
      assert_int_equal(hf_solver_get_site_count(solver), 3);
      hf_solver_destroy(solver);
      return got;
    case PINS:
      pins.influence_count = 1;
      pins.joints = joints;
      pins.weights = shares;
      return hf_weights_set_pins(scene.weights, &pins);
    case CURVES:
      edit.curve = &curve;
      return hf_region_edit(scene.region, &edit);
    default:
      assert_ok(hf_pose_create(scene.body, NULL, &pose));
      handles.radii = radii;
      got = hf_pose_add_handles(pose, &handles, NULL);
      assert_int_equal(hf_pose_get_handle_count(pose), 0);
      hf_pose_destroy(pose);
      return got;
  }
}

static const char* const nouns[NOUNS] = {"hf_add_sites", "hf_solver_move_sites", "hf_weights_set_pins",
                                         "hf_region_edit", "hf_pose_add_handles"};

static void refused(int line, const char* what, Form form, hf_result code, uint32_t index) {
  for (int noun = 0; noun < NOUNS; ++noun) check_row(line, what, nouns[noun], call(noun, 3, form), code, index);
}

static void every_noun_refuses_the_same_places(void** state) {
  (void)state;
  scene_create(&scene);
  const uint32_t good[3] = {30, 60, 90}, beyond[3] = {30, COUNT, 90};
  hf_place places[3], one;
  for (int i = 0; i < 3; ++i) {
    places[i] = (hf_place){{good[i], NO_INDEX, NO_INDEX}, 0, {1, 0, 0}};
    position_of(good[i], points + 3 * i);
  }
#define REFUSED(what, form, code, index) refused(__LINE__, what, form, code, index)
  REFUSED("no form", ((Form){NULL, NULL, NULL}), HF_ERROR_NULL_POINTER, NO_INDEX);
  REFUSED("vertices and places", ((Form){good, places, NULL}), HF_ERROR_INVALID_ARGUMENT, NO_INDEX);
  REFUSED("vertices and points", ((Form){good, NULL, points}), HF_ERROR_INVALID_ARGUMENT, NO_INDEX);
  REFUSED("places and points", ((Form){NULL, places, points}), HF_ERROR_INVALID_ARGUMENT, NO_INDEX);
  REFUSED("a vertex beyond", ((Form){beyond, NULL, NULL}), HF_ERROR_OUT_OF_RANGE, 1);
  const hf_place sound = places[2];
#define PLACE(what, change, code)                                                                                      \
  do {                                                                                                                 \
    change;                                                                                                            \
    REFUSED(what, ((Form){NULL, places, NULL}), code, 2);                                                              \
    hf_path path = HF_INIT(hf_path);                                                                                   \
    double map[2 * COUNT];                                                                                             \
    one = places[2];                                                                                                   \
    check_row(__LINE__, what, "hf_geodesics_find_path", hf_geodesics_find_path(scene.geodesics, places, &one, &path),  \
              code, 1);                                                                                                \
    check_row(__LINE__, what, "hf_geodesics_get_map", hf_geodesics_get_map(scene.geodesics, &one, 0, map, NULL), code, \
              0);                                                                                                      \
    places[2] = sound;                                                                                                 \
  } while (0)
  PLACE("reserved set", places[2].reserved = 1, HF_ERROR_INVALID_DESC);
  PLACE("a corner beyond", places[2].corners[0] = COUNT, HF_ERROR_OUT_OF_RANGE);
  PLACE("a corner that counts is none", places[2].corners[0] = NO_INDEX, HF_ERROR_OUT_OF_RANGE);
  PLACE("a weight NaN", places[2].barycentrics[1] = (double)NAN, HF_ERROR_NON_FINITE);
  PLACE("a weight infinite", places[2].barycentrics[0] = HUGE_VAL, HF_ERROR_NON_FINITE);
  PLACE("a weight below 0", (places[2].barycentrics[0] = 1.5, places[2].barycentrics[1] = -0.5),
        HF_ERROR_INVALID_ARGUMENT);
  PLACE("weights of sum 1.001", places[2].barycentrics[0] = 1.001, HF_ERROR_INVALID_ARGUMENT);
  PLACE("weights of sum 0", places[2].barycentrics[0] = 0, HF_ERROR_INVALID_ARGUMENT);
  const double kept = points[4];
  points[4] = (double)NAN;
  REFUSED("a point NaN", ((Form){NULL, NULL, points}), HF_ERROR_NON_FINITE, 1);
  points[4] = -HUGE_VAL;
  REFUSED("a point infinite", ((Form){NULL, NULL, points}), HF_ERROR_NON_FINITE, 1);
  points[4] = 1e3;
  REFUSED("a point far away", ((Form){NULL, NULL, points}), HF_ERROR_TOO_LARGE, 1);
  points[4] = kept;
  assert_true(weights_unchanged(&scene));
  scene_destroy(&scene);
  finish_rows("places");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_vertex_is_the_same_in_every_form),
      cmocka_unit_test(a_point_in_a_triangle_is_the_same_in_every_form),
      cmocka_unit_test(a_curve_takes_every_form),
      cmocka_unit_test(every_noun_refuses_the_same_places),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
