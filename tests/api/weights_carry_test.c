/* Carried and mirrored weights and helper bones through the C ABI, and every bad argument named. */
#include "bad_scene.h"

enum { INFLUENCES = 2 };

static Scene scene;
static hf_weights_transfer_desc carry;
static hf_weights_mirror_desc mirror;
static hf_weights_out out;
static hf_weights_transfer_info carried;
static hf_weights_mirror_info mirrored;
static uint32_t joints[INFLUENCES * TUBE_VERTICES], out_joints[8 * TUBE_VERTICES], partners[3], out_partners[3],
    pairings[3];
static float weights[INFLUENCES * TUBE_VERTICES], out_weights[8 * TUBE_VERTICES];
static uint16_t narrow[8 * TUBE_VERTICES];
static double heads[9], plane[6];
static uint32_t reasons[3];

static void good(void) {
  for (size_t v = 0; v < TUBE_VERTICES; ++v) {
    joints[2 * v] = 0;
    joints[2 * v + 1] = 2;
    weights[2 * v + 1] = (float)v / TUBE_VERTICES;
    weights[2 * v] = 1 - weights[2 * v + 1];
  }
  const hf_joints_desc bones = scene_bones();
  memcpy(heads, bones.heads, sizeof heads);
  for (int b = 0; b < 3; ++b) partners[b] = HF_NO_INDEX;
  for (int i = 0; i < 6; ++i) plane[i] = i == 3;
  out = HF_INIT(hf_weights_out);
  out.vertex_capacity = TUBE_VERTICES;
  out.joints = out_joints;
  out.weights = out_weights;
  carry = HF_INIT(hf_weights_transfer_desc);
  mirror = HF_INIT(hf_weights_mirror_desc);
  carried = HF_INIT(hf_weights_transfer_info);
  mirrored = HF_INIT(hf_weights_mirror_info);
  carry.source_influence_count = mirror.source_influence_count = INFLUENCES;
  carry.joints = mirror.joints = joints;
  carry.weights = mirror.weights = weights;
  mirror.joint_count = 3;
  mirror.heads = heads;
  mirror.partners = partners;
  mirror.plane = plane;
  memset(out_weights, 0x55, sizeof out_weights);
  memset(out_partners, 0x55, sizeof out_partners);
}

static int nothing_is_written(void) {
  const unsigned char* bytes = (const unsigned char*)out_weights;
  for (size_t i = 0; i < sizeof out_weights; ++i) {
    if (bytes[i] != 0x55) return 0;
  }
  return out_partners[0] == 0x55555555u;
}

#define GOOD good
#define UNCHANGED() (weights_unchanged(&scene) && nothing_is_written())
/* What both read alike. */
#define BOTH(what, expected, index, change)                                                                \
  ROW(what, expected, index, change, hf_weights_transfer(scene.body, scene.body, &carry, &out, &carried)); \
  ROW(what, expected, index, change,                                                                       \
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL))

