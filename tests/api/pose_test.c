/* Poses and transfers from the outside: rest comes back, handles land on their targets, outputs agree with each other.
 */
#include "api_support.h"

enum { AROUND = 14, RINGS = 24, VERTICES = AROUND * RINGS };

static Surface tube;
static hf_surface surface;

static int create_tube(void** state) {
  (void)state;
  tube = surface_tube(AROUND, RINGS);
  for (uint32_t v = 0; v < VERTICES; ++v) {
    tube.positions[3 * v] += 100.0f;
    tube.positions[3 * v + 2] -= 40.0f;
  } /* not at the origin */
  surface = surface_on(&tube);
  return 0;
}
static int free_tube(void** state) {
  (void)state;
  hf_surface_destroy(surface);
  surface_free(&tube);
  return 0;
}

static hf_deform_desc to_doubles(double* positions, float* normals) {
  hf_deform_desc desc = HF_INIT(hf_deform_desc);
  desc.positions = ROWS_OUT(positions);
  if (normals) desc.normals = ROWS_OUT(normals);
  return desc;
}

static const int32_t modes[] = {POSE_SMOOTH, POSE_PAPER};

static hf_pose pose_of(int32_t mode, uint32_t out_handles[2]) {
  hf_pose pose = NULL;
  assert_ok(create_pose_with(mode, surface, NULL, &pose));
  uint32_t* ends = tube_ends(AROUND, RINGS);
  const uint32_t counts[2] = {2 * AROUND, 2 * AROUND};
  hf_handles_desc handles = HF_INIT(hf_handles_desc);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = ends;
  assert_ok(hf_pose_add_handles(pose, &handles, out_handles));
  free(ends);
  return pose;
}

/* p -> rotation (p - centroid) + centroid + translation */
static void place(const hf_transform* t, const double centroid[3], const float* rest, double out[3]) {
  const double *q = t->rotation,
               d[3] = {(double)rest[0] - centroid[0], (double)rest[1] - centroid[1], (double)rest[2] - centroid[2]};
  const double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), x = q[0] / n, y = q[1] / n,
               z = q[2] / n, w = q[3] / n;
  const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                       2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                       2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  for (int k = 0; k < 3; ++k)
    out[k] = r[3 * k] * d[0] + r[3 * k + 1] * d[1] + r[3 * k + 2] * d[2] + centroid[k] + t->translation[k];
}

static void identity_transforms_give_the_rest_pose(void** state) {
  (void)state;
  for (size_t m = 0; m < COUNT_OF(modes); ++m) {
    uint32_t handles[2];
    hf_pose pose = pose_of(modes[m], handles);
    static double positions[3 * VERTICES];
    static float normals[3 * VERTICES];
    const hf_transform identity[2] = {{{0, 0, 0, 1}, {0, 0, 0}},
                                      {{0, 0, 0, 0}, {0, 0, 0}}}; /* all zero is identity, too */
    assert_ok(hf_pose_set_transforms(pose, 2, handles, identity));
    const hf_deform_desc desc = to_doubles(positions, normals);
    hf_deform_info info = HF_INIT(hf_deform_info);
    assert_ok(hf_pose_deform(pose, &desc, &info));
    assert_int_equal(info.unreached_vertex_count, 0);
    hf_pose_statistics statistics = HF_INIT(hf_pose_statistics);
    assert_ok(hf_pose_get_statistics(pose, &statistics));
    assert_true(statistics.cluster_count > 0);
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) assert_true(fabs(positions[i] - (double)tube.positions[i]) < 1e-9);
    for (uint32_t v = 0; v < VERTICES; ++v) {
      const float *n = normals + 3 * v, *p = tube.positions + 3 * v;
      assert_true(fabs(sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])) - 1) < 1e-5);
      const double outward = (double)(n[0] * (p[0] - 100) + n[2] * (p[2] + 40));
      assert_true(fabs(outward) > 0.95 &&
                  outward * ((double)(normals[0] * (tube.positions[0] - 100) + normals[2] * (tube.positions[2] + 40))) >
                      0);
    }
    hf_pose_destroy(pose);
  }
}

static void handles_land_exactly_where_their_transforms_put_them(void** state) {
  (void)state;
  for (size_t m = 0; m < COUNT_OF(modes); ++m) {
    uint32_t handles[2];
    hf_pose pose = pose_of(modes[m], handles);
    const hf_transform moves[2] = {{{0.1, 0.2, -0.1, 2}, {1, -1, 0.5}}, {{0, 0, 1, 1}, {-5, 3, 2}}};
    assert_ok(hf_pose_set_transforms(pose, 2, handles, moves));
    static double positions[3 * VERTICES];
    const hf_deform_desc desc = to_doubles(positions, NULL);
    uint32_t* ends = tube_ends(AROUND, RINGS);
    for (int repeat = 0; repeat < 3; ++repeat) {
      assert_ok(hf_pose_deform(pose, &desc, NULL));
      for (uint32_t h = 0; h < 2; ++h) {
        hf_handle_info info = HF_INIT(hf_handle_info);
        assert_ok(hf_pose_get_handle(pose, handles[h], &info));
        assert_int_equal(info.vertex_count, 2 * AROUND);
        assert_true(info.site_count > 0 && info.site_count <= 2 * AROUND && info.leak < 1e-9);
        for (uint32_t i = 0; i < 2 * AROUND; ++i) {
          const uint32_t v = ends[h * 2 * AROUND + i];
          double target[3];
          place(&moves[h], info.centroid, tube.positions + 3 * v, target);
          for (int k = 0; k < 3; ++k) assert_true(fabs(positions[3 * v + (uint32_t)k] - target[k]) < 1e-9);
        }
      }
    }
    free(ends);
    hf_pose_destroy(pose);
  }
}

