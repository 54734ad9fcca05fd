/* Surfaces of faces with any number of corners: how hosts store them, what does not depend on a cut, sites in faces. */
#include "api_support.h"

enum {
  COLUMNS = 7,
  ROWS = 5,
  QUADS = COLUMNS * ROWS,
  POINTS = (COLUMNS + 1) * (ROWS + 1),
  LEFT = 0,
  RIGHT = POINTS - 1
};

/* A sheet of long bent quads, skewed, in double: what most operators have trouble with. */
typedef struct Sheet {
  double positions[3 * POINTS];
  uint32_t corners[4 * QUADS], sizes[QUADS], offsets[QUADS + 1];
} Sheet;

static Sheet bent_sheet(void) {
  Sheet sheet;
  for (uint32_t j = 0; j <= ROWS; ++j) {
    for (uint32_t i = 0; i <= COLUMNS; ++i) {
      double* p = sheet.positions + 3 * (j * (COLUMNS + 1) + i);
      p[0] = 3.0 * i + 0.7 * j + 0.2 * sin(5.0 * i + j);
      p[1] = j + 0.1 * cos(3.0 * j + i);
      p[2] = sin(1.3 * i) * cos(0.9 * j);
    }
  }
  for (uint32_t f = 0; f < QUADS; ++f) {
    const uint32_t a = f / COLUMNS * (COLUMNS + 1) + f % COLUMNS;
    const uint32_t corners[4] = {a, a + 1, a + COLUMNS + 2, a + COLUMNS + 1};
    memcpy(sheet.corners + 4 * f, corners, sizeof corners);
    sheet.sizes[f] = 4;
    sheet.offsets[f] = 4 * f;
  }
  sheet.offsets[QUADS] = 4 * QUADS;
  return sheet;
}

static hf_surface_desc desc_of(const Sheet* sheet) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = POINTS;
  desc.positions_f64 = sheet->positions;
  desc.face_count = QUADS;
  desc.corner_count = 4 * QUADS;
  desc.face_sizes = sheet->sizes;
  desc.corners = sheet->corners;
  return desc;
}

static hf_surface made(const hf_surface_desc* desc) {
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(desc, &surface));
  return surface;
}

/* The field with 0 at the first vertex and 1 at the last. */
static void field_on(const hf_surface_desc* desc, double* field) {
  hf_surface surface = made(desc);
  hf_solver solver = solver_on(surface);
  add_site(solver, LEFT, 0);
  add_site(solver, desc->vertex_count - 1, 1);
  assert_ok(hf_solver_solve_f64(solver, field, 0, NULL));
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
}

static double difference(const double* a, const double* b, uint32_t count) {
  double most = 0;
  for (uint32_t v = 0; v < count; ++v) most = fmax(most, fabs(a[v] - b[v]));
  return most;
}

static hf_surface_report report_of(const hf_surface_desc* desc) {
  hf_surface surface = made(desc);
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  hf_surface_destroy(surface);
  return report;
}

static hf_mesh_statistics statistics_of(const hf_surface_desc* desc) {
  hf_surface surface = made(desc);
  hf_mesh_statistics statistics = HF_INIT(hf_mesh_statistics);
  assert_ok(hf_surface_get_mesh_statistics(surface, &statistics));
  hf_surface_destroy(surface);
  return statistics;
}

static void faces_are_taken_as_every_host_stores_them(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  hf_surface_desc desc = desc_of(&sheet);
  double sizes[POINTS], other[POINTS];
  field_on(&desc, sizes);
  desc.face_starts = sheet.offsets;
  desc.face_sizes = NULL;
  field_on(&desc, other);
  assert_memory_equal(sizes, other, sizeof sizes);
  /* records of a host: start and size of a face, the vertex of a corner, among other things */
  struct {
    uint32_t start, size, material;
  } polygons[QUADS];
  struct {
    uint32_t vertex, edge;
  } loops[4 * QUADS];
  for (uint32_t f = 0; f < QUADS; ++f) {
    polygons[f].start = 4 * (QUADS - 1 - f);
    polygons[f].size = 4;
    polygons[f].material = 77;
    for (uint32_t k = 0; k < 4; ++k) loops[polygons[f].start + k].vertex = sheet.corners[4 * f + k];
  }
  desc.face_starts = &polygons[0].start;
  desc.face_sizes = &polygons[0].size;
  desc.face_stride = sizeof polygons[0];
  desc.corners = &loops[0].vertex;
  desc.corner_stride = sizeof loops[0];
  field_on(&desc, other);
  assert_memory_equal(sizes, other, sizeof sizes);
}

