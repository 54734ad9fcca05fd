/* Cuts through triangles: hf_surface_trace_cut, and hf_surface_edit with its arrays, against surfaces that
 * hf_surface_create makes of the same triangles. */
#include "host_mesh.h"

enum { AROUND = 12, RINGS = 18, VERTICES = AROUND * RINGS, SPACE = HOST_ROOM };

/* The arrays of one cut. */
typedef struct Arrays {
  hf_cut cut;
  uint32_t removed[SPACE], triangles[3 * SPACE], corners[3 * SPACE], sources[SPACE], rims[2 * SPACE];
  double positions[3 * SPACE], barycentrics[3 * SPACE], weights[9 * SPACE];
} Arrays;

static HostMesh host;
static Arrays arrays;

static hf_cut_desc line_of(uint32_t count, const hf_place* places) {
  hf_cut_desc desc = HF_INIT(hf_cut_desc);
  desc.point_count = count;
  desc.places = places;
  return desc;
}
static hf_result trace(hf_surface surface, const hf_cut_desc* desc) {
  arrays.cut = HF_INIT(hf_cut);
  hf_cut* const c = &arrays.cut;
  c->removed_triangle_capacity = c->new_vertex_capacity = c->new_triangle_capacity = c->rim_capacity = SPACE;
  c->removed_triangles = arrays.removed;
  c->new_positions = arrays.positions;
  c->new_triangles = arrays.triangles;
  c->vertex_corners = arrays.corners;
  c->vertex_barycentrics = arrays.barycentrics;
  c->source_triangles = arrays.sources;
  c->corner_barycentrics = arrays.weights;
  c->rim_vertices = arrays.rims;
  return hf_surface_trace_cut(surface, desc, c);
}
/* Edits with the arrays, and changes the host's mesh in the same way. */
static hf_surface apply(hf_surface surface) {
  const hf_cut* const c = &arrays.cut;
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.removed_triangle_count = c->removed_triangle_count;
  patch.removed_triangles = c->removed_triangles;
  patch.new_vertex_count = c->new_vertex_count;
  patch.new_positions = c->new_positions;
  patch.new_triangle_count = c->new_triangle_count;
  patch.new_triangles = c->new_triangles;
  return host_patch(&host, surface, &patch);
}
static hf_surface cut_by(hf_surface surface, uint32_t count, const hf_place* places) {
  const hf_cut_desc desc = line_of(count, places);
  assert_ok(trace(surface, &desc));
  return apply(surface);
}
static hf_place in_triangle(uint32_t t, double a, double b) {
  hf_place place = {{0, 0, 0}, 0, {a, b, 1 - a - b}};
  memcpy(place.corners, &host.triangles[3 * t], sizeof place.corners);
  return place;
}
static hf_place at(uint32_t vertex) {
  const hf_place place = {{vertex, NO_INDEX, NO_INDEX}, 0, {1, 0, 0}};
  return place;
}
static uint32_t component_count(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  return report.component_count;
}
static double apart(hf_surface one, hf_surface two, uint32_t site_count, const uint32_t* sites) {
  hf_solver solvers[2] = {solver_on(one), solver_on(two)};
  for (int s = 0; s < 2; ++s)
    for (uint32_t i = 0; i < site_count; ++i) add_site(solvers[s], sites[i], i);
  double *x = field_of(solvers[0], host.vertex_count), *y = field_of(solvers[1], host.vertex_count), worst = 0;
  for (uint32_t v = 0; v < host.vertex_count; ++v) worst = fmax(worst, fabs(x[v] - y[v]));
  free(x);
  free(y);
  hf_solver_destroy(solvers[0]);
  hf_solver_destroy(solvers[1]);
  return worst;
}
static hf_surface tube(void) {
  host_take(&host, surface_tube(AROUND, RINGS));
  return host_fresh(&host, 0);
}

