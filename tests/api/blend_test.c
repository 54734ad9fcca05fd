/* The blend of a pose: what a shader computes from rows and transforms is what hf_deform writes. */
#include "api_support.h"

enum { AROUND = 16, RINGS = 30, TUBE = AROUND * RINGS, ALL = TUBE + CUT_VERTICES };

/* What a host keeps for its shader. */
typedef struct Blend {
  hf_blend_info info;
  hf_blend_rows rows;
} Blend;

static Blend blend_of(hf_pose pose) {
  Blend b = {HF_INIT(hf_blend_info), HF_INIT(hf_blend_rows)};
  assert_ok(hf_pose_get_blend_info(pose, &b.info));
  assert_ok(hf_pose_get_blend_rows(pose, &b.rows));
  b.rows.vertex_capacity = b.rows.vertex_count;
  b.rows.entry_capacity = b.rows.entry_count;
  b.rows.rows = malloc(sizeof(uint32_t) * 2 * b.rows.vertex_count);
  b.rows.positions = malloc(sizeof(float) * 3 * b.rows.vertex_count);
  b.rows.offsets = malloc(sizeof(float) * 3 * b.rows.vertex_count);
  b.rows.clusters = malloc(sizeof(uint16_t) * b.rows.entry_count);
  b.rows.weights = malloc(sizeof(float) * b.rows.entry_count);
  b.rows.normals = malloc(sizeof(float) * 3 * b.rows.vertex_count);
  b.rows.gradients = malloc(sizeof(float) * 3 * b.rows.entry_count);
  assert_ok(hf_pose_get_blend_rows(pose, &b.rows));
  return b;
}
static void blend_free(Blend* b) {
  free(b->rows.rows);
  free(b->rows.positions);
  free(b->rows.offsets);
  free(b->rows.clusters);
  free(b->rows.weights);
  free(b->rows.normals);
  free(b->rows.gradients);
}

/* The vertices in floats, as a shader computes them. */
static void shade(const Blend* b, const hf_blend_info* frame, const float* transforms, float* out) {
  for (size_t v = 0; v < b->rows.vertex_count; ++v) {
    const uint32_t first = b->rows.rows[2 * v], count = b->rows.rows[2 * v + 1];
    const float* p = b->rows.positions + 3 * v;
    assert_true(count >= 1 && count <= b->rows.longest_row && first + count <= b->rows.entry_count);
    float sum = 0, x[3] = {0, 0, 0};
    for (uint32_t e = first; e < first + count; ++e) {
      assert_true(b->rows.clusters[e] < frame->cluster_count);
      const float *a = transforms + 12 * (size_t)b->rows.clusters[e], w = b->rows.weights[e];
      for (int i = 0; i < 3; ++i)
        x[i] += w * (a[4 * i] * p[0] + a[4 * i + 1] * p[1] + a[4 * i + 2] * p[2] + a[4 * i + 3]);
      sum += w;
    }
    assert_true(sum == 1);
    for (size_t i = 0; i < 3; ++i) out[3 * v + i] = x[i] + (float)frame->offset_share * b->rows.offsets[3 * v + i];
  }
}

static hf_blend_info frame_of(hf_pose pose, float* transforms, uint32_t capacity) {
  hf_blend_info info = HF_INIT(hf_blend_info);
  uint32_t count = 0;
  assert_ok(hf_pose_get_blend_info(pose, &info));
  assert_ok(hf_pose_get_blend_transforms(pose, capacity, transforms, &count));
  assert_int_equal(count, info.cluster_count);
  return info;
}

/* The box holds the vertices. Returns how many times its diagonal is longer than needed. */
static double too_large(const hf_blend_info* info, const float* shaded, uint32_t vertices) {
  double needed = 0, given = 0;
  for (size_t c = 0; c < 3; ++c) {
    double low = 1e30, high = -1e30;
    for (size_t v = 0; v < vertices; ++v) {
      low = fmin(low, (double)shaded[3 * v + c]);
      high = fmax(high, (double)shaded[3 * v + c]);
    }
    assert_true(info->low[c] <= low && high <= info->high[c]);
    needed += (high - low) * (high - low);
    given += (info->high[c] - info->low[c]) * (info->high[c] - info->low[c]);
  }
  return sqrt(given / needed);
}