static void one_rigid_motion_of_all_handles_moves_everything(void** state) {
  (void)state;
  for (size_t m = 0; m < COUNT_OF(modes); ++m) {
    uint32_t handles[2];
    hf_pose pose = pose_of(modes[m], handles);
    /* both handles move as one body: the same rotation about the origin, so other translations about their centroids */
    const hf_transform body = {{0, 0.3, 0.1, 1}, {7, 8, 9}};
    const double origin[3] = {0, 0, 0};
    hf_transform moves[2] = {body, body};
    for (int h = 0; h < 2; ++h) {
      hf_handle_info info = HF_INIT(hf_handle_info);
      assert_ok(hf_pose_get_handle(pose, handles[h], &info));
      const float centre[3] = {(float)info.centroid[0], (float)info.centroid[1], (float)info.centroid[2]};
      double placed[3];
      place(&body, origin, centre, placed);
      for (int k = 0; k < 3; ++k) moves[h].translation[k] = placed[k] - (double)centre[k];
    }
    assert_ok(hf_pose_set_transforms(pose, 2, handles, moves));
    static double positions[3 * VERTICES];
    hf_deform_desc desc = to_doubles(positions, NULL);
    desc.iteration_count = 500;
    assert_ok(hf_pose_deform(pose, &desc, NULL));
    double worst = 0;
    for (uint32_t v = 0; v < VERTICES; ++v) {
      double target[3];
      place(&body, origin, tube.positions + 3 * v, target);
      for (int k = 0; k < 3; ++k) worst = fmax(worst, fabs(positions[3 * v + (uint32_t)k] - target[k]));
    }
    /* the paper's relaxation moves a cluster at a time and needs thousands of iterations to carry 40 units along the
     * tube */
    const double allowed = modes[m] == POSE_PAPER ? 10 : 1e-6;
    if (!(worst < allowed)) fail_msg("mode %d: a vertex lies %g beside its rigid place", (int)modes[m], worst);
    hf_pose_destroy(pose);
  }
}

static void the_fields_of_the_handles_sum_to_one(void** state) {
  (void)state;
  uint32_t handles[2];
  hf_pose pose = pose_of(POSE_SMOOTH, handles);
  static float first[VERTICES], second[2 * VERTICES];
  assert_ok(hf_pose_get_field(pose, handles[0], OUT(first)));
  assert_ok(hf_pose_get_field(pose, handles[1], OUT_ROWS(second, 8)));
  for (uint32_t v = 0; v < VERTICES; ++v) {
    assert_true(fabs((double)(first[v] + second[2 * v]) - 1) < 1e-6);
    const uint32_t ring = v / AROUND;
    if (ring < 2) assert_true(fabs((double)first[v] - 1) < 1e-6);
    if (ring >= RINGS - 2) assert_true(fabs((double)first[v]) < 1e-6);
  }
  hf_pose_destroy(pose);
}

static void float_double_and_strided_outputs_agree(void** state) {
  (void)state;
  uint32_t handles[2];
  hf_pose pose = pose_of(POSE_SMOOTH, handles);
  const hf_transform bent = {{0, 0, 0.5, 1}, {2, 0, 0}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &bent));
  typedef struct Record {
    float position[3], normal[3], other[2];
  } Record;
  static double doubles[3 * VERTICES];
  static float floats[3 * VERTICES], normals[3 * VERTICES];
  static Record records[VERTICES];
  for (uint32_t v = 0; v < VERTICES; ++v) records[v].other[0] = records[v].other[1] = 42;
  hf_deform_desc desc = to_doubles(doubles, NULL);
  desc.restart = 1;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  desc.positions = ROWS_OUT(floats);
  desc.normals = ROWS_OUT(normals);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  desc.positions = ROWS_OUT(records[0].position);
  desc.normals = ROWS_OUT(records[0].normal);
  desc.positions.stride = desc.normals.stride = sizeof(Record);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  for (uint32_t v = 0; v < VERTICES; ++v) {
    for (uint32_t k = 0; k < 3; ++k) {
      assert_true(floats[3 * v + k] == (float)doubles[3 * v + k]);
      assert_true(records[v].position[k] == floats[3 * v + k] && records[v].normal[k] == normals[3 * v + k]);
    }
    assert_true(records[v].other[0] == 42 && records[v].other[1] == 42);
  }
  hf_pose_destroy(pose);
}

static void handles_come_and_go_and_clones_are_independent(void** state) {
  (void)state;
  uint32_t handles[2], third;
  hf_pose pose = pose_of(POSE_SMOOTH, handles), copy = NULL;
  const hf_transform bent = {{0, 0, 0.5, 1}, {2, 0, 0}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &bent));
  static double before[3 * VERTICES], after[3 * VERTICES];
  hf_deform_desc desc = to_doubles(before, NULL);
  desc.restart = 1;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_ok(hf_pose_clone(pose, &copy));
  const uint32_t count = AROUND;
  uint32_t ring[AROUND];
  for (uint32_t i = 0; i < AROUND; ++i) ring[i] = 12 * AROUND + i;
  hf_handles_desc more = HF_INIT(hf_handles_desc);
  more.handle_count = 1;
  more.region_counts = &count;
  more.region_vertices = ring;
  assert_ok(hf_pose_add_handles(pose, &more, &third));
  assert_int_equal(hf_pose_get_handle_count(pose), 3);
  assert_int_equal(hf_pose_get_handle_count(copy), 2);
  desc.positions = ROWS_OUT(after);
  assert_ok(hf_pose_deform(copy, &desc, NULL));
  assert_true(same_bits(before, after, sizeof before));
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_ok(hf_pose_remove_handles(pose, 1, &third));
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_true(same_bits(before, after, sizeof before));
  hf_pose_destroy(pose);
  hf_pose_destroy(copy);
}

