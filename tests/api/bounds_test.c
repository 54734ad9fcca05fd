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
      float* const axes = side == 0 ? desc.source_axes : desc.target_axes;
      axes[0] = axes[4] = axes[8] = 1;
      float* const entry = wrong == 0 ? &axes[0] : &axes[6];
      const float exact = *entry;
      hf_transfer transfer = NULL;
      *entry = exact + 0.99e-3f;
      assert_ok(hf_transfer_create(surface, surface, &desc, &transfer));
      hf_transfer_destroy(transfer);
      *entry = exact + 1.01e-3f;
      assert_code(HF_ERROR_INVALID_ARGUMENT, hf_transfer_create(surface, surface, &desc, &transfer));
      assert_null(transfer);
      assert_named("within 0.001");
      assert_named(side == 0 ? "source axes" : "target axes");
    }
  }
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

/* A list of that many bones is read to its last point, which is wrong. */
static void a_mirror_takes_1048576_bones(void** state) {
  (void)state;
  enum { MOST = 1048576 };
  Surface sheet = surface_sheet(4, 4);
  hf_surface surface = surface_on(&sheet);
  double* heads = calloc(3 * ((size_t)MOST + 1), sizeof *heads);
  uint32_t* joints = calloc(sheet.vertex_count, sizeof *joints);
  float* weights = calloc(sheet.vertex_count, sizeof *weights);
  hf_weights_out out = HF_INIT(hf_weights_out);
  hf_mirror_desc desc = HF_INIT(hf_mirror_desc);
  desc.heads = heads, desc.joints = joints, desc.weights = weights, desc.influence_count = 1;
  desc.bone_count = MOST, heads[3 * ((size_t)MOST - 1)] = NAN;
  assert_code(HF_ERROR_NON_FINITE, hf_weights_mirror(surface, &desc, &out, NULL, NULL, NULL));
  assert_named("bone 1048575");
  desc.bone_count = MOST + 1;
  assert_code(HF_ERROR_TOO_LARGE, hf_weights_mirror(surface, &desc, &out, NULL, NULL, NULL));
  assert_named("bone_count is 1048577; the limit is 1048576");
  free(heads), free(joints), free(weights);
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
    *t++ = 0, *t++ = disc_vertex(1, s), *t++ = disc_vertex(1, s + 1);
    for (uint32_t r = 1; r < RINGS; ++r) {
      *t++ = disc_vertex(r, s), *t++ = disc_vertex(r + 1, s), *t++ = disc_vertex(r + 1, s + 1);
      *t++ = disc_vertex(r, s), *t++ = disc_vertex(r + 1, s + 1), *t++ = disc_vertex(r, s + 1);
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
    *p++ = 0, *p++ = disc_vertex(1, s), *p++ = disc_vertex(2, s), *p++ = disc_vertex(2, s + 1);
    *p++ = disc_vertex(2, s + 2), *p++ = disc_vertex(1, s + 2);
  }
  hf_curve_desc curve = HF_INIT(hf_curve_desc);
  hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
  edit.curve = &curve, curve.vertices = points, curve.point_count = PETAL_POINTS * MOST_PASSES;
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
  mesh.positions = positions, mesh.triangles = triangle, mesh.vertex_limit = mesh.triangle_limit = UINT32_MAX;
  hf_graph_desc graph = HF_INIT(hf_graph_desc);
  graph.edges = edge, graph.weights = &weight, graph.vertex_limit = graph.edge_limit = UINT32_MAX;
  hf_surface surface = NULL;
  for (uint32_t more = 0; more < 2; ++more) {
    const hf_result expected = more ? HF_ERROR_TOO_LARGE : HF_ERROR_OUT_OF_RANGE;
    mesh.vertex_count = MOST + more, mesh.triangle_count = 1;
    assert_code(expected, hf_surface_create(&mesh, &surface));
    assert_named(more ? "357913942 vertices; at most 357913941 are supported" : "triangle 0");
    mesh.vertex_count = 3, mesh.triangle_count = MOST + more;
    assert_code(expected, hf_surface_create(&mesh, &surface));
    assert_named(more ? "357913942 triangles; at most 357913941 are supported" : "triangle 0");
    graph.vertex_count = MOST + more, graph.edge_count = 1;
    assert_code(expected, hf_surface_create_graph(&graph, &surface));
    assert_named(more ? "357913942 vertices; at most 357913941 are supported" : "edge 0");
    graph.vertex_count = 3, graph.edge_count = MOST + more;
    assert_code(expected, hf_surface_create_graph(&graph, &surface));
    assert_named(more ? "357913942 edges; at most 357913941 are supported" : "edge 0");
    assert_null(surface);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(axes_hold_within_1e_3),
      cmocka_unit_test(a_mirror_takes_1048576_bones),
      cmocka_unit_test(a_curve_passes_a_vertex_8_times),
      cmocka_unit_test(a_surface_takes_357913941_vertices),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