static void no_field_depends_on_the_first_corner(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  Sheet turned = sheet;
  for (uint32_t f = 0; f < QUADS; ++f) {
    for (uint32_t k = 0; k < 4; ++k) turned.corners[4 * f + k] = sheet.corners[4 * f + (k + f) % 4];
  }
  for (int32_t kind = 0; kind < 4; ++kind) {
    for (int32_t field = 0; field < 3; ++field) {
      hf_surface_desc a = desc_of(&sheet), b = desc_of(&turned);
      a.operator_kind = b.operator_kind = kind;
      a.field_kind = b.field_kind = field;
      double x[POINTS], y[POINTS];
      field_on(&a, x);
      field_on(&b, y);
      assert_true(difference(x, y, POINTS) <= 1e-12);
    }
  }
}

static void a_mirrored_mesh_has_the_mirrored_field(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  Sheet mirror = sheet;
  for (uint32_t v = 0; v < POINTS; ++v) mirror.positions[3 * v] = -sheet.positions[3 * v];
  for (uint32_t f = 0; f < QUADS; ++f) {
    for (uint32_t k = 0; k < 4; ++k) mirror.corners[4 * f + k] = sheet.corners[4 * f + 3 - k];
  }
  for (int32_t kind = 0; kind < 4; ++kind) {
    hf_surface_desc a = desc_of(&sheet), b = desc_of(&mirror);
    a.operator_kind = b.operator_kind = kind;
    double x[POINTS], y[POINTS];
    field_on(&a, x);
    field_on(&b, y);
    assert_true(difference(x, y, POINTS) <= 1e-12);
  }
}

static void faces_of_three_corners_are_triangles(void** state) {
  (void)state;
  Surface cut = surface_cut();
  uint32_t sizes[CUT_TRIANGLES];
  for (uint32_t t = 0; t < CUT_TRIANGLES; ++t) sizes[t] = 3;
  Options options = options_of(&cut);
  double triangles[CUT_VERTICES], faces[CUT_VERTICES];
  options.surface.vertex_count = CUT_VERTICES;
  hf_surface surface = surface_on(&cut);
  hf_solver solver = solver_on(surface);
  add_site(solver, CUT_LEFT, 0);
  add_site(solver, CUT_RIGHT, 1);
  assert_ok(hf_solver_solve_f64(solver, triangles, 0, NULL));
  const hf_surface_report before = report_of(&options.surface);
  hf_surface_desc desc = options.surface;
  desc.triangles = NULL;
  desc.triangle_count = 0;
  desc.face_count = CUT_TRIANGLES;
  desc.corner_count = 3 * CUT_TRIANGLES;
  desc.face_sizes = sizes;
  desc.corners = cut.triangles;
  hf_surface same = made(&desc);
  hf_solver other = solver_on(same);
  add_site(other, CUT_LEFT, 0);
  add_site(other, CUT_RIGHT, 1);
  assert_ok(hf_solver_solve_f64(other, faces, 0, NULL));
  assert_memory_equal(triangles, faces, sizeof faces);
  const hf_surface_report after = report_of(&desc);
  assert_memory_equal(&before, &after, sizeof before);
  assert_int_equal(statistics_of(&desc).largest_face, 3);
  assert_int_equal(statistics_of(&options.surface).largest_face, 0);
  hf_surface_info info = HF_INIT(hf_surface_info);
  assert_ok(hf_surface_get_info(same, &info));
  assert_int_equal(info.face_count, CUT_TRIANGLES);
  assert_int_equal(info.corner_count, 3 * CUT_TRIANGLES);
  assert_int_equal(info.triangle_count, CUT_TRIANGLES);
  hf_solver_destroy(solver);
  hf_solver_destroy(other);
  hf_surface_destroy(surface);
  hf_surface_destroy(same);
  surface_free(&cut);
}

static void a_field_keeps_to_the_range_of_its_sites(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  hf_surface_desc desc = desc_of(&sheet);
  double field[POINTS];
  field_on(&desc, field);
  for (uint32_t v = 0; v < POINTS; ++v) assert_true(field[v] >= -1e-12 && field[v] <= 1 + 1e-12);
}

