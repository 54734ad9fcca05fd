/* hf/quads.h from the outside: a quad mesh of a tube in the caller's arrays, streamlines, cancelling, and what bad
 * input is answered. */
#include "api_support.h"

enum { AROUND = 24, RINGS = 21, COUNT = AROUND * RINGS };

static hf_surface tube_on(Surface* mesh) {
  *mesh = surface_tube(AROUND, RINGS);
  return surface_on(mesh);
}

static hf_quads_desc quads_desc(void) {
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.edge_length = 1;
  return desc;
}

static void a_tube_becomes_a_closed_net_of_quads(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  hf_quads_desc desc = quads_desc();
  hf_quads quads = NULL;
  assert_ok(hf_quads_create(surface, &desc, &quads));
  hf_quads_info info = HF_INIT(hf_quads_info);
  assert_ok(hf_quads_get_info(quads, &info));
  assert_int_equal(info.euler_characteristic, 0);
  assert_true(fabs(info.edge_length - 1) < 1e-6);
  double* positions = calloc(info.vertex_count, 3 * sizeof *positions);
  double* weights = calloc(info.vertex_count, 3 * sizeof *weights);
  uint32_t* triangles = calloc(info.vertex_count, sizeof *triangles);
  uint32_t* corners = calloc(info.vertex_count, 3 * sizeof *corners);
  uint32_t* faces = calloc(info.face_count, 4 * sizeof *faces);
  hf_quads_mesh net = HF_INIT(hf_quads_mesh);
  net.vertex_capacity = info.vertex_count;
  net.face_capacity = info.face_count;
  net.positions = positions;
  net.triangles = triangles;
  net.barycentrics = weights;
  net.corners = corners;
  net.faces = faces;
  assert_ok(hf_quads_get_mesh(quads, &net));
  assert_int_equal(net.vertex_count, info.vertex_count);
  assert_int_equal(net.face_count, info.face_count);
  for (uint32_t i = 0; i < 4 * info.face_count; ++i) {
    assert_true(faces[i] < info.vertex_count);
    for (uint32_t k = i / 4 * 4; k < i; ++k) assert_true(faces[k] != faces[i]);
  }
  for (uint32_t v = 0; v < info.vertex_count; ++v) {
    assert_true(triangles[v] < mesh.triangle_count);
    for (uint32_t k = 0; k < 3; ++k) { /* the vertex is where its weights say */
      double p = 0;
      for (uint32_t c = 0; c < 3; ++c) {
        assert_int_equal(corners[3 * v + c], mesh.triangles[3 * triangles[v] + c]);
        p += weights[3 * v + c] * (double)mesh.positions[3 * corners[3 * v + c] + k];
      }
      assert_true(fabs(p - positions[3 * v + k]) < 1e-6);
    }
  }
  /* too small: nothing is written */
  net.face_capacity = info.face_count - 1;
  faces[0] = faces[1] = 77777;
  assert_code(HF_ERROR_TOO_SMALL, hf_quads_get_mesh(quads, &net));
  assert_true(faces[0] == 77777 && faces[1] == 77777);
  free(positions);
  free(weights);
  free(triangles);
  free(corners);
  free(faces);
  hf_quads_destroy(quads);
  assert_code(HF_ERROR_INVALID_OBJECT, hf_quads_get_info(quads, &info));
  /* HF_INIT, and no desc at all, give quads of 0.022 box diagonals */
  hf_quads_info plain[2] = {HF_INIT(hf_quads_info), HF_INIT(hf_quads_info)};
  desc = HF_INIT(hf_quads_desc);
  for (int given = 0; given < 2; ++given) {
    assert_ok(hf_quads_create(surface, given ? &desc : NULL, &quads));
    assert_ok(hf_quads_get_info(quads, &plain[given]));
    hf_quads_destroy(quads);
  }
  assert_memory_equal(&plain[0], &plain[1], sizeof plain[0]);
  assert_true(fabs(plain[0].edge_length / 0.022 - sqrt(8 + (RINGS - 1) * (RINGS - 1))) < 1e-3);
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

static void a_tube_becomes_quads_along_its_curvature(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.face_count = 400;
  hf_quads quads = NULL;
  assert_ok(hf_quads_create(surface, &desc, &quads));
  hf_quads_info info = HF_INIT(hf_quads_info);
  assert_ok(hf_quads_get_info(quads, &info));
  assert_int_equal(info.euler_characteristic, 0);
  assert_true(info.face_count >= 380 && info.face_count <= 420);
  assert_true(info.edge_length > 0);
  /* a tube has no singularities: every vertex has four faces, two on the borders */
  uint32_t* corners = calloc(info.face_count, 4 * sizeof *corners);
  uint32_t* valence = calloc(info.vertex_count, sizeof *valence);
  hf_quads_mesh net = HF_INIT(hf_quads_mesh);
  net.face_capacity = info.face_count;
  net.faces = corners;
  assert_ok(hf_quads_get_mesh(quads, &net));
  for (uint32_t i = 0; i < 4 * info.face_count; ++i) ++valence[corners[i]];
  for (uint32_t v = 0; v < info.vertex_count; ++v) assert_true(valence[v] == 4 || valence[v] == 2);
  free(corners);
  free(valence);
  hf_quads_destroy(quads);
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

/* Guides wind around the tube at 45 degrees; the plane cuts it in the middle, so its other half winds the other way. */
static void a_tube_becomes_quads_along_guides_and_its_own_mirror_image(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  uint32_t* vertices = calloc(COUNT, sizeof *vertices);
  double* vectors = calloc(COUNT, 3 * sizeof *vectors);
  for (uint32_t v = 0; v < COUNT; ++v) {
    const double x = (double)mesh.positions[3 * v], z = (double)mesh.positions[3 * v + 2];
    vertices[v] = v;
    vectors[3 * v] = -z;
    vectors[3 * v + 1] = 1;
    vectors[3 * v + 2] = x;
  }
  const uint32_t crease[4] = {0, AROUND, AROUND, 2 * AROUND};
  const double middle = (RINGS - 1) / 2.0;
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.face_count = 400;
  desc.guide_count = COUNT;
  desc.guide_vertices = vertices;
  desc.guide_vectors = vectors;
  desc.symmetry_plane[1] = 2;
  desc.symmetry_plane[3] = 2 * middle;
  for (int creased = 0; creased < 2; ++creased) {
    if (creased) {
      desc.crease_count = 2;
      desc.crease_edges = crease;
    } /* on the side that is mirrored: not used */
    hf_quads quads = NULL;
    assert_ok(hf_quads_create(surface, &desc, &quads));
    hf_quads_info info = HF_INIT(hf_quads_info);
    assert_ok(hf_quads_get_info(quads, &info));
    assert_int_equal(info.euler_characteristic, 0);
    double* positions = calloc(info.vertex_count, 3 * sizeof *positions);
    uint32_t* corners = calloc(info.face_count, 4 * sizeof *corners);
    hf_quads_mesh net = HF_INIT(hf_quads_mesh);
    net.vertex_capacity = info.vertex_count;
    net.positions = positions;
    net.face_capacity = info.face_count;
    net.faces = corners;
    assert_ok(hf_quads_get_mesh(quads, &net));
    uint32_t on_plane = 0;
    for (uint32_t v = 0; v < info.vertex_count; ++v) {
      const double* p = positions + 3 * v;
      int images = 0;
      for (uint32_t w = 0; w < info.vertex_count; ++w) {
        const double* q = positions + 3 * w;
        images += fabs(p[0] - q[0]) + fabs(p[1] + q[1] - 2 * middle) + fabs(p[2] - q[2]) < 1e-9;
      }
      assert_int_equal(images, 1);
      on_plane += fabs(p[1] - middle) < 1e-9;
    }
    assert_true(on_plane > 3);
    /* away from the plane and the ends a side of a quad rises as much as it winds */
    double slanting = 0, sides = 0;
    for (uint32_t i = 0; i < 4 * info.face_count; ++i) {
      const double *p = positions + 3 * corners[i], *q = positions + 3 * corners[i % 4 == 3 ? i - 3 : i + 1];
      const double rise = fabs(q[1] - p[1]),
                   along = sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[2] - p[2]) * (q[2] - p[2]));
      const double from = fabs((p[1] + q[1]) / 2 - middle);
      if (from < 3 || from > 7) continue;
      slanting += fabs(atan2(rise, along) - atan(1.0));
      sides += 1;
    }
    assert_true(slanting / sides < 0.15); /* pi / 4 without guides */
    free(positions);
    free(corners);
    hf_quads_destroy(quads);
  }
  free(vertices);
  free(vectors);
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

typedef struct Net {
  hf_quads_info info;
  double* positions;
  uint32_t* corners;
} Net;

static Net net_of(hf_quads quads) {
  Net net = {HF_INIT(hf_quads_info), NULL, NULL};
  assert_ok(hf_quads_get_info(quads, &net.info));
  net.positions = calloc(net.info.vertex_count, 3 * sizeof *net.positions);
  net.corners = calloc(net.info.face_count, 4 * sizeof *net.corners);
  hf_quads_mesh out = HF_INIT(hf_quads_mesh);
  out.vertex_capacity = net.info.vertex_count;
  out.face_capacity = net.info.face_count;
  out.positions = net.positions;
  out.faces = net.corners;
  assert_ok(hf_quads_get_mesh(quads, &out));
  return net;
}

/* Whether two nets are the same bit for bit. Frees both. */
static int same_nets(Net a, Net b) {
  const int same = memcmp(&a.info, &b.info, sizeof a.info) == 0 &&
                   memcmp(a.positions, b.positions, 3 * a.info.vertex_count * sizeof *a.positions) == 0 &&
                   memcmp(a.corners, b.corners, 4 * a.info.face_count * sizeof *a.corners) == 0;
  free(a.positions);
  free(a.corners);
  free(b.positions);
  free(b.corners);
  return same;
}

/* A tube has no irregular vertex by itself. */
static void a_pole_is_where_it_is_wanted(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  const double pole[3] = {1, RINGS / 2, 0}, along[3] = {0, 1, 0};
  const uint32_t three = 3;
  for (int with = 0; with < 2; ++with) {
    hf_quads_desc desc = HF_INIT(hf_quads_desc);
    desc.face_count = 1200;
    desc.relax_count = HF_NO_INDEX;
    if (with) {
      desc.irregular_count = 1;
      desc.irregular_points = pole;
      desc.irregular_valences = &three;
      desc.irregular_directions = along;
    }
    hf_quads quads = NULL;
    assert_ok(hf_quads_create(surface, &desc, &quads));
    Net net = net_of(quads);
    uint32_t* around = calloc(net.info.vertex_count, sizeof *around);
    for (uint32_t k = 0; k < 4 * net.info.face_count; ++k) ++around[net.corners[k]];
    double least = INFINITY;
    for (uint32_t v = 0; v < net.info.vertex_count; ++v) {
      const double *p = net.positions + 3 * v, d[3] = {p[0] - pole[0], p[1] - pole[1], p[2] - pole[2]};
      if (around[v] == three) least = fmin(least, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
    }
    const double edge = sqrt(6.2831853 * (RINGS - 1) / 1200);
    assert_true(with ? least < 1.5 * edge : least > 3 * edge);
    free(around);
    free(net.positions);
    free(net.corners);
    hf_quads_destroy(quads);
  }
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

/* Every update gives what hf_quads_create gives, whatever came before; a refused one changes nothing. */
static void an_update_is_a_new_mesh_of_the_same_options(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  const uint32_t creases[2] = {5 * AROUND, 6 * AROUND};
  uint32_t guided[3] = {10 * AROUND, 10 * AROUND + 1, 11 * AROUND};
  double vectors[9];
  const double pole[3] = {1, RINGS / 2, 0};
  const uint32_t three = 3;
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.face_count = 300;
  hf_quads updated = NULL, fresh = NULL;
  assert_ok(hf_quads_create(surface, &desc, &updated));
  for (uint32_t step = 0; step < 9; ++step) {
    for (uint32_t i = 0; i < 3; ++i) /* a stroke that turns */
    {
      vectors[3 * i] = 0.1 * step;
      vectors[3 * i + 1] = 0;
      vectors[3 * i + 2] = 1;
    }
    memset(&desc, 0, sizeof desc);
    desc.struct_size = sizeof desc;
    desc.face_count = 300;
    desc.relax_count = step % 2 ? 3 : HF_NO_INDEX;
    if (step > 0) {
      desc.guide_count = 3;
      desc.guide_vertices = guided;
      desc.guide_vectors = vectors;
    }
    if (step == 3) {
      desc.crease_count = 1;
      desc.crease_edges = creases;
    }
    if (step == 4) {
      desc.face_count = 0;
      desc.edge_length = 0.8;
    }
    if (step == 5 || step == 6) desc.symmetry_plane[2] = 1;
    if (step == 7) desc.symmetry_plane[0] = 1;
    if (step == 2 || step == 8) {
      desc.irregular_count = 1;
      desc.irregular_points = pole;
      desc.irregular_valences = &three;
    }
    assert_ok(hf_quads_update(updated, &desc));
    assert_ok(hf_quads_create(surface, &desc, &fresh));
    assert_true(same_nets(net_of(updated), net_of(fresh)));
    hf_quads_destroy(fresh);

    const Net before = net_of(updated);
    hf_quads_desc bad = desc;
    bad.edge_length = -1;
    assert_code(HF_ERROR_INVALID_ARGUMENT, hf_quads_update(updated, &bad));
    bad = desc;
    bad.guide_count = 3;
    bad.guide_vertices = guided;
    bad.guide_vectors = vectors;
    const double none[9] = {0, 0, 1, 0, 0, 1, 0, 0, 0};
    bad.guide_vectors = none;
    assert_code(HF_ERROR_INVALID_ARGUMENT, hf_quads_update(updated, &bad));
    hf_progress progress = NULL;
    assert_ok(hf_progress_create(&progress));
    assert_ok(hf_progress_cancel(progress));
    bad = desc;
    bad.progress = progress;
    assert_code(HF_ERROR_CANCELLED, hf_quads_update(updated, &bad));
    hf_progress_destroy(progress);
    assert_true(same_nets(before, net_of(updated)));
  }
  assert_code(HF_ERROR_NULL_POINTER, hf_quads_update(updated, NULL));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_quads_update(NULL, &desc));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_quads_update((hf_quads)surface, &desc));
  /* it outlives the surface */
  hf_surface_destroy(surface);
  desc.symmetry_plane[0] = 0;
  assert_ok(hf_quads_update(updated, &desc));
  hf_quads_destroy(updated);
  surface_free(&mesh);
}

static void flow_lines_rise_and_outlive_the_surface(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  double height[COUNT];
  for (uint32_t v = 0; v < COUNT; ++v) height[v] = (double)mesh.positions[3 * v + 1] + 1e-3 * (v % AROUND);
  hf_flow flow = NULL;
  assert_ok(hf_flow_create(surface, &flow));
  hf_surface_destroy(surface);
  const hf_array field = HF_ARRAY(height, COUNT);
  const uint32_t seed = 10 * AROUND + 3;
  for (int pass = 0; pass < 2; ++pass) {
    hf_streamlines lines = HF_INIT(hf_streamlines);
    if (pass == 0) lines.wanted_count = 12;
    if (pass == 1) {
      lines.seed_count = 1;
      lines.seeds = &seed;
    }
    assert_ok(hf_flow_trace(flow, &field, &lines));
    assert_int_equal(lines.line_count, pass == 0 ? 12 : 1);
    double* positions = calloc(lines.point_count, 3 * sizeof *positions);
    double* values = calloc(lines.point_count, sizeof *values);
    uint32_t starts[13], ends[24];
    lines.positions = positions;
    lines.values = values;
    lines.line_starts = starts;
    lines.line_ends = ends;
    lines.point_capacity = lines.point_count - 1;
    lines.line_capacity = 12;
    assert_code(HF_ERROR_TOO_SMALL, hf_flow_trace(flow, &field, &lines));
    lines.point_capacity = lines.point_count;
    assert_ok(hf_flow_trace(flow, &field, &lines));
    for (uint32_t l = 0; l < lines.line_count; ++l) {
      assert_true(starts[l] + 2 <= starts[l + 1]);
      for (uint32_t i = starts[l] + 1; i < starts[l + 1]; ++i) assert_true(values[i] > values[i - 1]);
      assert_true(fabs(values[starts[l]] - height[ends[2 * l]]) < 1e-12);
      assert_true(fabs(values[starts[l + 1] - 1] - height[ends[2 * l + 1]]) < 1e-12);
    }
    free(positions);
    free(values);
  }
  height[5] = NAN;
  hf_streamlines lines = HF_INIT(hf_streamlines);
  lines.wanted_count = 3;
  assert_code(HF_ERROR_NON_FINITE, hf_flow_trace(flow, &field, &lines));
  hf_flow_destroy(flow);
  hf_flow_destroy(flow);
  surface_free(&mesh);
}

static void cancelling_leaves_nothing_and_stops_one_call(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  hf_progress progress = NULL;
  assert_ok(hf_progress_create(&progress));
  assert_ok(hf_progress_cancel(progress));
  hf_quads_desc desc = quads_desc();
  desc.progress = progress;
  hf_quads quads = (hf_quads)(uintptr_t)1;
  assert_code(HF_ERROR_CANCELLED, hf_quads_create(surface, &desc, &quads));
  assert_null(quads);
  assert_ok(hf_quads_create(surface, &desc, &quads));
  double done = 0;
  assert_ok(hf_progress_get_fraction(progress, &done));
  assert_true(done == 1);
  hf_quads_destroy(quads);
  hf_progress_destroy(progress);
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

/* A host's allocator that looks at the progress whenever the library asks for memory or gives some back. */
typedef struct Watcher {
  hf_progress progress;
  double last, largest_step, cancel_at;
  unsigned values, falls;
} Watcher;

static void look_at_progress(Watcher* watcher) {
  double now = 0;
  if (watcher->progress && hf_progress_get_fraction(watcher->progress, &now) == HF_OK) {
    if (now < watcher->last) ++watcher->falls;
    if (now > watcher->last) {
      if (now - watcher->last > watcher->largest_step) watcher->largest_step = now - watcher->last;
      ++watcher->values;
      watcher->last = now;
    }
    if (now >= watcher->cancel_at) hf_progress_cancel(watcher->progress);
  }
}

static void* watch(void* user, size_t size, size_t alignment) {
  look_at_progress(user);
  /* the block that malloc gave stands in front of the aligned one */
  char* base = malloc(size + alignment + sizeof(void*));
  if (!base) return NULL;
  char* block = base + sizeof(void*);
  block += alignment - (uintptr_t)block % alignment;
  memcpy(block - sizeof(void*), &base, sizeof(void*));
  return block;
}
static void let_go(void* user, void* block, size_t size, size_t alignment) {
  (void)size, (void)alignment;
  look_at_progress(user);
  char* base = NULL;
  memcpy(&base, (char*)block - sizeof(void*), sizeof(void*));
  free(base);
}

static void progress_rises_in_small_steps_and_stops_where_it_is_cancelled(void** state) {
  (void)state;
  Watcher watcher = {NULL, 0, 0, 2, 0, 0};
  Surface mesh = surface_tube(AROUND, RINGS);
  hf_surface_desc create = options_of(&mesh).surface;
  const hf_allocator hooks = {watch, let_go, &watcher};
  create.allocator = hooks;
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&create, &surface));
  assert_ok(hf_progress_create(&watcher.progress));
  for (int counted = 0; counted < 2; ++counted) {
    hf_quads_desc desc = quads_desc();
    desc.progress = watcher.progress;
    if (counted) desc.face_count = 300;
    watcher.last = watcher.largest_step = 0;
    watcher.values = watcher.falls = 0;
    watcher.cancel_at = 2;
    hf_quads quads = NULL;
    assert_ok(hf_quads_create(surface, &desc, &quads));
    assert_int_equal(watcher.falls, 0);
    assert_true(watcher.values >= 10);
    assert_true(watcher.largest_step <= 0.5); /* trials that are not needed are passed over, and kept blocks not seen */
    hf_quads_destroy(quads);
    quads = NULL;
    for (double at = 0.05; at < 0.5; at += 0.2) { /* it passes 0.6 in one step where nothing is left to fit */
      watcher.last = 0;
      watcher.cancel_at = at;
      assert_code(HF_ERROR_CANCELLED, hf_quads_create(surface, &desc, &quads));
      assert_null(quads);
      assert_true(watcher.last >= at);
    }
  }
  hf_progress_destroy(watcher.progress);
  watcher.progress = NULL;
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

static void bad_input_is_named(void** state) {
  (void)state;
  Surface mesh;
  const hf_surface surface = tube_on(&mesh);
  hf_quads quads = NULL;
  const uint32_t beyond[] = {COUNT}, edge[] = {0, 1, 0, COUNT};
  hf_quads_desc desc = quads_desc();
  assert_code(HF_ERROR_NULL_POINTER, hf_quads_create(surface, &desc, NULL));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_quads_create(NULL, &desc, &quads));
  desc.struct_size = 4;
  assert_code(HF_ERROR_INVALID_DESC, hf_quads_create(surface, &desc, &quads));
  desc = quads_desc();
  desc.irregular_count = 3;
  assert_code(HF_ERROR_NULL_POINTER, hf_quads_create(surface, &desc, &quads));
  desc = quads_desc();
  desc.edge_length = -1;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_quads_create(surface, &desc, &quads));
  desc = quads_desc();
  desc.edge_length = NAN;
  assert_code(HF_ERROR_NON_FINITE, hf_quads_create(surface, &desc, &quads));
  desc = quads_desc();
  desc.edge_length = 1e9;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_quads_create(surface, &desc, &quads));
  desc = quads_desc();
  desc.relax_count = 1001;
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_quads_create(surface, &desc, &quads));
  desc = quads_desc();
  desc.crease_count = 2;
  desc.crease_edges = edge;
  assert_code(HF_ERROR_OUT_OF_RANGE, hf_quads_create(surface, &desc, &quads));
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  assert_int_equal(detail.index, 1);
  assert_null(quads);
  hf_flow flow = NULL;
  assert_code(HF_ERROR_NULL_POINTER, hf_flow_create(surface, NULL));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_flow_create(NULL, &flow));
  assert_ok(hf_flow_create(surface, &flow));
  assert_code(HF_ERROR_INVALID_OBJECT, hf_quads_get_info((hf_quads)flow, NULL));
  double values[COUNT] = {0};
  const hf_array field = HF_ARRAY(values, COUNT);
  hf_streamlines out = HF_INIT(hf_streamlines);
  assert_code(HF_ERROR_INVALID_ARGUMENT, hf_flow_trace(flow, &field, &out)); /* no line is wanted */
  out.wanted_count = 1;
  assert_code(HF_ERROR_NULL_POINTER, hf_flow_trace(flow, &field, NULL));
  assert_code(HF_ERROR_NULL_POINTER, hf_flow_trace(flow, NULL, &out));
  out.seed_count = 1;
  out.seeds = beyond;
  assert_code(HF_ERROR_OUT_OF_RANGE, hf_flow_trace(flow, &field, &out));
  out.reserved = 1;
  assert_code(HF_ERROR_INVALID_DESC, hf_flow_trace(flow, &field, &out));
  hf_flow_destroy(flow);
  hf_surface_destroy(surface);
  surface_free(&mesh);
}

