/* hf_surface_edit through the ABI: stiff regions in fields and poses, what moves to an edited surface, what does not
 * see edits, and bad calls. */
#include "bad_scene.h"

enum { AROUND = 12, RINGS = 60, VERTICES = AROUND * RINGS, BELT = 25, BELT_END = 35 };

static Scene scene;
static Surface tube;

static int create_tube(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  return 0;
}
static int free_tube(void** state) {
  (void)state;
  surface_free(&tube);
  return 0;
}

static hf_surface edited(hf_surface surface, uint32_t first, uint32_t end, double stiffness) {
  uint32_t vertices[VERTICES];
  double values[VERTICES];
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  for (uint32_t v = first; v < end; ++v, ++desc.vertex_count) {
    vertices[desc.vertex_count] = v;
    values[desc.vertex_count] = stiffness;
  }
  desc.vertices = vertices;
  desc.stiffness = values;
  hf_surface out = NULL;
  assert_ok(hf_surface_edit(surface, &desc, &out));
  return out;
}
static hf_surface belted(hf_surface surface, double stiffness) {
  return edited(surface, BELT * AROUND, BELT_END * AROUND, stiffness);
}
static hf_solver ramp_on(hf_surface surface) {
  hf_solver solver = solver_on(surface);
  for (uint32_t i = 0; i < AROUND; ++i) {
    add_site(solver, i, 0);
    add_site(solver, VERTICES - 1 - i, 1);
  }
  return solver;
}