static void a_line_from_border_to_border_parts_fields(void** state) {
  (void)state;
  hf_surface body = tube();
  hf_solver solver = solver_on(body);
  /* along the tube and once through many triangles: the tube is a sheet then */
  const hf_place line[3] = {in_triangle(0, 0.55, 0.01), in_triangle(2 * AROUND * 8 + 5, 0.3, 0.3),
                            in_triangle(2 * AROUND * (RINGS - 2) + 7, 0.02, 0.3)};
  hf_surface open = cut_by(body, 3, line), fresh = host_fresh(&host, 0);
  assert_int_equal(component_count(open), 1);
  /* 0 and 1 at the two sides of the middle of the line */
  const uint32_t* const rim = &arrays.rims[2 * (arrays.cut.rim_count / 2)];
  assert_true(rim[0] != rim[1]);
  assert_true(apart(open, fresh, 2, rim) < 1e-11);
  /* sites go along */
  add_site(solver, VERTICES / 2, 0);
  assert_ok(hf_solver_move_to(solver, open));
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(open, &report));
  assert_int_equal(report.non_manifold_edge_count, 0);
  assert_int_equal(report.flipped_edge_count, 0);
  hf_solver_destroy(solver);
  hf_surface_destroy(open);
  hf_surface_destroy(fresh);
  hf_surface_destroy(body);
}

static void a_closed_line_cuts_a_part_out(void** state) {
  (void)state;
  hf_surface body = tube();
  hf_place ring[5];
  for (uint32_t i = 0; i < 4; ++i) ring[i] = in_triangle(2 * AROUND * 7 + 6 * i, 0.3, 0.2 + 0.1 * i);
  ring[4] = ring[0];
  hf_surface two = cut_by(body, 5, ring), fresh = host_fresh(&host, 0);
  assert_int_equal(component_count(two), 2);
  const uint32_t ends[2] = {0, VERTICES - 1};
  assert_true(apart(two, fresh, 2, ends) < 1e-11);
  hf_surface_destroy(two);
  hf_surface_destroy(fresh);
  hf_surface_destroy(body);
  /* inside one triangle */
  body = tube();
  const hf_place hole[4] = {in_triangle(40, 0.6, 0.2), in_triangle(40, 0.2, 0.6), in_triangle(40, 0.2, 0.2),
                            in_triangle(40, 0.6, 0.2)};
  two = cut_by(body, 4, hole);
  assert_int_equal(component_count(two), 2);
  assert_int_equal(arrays.cut.removed_triangle_count, 1);
  assert_int_equal(arrays.cut.new_vertex_count, 6);
  assert_int_equal(arrays.cut.rim_count, 3);
  hf_surface_destroy(two);
  hf_surface_destroy(body);
}

static void attributes_follow_places_and_corners(void** state) {
  (void)state;
  hf_surface body = tube();
  const hf_place line[2] = {in_triangle(60, 0.2, 0.3), in_triangle(150, 0.3, 0.2)};
  const hf_cut_desc desc = line_of(2, line);
  assert_ok(trace(body, &desc));
  for (uint32_t v = 0; v < arrays.cut.new_vertex_count; ++v) {
    for (int x = 0; x < 3; ++x) {
      double sum = 0;
      for (uint32_t k = 0; k < 3; ++k) {
        const double w = arrays.barycentrics[3 * v + k];
        if (w > 0) sum += w * host.positions[3 * arrays.corners[3 * v + k] + (uint32_t)x];
        assert_int_equal(w == 0, arrays.corners[3 * v + k] == NO_INDEX);
      }
      assert_float_equal(sum, arrays.positions[3 * v + (uint32_t)x], 1e-12);
    }
  }
  hf_surface_destroy(body);
}

static void lines_pass_vertices_and_run_along_edges(void** state) {
  (void)state;
  hf_surface body = tube();
  /* up one row of vertices, from border to border: edges alone */
  const hf_place column[2] = {at(3), at(3 + (RINGS - 1) * AROUND)};
  hf_surface open = cut_by(body, 2, column), fresh = host_fresh(&host, 0);
  assert_int_equal(arrays.cut.new_vertex_count, RINGS);
  assert_int_equal(arrays.cut.new_triangle_count, arrays.cut.removed_triangle_count);
  const uint32_t sides[2] = {arrays.rims[RINGS], arrays.rims[RINGS + 1]};
  assert_true(apart(open, fresh, 2, sides) < 1e-11);
  hf_surface_destroy(open);
  hf_surface_destroy(fresh);
  hf_surface_destroy(body);
  /* the same cut of the same surface along edges: the same vertices */
  body = tube();
  uint32_t edges[2 * (RINGS - 1)];
  for (uint32_t r = 0; r + 1 < RINGS; ++r) {
    edges[2 * r] = 3 + r * AROUND;
    edges[2 * r + 1] = 3 + (r + 1) * AROUND;
  }
  hf_patch_desc patch = HF_INIT(hf_patch_desc);
  patch.cut_edge_count = RINGS - 1;
  patch.cut_edges = edges;
  hf_surface_edit_desc knife = HF_INIT(hf_surface_edit_desc);
  knife.patch = &patch;
  hf_surface along = NULL;
  assert_ok(hf_surface_edit(body, &knife, &along));
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(along, &report));
  assert_int_equal(report.vertex_count, VERTICES + RINGS);
  hf_surface_destroy(along);
  hf_surface_destroy(body);
}