static void mostly_non_manifold_triangles_are_refused_with_a_vertex(void** state) {
  (void)state;
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, -1};
  const uint32_t triangles[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
  hf_surface_desc create = HF_INIT(hf_surface_desc);
  create.positions = HF_ARRAY(positions, 5);
  create.triangles = HF_ARRAY(triangles, 3);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&create, &surface));
  hf_quads quads = NULL;
  hf_flow flow = NULL;
  assert_code(HF_ERROR_UNSUPPORTED, hf_quads_create(surface, NULL, &quads));
  assert_code(HF_ERROR_UNSUPPORTED, hf_flow_create(surface, &flow));
  hf_error_detail detail;
  assert_ok(hf_error_get_detail(&detail));
  assert_true(detail.index == 0 || detail.index == 1);
  assert_non_null(strstr(detail.message, "1 of 1 edges"));
  hf_surface_destroy(surface);
}

/* The two triangles of a square with corners a b, and above them c d. Returns the count with theirs. */
static uint32_t add_square(uint32_t* triangles, uint32_t count, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  const uint32_t corners[6] = {a, b, d, a, d, c};
  memcpy(triangles + count, corners, sizeof corners);
  return count + 6;
}

/* A spiral staircase of 1,500 turns, flat as a disc: over a million quads of the default edge length. */
static void very_many_quads_must_be_asked_for(void** state) {
  (void)state;
  enum { TURNS = 1500, STEPS = 8, RIM = TURNS * STEPS };
  static float positions[3 * (2 * RIM + 2)];
  static uint32_t triangles[6 * RIM];
  for (uint32_t i = 0; i <= RIM; ++i) {
    const double angle = 6.283185307179586 * i / STEPS;
    for (uint32_t k = 0; k < 2; ++k) {
      float* p = positions + 3 * (2 * i + k);
      p[0] = (float)((1 + 9 * k) * cos(angle));
      p[1] = (float)((1 + 9 * k) * sin(angle));
      p[2] = 1e-4f * (float)i;
    }
  }
  for (uint32_t i = 0; i < RIM; ++i) add_square(triangles, 6 * i, 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3);
  hf_surface_desc create = HF_INIT(hf_surface_desc);
  create.positions = HF_ARRAY(positions, 2 * RIM + 2);
  create.triangles = HF_ARRAY(triangles, 2 * RIM);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&create, &surface));
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  hf_quads quads = NULL;
  assert_code(HF_ERROR_TOO_LARGE, hf_quads_create(surface, &desc, &quads));
  assert_null(quads);
  hf_surface_destroy(surface);
}

