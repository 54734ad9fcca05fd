/* Links that come in and go out by hf_surface_edit: a sword that is taken up and dropped. Fields and poses are compared
 * with those on a surface that hf_surface_relink makes of the same list. */
#include "bad_scene.h"

enum { AROUND = 10, RINGS = 16, BODY = AROUND * RINGS, VERTICES = 2 * BODY, HAND = BODY - 1, HILT = BODY };

static Scene scene;
static Surface armed; /* a body and a sword beside it, without links */

static int create_armed(void** state) {
  (void)state;
  Surface tube = surface_tube(AROUND, RINGS);
  armed = (Surface){VERTICES, 2 * tube.triangle_count, malloc(sizeof(float) * 3 * VERTICES),
                    malloc(24 * (size_t)tube.triangle_count)};
  assert_non_null(armed.positions);
  assert_non_null(armed.triangles);
  for (uint32_t i = 0; i < 3 * VERTICES; ++i)
    armed.positions[i] = tube.positions[i % (3 * BODY)] + (i >= 3 * BODY && i % 3 == 0 ? 2.5f : 0.0f);
  for (uint32_t i = 0; i < 6 * tube.triangle_count; ++i)
    armed.triangles[i] = tube.triangles[i % (3 * tube.triangle_count)] + (i < 3 * tube.triangle_count ? 0 : BODY);
  surface_free(&tube);
  return 0;
}
static int free_armed(void** state) {
  (void)state;
  surface_free(&armed);
  return 0;
}

/* The grip: three links from the sword to a vertex, an edge and a triangle of the body. */
static void grip(hf_link links[3]) {
  memset(links, 0, 3 * sizeof *links);
  for (uint32_t i = 0; i < 3; ++i) {
    links[i].vertex = HILT + i;
    for (int k = 0; k < 3; ++k) {
      links[i].corners[k] = (uint32_t)k <= i ? armed.triangles[3 * (20 + i) + (uint32_t)k] : NO_INDEX;
      links[i].barycentrics[k] = (uint32_t)k <= i ? 1.0 / (1 + (double)i) : 0;
    }
    links[i].weight = 1 + (double)i;
  }
}
static hf_surface edited(hf_surface surface, uint32_t added, const hf_link* links, uint32_t removed_count,
                         const uint32_t* removed) {
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  desc.link_count = added;
  desc.links = links;
  desc.removed_link_count = removed_count;
  desc.removed_links = removed;
  hf_surface out = NULL;
  assert_ok(hf_surface_edit(surface, &desc, &out));
  return out;
}
static hf_surface relinked(hf_surface surface, uint32_t count, const hf_link* links) {
  hf_links_desc list = HF_INIT(hf_links_desc);
  list.mode = HF_LINK_LIST;
  list.link_count = count;
  list.links = links;
  hf_surface out = NULL;
  assert_ok(hf_surface_relink(surface, count ? &list : NULL, NULL, &out));
  return out;
}
static uint32_t component_count(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  return report.component_count;
}
static uint32_t link_count(hf_surface surface) {
  uint32_t count = 0;
  assert_ok(hf_surface_get_links(surface, 0, NULL, &count));
  return count;
}
static hf_solver ramp_on(hf_surface surface) {
  hf_solver solver = solver_on(surface);
  add_site(solver, 0, 0);
  add_site(solver, HAND, 1);
  return solver;
}
static double worst_difference(const double* a, const double* b) {
  double worst = 0;
  for (uint32_t v = 0; v < VERTICES; ++v) worst = fmax(worst, fabs(a[v] - b[v]));
  return worst;
}
static void assert_certified(hf_solver solver) {
  hf_certificate certificate = HF_INIT(hf_certificate);
  assert_ok(hf_solver_certify(solver, &certificate));
}