/* A frame of two poses that are alike, one by a shader. Returns how far the vertices are apart. */
static double off(hf_pose pose, hf_pose twin, const Blend* b) {
  static float transforms[12 * 4096], shaded[3 * ALL];
  static double exact[3 * ALL];
  assert_ok(hf_pose_solve(pose, 0, 0, NULL));
  const hf_blend_info info = frame_of(pose, transforms, 4096);
  assert_int_equal(info.revision, b->info.revision);
  shade(b, &info, transforms, shaded);
  assert_true(too_large(&info, shaded, b->rows.vertex_count) < 1.1); /* a small mesh: the box of its vertices */
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = HF_ARRAY_OUT(exact, b->rows.vertex_count);
  assert_ok(hf_pose_deform(twin, &desc, NULL));
  double most = 0;
  for (size_t i = 0; i < 3 * (size_t)b->rows.vertex_count; ++i)
    most = fmax(most, fabs(info.centre[i % 3] + (double)shaded[i] - exact[i]));
  return most;
}

/* A tube and the cut sheet, a seam, a piece without a handle and an isolated vertex among it, far from 0. */
static float points[3 * ALL];
static uint32_t corners[3 * (2 * AROUND * (RINGS - 1) + CUT_TRIANGLES)];
static hf_surface whole_surface(float far) {
  Surface tube = surface_tube(AROUND, RINGS), cut = surface_cut();
  for (size_t i = 0; i < 3 * TUBE; ++i) points[i] = tube.positions[i] + far;
  for (size_t i = 0; i < 3 * CUT_VERTICES; ++i) points[3 * TUBE + i] = cut.positions[i] + far + (i % 3 ? 0 : 5.0f);
  memcpy(corners, tube.triangles, sizeof(uint32_t) * 3 * tube.triangle_count);
  for (size_t i = 0; i < 3 * (size_t)cut.triangle_count; ++i)
    corners[3 * (size_t)tube.triangle_count + i] = cut.triangles[i] + TUBE;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(points, ALL);
  desc.triangles = HF_ARRAY(corners, tube.triangle_count + cut.triangle_count);
  hf_surface surface;
  assert_ok(hf_surface_create(&desc, &surface));
  surface_free(&tube);
  surface_free(&cut);
  return surface;
}

static hf_transform drag(double t) {
  const hf_transform at = {{0.2 * sin(t), 0, 0.3 * sin(t), 1}, {3 * sin(t), -2 * sin(2 * t), sin(t)}};
  return at;
}

static const double close = 1e-5 * 40; /* of the box; floats, and transforms that turn far */

static void a_shader_has_the_vertices_of_hf_deform(void** state) {
  (void)state;
  for (int far = 0; far < 2; ++far) {
    hf_surface surface = whole_surface(far ? 1e4f : 0);
    uint32_t handles[2], middle;
    hf_pose pose = tube_pose(surface, AROUND, RINGS, handles), twin;
    assert_ok(hf_pose_clone(pose, &twin));
    Blend b = blend_of(pose);
    assert_int_equal(b.rows.vertex_count, ALL);
    static float at_rest[12 * 4096];
    const uint32_t count = frame_of(pose, at_rest, 4096).cluster_count; /* before the first frame */
    for (uint32_t k = 0; k < 12 * count; ++k) assert_true(at_rest[k] == (k % 12 % 5 == 0 ? 1.0f : 0.0f));
    for (uint32_t f = 1; f < 8; ++f) {
      const hf_transform to = drag(0.3 * f);
      assert_ok(hf_pose_set_transform(pose, handles[1], &to));
      assert_ok(hf_pose_set_transform(twin, handles[1], &to));
      assert_true(off(pose, twin, &b) < close);
    }
    /* a handle in place: an offset that fades */
    const double at[3] = {(double)points[3 * 15 * AROUND], (double)points[3 * 15 * AROUND + 1],
                          (double)points[3 * 15 * AROUND + 2]};
    const double radius = 1.2;
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.handle_count = 1;
    desc.points = at;
    desc.radii = &radius;
    desc.in_place = 1;
    assert_ok(hf_pose_add_handles(pose, &desc, &middle));
    assert_ok(hf_pose_add_handles(twin, &desc, &middle));
    hf_blend_info info = HF_INIT(hf_blend_info);
    assert_ok(hf_pose_get_blend_info(pose, &info));
    assert_int_not_equal(info.revision, b.info.revision);
    assert_true(info.offset_share == 1);
    blend_free(&b);
    b = blend_of(pose);
    double share = 1;
    for (uint32_t f = 8; f < 30; ++f) {
      const hf_transform to = drag(2.1 + 0.01 * (f - 8));
      assert_ok(hf_pose_set_transform(pose, handles[1], &to));
      assert_ok(hf_pose_set_transform(twin, handles[1], &to));
      assert_true(off(pose, twin, &b) < close);
      assert_ok(hf_pose_get_blend_info(pose, &info));
      share = fmin(share, info.offset_share);
    }
    assert_true(share > 0 && share < 0.5); /* on its way */
    blend_free(&b);
    hf_pose_destroy(pose);
    hf_pose_destroy(twin);
    hf_surface_destroy(surface);
  }
}

