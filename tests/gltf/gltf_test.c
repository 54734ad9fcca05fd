/* The C interface of hf_gltf: a strip gets a skin and a clip, is written, read and played; bad calls change nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
/* behind the headers that it needs */
#include <cmocka.h>

#include "hf/transfer.h"
#include "hf_gltf/gltf.h"

enum { ROWS = 5, VERTICES = 2 * ROWS, TRIANGLES = 2 * (ROWS - 1), FRAMES = 5 };

static hf_gltf_model strip(void) {
  static double positions[3 * VERTICES];
  static uint32_t triangles[3 * TRIANGLES];
  for (uint32_t r = 0; r < ROWS; ++r)
    for (uint32_t s = 0; s < 2; ++s) {
      positions[3 * (2 * r + s)] = s;
      positions[3 * (2 * r + s) + 1] = r;
    }
  for (uint32_t r = 0; r + 1 < ROWS; ++r) {
    const uint32_t a = 2 * r, corners[6] = {a, a + 1, a + 2, a + 2, a + 1, a + 3};
    memcpy(triangles + 6 * r, corners, sizeof corners);
  }
  hf_gltf_mesh_desc desc = HF_INIT(hf_gltf_mesh_desc);
  desc.vertex_count = VERTICES;
  desc.triangle_count = TRIANGLES;
  desc.positions = positions;
  desc.triangles = triangles;
  desc.name = "strip";
  hf_gltf_model model;
  assert_int_equal(hf_gltf_model_create(&desc, &model), HF_OK);
  return model;
}

/* The strip on the earth: a file holds floats, which round by 0.25 there, so a node has the place. */
static void a_mesh_far_from_0_keeps_its_digits(void** state) {
  (void)state;
  static const double at[3] = {-2487001.29, -4684680.17, 3529644.7};
  double positions[3 * VERTICES], got[3 * VERTICES];
  uint32_t triangles[3 * (VERTICES - 2)];
  for (uint32_t v = 0; v < VERTICES; ++v)
    for (uint32_t c = 0; c < 3; ++c) positions[3 * v + c] = at[c] + sin(1.7 * (v + 1) * (c + 1));
  for (uint32_t t = 0; t < VERTICES - 2; ++t)
    for (uint32_t c = 0; c < 3; ++c) triangles[3 * t + c] = t + c;
  hf_gltf_mesh_desc desc = HF_INIT(hf_gltf_mesh_desc);
  desc.vertex_count = VERTICES;
  desc.triangle_count = VERTICES - 2;
  desc.positions = positions;
  desc.triangles = triangles;
  hf_gltf_model model, again;
  assert_int_equal(hf_gltf_model_create(&desc, &model), HF_OK);
  uint64_t count;
  assert_int_equal(hf_gltf_model_write(model, HF_GLTF_GLB, 0, NULL, &count), HF_OK);
  void* bytes = malloc((size_t)count);
  assert_int_equal(hf_gltf_model_write(model, HF_GLTF_GLB, count, bytes, &count), HF_OK);
  hf_gltf_read_desc read = HF_INIT(hf_gltf_read_desc);
  read.bytes = bytes;
  read.byte_count = count;
  assert_int_equal(hf_gltf_model_read(&read, &again), HF_OK);
  hf_gltf_surface surface = HF_INIT(hf_gltf_surface);
  surface.positions = got;
  assert_int_equal(hf_gltf_model_get_surface(again, &surface), HF_OK);
  for (uint32_t i = 0; i < 3 * VERTICES; ++i) assert_true(fabs(got[i] - positions[i]) < 1e-6);
  free(bytes);
  hf_gltf_model_destroy(again);
  hf_gltf_model_destroy(model);
  positions[4] = 1e40; /* no file can hold it */
  assert_int_equal(hf_gltf_model_create(&desc, &model), HF_ERROR_NON_FINITE);
  assert_null(model);
}

