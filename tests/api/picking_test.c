/* Picking: rays and nearest vertices against closed forms and brute force; rays through edges and vertices never miss.
 */
#include "api_support.h"

/* A closed surface: a ring of `along` x `across` vertices, radii 3 and 1, seen from outside counter-clockwise. */
enum { ALONG = 40, ACROSS = 20, RING = ALONG * ACROSS };
static float ring_positions[3 * RING];
static uint32_t ring_triangles[6 * RING];
static const Surface ring = {RING, 2 * RING, ring_positions, ring_triangles};

static uint64_t state_of_random = 88172645463325252ull;
static double random_in(double low, double high) {
  state_of_random ^= state_of_random << 13;
  state_of_random ^= state_of_random >> 7;
  state_of_random ^= state_of_random << 17;
  return low + (high - low) * (double)(state_of_random >> 11) / 9007199254740992.0;
}
static uint32_t random_below(uint32_t count) { return (uint32_t)random_in(0, count) % count; }

static void make_ring(void) {
  uint32_t* corner = ring_triangles;
  for (uint32_t i = 0; i < ALONG; ++i) {
    for (uint32_t j = 0; j < ACROSS; ++j) {
      const double s = 6.283185307179586 * i / ALONG, t = 6.283185307179586 * j / ACROSS;
      float* p = ring_positions + 3 * (i * ACROSS + j);
      p[0] = (float)((3 + cos(t)) * cos(s));
      p[1] = (float)((3 + cos(t)) * sin(s));
      p[2] = (float)sin(t);
      const uint32_t next = (i + 1) % ALONG * ACROSS, up = (j + 1) % ACROSS;
      const uint32_t a = i * ACROSS + j, b = next + j, c = i * ACROSS + up, d = next + up;
      const uint32_t corners[6] = {a, b, d, a, d, c};
      memcpy(corner, corners, sizeof corners);
      corner += 6;
    }
  }
}

static hf_hit cast(hf_surface surface, const double* origin, const double* direction, const hf_pick_desc* desc) {
  hf_hit hit;
  memset(&hit, 0x5A, sizeof hit);
  hit.struct_size = sizeof hit;
  assert_ok(hf_surface_cast_ray(surface, origin, direction, desc, &hit));
  return hit;
}

static void assert_missed(hf_surface surface, const double* origin, const double* direction, const hf_pick_desc* desc) {
  const hf_hit hit = cast(surface, origin, direction, desc);
  hf_hit none = HF_INIT(hf_hit);
  none.triangle = none.vertex = NO_INDEX;
  for (int k = 0; k < 3; ++k) none.place.corners[k] = NO_INDEX;
  assert_true(same_bits(&hit, &none, sizeof hit));
}

/* What every hit obeys: weights of sum 1 in the triangle, the place they and the ray name, the nearest corner. */
static void assert_consistent(const hf_hit* hit, const float* positions, const uint32_t* triangles,
                              const double* origin, const double* direction, double tolerance) {
  assert_int_equal(hit->found, 1);
  const uint32_t* v = triangles + 3 * (size_t)hit->triangle;
  double sum = 0, least = HUGE_VAL, to_vertex = HUGE_VAL;
  for (int k = 0; k < 3; ++k) {
    double place = 0;
    assert_int_equal(hit->place.corners[k], v[k]);
    for (int c = 0; c < 3; ++c) place += hit->place.barycentrics[c] * (double)positions[3 * (size_t)v[c] + (size_t)k];
    assert_true(fabs(place - hit->position[k]) <= tolerance);
    assert_true(fabs(origin[k] + hit->distance * direction[k] - hit->position[k]) <= tolerance);
    assert_true(hit->place.barycentrics[k] >= 0 && hit->place.barycentrics[k] <= 1);
    sum += hit->place.barycentrics[k];
  }
  assert_true(fabs(sum - 1) <= 1e-12);
  for (int c = 0; c < 3; ++c) {
    double square = 0;
    for (int k = 0; k < 3; ++k) square += pow((double)positions[3 * (size_t)v[c] + (size_t)k] - hit->position[k], 2);
    least = fmin(least, square);
    if (v[c] == hit->vertex) to_vertex = square;
  }
  assert_true(sqrt(to_vertex) <= sqrt(least) + tolerance);
}