/* A frame by rows of one length. Returns the largest change of a vertex's weights and the largest distance of a vertex
 * from its place; no vertex may go farther than its change allows. */
static void brute(const Blend* b, const float* transforms, uint32_t count, uint32_t total, const uint32_t* clusters,
                  const uint32_t* weights, double* change, double* error) {
  *change = *error = 0;
  for (size_t v = 0; v < b->rows.vertex_count; ++v) {
    static double places[4096][3], differences[4096];
    const float* p = b->rows.positions + 3 * v;
    uint32_t used[64 + 256], uses = 0, sum = 0;
    double half = 0, away[3] = {0, 0, 0}, spread = 0, far = 0;
    for (int known = 0; known < 2; ++known) {
      const uint32_t length = known ? count : b->rows.rows[2 * v + 1], first = b->rows.rows[2 * v];
      for (uint32_t e = 0; e < length; ++e) {
        const uint32_t c = known ? clusters[count * v + e] : b->rows.clusters[first + e];
        const double w = known ? weights[count * v + e] / (double)total : (double)b->rows.weights[first + e];
        uint32_t at = 0;
        while (at < uses && used[at] != c) ++at;
        if (at == uses) {
          used[uses++] = c;
          differences[at] = 0;
          const float* a = transforms + 12 * (size_t)c;
          for (int i = 0; i < 3; ++i)
            places[at][i] = (double)a[4 * i] * (double)p[0] + (double)a[4 * i + 1] * (double)p[1] +
                            (double)a[4 * i + 2] * (double)p[2] + (double)a[4 * i + 3];
        }
        differences[at] += known ? w : -w;
        if (known) {
          assert_true(e == 0 || weights[count * v + e] <= weights[count * v + e - 1]);
          sum += weights[count * v + e];
        }
      }
    }
    assert_int_equal(sum, total);
    for (uint32_t i = 0; i < uses; ++i) {
      half += 0.5 * fabs(differences[i]);
      for (int k = 0; k < 3; ++k) away[k] += differences[i] * places[i][k];
      for (uint32_t j = 0; j < i; ++j)
        spread = fmax(spread, hypot(hypot(places[i][0] - places[j][0], places[i][1] - places[j][1]),
                                    places[i][2] - places[j][2]));
    }
    far = hypot(hypot(away[0], away[1]), away[2]);
    assert_true(far <= half * spread + 1e-9);
    *change = fmax(*change, half);
    *error = fmax(*error, far);
  }
}