static void a_handle_in_place_moves_nothing(void** state) {
  (void)state;
  uint32_t handles[2], added = 0;
  hf_pose pose = pose_of(POSE_SMOOTH, handles);
  const hf_transform bent = {{0, 0, sin(0.3), cos(0.3)}, {0.4, -0.1, 0.1}};
  assert_ok(hf_pose_set_transform(pose, handles[1], &bent));
  const uint32_t count = AROUND * RINGS;
  double* before = malloc(3 * sizeof(double) * count);
  double* after = malloc(3 * sizeof(double) * count);
  const hf_deform_desc first = to_doubles(before, NULL), second = to_doubles(after, NULL);
  assert_ok(hf_pose_deform(pose, &first, NULL));
  const uint32_t ring[1] = {AROUND}, start = AROUND * (RINGS / 2);
  uint32_t vertices[AROUND];
  for (uint32_t i = 0; i < AROUND; ++i) vertices[i] = start + i;
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 1;
  desc.region_counts = ring;
  desc.region_vertices = vertices;
  desc.in_place = 1;
  assert_ok(hf_pose_add_handles(pose, &desc, &added));
  hf_handle_info info = HF_INIT(hf_handle_info);
  assert_ok(hf_pose_get_handle(pose, added, &info));
  assert_true(fabs(info.translation[0]) + fabs(info.translation[1]) > 0.01);
  assert_true(fabs(info.rotation[3]) < 0.9999);
  assert_ok(hf_pose_deform(pose, &second, NULL));
  for (uint32_t i = 0; i < 3 * count; ++i) assert_true(fabs(after[i] - before[i]) < 1e-6);
  hf_transform stands;
  memcpy(stands.rotation, info.rotation, sizeof stands.rotation);
  memcpy(stands.translation, info.translation, sizeof stands.translation);
  assert_ok(hf_pose_set_transform(pose, added, &stands)); /* 1e-4 of the box: rounding makes it a motion */
  assert_ok(hf_pose_deform(pose, &second, NULL));
  for (uint32_t i = 0; i < 3 * count; ++i) assert_true(fabs(after[i] - before[i]) < 2e-3);
  hf_pose_destroy(pose);
  free(before);
  free(after);
}

/* what a host does that must not lose a frame */
static void handles_come_to_a_clone_while_the_pose_is_dragged(void** state) {
  (void)state;
  uint32_t handles[2], added = 0;
  hf_pose pose = pose_of(POSE_SMOOTH, handles), next = NULL;
  hf_transform bent = {{0, 0, sin(0.3), cos(0.3)}, {0.4, -0.1, 0.1}};
  const uint32_t count = AROUND * RINGS;
  double* before = malloc(3 * sizeof(double) * count);
  double* after = malloc(3 * sizeof(double) * count);
  const hf_deform_desc first = to_doubles(before, NULL), second = to_doubles(after, NULL);
  assert_ok(hf_pose_set_transform(pose, handles[1], &bent));
  for (int f = 0; f < 30; ++f) assert_ok(hf_pose_deform(pose, &first, NULL));
  assert_ok(hf_pose_clone(pose, &next));
  const uint32_t ring[1] = {AROUND}, start = AROUND * (RINGS / 2);
  uint32_t vertices[AROUND];
  for (uint32_t i = 0; i < AROUND; ++i) vertices[i] = start + i;
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 1;
  desc.region_counts = ring;
  desc.region_vertices = vertices;
  desc.in_place = 1;
  assert_ok(hf_pose_add_handles(next, &desc, &added)); /* in another thread */
  bent.translation[0] += 1e-4;
  assert_ok(hf_pose_set_transform(pose, handles[1], &bent));
  assert_ok(hf_pose_deform(pose, &first, NULL));
  assert_ok(hf_pose_set_transform(next, handles[1], &bent));
  assert_ok(hf_pose_deform(next, &second, NULL));
  for (uint32_t i = 0; i < 3 * count; ++i) assert_true(fabs(after[i] - before[i]) < 1e-2);
  hf_pose_destroy(pose);
  hf_pose_destroy(next);
  free(before);
  free(after);
}

static void what_no_handle_reaches_stays_at_rest(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_surface both = surface_on(&cut);
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(both, NULL, &pose));
  const uint32_t counts[2] = {5, 5}, vertices[10] = {0, 5, 10, 15, 20, 29, 34, 39, 44, 49};
  uint32_t handles[2];
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 2;
  desc.region_counts = counts;
  desc.region_vertices = vertices;
  assert_ok(hf_pose_add_handles(pose, &desc, handles));
  const hf_transform lifted = {{0, 0, 0, 1}, {0, 0, 3}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &lifted));
  double positions[3 * CUT_VERTICES];
  const hf_deform_desc deform = to_doubles(positions, NULL);
  hf_deform_info info = HF_INIT(hf_deform_info);
  assert_ok(hf_pose_deform(pose, &deform, &info));
  assert_int_equal(info.unreached_vertex_count, 10);
  for (uint32_t i = 3 * CUT_ISLAND; i < 3 * CUT_VERTICES; ++i)
    assert_true(fabs(positions[i] - (double)cut.positions[i]) < 1e-9);
  for (uint32_t j = 0; j < 5; ++j)
    assert_true(same_bits(positions + 3 * (CUT_SEAM_LEFT + 5 * j), positions + 3 * (CUT_SEAM_RIGHT + 5 * j), 24));
  assert_true(positions[3 * CUT_SEAM_LEFT + 2] > (double)cut.positions[3 * CUT_SEAM_LEFT + 2] + 0.1);
  hf_pose_destroy(pose);
  hf_surface_destroy(both);
  surface_free(&cut);
}

static hf_transfer transfer_of(int32_t kind, hf_surface source, hf_surface target, uint32_t source_around,
                               uint32_t source_rings, uint32_t target_around, uint32_t target_rings,
                               uint32_t out_pairs[2]) {
  hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
  desc.mode = mode_of(kind);
  hf_transfer transfer = NULL;
  assert_ok(create_transfer_with(kind, source, target, &desc, &transfer));
  uint32_t *from = tube_ends(source_around, source_rings), *to = tube_ends(target_around, target_rings);
  const uint32_t from_counts[2] = {2 * source_around, 2 * source_around},
                 to_counts[2] = {2 * target_around, 2 * target_around};
  hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
  pairs.pair_count = 2;
  pairs.source_counts = from_counts;
  pairs.source_vertices = from;
  pairs.target_counts = to_counts;
  pairs.target_vertices = to;
  assert_ok(hf_transfer_add_pairs(transfer, &pairs, out_pairs));
  free(from);
  free(to);
  return transfer;
}

