/* Triangles that go and come, and cuts, by hf_surface_edit, against surfaces that hf_surface_create makes of the same
 * triangles. */
#include "host_mesh.h"

enum { AROUND = 12, RINGS = 18, VERTICES = AROUND * RINGS };

static Scene scene;

/* Replaces some triangles by three each, with a vertex in the middle. */
static hf_surface refined(hf_surface surface, HostMesh* host, uint32_t count, const uint32_t* list) {
  double middle[3 * 40] = {0};
  uint32_t fans[9 * 40];
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t* const v = &host->triangles[3 * list[i]];
    for (uint32_t k = 0; k < 3; ++k) {
      for (uint32_t x = 0; x < 3; ++x) middle[3 * i + x] += host->positions[3 * v[k] + x] / 3;
      fans[9 * i + 3 * k] = v[k];
      fans[9 * i + 3 * k + 1] = v[(k + 1) % 3];
      fans[9 * i + 3 * k + 2] = host->vertex_count + i;
    }
  }
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.removed_triangle_count = patch.new_vertex_count = count;
  patch.removed_triangles = list;
  patch.new_positions = middle;
  patch.new_triangle_count = 3 * count;
  patch.new_triangles = fans;
  return host_patch(host, surface, &patch);
}
/* Cuts, and takes the corners over as a host does. */
static hf_surface cut_along(hf_surface surface, HostMesh* host, uint32_t count, const uint32_t* edges) {
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.cut_edge_count = count;
  patch.cut_edges = edges;
  hf_surface out = host_patch(host, surface, &patch);
  hf_cut_corner corners[HOST_ROOM];
  uint32_t corner_count = 0, before = 0;
  assert_ok(hf_surface_get_cuts(surface, 0, NULL, &before));
  assert_ok(hf_surface_get_cuts(out, HOST_ROOM, corners, &corner_count));
  assert_true(corner_count > before);
  for (uint32_t i = before; i < corner_count; ++i) {
    const hf_cut_corner c = corners[i];
    assert_int_equal(host->triangles[3 * c.triangle + c.corner], c.copied);
    host->triangles[3 * c.triangle + c.corner] = c.vertex;
    memcpy(&host->positions[3 * c.vertex], &host->positions[3 * c.copied], 3 * sizeof *host->positions);
    if (host->vertex_count <= c.vertex) host->vertex_count = c.vertex + 1;
  }
  return out;
}
static hf_solver ramp_on(hf_surface surface) {
  hf_solver solver = solver_on(surface);
  add_site(solver, 0, 0);
  add_site(solver, VERTICES - 1, 1);
  add_site(solver, VERTICES / 2, 0.25);
  return solver;
}
/* A field counts 0 where no site reaches. */
static double apart(hf_solver a, hf_solver b, uint32_t count) {
  double *x = field_of(a, count), *y = field_of(b, count), worst = 0;
  for (uint32_t v = 0; v < count; ++v) worst = fmax(worst, fabs(x[v] - y[v]));
  free(x);
  free(y);
  return worst;
}
static uint32_t ring_edges(uint32_t ring, uint32_t count, uint32_t* edges) {
  for (uint32_t i = 0; i < count; ++i) {
    edges[2 * i] = ring * AROUND + i;
    edges[2 * i + 1] = ring * AROUND + (i + 1) % AROUND;
  }
  return count;
}
static void same_report(hf_surface edited, hf_surface fresh) {
  hf_surface_report a = HF_INIT(hf_surface_report), b = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(edited, &a));
  assert_ok(hf_surface_get_report(fresh, &b));
  assert_int_equal(a.vertex_count, b.vertex_count);
  assert_int_equal(a.component_count, b.component_count);
  assert_int_equal(a.isolated_vertex_count, b.isolated_vertex_count);
  assert_int_equal(a.boundary_edge_count, b.boundary_edge_count);
  assert_int_equal(a.inside_out_count, b.inside_out_count);
  hf_surface_info info = HF_INIT(hf_surface_info);
  assert_ok(hf_surface_get_info(edited, &info));
  assert_int_equal(info.vertex_count, a.vertex_count);
  assert_int_equal(info.triangle_count, a.triangle_count);
}

