/* Doubled faces count once: the same three welded corners again, in the same direction or mirrored. A mesh with them is
 * the mesh without them in fields, poses and quads, and a two-sided sheet is one sheet with a border. The same holds
 * for triangles over three vertices of a line that join nothing. */
#include "api_support.h"

/* A soup: every triangle has three vertices of its own, which the surface welds. */
typedef struct Soup {
  uint32_t triangle_count;
  double positions[3 * 3 * 4000];
} Soup;

static void append_triangle(Soup* soup, const double* a, const double* b, const double* c) {
  double* out = &soup->positions[9 * soup->triangle_count++];
  memcpy(out, a, 24);
  memcpy(out + 3, b, 24);
  memcpy(out + 6, c, 24);
}

static void subdivide(Soup* soup, const double* a, const double* b, const double* c, int depth) {
  if (depth == 0) {
    append_triangle(soup, a, b, c);
    return;
  }
  const double* ends[3][2] = {{a, b}, {b, c}, {c, a}};
  double middle[3][3];
  for (int i = 0; i < 3; ++i) {
    double square = 0;
    for (int k = 0; k < 3; ++k) {
      middle[i][k] = ends[i][0][k] + ends[i][1][k];
      square += middle[i][k] * middle[i][k];
    }
    for (int k = 0; k < 3; ++k) middle[i][k] /= sqrt(square);
  }
  subdivide(soup, a, middle[0], middle[2], depth - 1);
  subdivide(soup, b, middle[1], middle[0], depth - 1);
  subdivide(soup, c, middle[2], middle[1], depth - 1);
  subdivide(soup, middle[0], middle[1], middle[2], depth - 1);
}