static void the_rest_of_the_source_gives_the_rest_of_the_target(void** state) {
  (void)state;
  Surface other = surface_tube(9, 17);
  hf_surface target = surface_on(&other);
  const int32_t transfer_modes[] = {TRANSFER_FIELDS, TRANSFER_PAPER, TRANSFER_STRETCH};
  for (size_t m = 0; m < COUNT_OF(transfer_modes); ++m) {
    uint32_t pairs[2];
    hf_transfer transfer = transfer_of(transfer_modes[m], surface, target, AROUND, RINGS, 9, 17, pairs);
    static float positions[3 * 9 * 17], normals[3 * 9 * 17];
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(tube.positions, VERTICES);
    frame.target_positions = ROWS_OUT(positions);
    frame.target_normals = ROWS_OUT(normals);
    assert_ok(hf_transfer_apply(transfer, &frame));
    for (uint32_t i = 0; i < 3 * 9 * 17; ++i) assert_true(fabs((double)(positions[i] - other.positions[i])) < 1e-4);
    for (uint32_t v = 0; v < 9 * 17; ++v)
      assert_true(fabs((double)(normals[3 * v] * normals[3 * v] + normals[3 * v + 1] * normals[3 * v + 1] +
                                normals[3 * v + 2] * normals[3 * v + 2]) -
                       1) < 1e-5);
    hf_pair_info info = HF_INIT(hf_pair_info);
    assert_ok(hf_transfer_get_pair(transfer, pairs[1], &info));
    assert_true(info.flags == 0 && info.source_leak < 1e-9 && info.target_leak < 1e-9 && info.confidence > 0 &&
                info.confidence <= 1);
    hf_transfer_destroy(transfer);
  }
  hf_surface_destroy(target);
  surface_free(&other);
}

static void a_transfer_of_stretch_swells_with_the_source_and_refuses_holds_and_skins(void** state) {
  (void)state;
  enum { TARGET = 9 * 17 };
  Surface other = surface_tube(9, 17);
  hf_surface target = surface_on(&other);
  uint32_t pairs[2];
  hf_transfer transfer = transfer_of(TRANSFER_STRETCH, surface, target, AROUND, RINGS, 9, 17, pairs);
  static double posed[3 * VERTICES], made[3 * TARGET], before[3 * TARGET];
  for (uint32_t i = 0; i < 3 * VERTICES; ++i) posed[i] = 1.5 * (double)tube.positions[i];
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, VERTICES);
  frame.target_positions = ROWS_OUT(made);
  assert_ok(hf_transfer_apply(transfer, &frame));
  double box = 0; /* without fmax: GCC 12 for ARM breaks down on a maximum in a loop */
  for (uint32_t i = 0; i < 3 * TARGET; ++i) {
    const double size = fabs((double)other.positions[i]);
    if (size > box) box = size;
  }
  for (uint32_t i = 0; i < 3 * TARGET; ++i) {
    const double off = made[i] - made[i % 3] - 1.5 * ((double)other.positions[i] - (double)other.positions[i % 3]);
    assert_true(fabs(off) < 1e-9 * box);
  }
  memcpy(before, made, sizeof made);
  const double place[3] = {0, 0, 0};
  frame.hold_count = 1;
  frame.hold_pairs = pairs;
  frame.hold_positions = place;
  assert_int_equal(hf_transfer_apply(transfer, &frame), HF_ERROR_UNSUPPORTED);
  assert_memory_equal(made, before, sizeof made);
  hf_skin_info info = HF_INIT(hf_skin_info);
  assert_int_equal(hf_transfer_get_skin(transfer, &info), HF_ERROR_UNSUPPORTED);
  assert_int_equal(info.joint_count, 0);
  frame.hold_count = 0;
  assert_ok(hf_transfer_apply(transfer, &frame));
  assert_memory_equal(made, before, sizeof made);
  hf_transfer_destroy(transfer);
  hf_surface_destroy(target);
  surface_free(&other);
}

static void dials_are_read_back_and_neutral_ones_change_no_bit(void** state) {
  (void)state;
  Surface other = surface_tube(9, 17);
  enum { TARGET = 9 * 17 };
  hf_surface target = surface_on(&other);
  uint32_t pairs[2];
  hf_transfer transfer = transfer_of(TRANSFER_FIELDS, surface, target, AROUND, RINGS, 9, 17, pairs);
  static float posed[3 * VERTICES], plain[3 * TARGET], dialled[3 * TARGET], again[3 * TARGET];
  for (uint32_t v = 0; v < VERTICES; ++v)
    for (int c = 0; c < 3; ++c) posed[3 * v + c] = tube.positions[3 * v + c] + (c == 0 ? 2.0f : 0.0f);
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, VERTICES);
  frame.target_positions = ROWS_OUT(plain);
  assert_ok(hf_transfer_apply(transfer, &frame));
  hf_transfer_dials dials = HF_INIT(hf_transfer_dials);
  assert_ok(hf_transfer_get_dials(transfer, &dials));
  assert_true(dials.stride == 1 && dials.hip_height_share == 0 && dials.neck_follow == 0 && dials.tail_follow == 0 &&
              dials.arm_space == 0 && dials.long_follow == 0);
  dials.stride = 1.5;
  dials.hip_height_share = 0.25;
  dials.neck_follow = -0.5;
  dials.tail_follow = 1;
  dials.arm_space = 0.5;
  dials.long_follow = 0.75;
  assert_ok(hf_transfer_set_dials(transfer, &dials));
  hf_transfer_dials read = HF_INIT(hf_transfer_dials);
  assert_ok(hf_transfer_get_dials(transfer, &read));
  assert_memory_equal(&read, &dials, sizeof read);
  frame.target_positions = ROWS_OUT(dialled);
  assert_ok(hf_transfer_apply(transfer, &frame));
  double moved = 0, path = 0;
  for (uint32_t v = 0; v < TARGET; ++v) {
    moved += (double)(dialled[3 * v] - other.positions[3 * v]) / TARGET;
    path += (double)(plain[3 * v] - other.positions[3 * v]) / TARGET;
  }
  assert_true(fabs(moved - 1.5 * path) < 1e-4 * fabs(path)); /* the body travels 1.5 times as far */
  assert_ok(hf_transfer_set_dials(transfer, NULL));
  frame.target_positions = ROWS_OUT(again);
  assert_ok(hf_transfer_apply(transfer, &frame));
  assert_memory_equal(again, plain, sizeof plain);
  hf_transfer_statistics work = HF_INIT(hf_transfer_statistics);
  assert_ok(hf_transfer_get_statistics(transfer, &work));
  assert_true(work.source_factorisation_count == 0 && work.target_factorisation_count == 0);
  hf_transfer_destroy(transfer);
  hf_surface_destroy(target);
  surface_free(&other);
}