/* Refine, cut a slit, cut a ring off, refine across: a solver that moves along has the fields of fresh surfaces. */
static void a_solver_follows_patches_and_cuts(void** state) {
  (void)state;
  const int32_t kinds[] = {HF_OPERATOR_INTRINSIC_DELAUNAY, HF_OPERATOR_COTANGENT, HF_OPERATOR_CLAMPED,
                           HF_OPERATOR_UNIFORM};
  for (size_t k = 0; k < COUNT_OF(kinds); ++k) {
    static HostMesh host;
    host_take(&host, surface_tube(AROUND, RINGS));
    hf_surface surfaces[5] = {host_fresh(&host, kinds[k])};
    hf_solver solver = ramp_on(surfaces[0]);
    double* const before = field_of(solver, VERTICES);
    const uint32_t some[] = {40, 41, 42, 43, 64, 65, 66, 200}, others[] = {44, 45, 150, 90};
    uint32_t edges[2 * AROUND];
    for (int step = 1; step < 5; ++step) {
      if (step == 1) surfaces[1] = refined(surfaces[0], &host, COUNT_OF(some), some);
      if (step == 2) surfaces[2] = cut_along(surfaces[1], &host, ring_edges(4, 5, edges), edges);
      if (step == 3) surfaces[3] = cut_along(surfaces[2], &host, ring_edges(12, AROUND, edges), edges);
      if (step == 4) surfaces[4] = refined(surfaces[3], &host, COUNT_OF(others), others);
      hf_surface fresh = host_fresh(&host, kinds[k]);
      hf_solver same = ramp_on(fresh);
      assert_ok(hf_solver_move_to(solver, surfaces[step]));
      assert_true(apart(solver, same, host.vertex_count) < 1e-10);
      same_report(surfaces[step], fresh);
      hf_certificate certificate = HF_INIT(hf_certificate);
      assert_ok(hf_solver_certify(solver, &certificate));
      hf_solver copy = NULL;
      assert_ok(hf_solver_clone(solver, &copy));
      add_site(copy, host.vertex_count - 1, 2); /* at a new vertex */
      add_site(same, host.vertex_count - 1, 2);
      assert_true(apart(copy, same, host.vertex_count) < 1e-10);
      assert_ok(hf_solver_prepare_rebase(copy));
      add_site(copy, 7, 0.5);
      add_site(same, 7, 0.5);
      assert_true(apart(copy, same, host.vertex_count) < 1e-10);
      hf_solver_destroy(copy);
      hf_solver_destroy(same);
      hf_surface_destroy(fresh);
    }
    assert_ok(hf_solver_move_to(solver, surfaces[0]));
    double* const after = field_of(solver, VERTICES);
    for (uint32_t v = 0; v < VERTICES; ++v) assert_float_equal(after[v], before[v], 1e-12);
    free(before);
    free(after);
    hf_solver_destroy(solver);
    for (int i = 0; i < 5; ++i) hf_surface_destroy(surfaces[i]);
  }
}