/* A field along a tube is the voltage along resistors in a row: a belt of stiffness s takes 1 / s of its drop. */
static void a_stiff_belt_has_an_almost_constant_field(void** state) {
  (void)state;
  hf_surface plain = surface_on(&tube);
  for (int k = 0; k < 3; ++k) {
    const double s = k == 0 ? 0.1 : k == 1 ? 8 : 1e4, edge = 2 * s / (1 + s);
    hf_surface surface = belted(plain, s);
    hf_solver solver = ramp_on(surface);
    double* field = field_of(solver, VERTICES);
    const int inner = BELT_END - BELT - 1, outer = RINGS - 1 - inner - 2;
    const double whole = outer + 2 / edge + inner / s;
    assert_float_equal(field[BELT * AROUND], (BELT - 1 + 1 / edge) / whole, 1e-6); /* the tube is round to floats */
    assert_float_equal(field[(BELT_END - 1) * AROUND] - field[BELT * AROUND], inner / s / whole,
                       1e-6); /* the tube is round to floats */
    hf_certificate certificate = HF_INIT(hf_certificate);
    assert_ok(hf_solver_certify(solver, &certificate));
    free(field);
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
  hf_surface_destroy(plain);
}

/* Sites that came one by one and sites that came at once differ by rounding. */
static void assert_near(const double* a, const double* b) {
  for (uint32_t v = 0; v < VERTICES; ++v) assert_float_equal(a[v], b[v], 1e-12);
}

static void a_solver_that_moved_has_the_field_of_a_new_one_and_comes_back(void** state) {
  (void)state;
  hf_surface plain = surface_on(&tube), stiff = belted(plain, 30), stiffer = edited(stiff, 0, 5 * AROUND, 4),
             back = belted(edited(stiffer, 0, 5 * AROUND, 1), 1);
  hf_solver solver = ramp_on(plain), fresh = ramp_on(stiffer), copy = NULL;
  assert_ok(hf_solver_clone(solver, &copy));
  double *before = field_of(solver, VERTICES), *expected = field_of(fresh, VERTICES);
  assert_ok(hf_solver_move_to(solver, stiff));
  assert_ok(hf_solver_move_to(solver, stiffer));
  double* there = field_of(solver, VERTICES);
  assert_near(there, expected);
  double* clone = field_of(copy, VERTICES); /* the copy stays */
  assert_true(same_bits(clone, before, sizeof(double) * VERTICES));
  hf_surface_destroy(stiff);
  hf_surface_destroy(plain);
  assert_ok(hf_solver_move_to(solver, back));
  double* returned = field_of(solver, VERTICES);
  assert_near(returned, before);
  uint32_t site = 5;
  assert_ok(hf_remove_sites(solver, 1, &site)); /* numbers are kept */
  free(before);
  free(expected);
  free(there);
  free(clone);
  free(returned);
  hf_solver_destroy(solver);
  hf_solver_destroy(fresh);
  hf_solver_destroy(copy);
  hf_surface_destroy(stiffer);
  hf_surface_destroy(back);
}

/* How much the edges of the belt change their length, at most. */
static double stretch_of(const float* posed) {
  double worst = 0;
  for (uint32_t v = BELT * AROUND; v < (BELT_END - 1) * AROUND; ++v) {
    double rest = 0, now = 0;
    for (int c = 0; c < 3; ++c) {
      const double a = (double)tube.positions[3 * (v + AROUND) + (uint32_t)c] -
                       (double)tube.positions[3 * v + (uint32_t)c],
                   b = (double)posed[3 * (v + AROUND) + (uint32_t)c] - (double)posed[3 * v + (uint32_t)c];
      rest += a * a;
      now += b * b;
    }
    worst = fmax(worst, fabs(sqrt(now / rest) - 1));
  }
  return worst;
}
static void deform(hf_pose pose, float* out) {
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = HF_ARRAY_OUT(out, VERTICES);
  desc.restart = 1;
  desc.iteration_count = 200;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
}
static hf_pose bent_on(hf_surface surface, uint32_t layer) {
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  uint32_t counts[2] = {2 * AROUND, 2 * AROUND}, vertices[4 * AROUND], numbers[2];
  for (uint32_t i = 0; i < 2 * AROUND; ++i) {
    vertices[i] = i;
    vertices[2 * AROUND + i] = VERTICES - 1 - i;
  }
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = vertices;
  handles.layer = layer;
  assert_ok(hf_pose_add_handles(pose, &handles, numbers));
  hf_transform transform;
  memset(&transform, 0, sizeof transform);
  transform.rotation[0] = sin(0.6);
  transform.rotation[3] = cos(0.6);
  transform.translation[2] = 18;
  transform.translation[1] = -14;
  assert_ok(hf_pose_set_transforms(pose, 1, &numbers[1], &transform));
  return pose;
}

static void a_stiff_belt_keeps_its_lengths_in_a_pose(void** state) {
  (void)state;
  static float plain_out[3 * VERTICES], moved[3 * VERTICES], made[3 * VERTICES], back[3 * VERTICES];
  hf_surface plain = surface_on(&tube), stiff = belted(plain, 1e4);
  for (uint32_t layer = 0; layer < 2; ++layer) {
    hf_pose pose = bent_on(plain, layer), fresh = bent_on(stiff, layer);
    deform(pose, plain_out);
    assert_ok(hf_pose_move_to(pose, stiff));
    deform(pose, moved);
    deform(fresh, made);
    for (size_t i = 0; i < COUNT_OF(made); ++i) assert_float_equal(moved[i], made[i], 2e-3);
    assert_true(stretch_of(moved) < 0.1 * stretch_of(plain_out));
    assert_ok(hf_pose_move_to(pose, plain));
    deform(pose, back);
    for (size_t i = 0; i < COUNT_OF(made); ++i) assert_float_equal(back[i], plain_out[i], 2e-3);
    hf_pose_destroy(pose);
    hf_pose_destroy(fresh);
  }
  hf_surface_destroy(plain);
  hf_surface_destroy(stiff);
}

/* Distances, links and the factor's statistics are those of the mesh; a relinked surface keeps its stiffness. */
static void lengths_do_not_see_stiffness_and_links_keep_it(void** state) {
  (void)state;
  hf_surface plain = surface_on(&tube), stiff = belted(plain, 50), linked = NULL;
  double distances[2][VERTICES], stiffness[VERTICES];
  hf_surface both[2] = {plain, stiff};
  for (int k = 0; k < 2; ++k) {
    hf_geodesics geodesics = NULL;
    assert_ok(hf_geodesics_create(both[k], NULL, &geodesics));
    const uint32_t source = 3;
    const hf_array_out rows = HF_ARRAY_OUT(distances[k], VERTICES);
    assert_ok(hf_geodesics_solve(geodesics, 1, &source, &rows));
    hf_geodesics_destroy(geodesics);
  }
  assert_true(same_bits(distances[0], distances[1], sizeof distances[0]));
  assert_ok(hf_surface_relink(stiff, NULL, NULL, &linked));
  uint32_t count = 0;
  assert_ok(hf_surface_get_stiffness(linked, VERTICES, stiffness, &count));
  assert_int_equal(count, VERTICES);
  for (uint32_t v = 0; v < VERTICES; ++v)
    assert_true(stiffness[v] == (v >= BELT * AROUND && v < BELT_END * AROUND ? 50 : 1));
  hf_surface_destroy(plain);
  hf_surface_destroy(stiff);
  hf_surface_destroy(linked);
}

/* A tube of two pieces that links hold together, and a vertex of no triangle. An edit of the linked surface and the
 * links of the edited surface give one field; a stroke goes over the links. */
static void edits_and_links_can_be_made_in_any_order(void** state) {
  (void)state;
  enum { CUT = BELT + 4, STRAY = VERTICES };
  Surface pieces = {VERTICES + 1, 0, malloc(sizeof(float) * 3 * (VERTICES + 1)), malloc(12 * tube.triangle_count)};
  assert_non_null(pieces.positions);
  assert_non_null(pieces.triangles);
  memcpy(pieces.positions, tube.positions, sizeof(float) * 3 * VERTICES);
  for (int k = 0; k < 3; ++k) pieces.positions[3 * STRAY + k] = 100.0f + (float)k;
  for (uint32_t t = 0; t < tube.triangle_count; ++t) {
    const uint32_t* const corner = tube.triangles + 3 * t;
    int below = 0;
    for (int k = 0; k < 3; ++k) below += corner[k] < CUT * AROUND;
    if (below == 0 || below == 3) memcpy(pieces.triangles + 3 * pieces.triangle_count++, corner, 12);
  }
  hf_link links[AROUND];
  memset(links, 0, sizeof links);
  for (uint32_t i = 0; i < AROUND; ++i) {
    links[i].vertex = (CUT - 1) * AROUND + i;
    links[i].corners[0] = CUT * AROUND + i;
    links[i].corners[1] = links[i].corners[2] = NO_INDEX;
    links[i].barycentrics[0] = links[i].weight = 1;
  }
  hf_links_desc list = HF_INIT(hf_links_desc);
  list.mode = HF_LINK_LIST;
  list.link_count = AROUND;
  list.links = links;
  hf_surface plain = surface_on(&pieces), stiff = belted(plain, 50), linked = NULL, surfaces[2];
  assert_ok(hf_surface_relink(plain, &list, NULL, &linked));
  surfaces[0] = belted(linked, 50);
  assert_ok(hf_surface_relink(stiff, &list, NULL, &surfaces[1]));
  double* fields[3];
  for (int k = 0; k < 3; ++k) {
    hf_solver solver = solver_on(k < 2 ? surfaces[k] : linked);
    add_site(solver, 0, 0);
    add_site(solver, VERTICES - 1, 1);
    fields[k] = field_of(solver, VERTICES + 1);
    hf_solver_destroy(solver);
  }
  assert_near(fields[0], fields[1]);
  assert_float_equal(fields[0][STRAY], fields[2][STRAY], 0);
  double softer = 0; /* the links and the belt around them give way less than before */
  for (uint32_t i = 0; i < AROUND; ++i) {
    const uint32_t a = (CUT - 1) * AROUND + i;
    softer += fields[2][a + AROUND] - fields[2][a] - 5 * (fields[0][a + AROUND] - fields[0][a]);
  }
  assert_true(softer > 0);
  for (int k = 0; k < 3; ++k) free(fields[k]);
  for (int k = 0; k < 2; ++k) hf_surface_destroy(surfaces[k]);
  hf_surface_destroy(plain);
  hf_surface_destroy(stiff);
  hf_surface_destroy(linked);
  surface_free(&pieces);
}

/* Harmonic operators of a bi-harmonic surface are edits too: a strip of eight digits, whose matrix alone has no factor.
 */
static void an_edited_biharmonic_surface_has_harmonic_fields(void** state) {
  (void)state;
  Surface strip = surface_sheet(120, 1);
  for (uint32_t v = 0; v < strip.vertex_count; ++v) strip.positions[3 * v + 2] = 0;
  hf_surface plain[2], edited[2];
  double* fields[2];
  double* mixed = malloc(sizeof(double) * strip.vertex_count);
  assert_non_null(mixed);
  uint32_t random = 39596; /* soft parts lie between stiff ones, so that pivots lose their digits */
  for (uint32_t v = 0; v < strip.vertex_count; ++v) {
    random = random * 1664525u + 1013904223u;
    mixed[v] = random >> 31 ? 1e4 : 1e-4;
  }
  for (int k = 0; k < 2; ++k) {
    Options options = options_of(&strip);
    options.surface.field_kind = k ? HF_FIELD_BIHARMONIC : HF_FIELD_HARMONIC;
    assert_ok(hf_surface_create(&options.surface, &plain[k]));
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.vertex_count = strip.vertex_count;
    desc.stiffness = mixed;
    assert_ok(hf_surface_edit(plain[k], &desc, &edited[k]));
    hf_solver solver = NULL;
    hf_solver_desc harmonic = HF_INIT(hf_solver_desc);
    harmonic.field_kind = HF_FIELD_HARMONIC;
    assert_ok(hf_create(edited[k], &harmonic, &solver));
    add_site(solver, 0, 0);
    add_site(solver, strip.vertex_count - 1, 1);
    fields[k] = field_of(solver, strip.vertex_count);
    hf_solver_destroy(solver);
  }
  assert_true(same_bits(fields[0], fields[1], sizeof(double) * strip.vertex_count));
  for (int k = 0; k < 2; ++k) {
    free(fields[k]);
    hf_surface_destroy(plain[k]);
    hf_surface_destroy(edited[k]);
  }
  free(mixed);
  surface_free(&strip);
}

/* Two edges of 1 hold one of -0.4, until their common end is soft. Vertices 0 to 3 have no edge. */
static void an_edit_that_negative_weights_outweigh_names_a_vertex(void** state) {
  (void)state;
  uint32_t edges[6] = {4, 5, 5, 6, 4, 6};
  double weights[3] = {1, 1, -0.4};
  hf_graph_desc desc = HF_INIT(hf_graph_desc);
  desc.vertex_count = 7;
  desc.edges = HF_ARRAY(edges, 3);
  desc.weights = HF_ARRAY(weights, 3);
  desc.allow_negative = 1;
  hf_surface graph = NULL, soft = NULL;
  assert_ok(hf_surface_create_graph(&desc, &graph));
  const uint32_t middle = 5;
  const double stiffness = 0.1;
  hf_surface_edit_desc edit = HF_INIT(hf_surface_edit_desc);
  edit.vertex_count = 1;
  edit.vertices = &middle;
  edit.stiffness = &stiffness;
  assert_code(HF_ERROR_NOT_POSITIVE_DEFINITE, hf_surface_edit(graph, &edit, &soft));
  assert_null(soft);
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  assert_true(detail.index >= 4 && detail.index <= 6);
  hf_surface_destroy(graph);
}

/* ---- bad calls ---- */

static hf_surface_edit_desc bad;
static uint32_t vertices[3], count;
static double stiffness[3], out_stiffness[CUT_VERTICES];
static hf_surface out;
static void good_input(void) {
  vertices[0] = CUT_LEFT;
  vertices[1] = CUT_SEAM_LEFT;
  vertices[2] = CUT_ISOLATED;
  stiffness[0] = stiffness[1] = stiffness[2] = 2;
  bad = HF_INIT(hf_surface_edit_desc);
  bad.vertex_count = 3;
  bad.vertices = vertices;
  bad.stiffness = stiffness;
  out = NULL;
}
static int nothing_changed(void) { return out == NULL && solver_unchanged(&scene) && pose_unchanged(&scene); }
#define GOOD good_input
#define UNCHANGED nothing_changed
#define EDIT(what, code, index, change) ROW(what, code, index, change, hf_surface_edit(scene.sheet, &bad, &out))

static void bad_edits_are_refused_by_index_and_change_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  good_input();
  assert_ok(hf_surface_edit(scene.sheet, &bad, &out));
  hf_surface stiff = out, others = NULL;
  good_input();
  EDIT("vertex out of range", HF_ERROR_OUT_OF_RANGE, 1, vertices[1] = CUT_VERTICES);
  EDIT("stiffness not finite", HF_ERROR_NON_FINITE, 2, stiffness[2] = NAN);
  EDIT("stiffness 0", HF_ERROR_INVALID_ARGUMENT, 0, stiffness[0] = 0);
  EDIT("stiffness below 0", HF_ERROR_INVALID_ARGUMENT, 0, stiffness[0] = -1);
  EDIT("stiffness too large", HF_ERROR_INVALID_ARGUMENT, 1, stiffness[1] = 2e4);
  EDIT("a vertex twice", HF_ERROR_CONFLICT, 1, (vertices[1] = CUT_LEFT, stiffness[1] = 3));
  EDIT("a welded copy", HF_ERROR_CONFLICT, 2, (vertices[2] = CUT_SEAM_RIGHT, stiffness[2] = 3));
  EDIT("no stiffness", HF_ERROR_NULL_POINTER, NO_INDEX, bad.stiffness = NULL);
  EDIT("no vertex", HF_ERROR_EMPTY, NO_INDEX, bad.vertex_count = 0);
  EDIT("all vertices, but three", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bad.vertices = NULL);
  ROW("short list", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_surface_get_stiffness(scene.sheet, 3, out_stiffness, NULL));
  ROW("no list", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_surface_get_stiffness(scene.sheet, 0, NULL, NULL));
  ROW("solver on another mesh", HF_ERROR_CONFLICT, NO_INDEX, (void)0, hf_solver_move_to(scene.solver, scene.body));
  ROW("pose on another mesh", HF_ERROR_CONFLICT, NO_INDEX, (void)0, hf_pose_move_to(scene.pose, stiff));
  ROW("to nothing", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_solver_move_to(scene.solver, scene.stale_surface));
  assert_ok(hf_surface_relink(scene.sheet, NULL, NULL, &others));
  hf_solver peer = NULL;
  assert_ok(hf_peer_refactor_create(scene.sheet, NULL, &peer));
  ROW("a baseline", HF_ERROR_UNSUPPORTED, NO_INDEX, (void)0, hf_solver_move_to(peer, stiff));
  size_t size = 0;
  ROW("a saved factor", HF_ERROR_UNSUPPORTED, NO_INDEX, (void)0,
      hf_surface_save(stiff, HF_FIELD_HARMONIC, NULL, 0, NULL, &size));
  ROW("a cancelled edit", HF_ERROR_CANCELLED, NO_INDEX,
      (bad.progress = scene.progress, hf_progress_cancel(scene.progress)), hf_surface_edit(scene.sheet, &bad, &out));
  assert_ok(hf_surface_get_stiffness(stiff, CUT_VERTICES, out_stiffness, &count));
  assert_true(out_stiffness[CUT_LEFT] == 2 && out_stiffness[CUT_SEAM_RIGHT] == 2 && out_stiffness[CUT_ISOLATED] == 1);
  hf_solver_destroy(peer);
  hf_surface_destroy(stiff);
  hf_surface_destroy(others);
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_stiff_belt_has_an_almost_constant_field),
      cmocka_unit_test(a_solver_that_moved_has_the_field_of_a_new_one_and_comes_back),
      cmocka_unit_test(a_stiff_belt_keeps_its_lengths_in_a_pose),
      cmocka_unit_test(lengths_do_not_see_stiffness_and_links_keep_it),
      cmocka_unit_test(edits_and_links_can_be_made_in_any_order),
      cmocka_unit_test(an_edited_biharmonic_surface_has_harmonic_fields),
      cmocka_unit_test(an_edit_that_negative_weights_outweigh_names_a_vertex),
      cmocka_unit_test(bad_edits_are_refused_by_index_and_change_nothing),
  };
  return cmocka_run_group_tests(tests, create_tube, free_tube);
}