static void points_that_come_twice_in_a_row_count_once(void** state) {
  (void)state;
  hf_surface body = tube();
  const hf_place once[2] = {in_triangle(60, 0.2, 0.3), in_triangle(150, 0.3, 0.2)};
  const hf_place often[5] = {once[0], once[0], once[1], once[1], once[1]};
  hf_cut_desc desc = line_of(2, once);
  assert_ok(trace(body, &desc));
  const uint32_t vertices = arrays.cut.new_vertex_count, triangles = arrays.cut.new_triangle_count;
  desc = line_of(5, often);
  assert_ok(trace(body, &desc));
  assert_int_equal(arrays.cut.new_vertex_count, vertices);
  assert_int_equal(arrays.cut.new_triangle_count, triangles);
  /* a knife drags points in space */
  double points[6];
  for (int i = 0; i < 2; ++i)
    for (int x = 0; x < 3; ++x) {
      points[3 * i + x] = 0;
      for (int k = 0; k < 3; ++k)
        points[3 * i + x] += once[i].barycentrics[k] * host.positions[3 * once[i].corners[k] + (uint32_t)x];
    }
  desc = HF_INIT(hf_cut_desc);
  desc.point_count = 2;
  desc.points = points;
  assert_ok(trace(body, &desc));
  assert_int_equal(arrays.cut.new_vertex_count, vertices);
  assert_int_equal(arrays.cut.new_triangle_count, triangles);
  hf_surface_destroy(body);
}

static Scene scene;
static hf_surface body;
static hf_cut_desc desc;
static hf_place places[6];
static hf_progress progress;

static void good(void) {
  places[0] = in_triangle(60, 0.2, 0.3);
  places[1] = in_triangle(150, 0.3, 0.2);
  desc = line_of(2, places);
  arrays.cut = HF_INIT(hf_cut);
}
#define GOOD() good()
#define UNCHANGED() (arrays.cut.new_vertex_count == 0)
static void give(uint32_t count, const hf_place* list) {
  memcpy(places, list, count * sizeof *list);
  desc.point_count = count;
}