static void the_skin_replays_the_transfer(void** state) {
  (void)state;
  Surface other = surface_tube(9, 17);
  enum { TARGET = 9 * 17 };
  hf_surface target = surface_on(&other);
  uint32_t handles[2], pairs[2];
  hf_pose pose = pose_of(POSE_SMOOTH, handles);
  const hf_transform bent = {{0, 0, 0.4, 1}, {1, 0, 0}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &bent));
  static double posed[3 * VERTICES], moved[3 * TARGET];
  const hf_deform_desc desc = to_doubles(posed, NULL);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  hf_transfer transfer = transfer_of(TRANSFER_FIELDS, surface, target, AROUND, RINGS, 9, 17, pairs);
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, VERTICES);
  frame.target_positions = ROWS_OUT(moved);
  assert_ok(hf_transfer_apply(transfer, &frame));

  hf_skin_info skin = HF_INIT(hf_skin_info);
  assert_ok(hf_transfer_get_skin(transfer, &skin));
  const uint32_t n = skin.joint_count;
  assert_true(n > 0 && skin.influence_count == 4);
  double *pivots = malloc(24 * (size_t)n), *rotations = malloc(32 * (size_t)n), *translations = malloc(24 * (size_t)n);
  static uint32_t joints[4 * TARGET];
  static float weights[4 * TARGET];
  skin.joint_capacity = n;
  skin.vertex_capacity = TARGET;
  skin.pivots = pivots;
  skin.rotations = rotations;
  skin.translations = translations;
  skin.vertex_joints = joints;
  skin.vertex_weights = weights;
  assert_ok(hf_transfer_get_skin(transfer, &skin));
  assert_int_equal(skin.joint_count, n);
  double farthest = 0;
  for (uint32_t v = 0; v < TARGET; ++v) {
    double blended[3] = {0, 0, 0}, sum = 0;
    for (int k = 0; k < 4; ++k) {
      const uint32_t j = joints[4 * v + (uint32_t)k];
      const double w = (double)weights[4 * v + (uint32_t)k];
      assert_true(j < n && w >= 0 && (k == 0 || w <= (double)weights[4 * v + (uint32_t)k - 1]));
      hf_transform joint = {{0, 0, 0, 1}, {0, 0, 0}};
      memcpy(joint.rotation, rotations + 4 * j, sizeof joint.rotation);
      for (int c = 0; c < 3; ++c)
        joint.translation[c] = translations[3 * j + (uint32_t)c] - pivots[3 * j + (uint32_t)c];
      double placed[3];
      place(&joint, pivots + 3 * j, other.positions + 3 * v, placed);
      for (int c = 0; c < 3; ++c) blended[c] += w * placed[c];
      sum += w;
    }
    assert_true(fabs(sum - 1) < 1e-6);
    for (int c = 0; c < 3; ++c) assert_true(fabs(blended[c] - moved[3 * v + (uint32_t)c]) < 1e-4);
    farthest = fmax(farthest, fabs(moved[3 * v] - (double)other.positions[3 * v]));
  }
  assert_true(farthest > 0.5); /* the motion arrived at all */
  /* a frame without output moves the skin only */
  frame.target_positions = (hf_array_out){0};
  assert_ok(hf_transfer_apply(transfer, &frame));
  free(pivots);
  free(rotations);
  free(translations);
  hf_transfer_destroy(transfer);
  hf_pose_destroy(pose);
  hf_surface_destroy(target);
  surface_free(&other);
}

static void a_frame_may_be_transferred_in_place(void** state) {
  (void)state;
  uint32_t handles[2], pairs[2];
  hf_pose pose = pose_of(POSE_SMOOTH, handles);
  const hf_transform bent = {{0, 0, 0.4, 1}, {1, 0, 0}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &bent));
  static double posed[3 * VERTICES], apart[3 * VERTICES];
  const hf_deform_desc desc = to_doubles(posed, NULL);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  hf_transfer transfer = transfer_of(TRANSFER_FIELDS, surface, surface, AROUND, RINGS, AROUND, RINGS, pairs);
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(posed, VERTICES);
  frame.target_positions = ROWS_OUT(apart);
  assert_ok(hf_transfer_apply(transfer, &frame));
  frame.target_positions = ROWS_OUT(posed);
  assert_ok(hf_transfer_apply(transfer, &frame));
  assert_true(same_bits(posed, apart, sizeof posed));
  assert_ok(hf_transfer_remove_pairs(transfer, 1, pairs));
  hf_transfer_destroy(transfer);
  hf_pose_destroy(pose);
}