/* A fin on a sheet: the sheet stays in one piece, the fin gets a border. */
static void a_non_manifold_edge_is_parted(void** state) {
  (void)state;
  enum { N = 12, SHEET = (N + 1) * (N + 1) };
  float positions[3 * (SHEET + N + 1)];
  uint32_t triangles[18 * N * N], count = 0;
  for (uint32_t v = 0; v < SHEET; ++v) {
    positions[3 * v] = (float)(v % (N + 1));
    positions[3 * v + 1] = (float)(v / (N + 1));
    positions[3 * v + 2] = 0;
  }
  for (uint32_t i = 0; i <= N; ++i) {
    float* p = positions + 3 * (SHEET + i);
    p[0] = (float)i;
    p[1] = 6;
    p[2] = 2;
  }
  for (uint32_t q = 0; q < N * N; ++q) {
    const uint32_t a = q / N * (N + 1) + q % N, c = a + N + 1;
    count = add_square(triangles, count, a, a + 1, c, c + 1);
  }
  for (uint32_t i = 0; i < N; ++i) {
    const uint32_t a = 6 * (N + 1) + i, c = SHEET + i;
    count = add_square(triangles, count, a, a + 1, c, c + 1);
  }
  hf_surface_desc create = HF_INIT(hf_surface_desc);
  create.positions = HF_ARRAY(positions, SHEET + N + 1);
  create.triangles = HF_ARRAY(triangles, count / 3);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&create, &surface));
  hf_surface_report report = HF_INIT(hf_surface_report);
  assert_ok(hf_surface_get_report(surface, &report));
  assert_int_equal(report.non_manifold_edge_count, N);
  hf_quads_desc desc = HF_INIT(hf_quads_desc);
  desc.edge_length = 1;
  hf_quads quads = NULL;
  assert_ok(hf_quads_create(surface, &desc, &quads));
  hf_quads_info info = HF_INIT(hf_quads_info);
  assert_ok(hf_quads_get_info(quads, &info));
  assert_int_equal(info.euler_characteristic, 2); /* two sheets */
  assert_int_equal(info.face_count, N * N + 2 * N);
  /* in the middle of the edge the sheet has four quads, and the border of the fin two */
  enum { MOST = 2 * SHEET };
  static double places[3 * MOST];
  static uint32_t corners[4 * MOST];
  hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
  mesh.vertex_capacity = mesh.face_capacity = MOST;
  mesh.positions = places;
  mesh.faces = corners;
  assert_ok(hf_quads_get_mesh(quads, &mesh));
  uint32_t copies = 0;
  for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
    if (fabs(places[3 * v] - 6) + fabs(places[3 * v + 1] - 6) + fabs(places[3 * v + 2]) > 0.1) continue;
    uint32_t around = 0, upright = 0;
    for (uint32_t c = 0; c < 4 * mesh.face_count; ++c) {
      if (corners[c] != v) continue;
      double top = 0;
      for (uint32_t k = 0; k < 4; ++k) top = fmax(top, places[3 * corners[c / 4 * 4 + k] + 2]);
      ++around;
      upright += top > 0.1;
    }
    assert_true((around == 4 && upright == 0) || (around == 2 && upright == 2));
    ++copies;
  }
  assert_int_equal(copies, 2);
  hf_quads_destroy(quads);
  hf_flow flow = NULL;
  assert_ok(hf_flow_create(surface, &flow));
  hf_flow_destroy(flow);
  hf_surface_destroy(surface);
}