static void rows_of_one_length_are_off_by_what_they_say(void** state) {
  (void)state;
  hf_surface surface = whole_surface(0);
  hf_surface_report box = HF_INIT(hf_surface_report);
  uint32_t handles[2], middle;
  hf_pose pose = tube_pose(surface, AROUND, RINGS, handles);
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  const uint32_t size = 3, region[3] = {15 * AROUND, 15 * AROUND + 1, 15 * AROUND + 2};
  desc.handle_count = 1;
  desc.region_counts = &size;
  desc.region_vertices = region;
  assert_ok(hf_pose_add_handles(pose, &desc, &middle));
  const hf_transform to = drag(2.1);
  assert_ok(hf_pose_set_transform(pose, handles[1], &to));
  assert_ok(hf_pose_solve(pose, 0, 0, NULL));
  assert_ok(hf_surface_get_report(surface, &box));
  Blend b = blend_of(pose);
  static float transforms[12 * 4096];
  frame_of(pose, transforms, 4096);
  double before = 2;
  for (uint32_t count = 1; count <= 64; count = count < 4 ? count + 1 : 4 * count) {
    hf_blend_influences rows_of = HF_INIT(hf_blend_influences);
    rows_of.influence_count = count;
    assert_ok(hf_pose_get_blend_influences(pose, &rows_of)); /* the errors, without arrays */
    const double change = rows_of.change, error = rows_of.error;
    assert_int_equal(rows_of.vertex_count, ALL);
    rows_of.vertex_capacity = ALL;
    const size_t entries = (size_t)ALL * count;
    rows_of.clusters = malloc(sizeof(uint16_t) * entries);
    rows_of.weights = malloc(sizeof(uint16_t) * entries);
    rows_of.byte_clusters = malloc(entries);
    rows_of.byte_weights = malloc(entries);
    assert_ok(hf_pose_get_blend_influences(pose, &rows_of));
    assert_true(rows_of.change == change && rows_of.error == error);
    uint32_t *clusters = malloc(sizeof(uint32_t) * entries), *weights = malloc(sizeof(uint32_t) * entries);
    for (int bytes = 0; bytes < 2; ++bytes) {
      for (size_t i = 0; i < entries; ++i) {
        clusters[i] = bytes ? rows_of.byte_clusters[i] : rows_of.clusters[i];
        weights[i] = bytes ? rows_of.byte_weights[i] : rows_of.weights[i];
      }
      double found, far;
      brute(&b, transforms, count, bytes ? 255 : 65535, clusters, weights, &found, &far);
      const double told = bytes ? rows_of.byte_change : rows_of.change;
      const double farthest = (bytes ? rows_of.byte_error : rows_of.error) * box.bounding_box_diagonal;
      assert_true(fabs(found - told) < 1e-9);
      assert_true(fabs(far - farthest) < 1e-5 * box.bounding_box_diagonal); /* transforms are floats here */
    }
    assert_true(rows_of.change <= before); /* longer rows are never worse */
    before = rows_of.change;
    if (count >= b.rows.longest_row) assert_true(rows_of.change < 64 / 65535.0);
    free(rows_of.clusters);
    free(rows_of.weights);
    free(rows_of.byte_clusters);
    free(rows_of.byte_weights);
    free(clusters);
    free(weights);
  }
  assert_true(before < 64 / 65535.0);
  blend_free(&b);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
}

static void clusters_of_a_byte_are_refused_above_256(void** state) {
  (void)state;
  hf_surface surface = whole_surface(0);
  hf_pose pose;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  static uint8_t bytes[8 * ALL];
  static uint16_t words[8 * ALL];
  hf_blend_info info = HF_INIT(hf_blend_info);
  for (uint32_t ring = 0; ring < RINGS && info.cluster_count <= 256; ++ring) { /* handles until there are enough */
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    const uint32_t sizes[AROUND / 2] = {1, 1, 1, 1, 1, 1, 1, 1};
    uint32_t vertices[AROUND / 2], made[AROUND / 2];
    for (uint32_t i = 0; i < AROUND / 2; ++i) vertices[i] = ring * AROUND + 2 * i;
    desc.handle_count = AROUND / 2;
    desc.region_counts = sizes;
    desc.region_vertices = vertices;
    assert_ok(hf_pose_add_handles(pose, &desc, made));
    assert_ok(hf_pose_get_blend_info(pose, &info));
    hf_blend_influences rows_of = HF_INIT(hf_blend_influences);
    rows_of.vertex_capacity = ALL;
    rows_of.byte_clusters = bytes;
    const hf_result result = hf_pose_get_blend_influences(pose, &rows_of);
    assert_int_equal(result, info.cluster_count > 256 ? HF_ERROR_TOO_LARGE : HF_OK);
    if (result == HF_OK) continue;
    hf_error_detail detail;
    assert_ok(hf_error_get_detail(&detail));
    assert_non_null(strstr(detail.message, "at most 256"));
    rows_of.byte_clusters = NULL; /* what the text says to do */
    rows_of.clusters = words;
    assert_ok(hf_pose_get_blend_influences(pose, &rows_of));
  }
  assert_true(info.cluster_count > 256);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
}