static void a_solver_follows_links_that_come_and_go(void** state) {
  (void)state;
  hf_link links[3];
  grip(links);
  const uint32_t all[3] = {0, 1, 2}, last = 2;
  hf_surface plain = surface_on(&armed), held = edited(plain, 3, links, 0, NULL),
             loose = edited(held, 0, NULL, 1, &last), dropped = edited(loose, 0, NULL, 2, all),
             fresh = relinked(plain, 3, links), two = relinked(plain, 2, links);
  assert_int_equal(component_count(plain), 2);
  assert_int_equal(component_count(held), 1);
  assert_int_equal(component_count(dropped), 2);
  assert_int_equal(link_count(held), 3);
  assert_int_equal(link_count(loose), 2);
  assert_int_equal(link_count(dropped), 0);
  hf_link given[3], made[3];
  assert_ok(hf_surface_get_links(held, 3, given, NULL));
  assert_ok(hf_surface_get_links(fresh, 3, made, NULL));
  assert_memory_equal(given, made, sizeof given);

  hf_solver solver = ramp_on(plain), copy = NULL;
  double* const before = field_of(solver, VERTICES);
  assert_float_equal(before[HILT], 0, 0); /* no site reaches the sword */
  hf_surface surfaces[] = {held, loose, dropped, held, plain};
  hf_surface oracles[] = {fresh, two, plain, fresh, plain};
  for (size_t i = 0; i < COUNT_OF(surfaces); ++i) {
    assert_ok(hf_solver_move_to(solver, surfaces[i]));
    hf_solver same = ramp_on(oracles[i]);
    double *a = field_of(solver, VERTICES), *b = field_of(same, VERTICES);
    assert_true(worst_difference(a, b) < 1e-11);
    assert_certified(solver);
    assert_ok(hf_solver_clone(solver, &copy));
    add_site(copy, VERTICES - 1, 5); /* on the sword, in a component of its own or not */
    add_site(same, VERTICES - 1, 5);
    double *c = field_of(copy, VERTICES), *d = field_of(same, VERTICES);
    assert_true(worst_difference(c, d) < 1e-11);
    assert_certified(copy);
    assert_ok(hf_solver_prepare_rebase(copy));
    add_site(copy, 3, 0.25);
    add_site(same, 3, 0.25);
    free(d);
    d = field_of(same, VERTICES);
    double* e = field_of(copy, VERTICES);
    assert_true(worst_difference(e, d) < 1e-11);
    hf_solver_destroy(copy);
    hf_solver_destroy(same);
    double* const fields[] = {a, b, c, d, e};
    for (size_t k = 0; k < COUNT_OF(fields); ++k) free(fields[k]);
  }
  double* const after = field_of(solver, VERTICES);
  assert_true(same_bits(before, after, VERTICES * sizeof *before));
  free(before);
  free(after);
  hf_solver_destroy(solver);
  hf_surface gone[] = {plain, held, loose, dropped, fresh, two};
  for (size_t i = 0; i < COUNT_OF(gone); ++i) hf_surface_destroy(gone[i]);
}

/* Links and a stroke of stiffness in one edit, in two, and in the other order. Distances and transfers see links alone.
 */
static void links_and_stiffness_can_be_edited_together(void** state) {
  (void)state;
  hf_link links[3];
  grip(links);
  uint32_t vertices[40];
  double stiffness[40];
  for (uint32_t i = 0; i < 40; ++i) {
    vertices[i] = HILT - 20 + i;
    stiffness[i] = 30;
  }
  hf_surface plain = surface_on(&armed), surfaces[4];
  hf_surface_edit_desc stroke = HF_INIT(hf_surface_edit_desc), both;
  stroke.vertex_count = 40;
  stroke.vertices = vertices;
  stroke.stiffness = stiffness;
  both = stroke;
  both.link_count = 3;
  both.links = links;
  hf_surface held = edited(plain, 3, links, 0, NULL), fresh = relinked(plain, 3, links), stiff = NULL;
  assert_ok(hf_surface_edit(plain, &both, &surfaces[0]));
  assert_ok(hf_surface_edit(held, &stroke, &surfaces[1]));
  assert_ok(hf_surface_edit(plain, &stroke, &stiff));
  surfaces[2] = edited(stiff, 3, links, 0, NULL);
  assert_ok(hf_surface_edit(fresh, &stroke, &surfaces[3]));
  hf_solver oracle = ramp_on(surfaces[3]), moved = ramp_on(plain);
  double* const exact = field_of(oracle, VERTICES);
  for (int k = 0; k < 3; ++k) {
    assert_ok(hf_solver_move_to(moved, surfaces[k]));
    double* field = field_of(moved, VERTICES);
    assert_true(worst_difference(field, exact) < 1e-11);
    free(field);
  }
  /* all harmonic operators of a bi-harmonic surface */
  double* screened[2];
  for (int k = 0; k < 2; ++k) {
    hf_solver solver = ramp_on(surfaces[k ? 3 : 0]);
    double strength[VERTICES];
    for (uint32_t v = 0; v < VERTICES; ++v) strength[v] = v % 3 == 0 ? 2 : 0;
    assert_ok(hf_solver_set_screening(solver, strength, NULL));
    screened[k] = field_of(solver, VERTICES);
    assert_certified(solver);
    hf_solver_destroy(solver);
  }
  assert_true(worst_difference(screened[0], screened[1]) < 1e-11);
  free(screened[0]);
  free(screened[1]);
  free(exact);
  hf_solver_destroy(oracle);
  hf_solver_destroy(moved);
  for (int k = 0; k < 4; ++k) hf_surface_destroy(surfaces[k]);
  hf_surface_destroy(plain);
  hf_surface_destroy(held);
  hf_surface_destroy(fresh);
  hf_surface_destroy(stiff);
}

