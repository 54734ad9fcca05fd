/* Patches and cuts of hf_surface_edit that were faulty once: the smallest input of each. */
#include "host_mesh.h"

enum { AROUND = 12, RINGS = 18, VERTICES = AROUND * RINGS, MOST_VERTICES = VERTICES + 40 };

typedef struct Model {
  HostMesh mesh;
  hf_surface surface;
} Model;

static void start(Model* model, int32_t operator_kind) {
  host_take(&model->mesh, surface_tube(AROUND, RINGS));
  model->surface = host_fresh(&model->mesh, operator_kind);
}
/* Patches the surface and the mesh alike. */
static void change(Model* model, uint32_t gone_count, const uint32_t* gone, uint32_t vertex_count,
                   const double* positions, uint32_t triangle_count, const uint32_t* triangles) {
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.removed_triangle_count = gone_count;
  patch.removed_triangles = gone;
  patch.new_vertex_count = vertex_count;
  patch.new_positions = positions;
  patch.new_triangle_count = triangle_count;
  patch.new_triangles = triangles;
  const hf_surface edited = host_patch(&model->mesh, model->surface, &patch);
  hf_surface_destroy(model->surface);
  model->surface = edited;
}
/* The triangles at a vertex, and the same with another vertex in its place. */
static uint32_t fan_of(const Model* model, uint32_t vertex, uint32_t other, uint32_t* list, uint32_t* corners) {
  uint32_t count = 0;
  for (uint32_t t = 0; t < model->mesh.triangle_count; ++t) {
    const uint32_t* const v = &model->mesh.triangles[3 * t];
    if (v[0] != vertex && v[1] != vertex && v[2] != vertex) continue;
    for (uint32_t k = 0; k < 3; ++k) corners[3 * count + k] = v[k] == vertex ? other : v[k];
    list[count++] = t;
  }
  return count;
}
/* The largest difference from a field of a fresh surface. */
static double difference(const Model* model, int32_t operator_kind) {
  hf_surface surfaces[2] = {model->surface, host_fresh(&model->mesh, operator_kind)};
  double* fields[2];
  for (int i = 0; i < 2; ++i) {
    hf_solver solver = solver_on(surfaces[i]);
    add_site(solver, 0, 0);
    add_site(solver, VERTICES - 2, 1);
    add_site(solver, VERTICES / 2, 0.25);
    fields[i] = field_of(solver, model->mesh.vertex_count);
    hf_solver_destroy(solver);
  }
  double worst = 0;
  for (uint32_t v = 0; v < model->mesh.vertex_count; ++v) worst = fmax(worst, fabs(fields[0][v] - fields[1][v]));
  free(fields[0]);
  free(fields[1]);
  hf_surface_destroy(surfaces[1]);
  return worst;
}

/* A vertex that comes again in the place of a lower one, and then a vertex that goes: numbers inside close up, and do
 * not ascend. */
static void a_vertex_comes_again_before_others_go(void** state) {
  (void)state;
  static Model model;
  start(&model, 0);
  uint32_t list[16], corners[48];
  uint32_t count = fan_of(&model, 9, VERTICES, list, corners);
  const double nearby[3] = {model.mesh.positions[27] * 1.01, model.mesh.positions[28], model.mesh.positions[29] * 1.01};
  change(&model, count, list, 1, nearby, count, corners);
  count = fan_of(&model, 3, 9, list, corners);
  change(&model, count, list, 0, NULL, count, corners);
  assert_true(difference(&model, 0) < 1e-11);
  count = fan_of(&model, 6, 0, list, corners);
  change(&model, count, list, 0, NULL, 0, NULL);
  assert_true(difference(&model, 0) < 1e-11);
  hf_surface_destroy(model.surface);
}

/* Needles of new vertices at one place: hf_surface_create takes them, so an edit does. */
static void needles_come_in(void** state) {
  (void)state;
  const int32_t kinds[] = {HF_OPERATOR_INTRINSIC_DELAUNAY, HF_OPERATOR_COTANGENT, HF_OPERATOR_CLAMPED,
                           HF_OPERATOR_UNIFORM};
  const double widths[] = {0, 1e-12, 1e-7};
  for (size_t k = 0; k < COUNT_OF(kinds); ++k) {
    for (size_t w = 0; w < COUNT_OF(widths); ++w) {
      static Model model;
      start(&model, kinds[k]);
      const uint32_t needle[3] = {0, VERTICES, VERTICES + 1};
      const double far[6] = {4, -4, 4, 4, -4, 4 + widths[w]};
      change(&model, 0, NULL, 2, far, 1, needle);
      assert_true(difference(&model, kinds[k]) < 1e-7);
      hf_surface_destroy(model.surface);
    }
  }
}