static void a_flat_sheet_is_hit_where_its_plane_is(void** state) {
  (void)state;
  enum { COLUMNS = 7, ROWS = 5 };
  Surface sheet = surface_sheet(COLUMNS, ROWS);
  for (uint32_t v = 0; v < sheet.vertex_count; ++v) sheet.positions[3 * v + 2] = 0.5f;
  const hf_surface surface = surface_on(&sheet);
  hf_pick_desc front = HF_INIT(hf_pick_desc);
  front.front_only = 1;
  for (int i = 0; i < 2000; ++i) {
    const double x = random_in(0, COLUMNS), y = random_in(0, ROWS), height = random_in(1, 9), step = random_in(0.1, 4);
    const double target[3] = {x, y, 0.5}, slope[2] = {random_in(-1, 1), random_in(-1, 1)};
    const double direction[3] = {slope[0] * step, slope[1] * step, -step}, up[3] = {-direction[0], -direction[1], step};
    double above[3], below[3];
    for (int k = 0; k < 3; ++k) {
      above[k] = target[k] - height * direction[k] / step;
      below[k] = target[k] + height * direction[k] / step;
    }
    const hf_hit hit = cast(surface, above, direction, i % 2 ? &front : NULL);
    const uint32_t column = (uint32_t)x, row = (uint32_t)y;
    const double fx = x - column, fy = y - row;
    if (fabs(fx - fy) > 1e-9) assert_int_equal(hit.triangle, 2 * (row * COLUMNS + column) + (fx < fy));
    const double lower[3] = {1 - fx, fx - fy, fy}, upper[3] = {1 - fy, fx, fy - fx};
    for (int k = 0; k < 3; ++k) {
      assert_true(fabs(hit.place.barycentrics[k] - (hit.triangle % 2 ? upper[k] : lower[k])) <= 1e-12);
      assert_true(fabs(hit.position[k] - target[k]) <= 1e-12);
    }
    assert_true(fabs(hit.distance - height / step) <= 1e-11 * hit.distance);
    assert_consistent(&hit, sheet.positions, sheet.triangles, above, direction, 1e-11);
    /* from below the triangles are seen from behind */
    assert_missed(surface, below, up, &front);
    const hf_hit behind = cast(surface, below, up, NULL);
    assert_int_equal(behind.triangle, hit.triangle);
    /* away from the plane, along it, and beside the sheet there is nothing */
    const double along[3] = {direction[0], direction[1], 0}, beside[3] = {COLUMNS + 0.001, y, 2}, down[3] = {0, 0, -1};
    assert_missed(surface, above, up, NULL);
    assert_missed(surface, above, along, NULL);
    assert_missed(surface, beside, down, NULL);
  }
  hf_surface_destroy(surface);
  surface_free(&sheet);
}

static void a_tube_is_hit_at_its_polygon_and_on_the_near_side(void** state) {
  (void)state;
  enum { AROUND = 12, RINGS = 6 };
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_surface surface = surface_on(&tube);
  hf_pick_desc front = HF_INIT(hf_pick_desc);
  front.front_only = 1;
  const double turn = 6.283185307179586, apothem = cos(turn / 2 / AROUND);
  for (int i = 0; i < 1000; ++i) {
    const double angle = random_in(0, turn), y = random_in(0.01, RINGS - 1.01);
    const double off = fmod(angle, turn / AROUND) - turn / 2 / AROUND, radius = apothem / cos(off);
    const double axis[3] = {0, y, 0}, out[3] = {cos(angle), 0, sin(angle)}, far[3] = {5 * out[0], y, 5 * out[2]};
    const double in[3] = {-2 * out[0], 0, -2 * out[2]};
    const hf_hit inside = cast(surface, axis, out, NULL), outside = cast(surface, far, in, &front);
    assert_true(fabs(inside.distance - radius) <= 1e-6);
    assert_true(fabs(outside.distance - (5 - radius) / 2) <= 1e-6); /* the near wall, not the far one */
    assert_int_equal(inside.triangle, outside.triangle);
    assert_consistent(&inside, tube.positions, tube.triangles, axis, out, 1e-11);
    assert_consistent(&outside, tube.positions, tube.triangles, far, in, 1e-11);
    assert_missed(surface, axis, out, &front); /* seen from within, every triangle is */
  }
  hf_surface_destroy(surface);
  surface_free(&tube);
}