/* The upper half of the strip turns about its middle row, by a right angle in a second. */
static hf_gltf_model swinging(hf_gltf_model model) {
  static double pivots[6] = {0, 0, 0, 0, 2, 0}, times[FRAMES], rotations[FRAMES * 8], translations[FRAMES * 6];
  static uint32_t joints[VERTICES];
  static float weights[VERTICES];
  for (uint32_t v = 0; v < VERTICES; ++v) {
    joints[v] = v / 2 > 2;
    weights[v] = 1;
  }
  for (int f = 0; f < FRAMES; ++f) {
    times[f] = 0.25 * f;
    const double half = 0.25 * 3.14159265358979 * times[f];
    rotations[8 * f + 3] = 1;
    rotations[8 * f + 6] = sin(half);
    rotations[8 * f + 7] = cos(half);
    translations[6 * f + 4] = 2;
  }
  hf_gltf_skin_desc desc = HF_INIT(hf_gltf_skin_desc);
  desc.joint_count = 2;
  desc.frame_count = FRAMES;
  desc.influence_count = 1;
  desc.name = "swing";
  desc.pivots = pivots;
  desc.joints = joints;
  desc.weights = weights;
  desc.times = times;
  desc.rotations = rotations;
  desc.translations = translations;
  hf_gltf_model out;
  assert_int_equal(hf_gltf_model_create_skinned(model, &desc, &out), HF_OK);
  return out;
}

static void* written(hf_gltf_model model, int32_t format, uint64_t* count) {
  assert_int_equal(hf_gltf_model_write(model, format, 0, NULL, count), HF_OK);
  void* bytes = malloc((size_t)*count);
  assert_int_equal(hf_gltf_model_write(model, format, *count, bytes, count), HF_OK);
  return bytes;
}

static hf_result reread(const void* bytes, uint64_t count, hf_gltf_model* model) {
  hf_gltf_read_desc desc = HF_INIT(hf_gltf_read_desc);
  desc.bytes = bytes;
  desc.byte_count = count;
  desc.file = "again.glb";
  return hf_gltf_model_read(&desc, model);
}

static void near_to(double a, double b) { assert_true(fabs(a - b) < 1e-5); }

static void a_mesh_gives_its_surface_back(void** state) {
  (void)state;
  hf_gltf_model model = strip();
  hf_gltf_model_info info = HF_INIT(hf_gltf_model_info);
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_OK);
  assert_int_equal(info.vertex_count, VERTICES);
  assert_int_equal(info.triangle_count, TRIANGLES);
  assert_int_equal(info.clip_count + info.has_skin, 0);
  double positions[3 * VERTICES];
  uint32_t triangles[3 * TRIANGLES];
  float weights[8 * VERTICES];
  hf_gltf_surface surface = HF_INIT(hf_gltf_surface);
  surface.positions = positions;
  surface.triangles = triangles;
  surface.weights = weights;
  assert_int_equal(hf_gltf_model_get_surface(model, &surface), HF_OK);
  near_to(positions[3 * 9 + 1], 4);
  near_to(positions[3 * 9], 1);
  assert_int_equal(triangles[3 * TRIANGLES - 1], 9);
  near_to((double)weights[0], 1); /* it hangs on its node */
  hf_gltf_model_destroy(model);
}

static void a_written_clip_plays_as_it_was_given(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still), again = NULL;
  for (int32_t format = HF_GLTF_GLB; format <= HF_GLTF_TEXT; ++format) {
    uint64_t count = 0;
    void* bytes = written(model, format, &count);
    assert_int_equal(reread(bytes, count, &again), HF_OK);
    hf_gltf_clip_info clip = HF_INIT(hf_gltf_clip_info);
    assert_int_equal(hf_gltf_model_get_clip(again, 0, &clip), HF_OK);
    assert_string_equal(clip.name, "swing");
    near_to(clip.duration, 1);
    double posed[3 * VERTICES];
    assert_int_equal(hf_gltf_model_pose(again, 0, 1, posed), HF_OK); /* (1, 4) about (0, 2) by a right angle */
    near_to(posed[3 * 9], -2);
    near_to(posed[3 * 9 + 1], 3);
    near_to(posed[0], 0);
    near_to(posed[3 * 5], 1);
    near_to(posed[3 * 5 + 1], 2);
    hf_gltf_model_destroy(again);
    free(bytes);
  }
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(still);
}

static void keys_between_straight_ones_are_left_out(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still);
  hf_gltf_clip_info before = HF_INIT(hf_gltf_clip_info), after = before;
  assert_int_equal(hf_gltf_model_get_clip(model, 0, &before), HF_OK);
  double off = 1;
  assert_int_equal(hf_gltf_model_remove_keys(model, 0, 1e-3, &off), HF_OK);
  assert_int_equal(hf_gltf_model_get_clip(model, 0, &after), HF_OK);
  assert_true(off <= 1e-3 && after.key_count < before.key_count);
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(still);
}