static void a_transfer_says_its_scale_and_holds_regions_where_the_caller_wants_them(void** state) {
  (void)state;
  Surface other = surface_tube(AROUND, RINGS);
  for (uint32_t i = 0; i < 3 * VERTICES; ++i) other.positions[i] *= 2;
  hf_surface target = surface_on(&other);
  uint32_t pairs[2];
  hf_transfer transfer = transfer_of(TRANSFER_FIELDS, surface, target, AROUND, RINGS, AROUND, RINGS, pairs);
  hf_transfer_info info = HF_INIT(hf_transfer_info);
  assert_ok(hf_transfer_get_info(transfer, &info));
  assert_int_equal(info.pair_count, 2);
  assert_true(info.cluster_count > 1 && info.scale_found && info.crossed_count == 0);
  assert_true(fabs(info.scale - 2) < 1e-6);
  /* the far end where it is asked to be, the other free */
  static float out[3 * VERTICES];
  const double place[3] = {1.5, -0.25, 7.0};
  hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
  frame.source_positions = HF_ARRAY(tube.positions, VERTICES);
  frame.target_positions = ROWS_OUT(out);
  frame.hold_count = 1;
  frame.hold_pairs = &pairs[1];
  frame.hold_positions = place;
  assert_ok(hf_transfer_apply(transfer, &frame));
  uint32_t* ends = tube_ends(AROUND, RINGS);
  double mean[3] = {0, 0, 0};
  for (uint32_t i = 2 * AROUND; i < 4 * AROUND; ++i)
    for (int c = 0; c < 3; ++c) mean[c] += (double)out[3 * ends[i] + (uint32_t)c] / (2 * AROUND);
  for (int c = 0; c < 3; ++c) assert_true(fabs(mean[c] - place[c]) < 1e-4);
  free(ends);
  /* what is wrong is said and changes nothing */
  static float before[3 * VERTICES];
  memcpy(before, out, sizeof out);
  const uint32_t twice[2] = {pairs[0], pairs[0]}, missing[1] = {99};
  const double places[6] = {0};
  frame.hold_positions = places;
  frame.hold_count = 2;
  frame.hold_pairs = twice;
  assert_int_equal(hf_transfer_apply(transfer, &frame), HF_ERROR_INVALID_ARGUMENT);
  frame.hold_count = 1;
  frame.hold_pairs = missing;
  assert_int_equal(hf_transfer_apply(transfer, &frame), HF_ERROR_NOT_FOUND);
  frame.hold_pairs = NULL;
  assert_int_equal(hf_transfer_apply(transfer, &frame), HF_ERROR_NULL_POINTER);
  frame.hold_pairs = pairs;
  frame.hold_count = 257;
  assert_int_equal(hf_transfer_apply(transfer, &frame), HF_ERROR_TOO_LARGE);
  assert_true(same_bits(before, out, sizeof out));
  hf_transfer_destroy(transfer);
  hf_surface_destroy(target);
  surface_free(&other);
}

/* Bent, and settled so that another hf_pose_deform gives the same bits. */
static hf_pose bent_pose(int32_t mode, uint32_t handles[2], double* positions) {
  hf_pose pose = pose_of(mode, handles);
  const hf_transform bent = {{0, 0, 0.4, 1}, {1, 0.5, 0}};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &bent));
  hf_deform_desc desc = to_doubles(positions, NULL);
  hf_deform_info info = HF_INIT(hf_deform_info);
  info.iteration_count = 1;
  for (int i = 0; i < 400 && info.iteration_count > 0; ++i) assert_ok(hf_pose_deform(pose, &desc, &info));
  return pose;
}

static double farthest_apart(const double* a, const double* b) {
  double farthest = 0;
  for (uint32_t i = 0; i < 3 * VERTICES; ++i) farthest = fmax(farthest, fabs(a[i] - b[i]));
  return farthest;
}

static void a_handle_on_a_layer_comes_without_a_jump_and_goes_without_a_trace(void** state) {
  (void)state;
  for (size_t m = 0; m < COUNT_OF(modes); ++m) {
    uint32_t handles[2], fine, region[AROUND];
    static double before[3 * VERTICES], after[3 * VERTICES];
    hf_pose pose = bent_pose(modes[m], handles, before);
    const uint32_t count = 3;
    for (uint32_t i = 0; i < count; ++i) region[i] = (RINGS / 2) * AROUND + i;
    hf_handles_desc desc = HF_INIT(hf_handles_desc);
    desc.handle_count = 1;
    desc.region_counts = &count;
    desc.region_vertices = region;
    desc.layer = 1;
    assert_ok(hf_pose_add_handles(pose, &desc, &fine));
    const hf_deform_desc out = to_doubles(after, NULL);
    assert_ok(hf_pose_deform(pose, &out, NULL));
    assert_true(farthest_apart(before, after) < 1e-9);
    hf_handle_info info = HF_INIT(hf_handle_info);
    assert_ok(hf_pose_get_handle(pose, fine, &info));
    assert_int_equal(info.layer, 1);
    assert_true(fabs(info.rotation[2]) > 0.05); /* turned by the layer below */
    const hf_transform edit = {{0, 0, 0, 1}, {0, 0, 0.3}};
    assert_ok(hf_pose_set_transforms(pose, 1, &fine, &edit));
    assert_ok(hf_pose_deform(pose, &out, NULL));
    assert_true(farthest_apart(before, after) > 0.25);
    /* a skin cannot say what a layer does */
    hf_skin_info skin = HF_INIT(hf_skin_info);
    assert_code(HF_ERROR_UNSUPPORTED, hf_pose_get_skin(pose, &skin));
    assert_ok(hf_pose_remove_handles(pose, 1, &fine));
    assert_ok(hf_pose_deform(pose, &out, NULL));
    assert_true(same_bits(before, after, sizeof before));
    assert_ok(hf_pose_get_skin(pose, &skin));
    hf_pose_destroy(pose);
  }
}

