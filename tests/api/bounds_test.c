/* Bounds that the headers state are the bounds that calls apply: just inside a value is taken, just outside the call is
 * refused, and its message names the bound. */
#include "api_support.h"

/* Whether the detail of the last failure holds a text. */
static void assert_named(const char* text) {
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  if (!strstr(detail.message, text)) fail_msg("\"%s\" is missing in: %s", text, detail.message);
}

static void axes_hold_within_1e_3(void** state) {
  (void)state;
  Surface sheet = surface_sheet(4, 4);
  hf_surface surface = surface_on(&sheet);
  for (int side = 0; side < 2; ++side) {
    for (int wrong = 0; wrong < 2; ++wrong) { /* right is longer; forward is not right x up */
      hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
      double* const axes = side == 0 ? desc.source_axes : desc.target_axes;
      axes[0] = axes[4] = axes[8] = 1;
      double* const entry = wrong == 0 ? &axes[0] : &axes[6];
      const double exact = *entry;
      hf_transfer transfer = NULL;
      *entry = exact + 0.99e-3;
      assert_ok(hf_transfer_create(surface, surface, &desc, &transfer));
      hf_transfer_destroy(transfer);
      *entry = exact + 1.01e-3;
      assert_code(HF_ERROR_INVALID_ARGUMENT, hf_transfer_create(surface, surface, &desc, &transfer));
      assert_null(transfer);
      assert_named("within 0.001");
      assert_named(side == 0 ? "source axes" : "target axes");
    }
  }
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

/* A list of that many joints is read to its last point, which is wrong. */
static void a_mirror_takes_1048576_joints(void** state) {
  (void)state;
  enum { MOST = 1048576 };
  Surface sheet = surface_sheet(4, 4);
  hf_surface surface = surface_on(&sheet);
  double* heads = calloc(3 * ((size_t)MOST + 1), sizeof *heads);
  uint32_t* joints = calloc(sheet.vertex_count, sizeof *joints);
  float* weights = calloc(sheet.vertex_count, sizeof *weights);
  hf_weights_out out = HF_INIT(hf_weights_out);
  hf_weights_mirror_desc desc = HF_INIT(hf_weights_mirror_desc);
  desc.heads = heads;
  desc.joints = joints;
  desc.weights = weights;
  desc.source_influence_count = 1;
  desc.joint_count = MOST;
  heads[3 * ((size_t)MOST - 1)] = NAN;
  assert_code(HF_ERROR_NON_FINITE, hf_weights_mirror(surface, &desc, &out, NULL, NULL, NULL, NULL));
  assert_named("joint 1048575");
  desc.joint_count = MOST + 1;
  assert_code(HF_ERROR_TOO_LARGE, hf_weights_mirror(surface, &desc, &out, NULL, NULL, NULL, NULL));
  assert_named("joint_count is 1048577; the limit is 1048576");
  free(heads);
  free(joints);
  free(weights);
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

/* A disc of rings around vertex 0. Petals of a curve leave it and come back, each around one vertex. */
enum { RINGS = 4, SPOKES = 36, DISC = 1 + RINGS * SPOKES, PETAL_POINTS = 6, MOST_PASSES = 8 };

static uint32_t disc_vertex(uint32_t ring, uint32_t spoke) { return 1 + (ring - 1) * SPOKES + spoke % SPOKES; }

static hf_surface make_disc(void) {
  static float positions[3 * DISC];
  static uint32_t triangles[3 * (2 * RINGS - 1) * SPOKES];
  uint32_t* t = triangles;
  for (uint32_t s = 0; s < SPOKES; ++s) {
    const double angle = 2 * 3.14159265358979 * s / SPOKES;
    for (uint32_t r = 1; r <= RINGS; ++r) {
      positions[3 * disc_vertex(r, s)] = (float)(r * cos(angle));
      positions[3 * disc_vertex(r, s) + 1] = (float)(r * sin(angle));
    }
    *t++ = 0;
    *t++ = disc_vertex(1, s);
    *t++ = disc_vertex(1, s + 1);
    for (uint32_t r = 1; r < RINGS; ++r) {
      *t++ = disc_vertex(r, s);
      *t++ = disc_vertex(r + 1, s);
      *t++ = disc_vertex(r + 1, s + 1);
      *t++ = disc_vertex(r, s);
      *t++ = disc_vertex(r + 1, s + 1);
      *t++ = disc_vertex(r, s + 1);
    }
  }
  const Surface disc = {DISC, (2 * RINGS - 1) * SPOKES, positions, triangles};
  return surface_on(&disc);
}

static void a_curve_passes_a_vertex_8_times(void** state) {
  (void)state;
  hf_surface surface = make_disc();
  hf_region region = NULL;
  assert_ok(hf_region_create(surface, NULL, &region));
  uint32_t points[PETAL_POINTS * (MOST_PASSES + 1)], *p = points;
  for (uint32_t petal = 0; petal <= MOST_PASSES; ++petal) {
    const uint32_t s = 4 * petal;
    *p++ = 0;
    *p++ = disc_vertex(1, s);
    *p++ = disc_vertex(2, s);
    *p++ = disc_vertex(2, s + 1);
    *p++ = disc_vertex(2, s + 2);
    *p++ = disc_vertex(1, s + 2);
  }
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.curve = &curve;
  curve.vertices = points;
  curve.point_count = PETAL_POINTS * MOST_PASSES;
  assert_ok(hf_region_edit(region, &edit));
  hf_region_info info = HF_INIT(hf_region_info);
  assert_ok(hf_region_get_info(region, &info));
  assert_int_equal(info.vertex_count, MOST_PASSES); /* one in each petal */
  curve.point_count += PETAL_POINTS;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_region_edit(region, &edit));
  assert_named("passes vertex 0 more than 8 times");
  hf_region_destroy(region);
  hf_surface_destroy(surface);
}

/* The sizes are checked before arrays are read, and their first entry is wrong. So no test needs so large a mesh. */
static void a_surface_takes_357913941_vertices(void** state) {
  (void)state;
  enum { MOST = 357913941 };
  const float positions[9] = {0};
  const uint32_t triangle[3] = {UINT32_MAX, 0, 0}, edge[2] = {UINT32_MAX, 0};
  const double weight = 1;
  hf_surface_desc mesh = HF_INIT(hf_surface_desc);
  mesh.positions.data = positions;
  mesh.triangles.data = triangle;
  mesh.vertex_limit = mesh.triangle_limit = UINT32_MAX;
  hf_graph_desc graph = HF_INIT(hf_graph_desc);
  graph.edges.data = edge;
  graph.weights = HF_ARRAY(&weight, 0);
  graph.vertex_limit = graph.edge_limit = UINT32_MAX;
  hf_surface surface = NULL;
  for (uint32_t more = 0; more < 2; ++more) {
    const hf_result expected = more ? HF_ERROR_TOO_LARGE : HF_ERROR_OUT_OF_RANGE;
    mesh.positions.count = MOST + more;
    mesh.triangles.count = 1;
    assert_code(expected, hf_surface_create(&mesh, &surface));
    assert_named(more ? "357913942 vertices; at most 357913941 are supported" : "triangle 0");
    mesh.positions.count = 3;
    mesh.triangles.count = MOST + more;
    assert_code(expected, hf_surface_create(&mesh, &surface));
    assert_named(more ? "357913942 triangles; at most 357913941 are supported" : "triangle 0");
    graph.vertex_count = MOST + more;
    graph.edges.count = graph.weights.count = 1;
    assert_code(expected, hf_surface_create_graph(&graph, &surface));
    assert_named(more ? "357913942 vertices; at most 357913941 are supported" : "edge 0");
    graph.vertex_count = 3;
    graph.edges.count = graph.weights.count = MOST + more;
    assert_code(expected, hf_surface_create_graph(&graph, &surface));
    assert_named(more ? "357913942 edges; at most 357913941 are supported" : "edge 0");
    assert_null(surface);
  }
}

/* Fields and morphs are refused at the first vertex whose number does not fit, and doubles take what floats do not. */
static void numbers_that_are_no_floats_are_named(void** state) {
  (void)state;
  Surface sheet = surface_sheet(4, 4);
  hf_surface surface = surface_on(&sheet);
  hf_error_detail detail;
  float* floats = calloc(3 * sheet.vertex_count, sizeof *floats);
  double* doubles = calloc(3 * sheet.vertex_count, sizeof *doubles);
  hf_solver solver = solver_on(surface);
  add_site(solver, 3, 1e30);
  add_site(solver, 24, 1e199);
  assert_ok(hf_solver_solve(solver, OUT(doubles), NULL));
  uint32_t first = 0;
  while (doubles[first] <= 3.4028234663852886e38) ++first;
  assert_code(HF_ERROR_TOO_LARGE, hf_solve(solver, floats, 0, NULL));
  assert_named("beyond 3.40282e+38");
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, first);
  assert_code(HF_ERROR_TOO_LARGE, hf_solver_solve_preview(solver, OUT(floats), 1, NULL));
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, first);
  hf_solver_destroy(solver);
  hf_solver_desc three = HF_INIT(hf_solver_desc);
  three.channel_count = 3;
  const double vector[3] = {1e100, 1e100, 0};
  assert_ok(hf_create(surface, &three, &solver));
  assert_ok(hf_solver_add_site(solver, 7, vector, NULL));
  assert_code(HF_ERROR_TOO_LARGE, hf_solver_solve_vectors(solver, OUT(floats), NULL, NULL));
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, 0);
  assert_ok(hf_solver_solve_vectors(solver, OUT(doubles), NULL, NULL));
  hf_solver_destroy(solver);
  hf_region region;
  assert_ok(hf_region_create(surface, NULL, &region));
  const uint32_t inside[] = {12};
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.add_count = 1;
  edit.add_vertices = inside;
  assert_ok(hf_region_edit(region, &edit));
  hf_morph_desc morph = HF_INIT(hf_morph_desc);
  morph.weight = 1e60;
  morph.positions = ROWS_OUT(floats);
  assert_code(HF_ERROR_TOO_LARGE, hf_region_morph(region, &morph));
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, 12);
  morph.positions = (hf_array_out){0};
  morph.positions = ROWS_OUT(doubles);
  assert_ok(hf_region_morph(region, &morph));
  hf_region_destroy(region);
  hf_surface_destroy(surface);
  free(floats);
  free(doubles);
  surface_free(&sheet);
}