/* The joints of a file, and a clip of their poses: played, it moves the surface as the first clip does. */
static void joints_give_their_clip_back(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still);
  hf_gltf_model_info info = HF_INIT(hf_gltf_model_info);
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_OK);
  enum { MOST = 8 };
  assert_true(info.joint_count >= 2 && info.joint_count <= MOST);
  char names[256];
  uint32_t parents[MOST], lines = 0, bound = 0;
  float rest[10 * MOST], binds[16 * MOST], posed[FRAMES * 10 * MOST];
  hf_gltf_skeleton skeleton = HF_INIT(hf_gltf_skeleton);
  skeleton.names = names;
  skeleton.name_capacity = info.name_byte_count - 1;
  assert_int_equal(hf_gltf_model_get_skeleton(model, &skeleton), HF_ERROR_TOO_SMALL);
  skeleton.name_capacity = info.name_byte_count;
  skeleton.parents = parents;
  skeleton.rest = rest;
  skeleton.inverse_binds = binds;
  assert_int_equal(hf_gltf_model_get_skeleton(model, &skeleton), HF_OK);
  assert_int_equal(strlen(names) + 1, info.name_byte_count);
  for (const char* c = names; *c; ++c) lines += *c == '\n';
  assert_int_equal(lines, info.joint_count);
  for (uint32_t j = 0; j < info.joint_count; ++j) {
    assert_true(parents[j] == HF_NO_INDEX || parents[j] < info.joint_count);
    bound += binds[16 * j + 15] != 0;
  }
  assert_int_equal(bound, 2);
  for (uint32_t j = 0; j < info.joint_count; ++j) { /* bound as it rests: the inverse bind takes the places above back */
    if (binds[16 * j + 15] == 0) continue;
    for (int c = 0; c < 3; ++c) {
      float place = 0;
      for (uint32_t k = j; k != HF_NO_INDEX; k = parents[k]) place += rest[10 * k + c];
      assert_true(fabsf(place + binds[16 * j + 12 + c]) < 1e-6F);
      assert_true(binds[16 * j + 5 * c] == 1);
    }
  }
  uint16_t joints[8 * VERTICES];
  float weights[8 * VERTICES];
  hf_gltf_surface surface = HF_INIT(hf_gltf_surface);
  surface.joints = joints;
  surface.weights = weights;
  assert_int_equal(hf_gltf_model_get_surface(model, &surface), HF_OK);
  for (uint32_t v = 0; v < VERTICES; ++v) {
    assert_true(binds[16 * joints[8 * v] + 15] != 0);
    assert_true((joints[8 * v] == joints[0]) == (v / 2 <= 2));
  }

  double times[FRAMES], first[3 * VERTICES], again[3 * VERTICES];
  for (int f = 0; f < FRAMES; ++f) {
    times[f] = 0.25 * f;
    float* const pose = posed + f * 10 * (int)info.joint_count;
    assert_int_equal(hf_gltf_model_pose_joints(model, 0, times[f], pose), HF_OK);
    for (uint32_t j = 0; j < info.joint_count; ++j) /* a rotation need not be of length 1 */
      for (int c = 3; c < 7; ++c) pose[10 * j + c] *= 3;
  }
  hf_gltf_joints_desc desc = HF_INIT(hf_gltf_joints_desc);
  desc.frame_count = FRAMES;
  desc.name = "copy";
  desc.times = times;
  desc.joints = posed;
  assert_int_equal(hf_gltf_model_add_joint_clip(model, &desc), HF_OK);
  hf_gltf_clip_info clip = HF_INIT(hf_gltf_clip_info);
  assert_int_equal(hf_gltf_model_get_clip(model, 0, &clip), HF_OK);
  assert_string_equal(clip.name, "copy");
  for (int f = 0; f < FRAMES; ++f) {
    assert_int_equal(hf_gltf_model_pose(model, 0, times[f], again), HF_OK);
    assert_int_equal(hf_gltf_model_pose(model, 1, times[f], first), HF_OK);
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) near_to(again[i], first[i]);
  }

  assert_int_equal(hf_gltf_model_pose_joints(model, 2, 0, posed), HF_ERROR_OUT_OF_RANGE);
  assert_int_equal(hf_gltf_model_pose_joints(model, 0, NAN, posed), HF_ERROR_NON_FINITE);
  assert_int_equal(hf_gltf_model_pose_joints(model, 0, 0, NULL), HF_ERROR_NULL_POINTER);
  memset(posed + 10 * info.joint_count + 3, 0, 4 * sizeof *posed);
  assert_int_equal(hf_gltf_model_add_joint_clip(model, &desc), HF_ERROR_INVALID_ARGUMENT);
  posed[10 * info.joint_count + 3] = NAN;
  assert_int_equal(hf_gltf_model_add_joint_clip(model, &desc), HF_ERROR_NON_FINITE);
  hf_error_detail detail;
  assert_int_equal(hf_gltf_error_get_detail(&detail), HF_OK);
  assert_int_equal(detail.index, 1);
  times[1] = times[0];
  assert_int_equal(hf_gltf_model_add_joint_clip(model, &desc), HF_ERROR_INVALID_ARGUMENT);
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_OK);
  assert_int_equal(info.clip_count, 2); /* refused calls changed nothing */
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(still);
}