/* Whether every triangle at a vertex of the ring is seen from its front (side 1) or from behind (side -1). */
static int all_face(uint32_t vertex, const double* origin, double side) {
  for (uint32_t t = 0; t < ring.triangle_count; ++t) {
    const uint32_t* v = ring_triangles + 3 * t;
    if (v[0] != vertex && v[1] != vertex && v[2] != vertex) continue;
    double p[3], q[3], d[3];
    for (uint32_t k = 0; k < 3; ++k) {
      const double a = (double)ring_positions[3 * v[0] + k];
      p[k] = (double)ring_positions[3 * v[1] + k] - a;
      q[k] = (double)ring_positions[3 * v[2] + k] - a;
      d[k] = origin[k] - a;
    }
    const double volume =
        d[0] * (p[1] * q[2] - p[2] * q[1]) + d[1] * (p[2] * q[0] - p[0] * q[2]) + d[2] * (p[0] * q[1] - p[1] * q[0]);
    if (side * volume < 1e-6) return 0;
  }
  return 1;
}

static void rays_through_edges_and_vertices_never_slip_through(void** state) {
  (void)state;
  make_ring();
  const hf_surface surface = surface_on(&ring);
  hf_pick_desc front = HF_INIT(hf_pick_desc);
  front.front_only = 1;
  for (int i = 0; i < 10000;) {
    const uint32_t t = random_below(ring.triangle_count), side = random_below(3);
    const uint32_t from = ring_triangles[3 * t + side], to = ring_triangles[3 * t + (side + 1) % 3];
    const double weight = i % 8 < 2 ? 0 : i % 8 < 4 ? 0.5 : random_in(0, 1);
    const double angle = random_in(0, 6.3), reach = i % 2 ? 9 : 3;
    const double origin[3] = {reach * cos(angle), reach * sin(angle), i % 2 ? random_in(-9, 9) : 0};
    const double seen = i % 2 ? 1 : -1; /* a silhouette is left out: rounding may pass it */
    if (!all_face(from, origin, seen) || !all_face(to, origin, seen)) continue;
    double direction[3];
    for (uint32_t k = 0; k < 3; ++k) {
      const double a = (double)ring_positions[3 * from + k], b = (double)ring_positions[3 * to + k];
      direction[k] = (1 - weight) * a + weight * b - origin[k];
    }
    /* even rays start within the closed surface, odd ones outside; what is aimed at may be behind other triangles */
    const hf_hit hit = cast(surface, origin, direction, i % 2 ? &front : NULL);
    assert_int_equal(hit.found, 1);
    assert_true(hit.distance <= 1 + 1e-9);
    assert_consistent(&hit, ring_positions, ring_triangles, origin, direction, 1e-10);
    ++i;
  }
  hf_surface_destroy(surface);

  /* rays that meet corners exactly: the first of the triangles around counts */
  Surface sheet = surface_sheet(4, 4);
  for (uint32_t v = 0; v < sheet.vertex_count; ++v) sheet.positions[3 * v + 2] = 0;
  const hf_surface grid = surface_on(&sheet);
  for (uint32_t v = 0; v < sheet.vertex_count; ++v) {
    const double origin[3] = {v % 5, (double)(v / 5), 8}, down[3] = {0, 0, -4};
    uint32_t first = 0;
    while (sheet.triangles[3 * first] != v && sheet.triangles[3 * first + 1] != v &&
           sheet.triangles[3 * first + 2] != v)
      ++first;
    const hf_hit hit = cast(grid, origin, down, NULL);
    assert_int_equal(hit.vertex, v);
    assert_int_equal(hit.triangle, first);
    assert_true(hit.distance == 2);
  }
  /* and where the distances of the triangles differ by rounding alone */
  double posed[3 * 25];
  hf_pick_desc stand = HF_INIT(hf_pick_desc);
  stand.positions_f64 = posed;
  for (uint32_t v = 0; v < 25; ++v) {
    posed[3 * v] = 3 * (v % 5);
    posed[3 * v + 1] = 7 * (v / 5);
    posed[3 * v + 2] = sin(v);
  }
  for (uint32_t v = 0; v < 25; ++v) {
    const double origin[3] = {posed[3 * v], posed[3 * v + 1], 8}, down[3] = {0, 0, -1};
    uint32_t first = 0;
    while (sheet.triangles[3 * first] != v && sheet.triangles[3 * first + 1] != v &&
           sheet.triangles[3 * first + 2] != v)
      ++first;
    assert_int_equal(cast(grid, origin, down, &stand).triangle, first);
  }
  hf_surface_destroy(grid);
  surface_free(&sheet);
}