/* Every other noun made on a patched surface is the one of a fresh surface. */
static void other_nouns_are_those_of_a_fresh_surface(void** state) {
  (void)state;
  static double a[HOST_ROOM], b[HOST_ROOM];
  static HostMesh host;
  host_take(&host, surface_tube(AROUND, RINGS));
  const uint32_t some[] = {40, 41, 42, 43, 64, 65, 66, 200};
  uint32_t edges[2 * AROUND];
  hf_surface plain = host_fresh(&host, 0), fine = refined(plain, &host, COUNT_OF(some), some),
             both = cut_along(fine, &host, ring_edges(9, 7, edges), edges), fresh = host_fresh(&host, 0);
  hf_surface surfaces[2] = {both, fresh};
  double* outs[2] = {a, b};
  const uint32_t source = 3;
  for (int32_t method = HF_GEODESICS_AUTO; method <= HF_GEODESICS_HEAT; ++method) {
    for (int i = 0; i < 2; ++i) {
      hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
      desc.method = method;
      hf_geodesics geodesics = NULL;
      assert_ok(hf_geodesics_create(surfaces[i], &desc, &geodesics));
      assert_ok(hf_geodesics_solve(geodesics, 1, &source, OUT(outs[i])));
      hf_geodesics_destroy(geodesics);
    }
    for (uint32_t v = 0; v < host.vertex_count; ++v) assert_float_equal(a[v], b[v], 1e-9);
  }
  static float posed[2][3 * HOST_ROOM];
  for (int i = 0; i < 2; ++i) {
    hf_pose pose = NULL;
    assert_ok(hf_pose_create(surfaces[i], NULL, &pose));
    uint32_t counts[2] = {AROUND, AROUND}, vertices[2 * AROUND], numbers[2];
    for (uint32_t k = 0; k < AROUND; ++k) {
      vertices[k] = k;
      vertices[AROUND + k] = VERTICES - 1 - k;
    }
    hf_handles_desc handles = HF_INIT(hf_handles_desc);
    handles.handle_count = 2;
    handles.region_counts = counts;
    handles.region_vertices = vertices;
    assert_ok(hf_pose_add_handles(pose, &handles, numbers));
    hf_transform turn;
    memset(&turn, 0, sizeof turn);
    turn.rotation[0] = sin(0.4);
    turn.rotation[3] = cos(0.4);
    turn.translation[2] = 1;
    assert_ok(hf_pose_set_transforms(pose, 1, &numbers[1], &turn));
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.positions = HF_ARRAY_OUT(posed[i], HOST_ROOM);
    desc.restart = 1;
    desc.iteration_count = 100;
    assert_ok(hf_pose_deform(pose, &desc, NULL));
    hf_pose_destroy(pose);
  }
  for (uint32_t v = 0; v < 3 * host.vertex_count; ++v) assert_float_equal(posed[0][v], posed[1][v], 1e-3);
  hf_surface gone[] = {plain, fine, both, fresh};
  for (size_t i = 0; i < COUNT_OF(gone); ++i) hf_surface_destroy(gone[i]);
}

/* Stiffness goes along, and links come in after a patch. */
static void stiffness_and_links_meet_patches(void** state) {
  (void)state;
  static HostMesh host;
  host_take(&host, surface_tube(AROUND, RINGS));
  uint32_t edges[2 * AROUND], vertices[30];
  double stiffness[30];
  for (uint32_t i = 0; i < 30; ++i) {
    vertices[i] = 5 * AROUND + i;
    stiffness[i] = 40;
  }
  hf_surface_edit_desc stroke = HF_INIT(hf_surface_edit_desc), hold = HF_INIT(hf_surface_edit_desc);
  stroke.vertex_count = 30;
  stroke.vertices = vertices;
  stroke.stiffness = stiffness;
  hf_link link;
  memset(&link, 0, sizeof link);
  link.vertex = 2;
  link.corners[0] = VERTICES - 2;
  link.corners[1] = link.corners[2] = NO_INDEX;
  link.barycentrics[0] = link.weight = 1;
  hold.link_count = 1;
  hold.links = &link;
  hf_surface plain = host_fresh(&host, 0), stiff = NULL, cut = NULL, held = NULL, again = NULL, fresh = NULL,
             soft = NULL;
  assert_ok(hf_surface_edit(plain, &stroke, &stiff));
  cut = cut_along(stiff, &host, ring_edges(9, AROUND, edges), edges);
  assert_ok(hf_surface_edit(cut, &hold, &held));
  fresh = host_fresh(&host, 0);
  assert_ok(hf_surface_edit(fresh, &stroke, &soft));
  assert_ok(hf_surface_edit(soft, &hold, &again));
  hf_solver a = ramp_on(cut), b = ramp_on(soft);
  assert_true(apart(a, b, host.vertex_count) < 1e-10);
  assert_ok(hf_solver_move_to(a, held));
  assert_ok(hf_solver_move_to(b, again));
  assert_true(apart(a, b, host.vertex_count) < 1e-10);
  hf_surface out = NULL;
  hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.cut_edge_count = ring_edges(3, 4, edges);
  patch.cut_edges = edges;
  desc.patch = &patch;
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_edit(held, &desc, &out));
  const uint32_t first = 0;
  hf_surface_edit_desc drop = HF_INIT(hf_surface_edit_desc);
  drop.removed_link_count = 1;
  drop.removed_links = &first;
  hf_surface loose = NULL;
  assert_ok(hf_surface_edit(held, &drop, &loose));
  out = cut_along(loose, &host, ring_edges(3, 4, edges), edges);
  hf_surface gone[] = {plain, stiff, cut, held, again, fresh, soft, loose, out};
  hf_solver_destroy(a);
  hf_solver_destroy(b);
  for (size_t i = 0; i < COUNT_OF(gone); ++i) hf_surface_destroy(gone[i]);
}