/* The report follows new and removed triangles. */
static void reports_are_those_of_a_fresh_surface(void** state) {
  (void)state;
  for (int step = 0; step < 2; ++step) {
    static Model model;
    start(&model, HF_OPERATOR_CLAMPED);
    const uint32_t flap[3] = {0, 1, VERTICES};
    const double far[3] = {4, 0, 0}, middle[3] = {0.5 * (model.mesh.positions[0] + model.mesh.positions[3]),
                                                  0.5 * (model.mesh.positions[1] + model.mesh.positions[4]),
                                                  0.5 * (model.mesh.positions[2] + model.mesh.positions[5])};
    change(&model, 0, NULL, 1, step == 0 ? far : middle, 1, flap); /* outside the box; a sliver */
    hf_surface fresh = host_fresh(&model.mesh, HF_OPERATOR_CLAMPED);
    hf_surface_report a = HF_INIT(hf_surface_report), b = HF_INIT(hf_surface_report);
    assert_ok(hf_surface_get_report(model.surface, &a));
    assert_ok(hf_surface_get_report(fresh, &b));
    assert_float_equal(a.bounding_box_diagonal, b.bounding_box_diagonal, 1e-12);
    assert_int_equal(a.degenerate_triangle_count, b.degenerate_triangle_count);
    hf_mesh_statistics c = HF_INIT(hf_mesh_statistics), d = HF_INIT(hf_mesh_statistics);
    assert_ok(hf_surface_get_mesh_statistics(model.surface, &c));
    assert_ok(hf_surface_get_mesh_statistics(fresh, &d));
    assert_int_equal(c.changed_vertex_count, d.changed_vertex_count);
    assert_int_equal(c.changed_vertex_count, step == 0 ? 0 : 3);
    hf_surface_destroy(fresh);
    hf_surface_destroy(model.surface);
  }
}

/* Both sides of a cut through a stiff part stay stiff. */
static void copies_have_the_stiffness_of_what_they_copy(void** state) {
  (void)state;
  static Model model;
  start(&model, 0);
  static double stiffness[MOST_VERTICES];
  for (uint32_t v = 0; v < VERTICES; ++v) stiffness[v] = v / AROUND == 9 ? 40 : 1;
  hf_surface_edit_desc stroke = HF_INIT(hf_surface_edit_desc), knife = HF_INIT(hf_surface_edit_desc);
  stroke.vertex_count = VERTICES;
  stroke.stiffness = stiffness;
  uint32_t edges[2 * AROUND], count = 0;
  for (uint32_t i = 0; i < AROUND; ++i) {
    edges[2 * i] = 9 * AROUND + i;
    edges[2 * i + 1] = 9 * AROUND + (i + 1) % AROUND;
  }
  hf_patch_desc cut = HF_INIT(hf_patch_desc);
  cut.cut_edge_count = AROUND;
  cut.cut_edges = edges;
  knife.patch = &cut;
  hf_surface stiff = NULL, open = NULL;
  assert_ok(hf_surface_edit(model.surface, &stroke, &stiff));
  assert_ok(hf_surface_edit(stiff, &knife, &open));
  assert_ok(hf_surface_get_stiffness(open, MOST_VERTICES, stiffness, &count));
  assert_int_equal(count, VERTICES + AROUND);
  for (uint32_t v = VERTICES; v < count; ++v) assert_true(stiffness[v] == 40);
  hf_surface gone[] = {model.surface, stiff, open};
  for (size_t i = 0; i < COUNT_OF(gone); ++i) hf_surface_destroy(gone[i]);
}

/* Without a triangle_limit a patch brings in at most eight triangles per vertex of the vertex_limit, as a mesh. */
static void new_triangles_count_for_the_vertex_limit(void** state) {
  (void)state;
  static double positions[3 * 20];
  static uint32_t fans[3 * 170], count = 0;
  for (uint32_t i = 0; i < COUNT_OF(positions); ++i) positions[i] = sin(7.0 * i);
  for (uint32_t a = 0; a < 20; ++a)
    for (uint32_t b = a + 1; b < 20; ++b)
      for (uint32_t c = b + 1; c < 20 && count < 170; ++c, ++count) {
        fans[3 * count] = a;
        fans[3 * count + 1] = b;
        fans[3 * count + 2] = c;
      }
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions, 20);
  desc.triangles = HF_ARRAY(fans, count);
  desc.vertex_limit = 20;
  hf_surface surface = NULL, out = NULL;
  assert_code(HF_ERROR_TOO_LARGE, hf_surface_create(&desc, &surface));
  desc.triangles.count = 100;
  assert_ok(hf_surface_create(&desc, &surface));
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.new_triangle_count = count - 100;
  patch.new_triangles = &fans[300];
  hf_surface_edit_desc edit = HF_INIT(hf_surface_edit_desc);
  edit.patch = &patch;
  assert_code(HF_ERROR_TOO_LARGE, hf_surface_edit(surface, &edit, &out));
  assert_null(out);
  patch.new_triangle_count = 60;
  assert_ok(hf_surface_edit(surface, &edit, &out));
  hf_surface_destroy(out);
  hf_surface_destroy(surface);
}

/* A cut at a triangle that lies on another one names the triangle. */
static void a_cut_names_the_triangle_that_lies_on_another(void** state) {
  (void)state;
  const double positions[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const uint32_t triangles[9] = {0, 1, 2, 0, 2, 3, 2, 0, 3}, edge[2] = {0, 2};
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions, 4);
  desc.triangles = HF_ARRAY(triangles, 3);
  hf_surface surface = NULL, out = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  hf_patch_desc cut = HF_INIT(hf_patch_desc);
  cut.cut_edge_count = 1;
  cut.cut_edges = edge;
  hf_surface_edit_desc knife = HF_INIT(hf_surface_edit_desc);
  knife.patch = &cut;
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_edit(surface, &knife, &out));
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, NO_INDEX);
  assert_non_null(strstr(detail.message, "corner of triangle 1 a copy of vertex 0"));
  hf_surface_destroy(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_vertex_comes_again_before_others_go),
      cmocka_unit_test(needles_come_in),
      cmocka_unit_test(reports_are_those_of_a_fresh_surface),
      cmocka_unit_test(copies_have_the_stiffness_of_what_they_copy),
      cmocka_unit_test(new_triangles_count_for_the_vertex_limit),
      cmocka_unit_test(a_cut_names_the_triangle_that_lies_on_another),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