static void lines_that_cannot_be_cut_are_refused(void** state) {
  (void)state;
  scene_create(&scene);
  body = tube();
  assert_ok(hf_progress_create(&progress));
  const uint32_t n = NO_INDEX;
  ROW("one point", HF_ERROR_EMPTY, 1, desc.point_count = 1, hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("no points", HF_ERROR_NULL_POINTER, n, desc.places = NULL, hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("two lists", HF_ERROR_INVALID_ARGUMENT, n, desc.points = arrays.positions,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("reserved", HF_ERROR_INVALID_DESC, n, desc.reserved = 1, hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("reserved", HF_ERROR_INVALID_DESC, n, arrays.cut.reserved = 1, hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("points without end", HF_ERROR_TOO_LARGE, n, desc.point_count = 10000001,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("a snap share below 1e-6", HF_ERROR_INVALID_ARGUMENT, n, desc.snap_share = 1e-7,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("a snap share of a half", HF_ERROR_INVALID_ARGUMENT, n, desc.snap_share = 0.5,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("a snap share of NaN", HF_ERROR_NON_FINITE, n, desc.snap_share = NAN,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("a corner that is no vertex", HF_ERROR_OUT_OF_RANGE, 1, places[1].corners[0] = VERTICES,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("weights of sum 2", HF_ERROR_INVALID_ARGUMENT, 1, places[1].barycentrics[0] += 1,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("a weight of NaN", HF_ERROR_NON_FINITE, 0, places[0].barycentrics[0] = NAN,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("corners of no triangle", HF_ERROR_INVALID_ARGUMENT, 1, places[1].corners[0] = 0,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("one place", HF_ERROR_EMPTY, n, places[1] = places[0], hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("nothing between two ends in a triangle", HF_ERROR_EMPTY, n, places[1] = in_triangle(60, 0.5, 0.3),
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("one edge inside", HF_ERROR_EMPTY, n, (places[0] = at(50), places[1] = at(51)),
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("more crossings than the limit", HF_ERROR_TOO_LARGE, 0, desc.crossing_limit = 3,
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  const hf_place eight[4] = {in_triangle(60, 0.3, 0.3), in_triangle(152, 0.3, 0.3), in_triangle(150, 0.3, 0.3),
                             in_triangle(62, 0.3, 0.3)};
  ROW("a line that crosses itself", HF_ERROR_CONFLICT, 2, give(4, eight),
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  const hf_place small[4] = {in_triangle(60, 0.6, 0.2), in_triangle(60, 0.2, 0.6), in_triangle(60, 0.2, 0.2),
                             in_triangle(60, 0.5, 0.4)};
  ROW("a crossing inside one triangle", HF_ERROR_CONFLICT, 2, give(4, small),
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  const hf_place edge[4] = {at(50), at(52), at(51), at(51 + AROUND)};
  ROW("an edge twice", HF_ERROR_CONFLICT, 1, give(4, edge), hf_surface_trace_cut(body, &desc, &arrays.cut));
  ROW("no out", HF_ERROR_NULL_POINTER, n, (void)0, hf_surface_trace_cut(body, &desc, NULL));
  ROW("no desc", HF_ERROR_NULL_POINTER, n, (void)0, hf_surface_trace_cut(body, NULL, &arrays.cut));
  ROW("a cancelled cut", HF_ERROR_CANCELLED, n, (desc.progress = progress, hf_progress_cancel(progress)),
      hf_surface_trace_cut(body, &desc, &arrays.cut));
  /* the seam's sheet has an island, and the line cannot reach it */
  hf_place island[3] = {at(CUT_LEFT), at(CUT_LEFT + 1), at(CUT_ISLAND)};
  ROW("a place in another component", HF_ERROR_NOT_FOUND, 1, give(3, island),
      hf_surface_trace_cut(scene.sheet, &desc, &arrays.cut));
  ROW("an isolated vertex", HF_ERROR_INVALID_ARGUMENT, 1, (places[0] = at(0), places[1] = at(CUT_ISOLATED)),
      hf_surface_trace_cut(scene.sheet, &desc, &arrays.cut));
  finish_rows("lines that cannot be cut");
  hf_progress_destroy(progress);
  hf_surface_destroy(body);
  scene_destroy(&scene);
}

/* Two quads side by side, and a triangle that lies on another one. */
static void polygons_and_doubled_triangles_are_refused(void** state) {
  (void)state;
  const float positions[18] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
  const uint32_t quads[8] = {0, 1, 4, 3, 1, 2, 5, 4}, sizes[2] = {4, 4};
  hf_faces_desc faces = HF_INIT(hf_faces_desc);
  faces.corners = HF_ARRAY(quads, 8);
  faces.sizes = HF_ARRAY(sizes, 2);
  hf_surface_desc make_desc = HF_INIT(hf_surface_desc);
  make_desc.positions = HF_ARRAY(positions, 6);
  make_desc.faces = &faces;
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&make_desc, &surface));
  const uint32_t across[2] = {0, 5};
  hf_cut_desc line = HF_INIT(hf_cut_desc);
  line.point_count = 2;
  line.vertices = across;
  hf_cut cut = HF_INIT(hf_cut);
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_trace_cut(surface, &line, &cut));
  hf_surface_destroy(surface);
  const uint32_t triangles[15] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 4, 1, 5};
  make_desc.faces = NULL;
  make_desc.triangles = HF_ARRAY(triangles, 5);
  assert_ok(hf_surface_create(&make_desc, &surface));
  assert_code(HF_ERROR_UNSUPPORTED, hf_surface_trace_cut(surface, &line, &cut));
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, 3);
  hf_surface_destroy(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_line_from_border_to_border_parts_fields),
      cmocka_unit_test(a_closed_line_cuts_a_part_out),
      cmocka_unit_test(attributes_follow_places_and_corners),
      cmocka_unit_test(lines_pass_vertices_and_run_along_edges),
      cmocka_unit_test(points_that_come_twice_in_a_row_count_once),
      cmocka_unit_test(lines_that_cannot_be_cut_are_refused),
      cmocka_unit_test(polygons_and_doubled_triangles_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