static void a_posed_surface_is_hit_where_it_stands(void** state) {
  (void)state;
  enum { AROUND = 12, RINGS = 14, COUNT = AROUND * RINGS };
  Surface tube = surface_tube(AROUND, RINGS);
  const hf_surface surface = surface_on(&tube);
  uint32_t handles[2];
  hf_pose pose = tube_pose(surface, AROUND, RINGS, handles);
  const hf_transform bent = {{0, 0, 0.38268343, 0.92387953}, {3, 1, 0}};
  assert_ok(hf_pose_set_transform(pose, handles[1], &bent));
  static float posed[3 * COUNT];
  static double doubles[4 * COUNT];
  assert_ok(hf_deform(pose, posed, NULL));
  for (uint32_t v = 0; v < COUNT; ++v)
    for (uint32_t k = 0; k < 3; ++k) doubles[4 * v + k] = (double)posed[3 * v + k];
  Surface moved = tube;
  moved.positions = posed;
  const hf_surface there = surface_on(&moved);
  hf_pick_desc floats = HF_INIT(hf_pick_desc), wide = HF_INIT(hf_pick_desc);
  floats.positions = posed;
  wide.positions_f64 = doubles;
  wide.position_stride = 4 * sizeof(double);
  int hits = 0, others = 0;
  for (int i = 0; i < 1000; ++i) {
    const uint32_t aim = random_below(COUNT);
    double origin[3], direction[3];
    for (int k = 0; k < 3; ++k) {
      origin[k] = random_in(-20, 20);
      direction[k] = (double)posed[3 * aim + (uint32_t)k] + random_in(-1, 1) - origin[k];
    }
    const hf_hit by_floats = cast(surface, origin, direction, &floats),
                 by_doubles = cast(surface, origin, direction, &wide);
    const hf_hit made = cast(there, origin, direction, NULL), rest = cast(surface, origin, direction, NULL);
    assert_true(same_bits(&by_floats, &by_doubles, sizeof by_floats));
    assert_int_equal(by_floats.found, made.found);
    if (made.found) {
      ++hits;
      others += rest.triangle != made.triangle;
      assert_int_equal(by_floats.triangle, made.triangle);
      assert_consistent(&by_floats, posed, tube.triangles, origin, direction, 1e-10);
    }
    uint32_t near_floats, near_doubles, near_made;
    double distance, again;
    assert_ok(hf_surface_find_vertex(surface, origin, &floats, &near_floats, &distance));
    assert_ok(hf_surface_find_vertex(surface, origin, &wide, &near_doubles, &again));
    assert_ok(hf_surface_find_vertex(there, origin, NULL, &near_made, NULL));
    assert_true(near_floats == near_doubles && distance == again && near_floats == near_made);
  }
  assert_true(hits > 500 && others > 300);
  hf_surface_destroy(there);
  hf_surface_destroy(surface);
  hf_pose_destroy(pose);
  surface_free(&tube);
}