static hf_pose bent_on(hf_surface surface, uint32_t layer) {
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  uint32_t counts[2] = {2 * AROUND, 2 * AROUND}, vertices[4 * AROUND], numbers[2];
  for (uint32_t i = 0; i < 2 * AROUND; ++i) {
    vertices[i] = i;
    vertices[2 * AROUND + i] = HAND - i;
  }
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = vertices;
  handles.layer = layer;
  assert_ok(hf_pose_add_handles(pose, &handles, numbers));
  hf_transform transform;
  memset(&transform, 0, sizeof transform);
  transform.rotation[0] = sin(0.4);
  transform.rotation[3] = cos(0.4);
  transform.translation[2] = 5;
  assert_ok(hf_pose_set_transforms(pose, 1, &numbers[1], &transform));
  return pose;
}
static void deform(hf_pose pose, float* out) {
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = HF_ARRAY_OUT(out, VERTICES);
  desc.restart = 1;
  desc.iteration_count = 200;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
}

/* The sword stays where it is until a link holds it, follows while it does, and stays at rest after it is dropped. */
static void a_pose_takes_a_sword_up_and_drops_it(void** state) {
  (void)state;
  static float alone[3 * VERTICES], moved[3 * VERTICES], made[3 * VERTICES], back[3 * VERTICES];
  hf_link links[3];
  grip(links);
  hf_surface plain = surface_on(&armed), held = edited(plain, 3, links, 0, NULL), fresh = relinked(plain, 3, links);
  for (uint32_t layer = 0; layer < 2; ++layer) {
    hf_pose pose = bent_on(plain, layer), same = bent_on(fresh, layer);
    deform(pose, alone);
    for (uint32_t i = 3 * BODY; i < 3 * VERTICES; ++i) assert_float_equal(alone[i], armed.positions[i], 1e-5);
    assert_ok(hf_pose_move_to(pose, held));
    deform(pose, moved);
    deform(same, made);
    double follows = 0;
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) {
      assert_float_equal(moved[i], made[i], 2e-3);
      if (i >= 3 * BODY) follows = fmax(follows, fabs((double)moved[i] - (double)armed.positions[i]));
    }
    assert_true(follows > 0.1);
    hf_pose copy = NULL;
    assert_ok(hf_pose_clone(pose, &copy));
    assert_ok(hf_pose_move_to(pose, plain));
    deform(pose, back);
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) assert_float_equal(back[i], alone[i], 2e-3);
    deform(copy, back); /* a clone stays on its surface */
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) assert_float_equal(back[i], moved[i], 2e-3);
    assert_ok(hf_pose_move_to(copy, fresh)); /* a relinked surface has the same mesh */
    deform(copy, back);
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) assert_float_equal(back[i], made[i], 2e-3);
    hf_pose_destroy(copy);
    hf_pose_destroy(pose);
    hf_pose_destroy(same);
  }
  hf_surface_destroy(plain);
  hf_surface_destroy(held);
  hf_surface_destroy(fresh);
}

/* ---- bad calls ---- */