static void a_hit_in_a_face_is_a_site(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  hf_surface_desc desc = desc_of(&sheet);
  hf_surface surface = made(&desc);
  hf_solver solver = solver_on(surface);
  add_site(solver, LEFT, 0);
  for (uint32_t f = 0; f < QUADS; f += 3) {
    double origin[3] = {0, 0, 50};
    const double down[3] = {0, 0, -1};
    for (uint32_t k = 0; k < 8; ++k)
      origin[k % 2] += (0.2 + 0.1 * (k / 2 == 1)) * sheet.positions[3 * sheet.corners[4 * f + k / 2] + k % 2];
    for (uint32_t k = 0; k < 2; ++k) origin[k] /= 0.9;
    hf_hit hit = HF_INIT(hf_hit);
    assert_ok(hf_surface_cast_ray(surface, origin, down, NULL, &hit));
    assert_int_equal(hit.found, 1);
    assert_int_equal(hit.triangle, f);
    for (uint32_t c = 0; c < 3; ++c) {
      double p = 0;
      for (uint32_t k = 0; k < 3; ++k) p += hit.place.barycentrics[k] * sheet.positions[3 * hit.place.corners[k] + c];
      assert_true(fabs(p - hit.position[c]) < 1e-12);
    }
    hf_sites_desc site = HF_INIT(hf_sites_desc);
    const double value = 0.25 * f;
    uint32_t number = NO_INDEX;
    site.site_count = 1;
    site.places = &hit.place;
    site.values = &value;
    assert_ok(hf_add_sites(solver, &site, &number));
    double* field = field_of(solver, POINTS);
    double there = 0;
    for (uint32_t k = 0; k < 3; ++k) there += hit.place.barycentrics[k] * field[hit.place.corners[k]];
    assert_true(fabs(there - value) < 1e-11);
    free(field);
  }
  hf_solver_destroy(solver);
  hf_surface_destroy(surface);
}

/* A letter C of eight corners with a hole bridged into its back, a triangle, and dirt. */
static void concave_faces_holes_and_dirt(void** state) {
  (void)state;
  const float positions[][3] = {{0, 0, 0},    {4, 0, 0},    {4, 1, 0}, {2, 1, 0},    {2, 3, 0},
                                {4, 3, 0},    {4, 4, 0},    {0, 4, 0}, {0.5f, 1, 0}, {0.5f, 2, 0},
                                {1.5f, 2, 0}, {1.5f, 1, 0}, {9, 9, 9}, {4, 0, 0}};
  const uint32_t c[] = {0, 1,  2, 3,  4, 5, 6, 7, 0, 8, 9, 10, 11, 8, /* the C; 0 - 8 is a bridge to the hole */
                        0, 2,  1, 13,                                 /* a triangle twice: 1 and 13 are one place */
                        3, 5,  6, 6,                                  /* a repeated corner: a triangle */
                        1, 13, 1,                                     /* nothing left */
                        6, 5,  3};                                    /* the third again, turned round */
  const uint32_t sizes[] = {14, 4, 4, 3, 3};
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = 14;
  desc.positions = &positions[0][0];
  desc.face_count = 5;
  desc.corner_count = (uint32_t)COUNT_OF(c);
  desc.face_sizes = sizes;
  desc.corners = c;
  const hf_surface_report report = report_of(&desc);
  const hf_mesh_statistics statistics = statistics_of(&desc);
  assert_int_equal(statistics.polygon_count, 3);
  assert_int_equal(statistics.largest_face, 14);
  assert_int_equal(statistics.non_planar_count, 0);
  assert_int_equal(report.collapsed_triangle_count, 1);
  assert_int_equal(report.duplicate_triangle_count, 1);
  assert_int_equal(report.isolated_vertex_count, 1);
  assert_int_equal(report.component_count, 1);
  assert_int_equal(report.triangle_count, 12 + 2 + 2 + 1 + 1);
  hf_surface surface = made(&desc);
  const struct {
    double x, y;
    int found;
  } rays[] = {{3, 0.5, 1},    {3, 3.5, 1},   {0.2, 3.8, 1}, {1, 0.5, 1},
              {1.75, 1.5, 1}, {2.5, 2.5, 0}, {1, 1.5, 0},   {0.25, 1.5, 1}};
  for (size_t i = 0; i < COUNT_OF(rays); ++i) {
    const double from[3] = {rays[i].x, rays[i].y, 5}, down[3] = {0, 0, -1};
    hf_pick_desc front = HF_INIT(hf_pick_desc);
    front.front_only = 1;
    hf_hit hit = HF_INIT(hf_hit);
    assert_ok(hf_surface_cast_ray(surface, from, down, &front, &hit));
    assert_int_equal(hit.found, rays[i].found);
    if (hit.found) assert_int_equal(hit.triangle, 0);
  }
  hf_surface_destroy(surface);
}