/* ---- bad calls ---- */

static hf_surface_edit_desc bad;
static hf_patch_desc patch;
static uint32_t removed[2], corners[6], edges[4];
static double positions[6];
static hf_surface body, out;
static void good_input(void) {
  const uint32_t first[2] = {4, 9};
  memcpy(removed, first, sizeof removed);
  const uint32_t fan[6] = {0, 1, TUBE_VERTICES, 1, 2, TUBE_VERTICES + 1};
  memcpy(corners, fan, sizeof corners);
  for (int i = 0; i < 6; ++i) positions[i] = 0.1 * i;
  bad = HF_INIT(hf_surface_edit_desc);
  patch = HF_INIT(hf_patch_desc);
  patch.removed_triangle_count = patch.new_vertex_count = patch.new_triangle_count = 2;
  patch.removed_triangles = removed;
  patch.new_positions = positions;
  patch.new_triangles = corners;
  bad.patch = &patch;
  out = NULL;
}
static void good_cut(void) {
  good_input();
  const uint32_t path[4] = {31, 32, 32, 33};
  memcpy(edges, path, sizeof edges);
  patch = HF_INIT(hf_patch_desc);
  patch.cut_edge_count = 2;
  patch.cut_edges = edges;
}
static int nothing_changed(void) { return out == NULL && solver_unchanged(&scene) && pose_unchanged(&scene); }
#define UNCHANGED nothing_changed
#define GOOD good_input
#define ADD(what, code, index, change) ROW(what, code, index, change, hf_surface_edit(body, &bad, &out))

static void bad_patches_are_refused_by_index_and_change_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  body = scene.body;
  good_input();
  hf_surface kept = NULL;
  assert_ok(hf_surface_edit(body, &bad, &kept));
  ADD("an empty patch", HF_ERROR_EMPTY, NO_INDEX, patch = HF_INIT(hf_patch_desc));
  ADD("no struct_size", HF_ERROR_INVALID_DESC, NO_INDEX, patch.struct_size = 0);
  ADD("reserved", HF_ERROR_INVALID_DESC, NO_INDEX, patch.reserved = 1);
  ADD("no removed triangles", HF_ERROR_NULL_POINTER, NO_INDEX, patch.removed_triangles = NULL);
  ADD("no positions", HF_ERROR_NULL_POINTER, NO_INDEX, patch.new_positions = NULL);
  ADD("no triangles", HF_ERROR_NULL_POINTER, NO_INDEX, patch.new_triangles = NULL);
  ADD("a triangle that is not there", HF_ERROR_OUT_OF_RANGE, 1, removed[1] = 100000);
  ADD("a triangle twice", HF_ERROR_CONFLICT, 1, removed[1] = removed[0]);
  ADD("a place not finite", HF_ERROR_NON_FINITE, 1, positions[4] = NAN);
  ADD("a place far away", HF_ERROR_TOO_LARGE, 0, positions[1] = 1e9);
  ADD("a corner that is not there", HF_ERROR_OUT_OF_RANGE, 1, corners[4] = TUBE_VERTICES + 2);
  ADD("equal corners", HF_ERROR_INVALID_ARGUMENT, 0, corners[1] = corners[0]);
  ADD("a triangle on another", HF_ERROR_CONFLICT, 0,
      memcpy(corners, &scene.tube.triangles[3 * 30], 3 * sizeof *corners));
  ADD("two new triangles on each other", HF_ERROR_CONFLICT, 0, memcpy(corners + 3, corners, 3 * sizeof *corners));
  ADD("with stiffness", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (bad.vertex_count = 2, bad.stiffness = positions));
  ADD("with links", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bad.removed_link_count = 1);
  ADD("with a cut", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (patch.cut_edge_count = 1, patch.cut_edges = corners));
  ADD("too many vertices", HF_ERROR_TOO_LARGE, NO_INDEX, patch.new_vertex_count = 0xfffffff0u);
  ADD("a cancelled edit", HF_ERROR_CANCELLED, NO_INDEX,
      (bad.progress = scene.progress, hf_progress_cancel(scene.progress)));
  uint32_t all[2 * TUBE_AROUND * TUBE_RINGS];
  for (uint32_t t = 0; t < scene.tube.triangle_count; ++t) all[t] = t;
  ADD("nothing left", HF_ERROR_EMPTY, NO_INDEX,
      (patch = HF_INIT(hf_patch_desc), patch.removed_triangle_count = scene.tube.triangle_count,
       patch.removed_triangles = all));
  body = kept;
  ADD("a triangle that went", HF_ERROR_NOT_FOUND, 0, (void)0);
  body = scene.body;