static void a_skin_follows_frames(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still);
  double frames[2 * 3 * VERTICES], times[2] = {0, 0.5}, posed[3 * VERTICES];
  for (int f = 0; f < 2; ++f) assert_int_equal(hf_gltf_model_pose(model, 0, f, frames + f * 3 * VERTICES), HF_OK);
  hf_gltf_frames_desc desc = HF_INIT(hf_gltf_frames_desc);
  desc.frame_count = 2;
  desc.times = times;
  desc.positions = frames;
  desc.name = "swing";
  hf_gltf_fit_info fit = HF_INIT(hf_gltf_fit_info);
  assert_int_equal(hf_gltf_model_add_clip(model, &desc, &fit), HF_OK);
  assert_true(fit.joint_count == 2 && fit.max < 1e-2);
  hf_gltf_clip_info clip = HF_INIT(hf_gltf_clip_info);
  assert_int_equal(hf_gltf_model_get_clip(model, 0, &clip), HF_OK);
  assert_string_equal(clip.name, "swing (2)"); /* there was one of that name */
  assert_int_equal(hf_gltf_model_pose(model, 0, 0.5, posed), HF_OK);
  assert_true(fabs(posed[3 * 9] + 2) < 1e-2 && fabs(posed[3 * 9 + 1] - 3) < 1e-2);
  /* without a skin there is no joint to turn */
  assert_int_equal(hf_gltf_model_add_clip(still, &desc, NULL), HF_ERROR_UNSUPPORTED);
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(still);
}

/* Frames that are shorter than the bones: half of the rest would stick out at each end. It sticks out above. */
static void a_fitted_skin_does_not_sink_under_the_frames(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still);
  double frames[3 * 3 * VERTICES + 3], times[3] = {0, 0.5, 1}, posed[3 * VERTICES];
  for (uint32_t c = 0; c < 3; ++c) frames[3 * 3 * VERTICES + c] = -1e30; /* behind the frames: no ground */
  for (uint32_t i = 0; i < 3 * 3 * VERTICES; ++i) {
    const uint32_t vertex = i / 3 % VERTICES;
    frames[i] = i % 3 == 0 ? vertex % 2 : i % 3 == 1 ? 0.9 * (vertex / 2) : 0;
  }
  hf_gltf_frames_desc desc = HF_INIT(hf_gltf_frames_desc);
  desc.frame_count = 3;
  desc.times = times;
  desc.positions = frames;
  assert_int_equal(hf_gltf_model_add_clip(model, &desc, NULL), HF_OK);
  for (int f = 0; f < 3; ++f) {
    double lowest = 1, highest = 0;
    assert_int_equal(hf_gltf_model_pose(model, 0, times[f], posed), HF_OK);
    for (uint32_t v = 0; v < VERTICES; ++v) {
      if (posed[3 * v + 1] < lowest) lowest = posed[3 * v + 1];
      if (posed[3 * v + 1] > highest) highest = posed[3 * v + 1];
    }
    assert_true(lowest > -0.01 && highest > 3.6); /* without a ground -0.2 and 3.8 */
  }
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(still);
}

static void clips_go_to_a_skeleton_of_the_same_names(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still), other = swinging(still);
  uint32_t joints = 0;
  assert_int_equal(hf_gltf_model_add_clips_of(model, other, &joints), HF_OK);
  assert_int_equal(joints, 2);
  hf_gltf_model_info info = HF_INIT(hf_gltf_model_info);
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_OK);
  assert_int_equal(info.clip_count, 2);
  assert_int_equal(hf_gltf_model_add_clips_of(still, other, NULL), HF_ERROR_INVALID_ARGUMENT);
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(other);
  hf_gltf_model_destroy(still);
}