/* One vertex is so far away that two others, at 4e-19 from each other, become one place inside: their triangles have no
 * angles. The indices of the crosses still fit the seams. */
static void triangles_whose_angles_are_lost_in_rounding_get_quads(void** state) {
  (void)state;
  enum { ROWS = 4, COLUMNS = 7 };
  static const struct {
    int vertex;
    double place[3];
  } moved[] = {{11, {1, 5, -4e-19}}, {18, {2e8, 4e8, 0}}, {1, {-.95, .6, .05}},    {3, {2.5, 3.1, -.67}},
               {5, {0, 1.33, -.42}}, {8, {.2, 1, .63}},   {9, {-.75, 1.54, -.47}}, {24, {3.05, 2.4, .69}}};
  double positions[ROWS * COLUMNS][3];
  uint32_t triangles[6 * (ROWS - 1) * (COLUMNS - 1)], count = 0;
  for (uint32_t v = 0; v < ROWS * COLUMNS; ++v) {
    positions[v][0] = v / COLUMNS;
    positions[v][1] = v % COLUMNS;
    positions[v][2] = 0;
    if (v / COLUMNS + 1 == ROWS || v % COLUMNS + 1 == COLUMNS) continue;
    const uint32_t square[] = {v, v + COLUMNS, v + COLUMNS + 1, v, v + COLUMNS + 1, v + 1};
    for (int k = 0; k < 6; ++k) triangles[count++] = square[k];
  }
  for (size_t i = 0; i < COUNT_OF(moved); ++i) memcpy(positions[moved[i].vertex], moved[i].place, sizeof positions[0]);
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(&positions[0][0], ROWS * COLUMNS);
  desc.triangles = HF_ARRAY(triangles, count / 3);
  hf_surface surface = NULL;
  assert_ok(hf_surface_create(&desc, &surface));
  hf_quads_desc options = HF_INIT(hf_quads_desc);
  options.face_count = 21;
  options.relax_count = NO_INDEX;
  hf_quads quads = NULL;
  assert_ok(hf_quads_create(surface, &options, &quads));
  hf_quads_info info = HF_INIT(hf_quads_info);
  assert_ok(hf_quads_get_info(quads, &info));
  assert_int_equal(info.euler_characteristic, 1);
  hf_quads_destroy(quads);
  hf_surface_destroy(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_tube_becomes_a_closed_net_of_quads),
      cmocka_unit_test(a_tube_becomes_quads_along_its_curvature),
      cmocka_unit_test(a_tube_becomes_quads_along_guides_and_its_own_mirror_image),
      cmocka_unit_test(a_pole_is_where_it_is_wanted),
      cmocka_unit_test(an_update_is_a_new_mesh_of_the_same_options),
      cmocka_unit_test(flow_lines_rise_and_outlive_the_surface),
      cmocka_unit_test(cancelling_leaves_nothing_and_stops_one_call),
      cmocka_unit_test(progress_rises_in_small_steps_and_stops_where_it_is_cancelled),
      cmocka_unit_test(bad_input_is_named),
      cmocka_unit_test(mostly_non_manifold_triangles_are_refused_with_a_vertex),
      cmocka_unit_test(very_many_quads_must_be_asked_for),
      cmocka_unit_test(a_non_manifold_edge_is_parted),
      cmocka_unit_test(triangles_whose_angles_are_lost_in_rounding_get_quads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