/* The surface of a cube as six quads, two of them in one face of six corners (an L of two sides). */
static void sides_of_faces_are_counted_not_cuts(void** state) {
  (void)state;
  const float positions[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  uint32_t corners[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
  const uint32_t sizes[] = {4, 4, 4, 4, 4, 4};
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = 8;
  desc.positions = &positions[0][0];
  desc.face_count = 6;
  desc.corner_count = 24;
  desc.face_sizes = sizes;
  desc.corners = corners;
  hf_surface_report report = report_of(&desc);
  assert_true(report.boundary_edge_count == 0 && report.flipped_edge_count == 0 && report.non_manifold_edge_count == 0);
  desc.face_count = 5;
  assert_int_equal(report_of(&desc).boundary_edge_count, 4);
  /* two sides of a card on the same four vertices are one sheet with a border */
  const uint32_t card[] = {0, 1, 2, 3, 3, 2, 1, 0};
  desc.vertex_count = 4;
  desc.face_count = 2;
  desc.corner_count = 8;
  desc.corners = card;
  report = report_of(&desc);
  assert_true(report.boundary_edge_count == 4 && report.flipped_edge_count == 0 && report.non_manifold_edge_count == 0);
  assert_int_equal(report.duplicate_triangle_count, 1);
  /* a bow tie on the four vertices is another face */
  const uint32_t tie[] = {0, 1, 2, 3, 0, 2, 1, 3};
  desc.corners = tie;
  assert_int_equal(report_of(&desc).duplicate_triangle_count, 0);
}

/* A cap of many corners on a ring of quads: a field over it is exact for a linear function. */
static void linear_fields_are_exact_on_flat_faces(void** state) {
  (void)state;
  enum { AROUND = 40, ALL = 2 * AROUND };
  double positions[3 * ALL];
  uint32_t corners[AROUND + 4 * AROUND], sizes[1 + AROUND], rim[AROUND];
  for (uint32_t i = 0; i < AROUND; ++i) {
    const double turn = 2 * 3.14159265358979323846 * i / AROUND;
    for (uint32_t ring = 0; ring < 2; ++ring) {
      double* p = positions + 3 * (ring * AROUND + i);
      p[0] = (1.0 + ring) * cos(turn);
      p[1] = (1.0 + ring) * sin(turn);
      p[2] = 0.5 * p[0];
    }
    corners[i] = i;
    rim[i] = AROUND + i;
    const uint32_t next = (i + 1) % AROUND, quad[4] = {i, AROUND + i, AROUND + next, next};
    memcpy(corners + AROUND + 4 * i, quad, sizeof quad);
    sizes[1 + i] = 4;
  }
  sizes[0] = AROUND;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = ALL;
  desc.positions_f64 = positions;
  desc.corners = corners;
  desc.face_sizes = sizes;
  desc.face_count = 1 + AROUND;
  desc.corner_count = 5 * AROUND;
  for (int32_t kind = HF_OPERATOR_INTRINSIC_DELAUNAY; kind <= HF_OPERATOR_COTANGENT; kind += 3) {
    desc.operator_kind = kind;
    hf_surface surface = made(&desc);
    hf_solver solver = solver_on(surface);
    double values[AROUND], field[ALL];
    for (uint32_t i = 0; i < AROUND; ++i) values[i] = positions[3 * rim[i]] + 2 * positions[3 * rim[i] + 1];
    const hf_sites_desc sites = sites_at(AROUND, rim, values);
    assert_ok(hf_add_sites(solver, &sites, NULL));
    assert_ok(hf_solver_solve_f64(solver, field, 0, NULL));
    for (uint32_t v = 0; v < ALL; ++v)
      assert_true(fabs(field[v] - positions[3 * v] - 2 * positions[3 * v + 1]) < 1e-12);
    hf_solver_destroy(solver);
    hf_surface_destroy(surface);
  }
}

static void quads_and_singularities_name_faces(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  hf_surface_desc desc = desc_of(&sheet);
  hf_surface surface = made(&desc);
  const uint32_t places[2] = {LEFT, RIGHT};
  hf_direction_desc options = HF_INIT(hf_direction_desc);
  options.degree = 4;
  hf_direction direction = NULL;
  assert_ok(hf_direction_create(surface, &options, &direction));
  const double vectors[6] = {1, 0, 0, 0, 1, 0};
  assert_ok(hf_direction_add_sites(direction, 2, places, vectors, NULL));
  hf_singularity found[QUADS];
  uint32_t count = 0;
  assert_ok(hf_direction_get_singularities(direction, QUADS, found, &count));
  for (uint32_t i = 0; i < count; ++i) {
    assert_true(found[i].triangle < QUADS && found[i].index != 0);
    assert_true(i == 0 || found[i].triangle > found[i - 1].triangle);
  }
  hf_direction_destroy(direction);
  hf_surface_destroy(surface);
}

static void a_pose_of_faces_follows_its_handles(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  hf_surface_desc desc = desc_of(&sheet);
  hf_surface surface = made(&desc);
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  uint32_t ends[2][ROWS + 1], counts[2] = {ROWS + 1, ROWS + 1}, handles[2];
  for (uint32_t j = 0; j <= ROWS; ++j) {
    ends[0][j] = j * (COLUMNS + 1);
    ends[1][j] = j * (COLUMNS + 1) + COLUMNS;
  }
  hf_handles_desc regions = HF_INIT(hf_handles_desc);
  regions.handle_count = 2;
  regions.region_counts = counts;
  regions.region_vertices = &ends[0][0];
  assert_ok(hf_pose_add_handles(pose, &regions, handles));
  float posed[3 * POINTS], normals[3 * POINTS];
  hf_deform_desc out = HF_INIT(hf_deform_desc);
  out.positions = posed;
  out.normals = normals;
  assert_ok(hf_pose_deform(pose, &out, NULL));
  for (uint32_t i = 0; i < 3 * POINTS; ++i) assert_true(fabs(posed[i] - sheet.positions[i]) < 1e-5);
  /* the normal of a corner of the sheet is Newell's normal of its one face, wherever the cut runs */
  const uint32_t at[4] = {0, COLUMNS, POINTS - 1 - COLUMNS, POINTS - 1};
  const uint32_t face[4] = {0, COLUMNS - 1, QUADS - COLUMNS, QUADS - 1};
  for (uint32_t i = 0; i < 4; ++i) {
    double n[3] = {0, 0, 0}, length = 0;
    for (uint32_t k = 0; k < 4; ++k) {
      const double* a = sheet.positions + 3 * sheet.corners[4 * face[i] + k];
      const double* b = sheet.positions + 3 * sheet.corners[4 * face[i] + (k + 1) % 4];
      for (uint32_t c = 0; c < 3; ++c) n[c] += a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
    }
    for (uint32_t c = 0; c < 3; ++c) length += n[c] * n[c];
    for (uint32_t c = 0; c < 3; ++c) assert_true(fabs(normals[3 * at[i] + c] - n[c] / sqrt(length)) < 1e-4);
  }
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
}

static void the_triangle_limit_holds_for_cut_faces(void** state) {
  (void)state;
  const Sheet sheet = bent_sheet();
  hf_surface_desc desc = desc_of(&sheet);
  desc.triangle_limit = 2 * QUADS;
  hf_surface_destroy(made(&desc));
  hf_surface surface = NULL;
  desc.triangle_limit = 2 * QUADS - 1;
  assert_code(HF_ERROR_TOO_LARGE, hf_surface_create(&desc, &surface));
  assert_null(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faces_are_taken_as_every_host_stores_them),
      cmocka_unit_test(no_field_depends_on_the_first_corner),
      cmocka_unit_test(a_mirrored_mesh_has_the_mirrored_field),
      cmocka_unit_test(faces_of_three_corners_are_triangles),
      cmocka_unit_test(a_field_keeps_to_the_range_of_its_sites),
      cmocka_unit_test(a_hit_in_a_face_is_a_site),
      cmocka_unit_test(concave_faces_holes_and_dirt),
      cmocka_unit_test(sides_of_faces_are_counted_not_cuts),
      cmocka_unit_test(linear_fields_are_exact_on_flat_faces),
      cmocka_unit_test(quads_and_singularities_name_faces),
      cmocka_unit_test(a_pose_of_faces_follows_its_handles),
      cmocka_unit_test(the_triangle_limit_holds_for_cut_faces),
  };
  return cmocka_run_group_tests_name("faces", tests, NULL, NULL);
}