static const char pairs_text[] =
    "{\"pairs\": [{\"name\": \"low\", \"both\": {\"vertices\": [0, 1]}, \"foot\": true},"
    " {\"name\": \"high\", \"both\": {\"vertices\": [8, 9]}}]}";

static void pairs_give_regions_and_come_back(void** state) {
  (void)state;
  hf_gltf_model model = strip();
  hf_gltf_pairs pairs, again;
  assert_int_equal(hf_gltf_pairs_read(model, model, pairs_text, sizeof pairs_text - 1, &pairs), HF_OK);
  hf_gltf_pairs_info info = HF_INIT(hf_gltf_pairs_info);
  assert_int_equal(hf_gltf_pairs_get_info(pairs, &info), HF_OK);
  assert_int_equal(info.pair_count, 2);
  near_to((double)info.source_axes[4], 1);
  near_to((double)info.scale, 0); /* a strip has no legs */
  assert_int_equal(info.ground, HF_GROUND_KEEP);
  hf_gltf_pair pair = HF_INIT(hf_gltf_pair);
  assert_int_equal(hf_gltf_pairs_get_pair(pairs, 1, &pair), HF_OK);
  assert_string_equal(pair.name, "high");
  assert_int_equal(pair.target_count, 2);
  uint32_t vertices[2] = {77, 77};
  assert_int_equal(hf_gltf_pairs_get_regions(pairs, 1, 0, NULL, 1, vertices), HF_ERROR_TOO_SMALL);
  assert_int_equal(vertices[0], 77);
  assert_int_equal(hf_gltf_pairs_get_regions(pairs, 1, 0, NULL, 2, vertices), HF_OK);
  assert_int_equal(vertices[0] + 10 * vertices[1], 98);
  assert_int_equal(hf_gltf_pairs_get_pair(pairs, 2, &pair), HF_ERROR_OUT_OF_RANGE);
  uint64_t count = 0;
  assert_int_equal(hf_gltf_pairs_write(pairs, 0, NULL, &count), HF_OK);
  char* text = malloc((size_t)count);
  assert_int_equal(hf_gltf_pairs_write(pairs, count - 1, text, &count), HF_ERROR_TOO_SMALL);
  assert_int_equal(hf_gltf_pairs_write(pairs, count, text, &count), HF_OK);
  hf_gltf_model_destroy(model); /* pairs stay */
  model = strip();
  assert_int_equal(hf_gltf_pairs_read(model, model, text, count, &again), HF_OK);
  assert_int_equal(hf_gltf_pairs_get_info(again, &info), HF_OK);
  assert_int_equal(info.pair_count, 2);
  static const char wet[] =
      "{\"settings\": {\"ground\": false}, \"pairs\": [{\"name\": \"a\", \"both\": {\"vertices\": [0]}}]}";
  hf_gltf_pairs swimming;
  assert_int_equal(hf_gltf_pairs_read(model, model, wet, sizeof wet - 1, &swimming), HF_OK);
  assert_int_equal(hf_gltf_pairs_get_info(swimming, &info), HF_OK);
  assert_int_equal(info.ground, HF_GROUND_OFF);
  hf_gltf_pairs_destroy(swimming);
  /* a strip is no creature */
  hf_gltf_pairs none = pairs;
  assert_int_equal(hf_gltf_pairs_propose(model, model, NULL, &none), HF_ERROR_EMPTY);
  assert_null(none);
  assert_int_equal(hf_gltf_pairs_read(model, model, "{\"pears\": 1}", 12, &none), HF_ERROR_INVALID_ARGUMENT);
  /* chains name joints, which pairs of surfaces do not have */
  static const char chains[] =
      "{\"pairs\": [{\"name\": \"a\", \"both\": {\"vertices\": [0]}}],"
      " \"chains\": [{\"name\": \"tail\", \"both\": [\"Tail\"]}]}";
  assert_int_equal(hf_gltf_pairs_read(model, model, chains, sizeof chains - 1, &none), HF_ERROR_INVALID_ARGUMENT);
  free(text);
  hf_gltf_pairs_destroy(pairs);
  hf_gltf_pairs_destroy(again);
  hf_gltf_model_destroy(model);
}