/* A mesh whose poses may leave the range of floats, or with a vertex in no triangle beyond it, is posed in doubles. The
 * refused frame leaves the pose as it was. */
static void poses_of_huge_meshes_are_doubles(void** state) {
  (void)state;
  enum { AROUND = 8, RINGS = 9, COUNT = AROUND * RINGS + 1 };
  Surface tube = surface_tube(AROUND, RINGS);
  static double positions[3 * COUNT], frame[3 * COUNT], expected[3 * COUNT];
  static float floats[3 * COUNT];
  for (int huge = 0; huge < 2; ++huge) {
    const double unit = huge ? 1e25 : 1;
    for (size_t i = 0; i < 3 * (COUNT - 1); ++i) positions[i] = unit * (double)tube.positions[i];
    for (size_t i = 3 * (COUNT - 1); i < 3 * COUNT; ++i) positions[i] = huge ? 0 : 1e39;
    hf_surface_desc desc = options_of(&tube).surface;
    desc.positions = HF_ARRAY(positions, COUNT);
    hf_surface surface;
    hf_pose pose, other;
    uint32_t handles[2];
    const hf_transform turn = {{0, 0.3, 0.1, 0.9}, {0.5 * unit, 0.2 * unit, 0}};
    assert_ok(hf_surface_create(&desc, &surface));
    pose = tube_pose(surface, AROUND, RINGS, handles);
    assert_ok(hf_pose_set_transform(pose, handles[1], &turn));
    assert_ok(hf_pose_clone(pose, &other));
    assert_code(HF_ERROR_TOO_LARGE, hf_deform(pose, floats, NULL));
    hf_error_detail detail;
    assert_ok(hf_error_get_detail(&detail));
    assert_int_equal(detail.index, huge ? HF_NO_INDEX : COUNT - 1);
    hf_deform_desc deform = HF_INIT(hf_deform_desc);
    deform.positions = ROWS_OUT(frame);
    assert_ok(hf_pose_deform(pose, &deform, NULL));
    deform.positions = ROWS_OUT(expected);
    assert_ok(hf_pose_deform(other, &deform, NULL));
    assert_true(same_bits(frame, expected, sizeof frame));
    hf_transfer transfer;
    const uint32_t ones[2] = {1, 1}, ends[2] = {0, COUNT - 2};
    assert_ok(hf_transfer_create(surface, surface, NULL, &transfer));
    add_own_pairs(transfer, ones, ends);
    hf_transfer_frame apply = HF_INIT(hf_transfer_frame);
    apply.source_positions = HF_ARRAY(expected, COUNT);
    apply.target_positions = ROWS_OUT(floats);
    assert_code(HF_ERROR_TOO_LARGE, hf_transfer_apply(transfer, &apply));
    apply.target_positions = ROWS_OUT(frame);
    assert_ok(hf_transfer_apply(transfer, &apply));
    hf_transfer_destroy(transfer);
    hf_pose_destroy(pose);
    hf_pose_destroy(other);
    hf_surface_destroy(surface);
  }
  surface_free(&tube);
}