static void matrices_place_handles_like_transforms(void** state) {
  (void)state;
  uint32_t handles[2];
  static double by_transform[3 * VERTICES], by_matrix[3 * VERTICES];
  hf_pose pose = pose_of(POSE_SMOOTH, handles), other = pose_of(POSE_SMOOTH, handles);
  hf_handle_info info = HF_INIT(hf_handle_info);
  assert_ok(hf_pose_get_handle(pose, handles[1], &info));
  const double c = cos(0.8), s = sin(0.8), *p = info.centroid;
  const hf_transform turned = {{0, 0, sin(0.4), cos(0.4)}, {0.5, 0, 0.25}};
  /* rotation about z through the centroid, then the translation */
  const double matrix[16] = {
      c, s, 0, 0, -s, c, 0, 0, 0, 0, 1, 0, p[0] - c * p[0] + s * p[1] + 0.5, p[1] - s * p[0] - c * p[1], 0.25, 1};
  assert_ok(hf_pose_set_transforms(pose, 1, &handles[1], &turned));
  assert_ok(hf_pose_set_matrices(other, 1, &handles[1], matrix));
  hf_deform_desc desc = to_doubles(by_transform, NULL);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  desc.positions = ROWS_OUT(by_matrix);
  assert_ok(hf_pose_deform(other, &desc, NULL));
  assert_true(farthest_apart(by_transform, by_matrix) < 1e-9);
  hf_pose_destroy(pose);
  hf_pose_destroy(other);
}

static void a_point_and_a_radius_make_a_handle(void** state) {
  (void)state;
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  const uint32_t at = 5 * AROUND;
  double points[6], radii[2] = {0.3, 0.3};
  for (uint32_t i = 0; i < 3; ++i) {
    points[i] = (double)tube.positions[3 * at + i];
    points[3 + i] = (double)tube.positions[i];
  }
  hf_handles_desc desc = HF_INIT(hf_handles_desc);
  desc.handle_count = 2;
  desc.points = points;
  desc.radii = radii;
  uint32_t handles[2];
  assert_ok(hf_pose_add_handles(pose, &desc, handles));
  hf_handle_info info = HF_INIT(hf_handle_info);
  assert_ok(hf_pose_get_handle(pose, handles[0], &info));
  assert_int_equal(info.vertex_count, 1);
  for (int i = 0; i < 3; ++i) assert_true(fabs(info.centroid[i] - points[i]) < 1e-9);
  assert_ok(hf_pose_remove_handles(pose, 2, handles));
  radii[0] = 1000; /* all that hangs together */
  desc.handle_count = 1;
  assert_ok(hf_pose_add_handles(pose, &desc, handles));
  assert_ok(hf_pose_get_handle(pose, handles[0], &info));
  assert_int_equal(info.vertex_count, VERTICES);
  hf_pose_destroy(pose);
}

static void check_range(int32_t limb_refine) {
  uint32_t handles[2];
  static double whole[3 * VERTICES], part[3 * VERTICES];
  static float normals[3 * VERTICES], part_normals[3 * VERTICES];
  hf_pose pose = bent_pose(POSE_SMOOTH, handles, whole);
  if (limb_refine > 0) assert_ok(hf_pose_set_limb_refine(pose, 1, handles, limb_refine));
  hf_deform_desc desc = to_doubles(whole, normals);
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  const uint32_t first = 3 * AROUND + 5, count = 2 * AROUND;
  for (int with_normals = 0; with_normals < 2; ++with_normals) {
    part[3 * count] = 777;
    desc = to_doubles(part, with_normals ? part_normals : NULL);
    desc.first_vertex = first;
    desc.vertex_count = count;
    assert_ok(hf_pose_deform(pose, &desc, NULL));
    for (uint32_t i = 0; i < 3 * count; ++i) {
      assert_true(fabs(part[i] - whole[3 * first + i]) < 1e-12);
      if (with_normals) assert_true(part_normals[i] == normals[3 * first + i]);
    }
    assert_true(part[3 * count] == 777);
  }
  desc = to_doubles(part, NULL);
  desc.first_vertex = VERTICES - 2; /* to the end */
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_true(fabs(part[5] - whole[3 * VERTICES - 1]) < 1e-12);
  hf_pose_destroy(pose);
}

static void a_range_of_vertices_is_the_same_as_in_the_whole(void** state) {
  (void)state;
  check_range(0);
  check_range(2);
}

static void a_refined_frame_keeps_the_handles_and_moves_the_rest_a_little(void** state) {
  (void)state;
  uint32_t handles[2];
  static double plain[3 * VERTICES], refined[3 * VERTICES];
  hf_pose pose = bent_pose(POSE_SMOOTH, handles, plain);
  hf_deform_desc desc = to_doubles(refined, NULL);
  hf_deform_info info = HF_INIT(hf_deform_info);
  double before = 0;
  for (desc.refine = 1; desc.refine <= 64; desc.refine *= 8) {
    assert_ok(hf_pose_deform(pose, &desc, &info));
    const double moved = farthest_apart(plain, refined);
    assert_true(moved > 1e-4 && moved < 0.5 && moved != before);
    before = moved;
    for (uint32_t i = 0; i < 3 * 2 * AROUND; ++i) assert_true(fabs(plain[i] - refined[i]) < 1e-9);
  }
  desc.refine = 0;
  assert_ok(hf_pose_deform(pose, &desc, NULL));
  assert_true(farthest_apart(plain, refined) == 0);
  hf_pose_destroy(pose);
}

/* v <- q v q^-1 (or its inverse), q a unit quaternion */
static void turn(const double q[4], double direction, double v[3]) {
  const double x = direction * q[0], y = direction * q[1], z = direction * q[2], w = q[3];
  const double c[3] = {y * v[2] - z * v[1] + w * v[0], z * v[0] - x * v[2] + w * v[1], x * v[1] - y * v[0] + w * v[2]};
  const double d[3] = {y * c[2] - z * c[1], z * c[0] - x * c[2], x * c[1] - y * c[0]};
  for (int k = 0; k < 3; ++k) v[k] += 2 * d[k];
}