static void bad_weights_are_named(void** state) {
  (void)state;
  scene_create(&scene);
  BOTH("no influence", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
       carry.source_influence_count = mirror.source_influence_count = 0);
  BOTH("65 influences", HF_ERROR_INVALID_ARGUMENT, NO_INDEX,
       carry.source_influence_count = mirror.source_influence_count = 65);
  BOTH("joints NULL", HF_ERROR_NULL_POINTER, NO_INDEX, carry.joints = mirror.joints = NULL);
  BOTH("weights NULL", HF_ERROR_NULL_POINTER, NO_INDEX, carry.weights = mirror.weights = NULL);
  BOTH("a weight is NaN", HF_ERROR_NON_FINITE, 7, weights[15] = NAN);
  BOTH("a weight below 0", HF_ERROR_INVALID_ARGUMENT, 9, weights[18] = -0.5f);
  BOTH("all weights 0", HF_ERROR_EMPTY, NO_INDEX, memset(weights, 0, sizeof weights));
  BOTH("distance NaN", HF_ERROR_NON_FINITE, NO_INDEX, carry.distance = mirror.distance = NAN);
  BOTH("distance below 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, carry.distance = mirror.distance = -1);
  BOTH("angle infinite", HF_ERROR_NON_FINITE, NO_INDEX, carry.angle = mirror.angle = INFINITY);
  BOTH("angle of 4", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, carry.angle = mirror.angle = 4);
  BOTH("5 weights", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, carry.influence_count = mirror.influence_count = 5);
  BOTH("reserved", HF_ERROR_INVALID_DESC, NO_INDEX, carry.reserved = mirror.reserved = 1);
  hf_progress progress = NULL;
  assert_ok(hf_progress_create(&progress));
  BOTH("cancelled", HF_ERROR_CANCELLED, NO_INDEX,
       (assert_ok(hf_progress_cancel(progress)), carry.progress = mirror.progress = progress));
  hf_progress_destroy(progress);
  BOTH("a small capacity", HF_ERROR_TOO_SMALL, NO_INDEX, out.vertex_capacity = TUBE_VERTICES - 1);
  ROW("a huge joint", HF_ERROR_OUT_OF_RANGE, 11, joints[23] = 1u << 20,
      hf_weights_transfer(scene.body, scene.body, &carry, &out, &carried));
  ROW("a joint beyond 16 bits", HF_ERROR_TOO_LARGE, NO_INDEX, (joints[23] = 70000, out.joints_u16 = narrow),
      hf_weights_transfer(scene.body, scene.body, &carry, &out, &carried));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_weights_transfer(scene.body, scene.body, &carry, NULL, &carried));
  ROW("desc NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_weights_transfer(scene.body, scene.body, NULL, &out, NULL));
  finish_rows("carried weights");
  scene_destroy(&scene);
}

static void bad_mirrors_are_named(void** state) {
  (void)state;
  scene_create(&scene);
  ROW("no bone", HF_ERROR_EMPTY, NO_INDEX, mirror.joint_count = 0,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("too many bones", HF_ERROR_TOO_LARGE, NO_INDEX, mirror.joint_count = UINT32_MAX,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("heads NULL", HF_ERROR_NULL_POINTER, NO_INDEX, mirror.heads = NULL,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a head is NaN", HF_ERROR_NON_FINITE, 2, heads[7] = NAN,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("two lines for three bones", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, mirror.names = "a\nb\n",
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a partner beyond the bones", HF_ERROR_OUT_OF_RANGE, 1, partners[1] = 3,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a partner of another", HF_ERROR_INVALID_ARGUMENT, 0, (partners[0] = 1, partners[1] = 2),
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a plane with NaN", HF_ERROR_NON_FINITE, NO_INDEX, plane[1] = NAN,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a normal without length", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, plane[3] = 0,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a side that is none", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, mirror.to = 3,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("a joint beyond the bones", HF_ERROR_OUT_OF_RANGE, 4, joints[8] = 3,
      hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_weights_mirror(scene.body, &mirror, NULL, NULL, NULL, NULL, NULL));
  ROW("helpers: names of two bones", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0,
      hf_weights_get_helpers(scene.weights, "a\nb", 3, reasons, NULL));
  ROW("helpers: a small capacity", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_weights_get_helpers(scene.weights, NULL, 2, reasons, NULL));
  ROW("helpers: nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_weights_get_helpers(scene.weights, NULL, 0, NULL, NULL));
  finish_rows("mirrored weights");
  scene_destroy(&scene);
}

static void weights_are_carried_mirrored_and_helpers_named(void** state) {
  (void)state;
  scene_create(&scene);
  good();
  assert_ok(hf_weights_transfer(scene.body, scene.body, &carry, &out, &carried));
  assert_int_equal(carried.vertex_count, TUBE_VERTICES);
  assert_int_equal(carried.matched_count + carried.solved_count, TUBE_VERTICES);
  for (size_t v = 0; v < TUBE_VERTICES; ++v)
    assert_true(out_weights[4 * v] + out_weights[4 * v + 1] + out_weights[4 * v + 2] + out_weights[4 * v + 3] == 1.0f);
  uint32_t plain = 0;
  assert_ok(hf_weights_get_helpers(scene.weights, "Root\nspine\npole.L", 3, reasons, &plain));
  assert_int_equal(plain, 3);
  assert_int_equal(reasons[0], HF_HELPER_PROPOSED | HF_HELPER_NAME_ROOT | HF_HELPER_ROOT);
  assert_int_equal(reasons[1], 0);
  assert_int_equal(reasons[2], HF_HELPER_NAME_CONTROL);
  /* the two ends of the tube are two sides */
  plane[1] = 6.75;
  plane[3] = 0;
  plane[4] = 2;
  partners[0] = 2;
  carry.influence_count = 8;
  assert_ok(hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  assert_int_equal(out_partners[0], 2);
  assert_int_equal(out_partners[2], 0);
  assert_int_equal(pairings[0], HF_MIRROR_JOINT_GIVEN);
  assert_int_equal(mirrored.plane_from, HF_MIRROR_PLANE_GIVEN);
  assert_true(fabs(mirrored.normal[1] - 1) < 1e-12);
  assert_int_equal(mirrored.given_count, 2);
  mirror.plane = NULL;
  mirror.partners = NULL;
  assert_ok(hf_weights_mirror(scene.body, &mirror, &out, out_partners, pairings, &mirrored, NULL));
  assert_true(mirrored.plane_from == HF_MIRROR_PLANE_SURFACE);
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bad_weights_are_named), cmocka_unit_test(bad_mirrors_are_named),
                                     cmocka_unit_test(weights_are_carried_mirrored_and_helpers_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