/* A frame of the source that is finite and far away would leave the range of double in a square. */
static void frames_beyond_1e15_boxes_are_refused_in_every_mode(void** state) {
  (void)state;
  Surface sheet = surface_sheet(7, 7);
  hf_surface surface = surface_on(&sheet);
  double* source = calloc(3 * sheet.vertex_count, sizeof *source);
  double* out = calloc(3 * sheet.vertex_count, sizeof *out);
  const uint32_t ones[2] = {1, 1}, ends[2] = {0, 63};
  for (int32_t kind = TRANSFER_FIELDS; kind <= TRANSFER_STRETCH; ++kind) {
    hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
    hf_transfer transfer;
    desc.mode = mode_of(kind);
    assert_ok(create_transfer_with(kind, surface, surface, &desc, &transfer));
    add_own_pairs(transfer, ones, ends);
    const double far[] = {1e14, 1e15, -1e18, 1e60, 1e160, 1e305};
    for (size_t f = 0; f < COUNT_OF(far); ++f) {
      for (size_t i = 0; i < 3 * (size_t)sheet.vertex_count; ++i) source[i] = (double)sheet.positions[i];
      source[30] = far[f];
      hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
      frame.source_positions = HF_ARRAY(source, sheet.vertex_count);
      frame.target_positions = ROWS_OUT(out);
      const hf_result result = hf_transfer_apply(transfer, &frame);
      if (f < 2) {
        assert_int_equal(result, HF_OK);
        for (size_t i = 0; i < 3 * (size_t)sheet.vertex_count; ++i) assert_true(isfinite(out[i]));
        continue;
      }
      hf_error_detail detail;
      assert_int_equal(result, HF_ERROR_TOO_LARGE);
      assert_ok(hf_error_get_detail(&detail));
      assert_int_equal(detail.index, 10);
      if (kind == TRANSFER_STRETCH) continue;
      const uint32_t pair = 0;
      const double place[3] = {far[f], 0, 0};
      source[30] = (double)sheet.positions[30];
      frame.hold_count = 1;
      frame.hold_pairs = &pair;
      frame.hold_positions = place;
      assert_code(HF_ERROR_TOO_LARGE, hf_transfer_apply(transfer, &frame));
    }
    hf_transfer_destroy(transfer);
  }
  hf_surface_destroy(surface);
  free(source);
  free(out);
  surface_free(&sheet);
}