static void the_skin_replays_the_pose(void** state) {
  (void)state;
  uint32_t handles[2];
  static double posed[3 * VERTICES];
  hf_pose pose = bent_pose(POSE_SMOOTH, handles, posed);
  double worst[2] = {0, 0}; /* rigid joints, stretching joints */
  for (uint32_t round = 0; round < 4; ++round) {
    const uint32_t count = round % 2 ? 8 : 4, stretching = round / 2;
    hf_skin_info skin = HF_INIT(hf_skin_info);
    skin.influence_count = count;
    assert_ok(hf_pose_get_skin(pose, &skin));
    const uint32_t n = skin.joint_count;
    double *pivots = malloc(24 * (size_t)n), *rotations = malloc(32 * (size_t)n), *places = malloc(24 * (size_t)n);
    double *axes = malloc(32 * (size_t)n), *scales = malloc(24 * (size_t)n);
    static uint32_t joints[8 * VERTICES];
    static float weights[8 * VERTICES];
    skin.joint_capacity = n;
    skin.vertex_capacity = VERTICES;
    skin.pivots = pivots;
    skin.rotations = rotations;
    skin.translations = places;
    skin.vertex_joints = joints;
    skin.vertex_weights = weights;
    if (stretching) {
      skin.axes = axes;
      skin.scales = scales;
    }
    assert_ok(hf_pose_get_skin(pose, &skin));
    assert_int_equal(skin.joint_count, n);
    for (uint32_t v = 0; v < VERTICES; ++v) {
      float sum = 0;
      double blended[3] = {0, 0, 0};
      for (uint32_t k = 0; k < count; ++k) {
        const uint32_t j = joints[count * v + k];
        assert_true(j < n && weights[count * v + k] >= 0);
        sum += weights[count * v + k];
        double arm[3];
        for (uint32_t c = 0; c < 3; ++c) arm[c] = (double)tube.positions[3 * v + c] - pivots[3 * j + c];
        if (stretching) {
          turn(axes + 4 * j, -1, arm);
          for (uint32_t c = 0; c < 3; ++c) arm[c] *= scales[3 * j + c];
          turn(axes + 4 * j, 1, arm);
        }
        turn(rotations + 4 * j, 1, arm);
        for (uint32_t c = 0; c < 3; ++c) blended[c] += (double)weights[count * v + k] * (arm[c] + places[3 * j + c]);
      }
      assert_true(sum == 1.0f);
      for (uint32_t c = 0; c < 3; ++c) worst[stretching] = fmax(worst[stretching], fabs(blended[c] - posed[3 * v + c]));
    }
    free(pivots);
    free(rotations);
    free(places);
    free(axes);
    free(scales);
  }
  assert_true(worst[0] < 0.1 && worst[1] < 0.02); /* 1 % of the box, and much less with stretching joints */
  assert_true(worst[1] < 0.5 * worst[0]);
  hf_pose_destroy(pose);
}

/* The piece gets its second handle before the sheet does. Components share the acceleration of rotations, whose sums
 * must not depend on that. */
static void handles_one_by_one_give_the_bits_of_a_batch(void** state) {
  (void)state;
  Surface cut = surface_cut();
  hf_surface pieces = surface_on(&cut);
  const uint32_t places[4] = {CUT_ISLAND, CUT_ISLAND + 8, CUT_LEFT, CUT_RIGHT}, ones[4] = {1, 1, 1, 1};
  double positions[2][3 * CUT_VERTICES];
  for (int batch = 0; batch < 2; ++batch) {
    hf_pose pose = NULL;
    uint32_t numbers[4];
    assert_ok(hf_pose_create(pieces, NULL, &pose));
    for (uint32_t i = 0; i < 4; i += batch ? 4 : 1) {
      hf_handles_desc handles = HF_INIT(hf_handles_desc);
      handles.handle_count = batch ? 4 : 1;
      handles.region_counts = ones;
      handles.region_vertices = places + i;
      assert_ok(hf_pose_add_handles(pose, &handles, numbers + i));
    }
    for (uint32_t i = 0; i < 4; ++i) {
      const hf_transform turned = {{0.3, 0.1 * i, -0.2, 0.7}, {0.2, -0.1 * i, 0.4}};
      assert_ok(hf_pose_set_transform(pose, numbers[i], &turned));
    }
    hf_deform_desc desc = to_doubles(positions[batch], NULL);
    desc.restart = 1;
    assert_ok(hf_pose_deform(pose, &desc, NULL));
    hf_pose_destroy(pose);
  }
  assert_memory_equal(positions[0], positions[1], sizeof positions[0]);
  hf_surface_destroy(pieces);
  surface_free(&cut);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_handle_on_a_layer_comes_without_a_jump_and_goes_without_a_trace),
      cmocka_unit_test(matrices_place_handles_like_transforms),
      cmocka_unit_test(a_point_and_a_radius_make_a_handle),
      cmocka_unit_test(a_range_of_vertices_is_the_same_as_in_the_whole),
      cmocka_unit_test(a_refined_frame_keeps_the_handles_and_moves_the_rest_a_little),
      cmocka_unit_test(the_skin_replays_the_pose),
      cmocka_unit_test(identity_transforms_give_the_rest_pose),
      cmocka_unit_test(handles_land_exactly_where_their_transforms_put_them),
      cmocka_unit_test(one_rigid_motion_of_all_handles_moves_everything),
      cmocka_unit_test(the_fields_of_the_handles_sum_to_one),
      cmocka_unit_test(float_double_and_strided_outputs_agree),
      cmocka_unit_test(handles_come_and_go_and_clones_are_independent),
      cmocka_unit_test(handles_one_by_one_give_the_bits_of_a_batch),
      cmocka_unit_test(a_handle_in_place_moves_nothing),
      cmocka_unit_test(handles_come_to_a_clone_while_the_pose_is_dragged),
      cmocka_unit_test(what_no_handle_reaches_stays_at_rest),
      cmocka_unit_test(the_rest_of_the_source_gives_the_rest_of_the_target),
      cmocka_unit_test(a_transfer_of_stretch_swells_with_the_source_and_refuses_holds_and_skins),
      cmocka_unit_test(dials_are_read_back_and_neutral_ones_change_no_bit),
      cmocka_unit_test(the_skin_replays_the_transfer),
      cmocka_unit_test(a_frame_may_be_transferred_in_place),
      cmocka_unit_test(a_transfer_says_its_scale_and_holds_regions_where_the_caller_wants_them),
  };
  return cmocka_run_group_tests(tests, create_tube, free_tube);
}