/* 1,280 triangles on a sphere, made longer along x. */
static void make_ball(Soup* soup) {
  const double g = 1.618033988749895, n = sqrt(1 + g * g);
  const double v[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const int f[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  double unit[12][3];
  for (int i = 0; i < 36; ++i) unit[i / 3][i % 3] = v[i / 3][i % 3] / n;
  soup->triangle_count = 0;
  for (int i = 0; i < 20; ++i) subdivide(soup, unit[f[i][0]], unit[f[i][1]], unit[f[i][2]], 3);
  for (uint32_t i = 0; i < 3 * soup->triangle_count; ++i) soup->positions[3 * i] *= 2;
}

/* Appends `count` triangles again, spread over the soup. mirrored: 0 none, 1 all, 2 every second. */
static void append_doubles(Soup* soup, uint32_t count, int mirrored) {
  const uint32_t before = soup->triangle_count;
  for (uint32_t i = 0; i < count; ++i) {
    const double* p = &soup->positions[9 * (size_t)(i * (before / count))];
    if (mirrored == 1 || (mirrored == 2 && i % 2))
      append_triangle(soup, p, p + 6, p + 3);
    else
      append_triangle(soup, p + 3, p + 6, p);
  }
}

static hf_surface surface_of(const Soup* soup, uint32_t* triangles, int32_t operator_kind) {
  for (uint32_t i = 0; i < 3 * soup->triangle_count; ++i) triangles[i] = i;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(soup->positions, 3 * soup->triangle_count);
  desc.triangles = HF_ARRAY(triangles, soup->triangle_count);
  desc.operator_kind = operator_kind;
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  return surface;
}

static hf_surface_report report_of(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  return report;
}

/* A field, a pose and quads of a surface. */
typedef struct Results {
  double* field;
  double* posed;
  float* normals;
  double* quads;
  uint32_t* faces;
  uint32_t quad_vertices, quad_faces;
} Results;

/* Vertices of three sites, and places and radius of two handles. */
typedef struct Places {
  uint32_t sites[3];
  double handles[2][3], radius;
} Places;
static const Places on_ball = {{0, 1234, 3001}, {{-2, 0, 0}, {2, 0, 0}}, 0.6};

static Results results_of(hf_surface surface, uint32_t vertices, const Places* places) {
  Results out = {0};
  hf_solver solver = solver_on(surface);
  add_site(solver, places->sites[0], 0);
  add_site(solver, places->sites[1], 1);
  add_site(solver, places->sites[2], 3);
  out.field = field_of(solver, vertices);
  hf_solver_destroy(solver);
  hf_pose pose = NULL;
  uint32_t handles[2];
  assert_ok(hf_pose_create(surface, NULL, &pose));
  for (int i = 0; i < 2; ++i) assert_ok(hf_pose_add_handle_at(pose, places->handles[i], places->radius, &handles[i]));
  const hf_transform turned = {{0, 0, 0.38268343, 0.92387953}, {0.2, 0.7, 0}};
  assert_ok(hf_pose_set_transform(pose, handles[1], &turned));
  hf_deform_desc deform = HF_INIT(hf_deform_desc);
  out.posed = calloc(vertices, 3 * sizeof(double));
  out.normals = calloc(vertices, 3 * sizeof(float));
  deform.positions = ROWS_OUT(out.posed);
  deform.normals = ROWS_OUT(out.normals);
  deform.refine = 4;
  assert_ok(hf_pose_deform(pose, &deform, NULL));
  hf_pose_destroy(pose);
  hf_quads quads = NULL;
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.face_count = 500;
  assert_ok(hf_quads_create(surface, &desc, &quads));
  hf_quads_info info = HF_INIT(hf_quads_info);
  assert_ok(hf_quads_get_info(quads, &info));
  out.quad_vertices = info.vertex_count;
  out.quad_faces = info.face_count;
  out.quads = calloc(info.vertex_count, 3 * sizeof(double));
  out.faces = calloc(info.face_count, 4 * sizeof(uint32_t));
  hf_quads_mesh net = HF_INIT(hf_quads_mesh);
  net.vertex_capacity = info.vertex_count;
  net.face_capacity = info.face_count;
  net.positions = out.quads;
  net.faces = out.faces;
  assert_ok(hf_quads_get_mesh(quads, &net));
  hf_quads_destroy(quads);
  return out;
}

static void free_results(Results* results) {
  free(results->field);
  free(results->posed);
  free(results->normals);
  free(results->quads);
  free(results->faces);
}

static void assert_same_results(const Results* got, const Results* expected, uint32_t vertices) {
  assert_true(same_bits(got->field, expected->field, vertices * sizeof(double)));
  assert_true(same_bits(got->posed, expected->posed, 3 * vertices * sizeof(double)));
  assert_int_equal(got->quad_faces, expected->quad_faces);
  assert_int_equal(got->quad_vertices, expected->quad_vertices);
  assert_true(same_bits(got->quads, expected->quads, 3 * got->quad_vertices * sizeof(double)));
  assert_true(same_bits(got->faces, expected->faces, 4 * got->quad_faces * sizeof(uint32_t)));
}

static Soup plain, doubled;
static uint32_t corners[2][3 * 4000];

static void fields_poses_and_quads_are_those_of_the_mesh_without_doubles(void** state) {
  (void)state;
  make_ball(&plain);
  const uint32_t vertices = 3 * plain.triangle_count;
  const hf_surface before = surface_of(&plain, corners[0], HF_OPERATOR_INTRINSIC_DELAUNAY);
  Results expected = results_of(before, vertices, &on_ball);
  const uint32_t counts[] = {1, 20, 100, 1280};
  for (size_t i = 0; i < COUNT_OF(counts); ++i) {
    for (int mirrored = 0; mirrored < 3; ++mirrored) {
      make_ball(&doubled);
      append_doubles(&doubled, counts[i], mirrored);
      const hf_surface surface = surface_of(&doubled, corners[1], HF_OPERATOR_INTRINSIC_DELAUNAY);
      const hf_surface_report report = report_of(surface);
      assert_int_equal(report.duplicate_triangle_count, counts[i]);
      assert_int_equal(report.non_manifold_edge_count + report.boundary_edge_count + report.flipped_edge_count, 0);
      assert_int_equal(report.welded_vertex_count, 642);
      Results got = results_of(surface, 3 * doubled.triangle_count, &on_ball);
      assert_same_results(&got, &expected, vertices);
      free_results(&got);
      hf_surface_destroy(surface);
    }
  }
  free_results(&expected);
  hf_surface_destroy(before);
}

static void every_operator_weighs_doubled_faces_once(void** state) {
  (void)state;
  make_ball(&plain);
  make_ball(&doubled);
  append_doubles(&doubled, 37, 2);
  for (int32_t kind = HF_OPERATOR_INTRINSIC_DELAUNAY; kind <= HF_OPERATOR_COTANGENT; ++kind) {
    double* field[2];
    for (int k = 0; k < 2; ++k) {
      const hf_surface surface = surface_of(k ? &doubled : &plain, corners[k], kind);
      hf_solver solver = solver_on(surface);
      add_site(solver, 0, 0);
      add_site(solver, 1234, 1);
      add_site(solver, 3001, 3);
      field[k] = field_of(solver, 3 * (k ? &doubled : &plain)->triangle_count);
      hf_solver_destroy(solver);
      hf_surface_destroy(surface);
    }
    assert_true(same_bits(field[0], field[1], 9 * sizeof(double) * plain.triangle_count / 3));
    free(field[0]);
    free(field[1]);
  }
}

/* A sheet with two sides of their own vertices, as a leaf is exported. first: which side of each square comes first; 0
 * front, 1 back, 2 mixed. The sides of square i are the faces 2 i and 2 i + 1, each of two triangles. */
enum { SIDE = 6, SQUARES = SIDE * SIDE };

static void make_leaf(Soup* soup, int first) {
  soup->triangle_count = 0;
  for (uint32_t i = 0; i < SQUARES; ++i) {
    const double x = i % SIDE, y = (double)(i / SIDE);
    const double p[4][3] = {{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}};
    for (int side = 0; side < 2; ++side) {
      const int back = side ^ (first == 2 ? (int)(i * 7 % 3 == 1) : first);
      for (int half = 0; half < 2; ++half) {
        const double *b = p[1 + half], *c = p[2 + half];
        append_triangle(soup, p[0], back ? c : b, back ? b : c);
      }
    }
  }
}

static int is_back(const Soup* soup, uint32_t triangle) {
  const double* p = &soup->positions[9 * (size_t)triangle];
  return (p[3] - p[0]) * (p[7] - p[1]) - (p[4] - p[1]) * (p[6] - p[0]) < 0;
}

static void a_two_sided_sheet_is_one_sheet_with_opposite_normals_behind(void** state) {
  (void)state;
  for (int first = 0; first < 3; ++first) {
    make_leaf(&doubled, first);
    const hf_surface surface = surface_of(&doubled, corners[1], HF_OPERATOR_INTRINSIC_DELAUNAY);
    const hf_surface_report report = report_of(surface);
    assert_int_equal(report.duplicate_triangle_count, 2 * SQUARES);
    assert_int_equal(report.boundary_edge_count, 4 * SIDE);
    assert_int_equal(report.flipped_edge_count + report.non_manifold_edge_count, 0);
    hf_pose pose = NULL;
    uint32_t handle;
    assert_ok(hf_pose_create(surface, NULL, &pose));
    assert_ok(hf_pose_add_handle_at(pose, (const double[]){0, 0, 0}, 1.1, &handle));
    const uint32_t vertices = 3 * doubled.triangle_count;
    float* normals = calloc(vertices, 3 * sizeof *normals);
    hf_deform_desc deform = HF_INIT(hf_deform_desc);
    deform.normals = ROWS_OUT(normals);
    assert_ok(hf_pose_deform(pose, &deform, NULL));
    for (uint32_t v = 0; v < vertices; ++v)
      assert_true(fabs((double)normals[3 * v + 2] - (is_back(&doubled, v / 3) ? -1 : 1)) < 1e-6);
    /* a range in the middle, with a stride */
    float range[4 * 20];
    deform.normals = ROWS_OUT(range);
    deform.normals.stride = 4 * sizeof(float);
    deform.first_vertex = 5;
    deform.vertex_count = 20;
    assert_ok(hf_pose_deform(pose, &deform, NULL));
    for (uint32_t v = 5; v < 25; ++v) assert_true(same_bits(&range[4 * (v - 5)], &normals[3 * v], 3 * sizeof(float)));
    free(normals);
    hf_pose_destroy(pose);
    /* rays from both sides hit the side that faces them */
    hf_pick_desc front = HF_INIT(hf_pick_desc);
    front.front_only = 1;
    for (int below = 0; below < 2; ++below) {
      for (uint32_t i = 0; i < SQUARES; ++i) {
        const double from[3] = {i % SIDE + 0.7, i / SIDE + 0.2, below ? -3 : 3}, along[3] = {0, 0, below ? 1 : -1};
        hf_hit hit = HF_INIT(hf_hit);
        assert_ok(hf_surface_cast_ray(surface, from, along, &front, &hit));
        assert_true(hit.found && fabs(hit.distance - 3) < 1e-12 && hit.triangle / 4 == i);
        assert_int_equal(is_back(&doubled, hit.triangle), below);
        double place[3] = {0, 0, 0};
        for (int c = 0; c < 3; ++c) {
          for (int k = 0; k < 3; ++k)
            place[k] += hit.place.barycentrics[c] * doubled.positions[3 * hit.place.corners[c] + k];
        }
        assert_true(fabs(place[0] - from[0]) < 1e-12 && fabs(place[1] - from[1]) < 1e-12);
        assert_ok(hf_surface_cast_ray(surface, from, along, NULL, &hit));
        assert_int_equal(hit.triangle / 2 * 2, 4 * i); /* the first of the two */
      }
    }
    hf_quads quads = NULL;
    hf_quads_desc desc = HF_INIT(hf_quads_desc);
    desc.edge_length = 1;
    assert_ok(hf_quads_create(surface, &desc, &quads));
    hf_quads_info info = HF_INIT(hf_quads_info);
    assert_ok(hf_quads_get_info(quads, &info));
    assert_int_equal(info.euler_characteristic, 1);
    assert_int_equal(info.face_count, SQUARES);
    hf_quads_destroy(quads);
    hf_surface_destroy(surface);
  }
}

/* A tube with a triangle more over three vertices of a line: neighbours, or from end to end. */
static void a_triangle_over_a_line_that_joins_nothing_changes_nothing(void** state) {
  (void)state;
  enum { AROUND = 24, RINGS = 41, VERTICES = AROUND * RINGS };
  const Places places = {{0, 500, 900}, {{0, 2, 0}, {0, 38, 0}}, 3};
  const uint32_t flaps[][3] = {{0, AROUND, 2 * AROUND}, {5, 5 + 40 * AROUND, 5 + 20 * AROUND}};
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_surface before = surface_on(&tube);
  Results expected = results_of(before, VERTICES, &places);
  uint32_t* triangles = malloc((tube.triangle_count + 1) * 3 * sizeof *triangles);
  for (size_t i = 0; i < COUNT_OF(flaps); ++i) {
    memcpy(triangles, flaps[i], sizeof flaps[i]);
    memcpy(triangles + 3, tube.triangles, 3 * tube.triangle_count * sizeof *triangles);
    hf_surface_desc desc = HF_INIT(hf_surface_desc);
    desc.positions = HF_ARRAY(tube.positions, VERTICES);
    desc.triangles = HF_ARRAY(triangles, tube.triangle_count + 1);
    hf_surface surface = NULL;
    assert_ok(hf_surface_create(&desc, &surface));
    const hf_surface_report report = report_of(surface);
    assert_int_equal(report.collapsed_triangle_count, 1);
    assert_int_equal(report.degenerate_triangle_count + report.non_manifold_edge_count, 0);
    Results got = results_of(surface, VERTICES, &places);
    assert_same_results(&got, &expected, VERTICES);
    free_results(&got);
    hf_surface_destroy(surface);
  }
  free(triangles);
  free_results(&expected);
  hf_surface_destroy(before);
  surface_free(&tube);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fields_poses_and_quads_are_those_of_the_mesh_without_doubles),
      cmocka_unit_test(every_operator_weighs_doubled_faces_once),
      cmocka_unit_test(a_two_sided_sheet_is_one_sheet_with_opposite_normals_behind),
      cmocka_unit_test(a_triangle_over_a_line_that_joins_nothing_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