static void refused_handles_say_what_to_do(void** state) {
  (void)state;
  Surface tube = surface_tube(12, 20);
  hf_surface surface = surface_on(&tube);
  hf_pose pose;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  const double at[3] = {1, 4, 0}, far[3] = {1, 19000, 0};
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_add_handle_at(pose, at, -1, NULL));
  assert_named("the radius of place 0 is -1");
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_add_handle_at(pose, at, 1e-6, NULL));
  assert_named("the next vertex is 0.5");
  assert_code(HF_ERROR_TOO_LARGE, hf_pose_add_handle_at(pose, far, 1, NULL));
  assert_named("unit of the positions");
  uint32_t handle;
  assert_ok(hf_pose_add_handle_at(pose, at, 0.4, &handle)); /* a coarse mesh: one vertex of a radius that is meant */
  const double rows[16] = {0, -1, 0, 2, 1, 0, 0, 3, 0, 0, 1, 4, 0, 0, 0, 1};
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_set_matrices(pose, 1, &handle, rows));
  assert_named("is it transposed?");
  const double scaled[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_set_matrices(pose, 1, &handle, scaled));
  assert_named("scale and shear");
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

/* Half of the triangles would be empty: every second 16-bit number is the high half of an index. */
static void indices_of_another_width_are_refused(void** state) {
  (void)state;
  Surface sheet = surface_sheet(6, 6);
  hf_surface_desc desc = options_of(&sheet).surface;
  hf_surface surface = NULL;
  desc.triangles.type = HF_TYPE_UINT16;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &surface));
  assert_named("give 0 for 32 bits");
  desc.triangles.stride = 3 * sizeof(uint16_t);
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &surface));
  uint64_t* wide = calloc(3 * sheet.triangle_count, sizeof *wide);
  for (size_t i = 0; i < 3 * (size_t)sheet.triangle_count; ++i) wide[i] = sheet.triangles[i];
  desc.triangles.stride = 0;
  desc.triangles.type = HF_TYPE_PLAIN;
  desc.triangles.data = wide;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_surface_create(&desc, &surface));
  assert_named("64-bit indices");
  assert_null(surface);
  free(wide);
  surface_free(&sheet);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_that_are_no_floats_are_named),
      cmocka_unit_test(poses_of_huge_meshes_are_doubles),
      cmocka_unit_test(frames_beyond_1e15_boxes_are_refused_in_every_mode),
      cmocka_unit_test(refused_handles_say_what_to_do),
      cmocka_unit_test(indices_of_another_width_are_refused),
      cmocka_unit_test(axes_hold_within_1e_3),
      cmocka_unit_test(a_mirror_takes_1048576_joints),
      cmocka_unit_test(a_curve_passes_a_vertex_8_times),
      cmocka_unit_test(a_surface_takes_357913941_vertices),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