/* It lies nearest to the places of both pairs, or so far away that the box would be another. */
static void a_vertex_without_a_triangle_is_in_no_region(void** state) {
  (void)state;
  static const char text[] =
      "{\"pairs\": [{\"name\": \"low\", \"both\": {\"position\": [0.5, -0.4, 0], \"radius\": 0.2}},"
      " {\"name\": \"high\", \"both\": {\"position\": [0.5, 9, 0], \"radius\": 0.1}}]}";
  hf_gltf_model plain = strip();
  const double strays[3][3] = {{0.5, -0.4, 0}, {0.5, 9, 0}, {1e5, 0, 0}};
  for (int s = 0; s < 3; ++s) {
    double positions[3 * (VERTICES + 1)] = {0};
    uint32_t triangles[3 * TRIANGLES];
    for (uint32_t v = 0; v < VERTICES; ++v) {
      positions[3 * v] = (double)(v % 2);
      positions[3 * v + 1] = (double)(v / 2);
    }
    memcpy(positions + 3 * VERTICES, strays[s], sizeof strays[s]);
    for (uint32_t r = 0; r + 1 < ROWS; ++r) {
      const uint32_t a = 2 * r, corners[6] = {a, a + 1, a + 2, a + 2, a + 1, a + 3};
      memcpy(triangles + 6 * r, corners, sizeof corners);
    }
    hf_gltf_mesh_desc desc = HF_INIT(hf_gltf_mesh_desc);
    desc.vertex_count = VERTICES + 1;
    desc.triangle_count = TRIANGLES;
    desc.positions = positions;
    desc.triangles = triangles;
    hf_gltf_model model;
    hf_gltf_pairs pairs, expected;
    assert_int_equal(hf_gltf_model_create(&desc, &model), HF_OK);
    assert_int_equal(hf_gltf_pairs_read(model, plain, text, sizeof text - 1, &pairs), HF_OK);
    assert_int_equal(hf_gltf_pairs_read(plain, plain, text, sizeof text - 1, &expected), HF_OK);
    for (uint32_t p = 0; p < 2; ++p) {
      hf_gltf_pair found = HF_INIT(hf_gltf_pair), wanted = HF_INIT(hf_gltf_pair);
      assert_int_equal(hf_gltf_pairs_get_pair(pairs, p, &found), HF_OK);
      assert_int_equal(hf_gltf_pairs_get_pair(expected, p, &wanted), HF_OK);
      assert_int_equal(found.source_count, wanted.source_count);
      assert_true(found.source_radius == wanted.source_radius);
      uint32_t vertices[VERTICES], others[VERTICES];
      assert_int_equal(hf_gltf_pairs_get_regions(pairs, p, VERTICES, vertices, 0, NULL), HF_OK);
      assert_int_equal(hf_gltf_pairs_get_regions(expected, p, VERTICES, others, 0, NULL), HF_OK);
      assert_memory_equal(vertices, others, found.source_count * sizeof *vertices);
    }
    hf_gltf_pairs_destroy(pairs);
    hf_gltf_pairs_destroy(expected);
    hf_gltf_model_destroy(model);
  }
  hf_gltf_model_destroy(plain);
}