/* Where the shader takes a tangent: J u of the header. */
static void push(const Blend* b, const float* transforms, size_t v, const float u[3], float out[3]) {
  const float* p = b->rows.positions + 3 * v;
  for (int i = 0; i < 3; ++i) out[i] = 0;
  for (uint32_t e = b->rows.rows[2 * v]; e < b->rows.rows[2 * v] + b->rows.rows[2 * v + 1]; ++e) {
    const float *a = transforms + 12 * (size_t)b->rows.clusters[e], *g = b->rows.gradients + 3 * (size_t)e;
    const float along = g[0] * u[0] + g[1] * u[1] + g[2] * u[2], w = b->rows.weights[e];
    for (int i = 0; i < 3; ++i)
      out[i] += w * (a[4 * i] * u[0] + a[4 * i + 1] * u[1] + a[4 * i + 2] * u[2]) +
                along * (a[4 * i] * p[0] + a[4 * i + 1] * p[1] + a[4 * i + 2] * p[2] + a[4 * i + 3]);
  }
}

static void cross_of(const float a[3], const float b[3], float out[3]) {
  float length = 0;
  for (int i = 0; i < 3; ++i) {
    out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    length += out[i] * out[i];
  }
  for (int i = 0; i < 3; ++i) out[i] /= sqrtf(length);
}