static void triangles_of_16_bits_give_the_same_bits_on_any_thread_count(void** state) {
  (void)state;
  make_ring();
  enum { STRIDE = 9 };
  static unsigned char narrow[STRIDE * 2 * RING];
  for (uint32_t t = 0; t < ring.triangle_count; ++t) {
    const uint16_t corners[3] = {(uint16_t)ring_triangles[3 * t], (uint16_t)ring_triangles[3 * t + 1],
                                 (uint16_t)ring_triangles[3 * t + 2]};
    memcpy(narrow + (size_t)STRIDE * t, corners, sizeof corners);
  }
  hf_surface_desc desc = options_of(&ring).surface;
  desc.triangles = NULL;
  desc.triangles_u16 = (const uint16_t*)(const void*)narrow;
  desc.triangle_stride = STRIDE;
  desc.thread_count = 3;
  hf_surface small = NULL;
  assert_ok(hf_surface_create(&desc, &small));
  const hf_surface large = surface_on(&ring);
  for (int i = 0; i < 2000; ++i) {
    const double origin[3] = {random_in(-5, 5), random_in(-5, 5), random_in(-5, 5)};
    const double direction[3] = {random_in(-1, 1), random_in(-1, 1), random_in(-1, 1)};
    const hf_hit a = cast(small, origin, direction, NULL), b = cast(large, origin, direction, NULL);
    assert_true(same_bits(&a, &b, sizeof a));
  }
  hf_surface_destroy(small);
  hf_surface_destroy(large);
}

static void the_nearest_vertex_is_that_of_brute_force(void** state) {
  (void)state;
  Surface cut = surface_cut();
  const hf_surface surface = surface_on(&cut);
  for (int i = 0; i < 3000; ++i) {
    const double point[3] = {random_in(-2, 32), random_in(-2, 6), random_in(-2, 4)};
    double least = HUGE_VAL;
    uint32_t expected = 0, found = 77;
    for (uint32_t v = 0; v < CUT_ISOLATED; ++v) { /* the isolated vertex is passed over */
      double square = 0;
      for (uint32_t k = 0; k < 3; ++k) square += pow((double)cut.positions[3 * v + k] - point[k], 2);
      if (square < least) {
        least = square;
        expected = v;
      }
    }
    double distance = -1;
    assert_ok(hf_surface_find_vertex(surface, point, NULL, &found, &distance));
    assert_int_equal(found, expected);
    assert_true(fabs(distance - sqrt(least)) <= 1e-12 * 40);
    assert_ok(hf_surface_find_vertex(surface, point, NULL, &found, NULL));
  }
  /* of welded copies the first, at distance 0 */
  double seam[3], distance = -1;
  for (uint32_t k = 0; k < 3; ++k) seam[k] = (double)cut.positions[3 * CUT_SEAM_RIGHT + k];
  uint32_t vertex = 0;
  assert_ok(hf_surface_find_vertex(surface, seam, NULL, &vertex, &distance));
  assert_int_equal(vertex, CUT_SEAM_LEFT);
  assert_true(distance < 1e-12);
  hf_surface_destroy(surface);
  surface_free(&cut);
}

#define BAD(what, expected, index, call) check_row(__LINE__, what, #call, (call), expected, index)