static void refused_calls_change_nothing(void** state) {
  (void)state;
  hf_gltf_model still = strip(), model = swinging(still), other = still;
  uint64_t count = 0, same = 0;
  void* bytes = written(model, HF_GLTF_GLB, &count);
  double positions[3 * VERTICES] = {0};
  positions[7] = NAN;
  hf_error_detail detail;
  assert_int_equal(hf_gltf_model_set_positions(model, positions), HF_ERROR_NON_FINITE);
  assert_int_equal(hf_gltf_error_get_detail(&detail), HF_OK);
  assert_int_equal(detail.index, 2);
  assert_string_equal(detail.function, "hf_gltf_model_set_positions");
  assert_int_equal(hf_gltf_model_remove_keys(model, 0, -1, NULL), HF_ERROR_INVALID_ARGUMENT);
  assert_int_equal(hf_gltf_model_remove_keys(model, 1, 1, NULL), HF_ERROR_OUT_OF_RANGE);
  assert_int_equal(hf_gltf_model_pose(model, 0, INFINITY, positions), HF_ERROR_NON_FINITE);
  double times[2] = {0.5, 0.5}, frames[6 * VERTICES] = {0};
  hf_gltf_frames_desc desc = HF_INIT(hf_gltf_frames_desc);
  desc.frame_count = 2;
  desc.times = times;
  desc.positions = frames;
  assert_int_equal(hf_gltf_model_add_clip(model, &desc, NULL), HF_ERROR_INVALID_ARGUMENT);
  times[1] = 1;
  frames[6 * VERTICES - 1] = NAN;
  assert_int_equal(hf_gltf_model_add_clip(model, &desc, NULL), HF_ERROR_NON_FINITE);
  frames[6 * VERTICES - 1] = 1e200; /* files hold floats */
  assert_int_equal(hf_gltf_model_add_clip(model, &desc, NULL), HF_ERROR_TOO_LARGE);
  assert_int_equal(hf_gltf_error_get_detail(&detail), HF_OK);
  assert_int_equal(detail.index, 1);
  positions[7] = -1e39;
  assert_int_equal(hf_gltf_model_set_positions(model, positions), HF_ERROR_TOO_LARGE);
  assert_int_equal(hf_gltf_model_write(model, 2, 0, NULL, &same), HF_ERROR_INVALID_ARGUMENT);
  assert_int_equal(hf_gltf_model_write(model, HF_GLTF_GLB, count - 1, bytes, &same), HF_ERROR_TOO_SMALL);
  void* after = written(model, HF_GLTF_GLB, &same);
  assert_int_equal(same, count);
  assert_memory_equal(after, bytes, (size_t)count);
  assert_int_equal(hf_gltf_model_save(model, "no_such_folder/a.glb"), HF_ERROR_INVALID_ARGUMENT);
  assert_int_equal(hf_gltf_model_save(model, NULL), HF_ERROR_NULL_POINTER);
  /* a cut file, and handles that are none */
  assert_int_equal(reread(bytes, count / 2, &other), HF_ERROR_INVALID_ARGUMENT);
  assert_null(other);
  assert_int_equal(reread(bytes, count, NULL), HF_ERROR_NULL_POINTER);
  hf_gltf_model_info info = HF_INIT(hf_gltf_model_info);
  info.struct_size = 4;
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_ERROR_INVALID_DESC);
  info.struct_size = sizeof info;
  assert_int_equal(hf_gltf_model_get_info(NULL, &info), HF_ERROR_INVALID_OBJECT);
  hf_gltf_pairs_destroy((hf_gltf_pairs)model); /* of another kind: nothing happens */
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_OK);
  hf_gltf_model_destroy(model);
  hf_gltf_model_destroy(model);
  assert_int_equal(hf_gltf_model_get_info(model, &info), HF_ERROR_INVALID_OBJECT);
  free(bytes);
  free(after);
  hf_gltf_model_destroy(still);
}

static void moved_vertices_stay_in_the_file(void** state) {
  (void)state;
  hf_gltf_model model = strip(), again;
  double positions[3 * VERTICES];
  hf_gltf_surface surface = HF_INIT(hf_gltf_surface);
  surface.positions = positions;
  assert_int_equal(hf_gltf_model_get_surface(model, &surface), HF_OK);
  positions[3 * 9 + 2] = 0.5;
  assert_int_equal(hf_gltf_model_set_positions(model, positions), HF_OK);
  uint64_t count;
  void* bytes = written(model, HF_GLTF_GLB, &count);
  assert_int_equal(reread(bytes, count, &again), HF_OK);
  assert_int_equal(hf_gltf_model_get_surface(again, &surface), HF_OK);
  near_to(positions[3 * 9 + 2], 0.5);
  free(bytes);
  hf_gltf_model_destroy(again);
  hf_gltf_model_destroy(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_mesh_gives_its_surface_back),
                                     cmocka_unit_test(a_mesh_far_from_0_keeps_its_digits),
                                     cmocka_unit_test(a_written_clip_plays_as_it_was_given),
                                     cmocka_unit_test(keys_between_straight_ones_are_left_out),
                                     cmocka_unit_test(joints_give_their_clip_back),
                                     cmocka_unit_test(a_skin_follows_frames),
                                     cmocka_unit_test(a_fitted_skin_does_not_sink_under_the_frames),
                                     cmocka_unit_test(clips_go_to_a_skeleton_of_the_same_names),
                                     cmocka_unit_test(pairs_give_regions_and_come_back),
                                     cmocka_unit_test(a_vertex_without_a_triangle_is_in_no_region),
                                     cmocka_unit_test(refused_calls_change_nothing),
                                     cmocka_unit_test(moved_vertices_stay_in_the_file)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