#undef GOOD
#define GOOD good_cut
  ADD("no edges", HF_ERROR_NULL_POINTER, NO_INDEX, patch.cut_edges = NULL);
  ADD("an end that is not there", HF_ERROR_OUT_OF_RANGE, 1, edges[3] = TUBE_VERTICES);
  ADD("an edge of no triangle", HF_ERROR_NOT_FOUND, 1, edges[3] = 100);
  ADD("equal ends", HF_ERROR_INVALID_ARGUMENT, 0, edges[1] = edges[0]);
  ADD("one edge inside", HF_ERROR_EMPTY, NO_INDEX, patch.cut_edge_count = 1);
  ADD("a cut with triangles", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
      (patch.removed_triangle_count = 1, patch.removed_triangles = removed));

  /* what stays behind: sites at vertices that went, screened solvers, poses */
  good_input();
  hf_solver solver = solver_on(scene.body);
  const uint32_t corner = add_site(solver, 0, 1), lone = add_site(solver, 55, 0);
  uint32_t around[16], count = 0;
  for (uint32_t t = 0; t < scene.tube.triangle_count; ++t)
    for (int k = 0; k < 3; ++k)
      if (scene.tube.triangles[3 * t + (uint32_t)k] == 55) around[count++] = t;
  patch = HF_INIT(hf_patch_desc);
  patch.removed_triangle_count = count;
  patch.removed_triangles = around;
  hf_surface holed = host_patch(NULL, scene.body, &patch);
  check_row(__LINE__, "a site went", "hf_solver_move_to", hf_solver_move_to(solver, holed), HF_ERROR_CONFLICT, lone);
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_move_to(scene.pose, holed));
  assert_true(nothing_changed());
  assert_ok(hf_remove_sites(solver, 1, &lone));
  assert_ok(hf_solver_move_to(solver, holed));
  (void)corner;
  hf_solver newer = solver_on(kept);
  const uint32_t fresh = add_site(newer, TUBE_VERTICES + 1, 1);
  check_row(__LINE__, "a site at a new vertex", "hf_solver_move_to", hf_solver_move_to(newer, scene.body),
            HF_ERROR_CONFLICT, fresh);
  hf_solver_destroy(newer);
  double strength[TUBE_VERTICES] = {1};
  hf_solver screened = solver_on(scene.body);
  assert_ok(hf_solver_set_screening(screened, strength, NULL));
  assert_code(HF_ERROR_UNSUPPORTED, hf_solver_move_to(screened, holed));
  assert_ok(hf_solver_set_screening(screened, NULL, NULL));
  assert_ok(hf_solver_move_to(screened, holed));
  size_t size = 0;
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_save(holed, HF_FIELD_HARMONIC, NULL, 0, NULL, &size));
  hf_solver_destroy(screened);
  hf_solver_destroy(solver);
  hf_surface_destroy(holed);
  hf_surface_destroy(kept);
  finish_rows("patches");
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_solver_follows_patches_and_cuts),
      cmocka_unit_test(other_nouns_are_those_of_a_fresh_surface),
      cmocka_unit_test(stiffness_and_links_meet_patches),
      cmocka_unit_test(bad_patches_are_refused_by_index_and_change_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