static void normals_of_a_shader_are_those_of_hf_deform(void** state) {
  (void)state;
  enum { ROUND = 64, LONG = 120, COUNT = ROUND * LONG };
  Surface tube = surface_tube(ROUND, LONG);
  for (size_t v = 0; v < COUNT; ++v) tube.positions[3 * v + 1] *= 0.1f; /* as far along as around */
  hf_surface surface = surface_on(&tube);
  uint32_t handles[2];
  hf_pose pose = tube_pose(surface, ROUND, LONG, handles);
  Blend b = blend_of(pose);
  static float transforms[12 * 4096], normals[3 * COUNT], shaded[3 * COUNT];
  double most = 0, mean = 0;
  for (uint32_t f = 0; f < 8; ++f) {
    const hf_transform to = drag(0.3 * f);
    assert_ok(hf_pose_set_transform(pose, handles[1], &to));
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    desc.normals = HF_ARRAY_OUT(normals, COUNT);
    assert_ok(hf_pose_deform(pose, &desc, NULL));
    const hf_blend_info info = frame_of(pose, transforms, 4096);
    shade(&b, &info, transforms, shaded);
    assert_true(too_large(&info, shaded, COUNT) < 2); /* the boxes of the clusters */
    for (size_t v = 0; v < COUNT; ++v) {
      const float *n = b.rows.normals + 3 * v, axis[3] = {fabsf(n[0]) < 0.5f, fabsf(n[0]) >= 0.5f, 0};
      float u[3], w[3], ju[3], jw[3], normal[3];
      cross_of(n, axis, u);
      cross_of(n, u, w);
      push(&b, transforms, v, u, ju);
      push(&b, transforms, v, w, jw);
      cross_of(ju, jw, normal);
      double sine = 0, cosine = 0;
      for (int i = 0; i < 3; ++i) {
        const double c = (double)normal[(i + 1) % 3] * (double)normals[3 * v + (size_t)(i + 2) % 3] -
                         (double)normal[(i + 2) % 3] * (double)normals[3 * v + (size_t)(i + 1) % 3];
        sine += c * c;
        cosine += (double)(normal[i] * normals[3 * v + (size_t)i]);
      }
      const double angle = atan2(sqrt(sine), cosine) * 57.29577951308232;
      most = fmax(most, angle);
      mean += angle / (8.0 * COUNT);
    }
  }
  assert_true(mean < 0.02 && most < 2); /* the largest beside handles of a tube that is bent hard: second order */
  blend_free(&b);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void a_solve_has_the_bits_of_a_deform(void** state) {
  (void)state;
  hf_surface surface = whole_surface(0);
  uint32_t handles[2];
  hf_pose pose = tube_pose(surface, AROUND, RINGS, handles), other;
  assert_ok(hf_pose_clone(pose, &other));
  static float a[3 * ALL], b[3 * ALL];
  for (uint32_t f = 0; f < 12; ++f) {
    const hf_transform to = drag(0.3 * f);
    assert_ok(hf_pose_set_transform(pose, handles[1], &to));
    assert_ok(hf_pose_set_transform(other, handles[1], &to));
    if (f == 9) { /* the surface stays, though one pose has not written it */
      assert_ok(hf_pose_set_free_rotations(pose, 1, &handles[1], 1));
      assert_ok(hf_pose_set_free_rotations(other, 1, &handles[1], 1));
    }
    hf_deform_desc desc = HF_INIT(hf_deform_desc);
    hf_deform_info by_deform = HF_INIT(hf_deform_info), by_solve = HF_INIT(hf_deform_info);
    desc.positions = HF_ARRAY_OUT(a, ALL);
    desc.restart = f == 6;
    desc.iteration_count = 3;
    assert_ok(hf_pose_deform(pose, &desc, &by_deform));
    assert_ok(hf_pose_solve(other, 3, f == 6, &by_solve));
    assert_memory_equal(&by_deform, &by_solve, sizeof by_solve);
    if (f % 4 < 3) continue; /* vertices between solves change nothing */
    static float ta[12 * 4096], tb[12 * 4096];
    const hf_blend_info info = frame_of(pose, ta, 4096);
    frame_of(other, tb, 4096);
    assert_memory_equal(ta, tb, sizeof(float) * 12 * info.cluster_count);
    assert_ok(hf_deform(pose, a, NULL));
    assert_ok(hf_deform(other, b, NULL));
    assert_memory_equal(a, b, sizeof a);
  }
  hf_pose_destroy(pose);
  hf_pose_destroy(other);
  hf_surface_destroy(surface);
}

static float largest_entry(hf_pose pose) {
  static float transforms[12 * 4096];
  const hf_blend_info info = frame_of(pose, transforms, 4096);
  float most = 0;
  for (uint32_t k = 0; k < 12 * info.cluster_count; ++k) most = fmaxf(most, fabsf(transforms[k]));
  return most;
}

static void the_blend_is_that_of_the_last_frame(void** state) {
  (void)state;
  hf_surface surface = whole_surface(0);
  uint32_t handles[2], middle;
  hf_pose pose = tube_pose(surface, AROUND, RINGS, handles), copy;
  const hf_transform to = drag(2.1);
  assert_ok(hf_pose_set_transform(pose, handles[1], &to));
  assert_ok(hf_pose_solve(pose, 0, 0, NULL));
  /* a clone of a pose without vertices has its surface */
  static float a[3 * ALL], b[3 * ALL];
  assert_ok(hf_pose_clone(pose, &copy));
  assert_ok(hf_deform(pose, a, NULL));
  assert_ok(hf_deform(copy, b, NULL));
  assert_memory_equal(a, b, sizeof a);
  hf_pose_destroy(copy);
  /* new clusters rest until they are solved; they do not vanish */
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  const uint32_t size = 3, region[3] = {15 * AROUND, 15 * AROUND + 1, 15 * AROUND + 2};
  desc.handle_count = 1;
  desc.region_counts = &size;
  desc.region_vertices = region;
  assert_ok(hf_pose_add_handles(pose, &desc, &middle));
  assert_true(largest_entry(pose) == 1);
  assert_ok(hf_pose_remove_handles(pose, 1, &middle));
  /* the share of an offset is that of the frame, not of transforms that no frame has shown, and ends for good */
  desc.in_place = 1;
  assert_ok(hf_deform(pose, a, NULL));
  assert_ok(hf_pose_add_handles(pose, &desc, &middle));
  hf_blend_info info = HF_INIT(hf_blend_info);
  const hf_transform away = {{0, 0, 0, 1}, {30, 0, 0}};
  assert_ok(hf_pose_set_transform(pose, handles[1], &away));
  assert_ok(hf_pose_get_blend_info(pose, &info));
  assert_true(info.offset_share == 1);
  assert_ok(hf_pose_solve(pose, 0, 0, NULL));
  assert_ok(hf_pose_set_transform(pose, handles[1], &to));
  assert_ok(hf_pose_solve(pose, 0, 0, NULL));
  assert_ok(hf_pose_get_blend_info(pose, &info));
  assert_true(info.offset_share == 0);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
}

static void what_is_no_blend_is_refused(void** state) {
  (void)state;
  hf_surface surface = whole_surface(0);
  uint32_t handles[2], fine;
  hf_blend_info info = HF_INIT(hf_blend_info);
  hf_blend_rows rows_of = HF_INIT(hf_blend_rows);
  float transforms[12];
  uint32_t count = 7;
  hf_pose empty;
  assert_ok(hf_pose_create(surface, NULL, &empty));
  assert_code(HF_ERROR_EMPTY, hf_pose_get_blend_info(empty, &info));
  assert_code(HF_ERROR_EMPTY, hf_pose_solve(empty, 0, 0, NULL));
  hf_pose_destroy(empty);

  hf_pose pose = tube_pose(surface, AROUND, RINGS, handles);
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_solve(pose, 1001, 0, NULL));
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_solve(pose, 0, 2, NULL));
  assert_code(HF_ERROR_NULL_POINTER, hf_pose_get_blend_transforms(pose, 0, NULL, NULL));
  assert_code(HF_ERROR_TOO_SMALL, hf_pose_get_blend_transforms(pose, 1, transforms, &count));
  assert_int_not_equal(count, 7);
  rows_of.weights = transforms;
  rows_of.entry_capacity = 12;
  assert_code(HF_ERROR_TOO_SMALL, hf_pose_get_blend_rows(pose, &rows_of));
  rows_of.weights = NULL;
  hf_blend_influences fixed = HF_INIT(hf_blend_influences);
  fixed.influence_count = 65;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_pose_get_blend_influences(pose, &fixed));
  uint8_t bytes[8];
  fixed.influence_count = 8;
  fixed.vertex_capacity = 1;
  fixed.byte_weights = bytes;
  assert_code(HF_ERROR_TOO_SMALL, hf_pose_get_blend_influences(pose, &fixed));

  const uint32_t island = TUBE + CUT_ISLAND;
  assert_ok(hf_pose_set_rigid_pieces(pose, 1, &island));
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_get_blend_info(pose, &info));
  assert_ok(hf_pose_set_rigid_pieces(pose, 0, NULL));
  assert_ok(hf_pose_get_blend_info(pose, &info));
  assert_ok(hf_pose_set_limb_refine(pose, 1, handles, 4));
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_get_blend_transforms(pose, 0, NULL, &count));
  assert_ok(hf_pose_solve(pose, 0, 0, NULL)); /* it still solves */
  assert_ok(hf_pose_set_limb_refine(pose, 1, handles, 0));
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  const uint32_t size = 3, region[3] = {15 * AROUND, 15 * AROUND + 1, 15 * AROUND + 2};
  desc.handle_count = 1;
  desc.region_counts = &size;
  desc.region_vertices = region;
  desc.layer = 1;
  assert_ok(hf_pose_add_handles(pose, &desc, &fine));
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_get_blend_rows(pose, &rows_of));
  fixed.byte_weights = NULL;
  assert_code(HF_ERROR_UNSUPPORTED, hf_pose_get_blend_influences(pose, &fixed));
  assert_ok(hf_pose_remove_handles(pose, 1, &fine));
  assert_ok(hf_pose_get_blend_rows(pose, &rows_of));
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_shader_has_the_vertices_of_hf_deform),
      cmocka_unit_test(normals_of_a_shader_are_those_of_hf_deform),
      cmocka_unit_test(rows_of_one_length_are_off_by_what_they_say),
      cmocka_unit_test(clusters_of_a_byte_are_refused_above_256),
      cmocka_unit_test(a_solve_has_the_bits_of_a_deform),
      cmocka_unit_test(the_blend_is_that_of_the_last_frame),
      cmocka_unit_test(what_is_no_blend_is_refused),
  };
  return cmocka_run_group_tests_name("blend", tests, NULL, NULL);
}