static void bad_input_is_named(void** state) {
  (void)state;
  Surface cut = surface_cut();
  const hf_surface s = surface_on(&cut);
  double o[3] = {1, 1, 9}, d[3] = {0, 0, -1}, doubles[3 * CUT_VERTICES] = {0};
  const double zero[3] = {0, 0, 0};
  hf_hit hit = HF_INIT(hf_hit), before;
  hit.distance = 777;
  before = hit;
  hf_pick_desc pick = HF_INIT(hf_pick_desc);
  uint32_t vertex = 777;
  BAD("origin NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_cast_ray(s, NULL, d, NULL, &hit));
  BAD("direction NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_cast_ray(s, o, NULL, NULL, &hit));
  BAD("hit NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_cast_ray(s, o, d, NULL, NULL));
  BAD("direction 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, hf_surface_cast_ray(s, o, zero, NULL, &hit));
  BAD("point NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_find_vertex(s, NULL, NULL, &vertex, NULL));
  BAD("vertex NULL", HF_ERROR_NULL_POINTER, NO_INDEX, hf_surface_find_vertex(s, o, NULL, NULL, NULL));
  o[1] = (double)NAN;
  BAD("origin NaN", HF_ERROR_NON_FINITE, NO_INDEX, hf_surface_cast_ray(s, o, d, NULL, &hit));
  BAD("point NaN", HF_ERROR_NON_FINITE, NO_INDEX, hf_surface_find_vertex(s, o, NULL, &vertex, NULL));
  o[1] = 1;
  d[2] = HUGE_VAL;
  BAD("direction infinite", HF_ERROR_NON_FINITE, NO_INDEX, hf_surface_cast_ray(s, o, d, NULL, &hit));
  d[2] = -1;
  const double away[] = {1e20, 1e155, -1e200, 1.7e308}; /* so far that no vertex is nearer than another */
  for (size_t i = 0; i < COUNT_OF(away); ++i) {
    const double far[3] = {away[i], 0, 0};
    BAD("a point far away", HF_ERROR_TOO_LARGE, NO_INDEX, hf_surface_find_vertex(s, far, NULL, &vertex, NULL));
  }
#define PICK(what, expected, index, change)                              \
  pick = HF_INIT(hf_pick_desc), pick.positions_f64 = doubles, change;    \
  BAD(what, expected, index, hf_surface_cast_ray(s, o, d, &pick, &hit)); \
  BAD(what, expected, index, hf_surface_find_vertex(s, o, &pick, &vertex, NULL))
  PICK("both positions", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, pick.positions = cut.positions);
  PICK("stride of floats", HF_ERROR_TOO_SMALL, NO_INDEX, pick.position_stride = 12);
  PICK("front_only 2", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, pick.front_only = 2);
  PICK("reserved set", HF_ERROR_INVALID_DESC, NO_INDEX, pick.reserved = 1);
  PICK("a posed vertex NaN", HF_ERROR_NON_FINITE, 13, doubles[3 * 13 + 1] = (double)NAN);
  PICK("a posed vertex infinite", HF_ERROR_NON_FINITE, 13, doubles[3 * 13 + 1] = HUGE_VAL);
  pick = HF_INIT(hf_pick_desc);
  pick.positions_f64 = doubles;
  for (size_t i = 0; i < COUNT_OF(doubles); ++i) doubles[i] = 1e200;
  BAD("all posed vertices far away", HF_ERROR_TOO_LARGE, NO_INDEX,
      hf_surface_find_vertex(s, zero, &pick, &vertex, NULL));
  assert_true(same_bits(&hit, &before, sizeof hit));
  assert_int_equal(vertex, 777);
  finish_rows("picking");
  hf_surface_destroy(s);
  surface_free(&cut);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_flat_sheet_is_hit_where_its_plane_is),
      cmocka_unit_test(a_tube_is_hit_at_its_polygon_and_on_the_near_side),
      cmocka_unit_test(rays_through_edges_and_vertices_never_slip_through),
      cmocka_unit_test(a_posed_surface_is_hit_where_it_stands),
      cmocka_unit_test(triangles_of_16_bits_give_the_same_bits_on_any_thread_count),
      cmocka_unit_test(the_nearest_vertex_is_that_of_brute_force),
      cmocka_unit_test(bad_input_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