static hf_surface_edit_desc bad;
static hf_link links[2];
static uint32_t removed[2];
static hf_surface held, graph, out;
static void good_input(void) {
  memset(links, 0, sizeof links);
  for (uint32_t i = 0; i < 2; ++i) {
    links[i].vertex = CUT_LEFT + i;
    links[i].corners[0] = CUT_ISLAND;
    links[i].corners[1] = links[i].corners[2] = NO_INDEX;
    links[i].barycentrics[0] = links[i].weight = 1;
  }
  removed[0] = 1;
  removed[1] = 0;
  bad = HF_INIT(hf_surface_edit_desc);
  bad.link_count = 2;
  bad.links = links;
  out = NULL;
}
static void good_removal(void) {
  good_input();
  bad.link_count = 0;
  bad.removed_link_count = 2;
  bad.removed_links = removed;
}
static int nothing_changed(void) {
  return out == NULL && solver_unchanged(&scene) && pose_unchanged(&scene) && link_count(held) == 2;
}
#define UNCHANGED nothing_changed
#define GOOD good_input
#define ADD(what, code, index, change) ROW(what, code, index, change, hf_surface_edit(held, &bad, &out))

static void bad_links_are_refused_by_index_and_change_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  good_input();
  assert_ok(hf_surface_edit(scene.sheet, &bad, &held));
  ADD("vertex out of range", HF_ERROR_OUT_OF_RANGE, 1, links[1].vertex = CUT_VERTICES);
  ADD("corner out of range", HF_ERROR_OUT_OF_RANGE, 0, links[0].corners[0] = CUT_VERTICES);
  ADD("isolated vertex", HF_ERROR_INVALID_ARGUMENT, 1, links[1].vertex = CUT_ISOLATED);
  ADD("no weight", HF_ERROR_INVALID_ARGUMENT, 1, links[1].weight = 0);
  ADD("weight not finite", HF_ERROR_NON_FINITE, 0, links[0].weight = INFINITY);
  ADD("sum of barycentrics", HF_ERROR_INVALID_ARGUMENT, 0, links[0].barycentrics[0] = 0.5);
  ADD("to itself", HF_ERROR_INVALID_ARGUMENT, 1, links[1].corners[0] = links[1].vertex);
  ADD("no list", HF_ERROR_NULL_POINTER, NO_INDEX, bad.links = NULL);
  ADD("nothing to edit", HF_ERROR_EMPTY, NO_INDEX, bad.link_count = 0);
  ADD("no list of removed ones", HF_ERROR_NULL_POINTER, NO_INDEX, bad.removed_link_count = 1);
  ADD("stiffness without vertices", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
      (bad.vertex_count = 2, bad.stiffness = links[0].barycentrics));
  ADD("no stiffness", HF_ERROR_NULL_POINTER, NO_INDEX, (bad.vertex_count = 2, bad.vertices = removed));
  ADD("a cancelled edit", HF_ERROR_CANCELLED, NO_INDEX,
      (bad.progress = scene.progress, hf_progress_cancel(scene.progress)));
#undef GOOD
#define GOOD good_removal
  ADD("a link that is not there", HF_ERROR_NOT_FOUND, 1, removed[1] = 2);
  ADD("a link twice", HF_ERROR_CONFLICT, 1, removed[1] = 1);
  size_t size = 0;
  ROW("a saved factor", HF_ERROR_UNSUPPORTED, NO_INDEX, (void)0,
      hf_surface_save(held, HF_FIELD_HARMONIC, NULL, 0, NULL, &size));
#undef GOOD
#define GOOD good_input
  const uint32_t edges[] = {0, 1, 1, 2};
  const double weights[] = {1, 1};
  hf_graph_desc desc = HF_INIT(hf_graph_desc);
  desc.vertex_count = 3;
  desc.edges = HF_ARRAY(edges, 2);
  desc.weights = HF_ARRAY(weights, 2);
  assert_ok(hf_surface_create_graph(&desc, &graph));
  ROW("links of a graph", HF_ERROR_UNSUPPORTED, NO_INDEX, (void)0, hf_surface_edit(graph, &bad, &out));
  hf_surface_destroy(graph);
  hf_surface_destroy(held);
  finish_rows("links in edits");
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_solver_follows_links_that_come_and_go),
      cmocka_unit_test(links_and_stiffness_can_be_edited_together),
      cmocka_unit_test(a_pose_takes_a_sword_up_and_drops_it),
      cmocka_unit_test(bad_links_are_refused_by_index_and_change_nothing),
  };
  return cmocka_run_group_tests(tests, create_armed, free_armed);
}
