/* Skin weights through the C ABI: sums, welded copies, pins, locks, moved joints, clones, and every bad argument named.
 */
#include "bad_scene.h"
#include "support/place_in.h"

static Scene scene;
static hf_joints_desc bones;
static hf_pins_desc pins;
static double heads[9], tails[9], radii[2];
static hf_place places[2];
static uint32_t parents[3], sources[3], vertices[2], joints[4], locks[2];
static int32_t deforms[3];
static float weights[4], values[2 * TUBE_VERTICES];

static void good(void) {
  bones = scene_bones();
  memcpy(heads, bones.heads, sizeof heads);
  memcpy(tails, bones.tails, sizeof tails);
  memcpy(parents, bones.parents, sizeof parents);
  bones.heads = heads;
  bones.tails = tails;
  bones.parents = parents;
  bones.deforms = deforms;
  for (uint32_t b = 0; b < 3; ++b) {
    deforms[b] = 1;
    sources[b] = b;
  }
  vertices[0] = 30;
  vertices[1] = 60;
  locks[0] = 0;
  locks[1] = 2;
  for (int i = 0; i < 4; ++i) {
    joints[i] = (uint32_t)(i % 2);
    weights[i] = 0.5f;
  }
  const double shares[3] = {0.5, 0.25, 0.25};
  places[0] = place_in(scene.tube.triangles, scene.tube.triangle_count, 40, shares);
  places[1] = place_in(scene.tube.triangles, scene.tube.triangle_count, 90, shares);
  radii[0] = radii[1] = 0;
  for (size_t i = 0; i < COUNT_OF(values); ++i) values[i] = 0.25f;
  pins = HF_INIT(hf_pins_desc);
  pins.pin_count = 2;
  pins.influence_count = 2;
  pins.vertices = vertices;
  pins.joints = joints;
  pins.weights = weights;
  pins.radii = radii;
}

static void between_corners(void) {
  pins.vertices = NULL;
  pins.places = places;
}

static hf_weights made;

#define GOOD good
#define UNCHANGED() (weights_unchanged(&scene) && made == NULL)

static void bad_bones_are_named(void** state) {
  (void)state;
  scene_create(&scene);
  ROW("no bone", HF_ERROR_EMPTY, NO_INDEX, bones.joint_count = 0, hf_weights_create(scene.body, &bones, 4, &made));
  ROW("heads NULL", HF_ERROR_NULL_POINTER, NO_INDEX, bones.heads = NULL,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_weights_create(scene.body, &bones, 4, NULL));
  ROW("5 weights", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, hf_weights_create(scene.body, &bones, 5, &made));
  ROW("too many bones", HF_ERROR_TOO_LARGE, NO_INDEX, bones.joint_count = UINT32_MAX,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("sources at creation", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bones.sources = sources,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("a head is NaN", HF_ERROR_NON_FINITE, 1, heads[4] = NAN, hf_weights_create(scene.body, &bones, 4, &made));
  ROW("a tail is infinite", HF_ERROR_NON_FINITE, 2, tails[6] = INFINITY,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("tails and axes", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, bones.axes = heads,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("an axis is NaN", HF_ERROR_NON_FINITE, 2, (bones.tails = NULL, bones.axes = tails, tails[8] = NAN),
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("a parent beyond the bones", HF_ERROR_OUT_OF_RANGE, 1, parents[1] = 3,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("its own parent", HF_ERROR_INVALID_ARGUMENT, 2, parents[2] = 2, hf_weights_create(scene.body, &bones, 4, &made));
  ROW("parents in a circle", HF_ERROR_INVALID_ARGUMENT, 0, parents[0] = 2,
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("deforms is 2", HF_ERROR_INVALID_ARGUMENT, 1, deforms[1] = 2, hf_weights_create(scene.body, &bones, 4, &made));
  ROW("none deforms", HF_ERROR_EMPTY, NO_INDEX, memset(deforms, 0, sizeof deforms),
      hf_weights_create(scene.body, &bones, 8, &made));
  ROW("moved: no bone", HF_ERROR_EMPTY, NO_INDEX, bones.joint_count = 0, hf_weights_set_joints(scene.weights, &bones));
  ROW("moved: a head is NaN", HF_ERROR_NON_FINITE, 0, heads[0] = NAN, hf_weights_set_joints(scene.weights, &bones));
  ROW("moved: a parent beyond", HF_ERROR_OUT_OF_RANGE, 2, parents[2] = 9, hf_weights_set_joints(scene.weights, &bones));
  ROW("moved: none deforms", HF_ERROR_EMPTY, NO_INDEX, memset(deforms, 0, sizeof deforms),
      hf_weights_set_joints(scene.weights, &bones));
  ROW("a source beyond", HF_ERROR_OUT_OF_RANGE, 1, (bones.sources = sources, sources[1] = 3),
      hf_weights_set_joints(scene.weights, &bones));
  ROW("a source twice", HF_ERROR_DUPLICATE, 2, (bones.sources = sources, sources[2] = 0),
      hf_weights_set_joints(scene.weights, &bones));
  finish_rows("bones");
  scene_destroy(&scene);
}

static void bad_pins_and_locks_are_named(void** state) {
  (void)state;
  scene_create(&scene);
  ROW("no place", HF_ERROR_NULL_POINTER, NO_INDEX, pins.vertices = NULL, hf_weights_set_pins(scene.weights, &pins));
  ROW("two kinds of places", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, pins.places = places,
      hf_weights_set_pins(scene.weights, &pins));
  ROW("no joints", HF_ERROR_NULL_POINTER, NO_INDEX, pins.joints = NULL, hf_weights_set_pins(scene.weights, &pins));
  ROW("no weights", HF_ERROR_NULL_POINTER, NO_INDEX, pins.weights = NULL, hf_weights_set_pins(scene.weights, &pins));
  ROW("reserved", HF_ERROR_INVALID_DESC, NO_INDEX, pins.reserved = 1, hf_weights_set_pins(scene.weights, &pins));
  ROW("no joint each", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, pins.influence_count = 0,
      hf_weights_set_pins(scene.weights, &pins));
  ROW("nine joints each", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, pins.influence_count = 9,
      hf_weights_set_pins(scene.weights, &pins));
  ROW("more pins than vertices", HF_ERROR_TOO_LARGE, NO_INDEX, pins.pin_count = TUBE_VERTICES + 1,
      hf_weights_set_pins(scene.weights, &pins));
  ROW("a vertex beyond", HF_ERROR_OUT_OF_RANGE, 1, vertices[1] = TUBE_VERTICES,
      hf_weights_set_pins(scene.weights, &pins));
  ROW("a corner beyond", HF_ERROR_OUT_OF_RANGE, 1, (between_corners(), places[1].corners[2] = UINT32_MAX),
      hf_weights_set_pins(scene.weights, &pins));
  ROW("a barycentric NaN", HF_ERROR_NON_FINITE, 1, (between_corners(), places[1].barycentrics[1] = NAN),
      hf_weights_set_pins(scene.weights, &pins));
  ROW("barycentrics of another sum", HF_ERROR_INVALID_ARGUMENT, 0, (between_corners(), places[0].barycentrics[0] = 1),
      hf_weights_set_pins(scene.weights, &pins));
  ROW("a joint beyond", HF_ERROR_OUT_OF_RANGE, 1, joints[2] = 3, hf_weights_set_pins(scene.weights, &pins));
  ROW("a weight NaN", HF_ERROR_NON_FINITE, 0, weights[1] = NAN, hf_weights_set_pins(scene.weights, &pins));
  ROW("a weight below 0", HF_ERROR_INVALID_ARGUMENT, 1, weights[3] = -0.5f, hf_weights_set_pins(scene.weights, &pins));
  ROW("weights of sum 0", HF_ERROR_INVALID_ARGUMENT, 1, weights[2] = weights[3] = 0,
      hf_weights_set_pins(scene.weights, &pins));
  ROW("a radius NaN", HF_ERROR_NON_FINITE, 1, radii[1] = NAN, hf_weights_set_pins(scene.weights, &pins));
  ROW("a radius below 0", HF_ERROR_INVALID_ARGUMENT, 0, radii[0] = -1, hf_weights_set_pins(scene.weights, &pins));
  ROW("a vertex twice", HF_ERROR_DUPLICATE, 1, vertices[1] = vertices[0], hf_weights_set_pins(scene.weights, &pins));
  ROW("discs that overlap", HF_ERROR_DUPLICATE, 1, (vertices[1] = 31, radii[0] = 2),
      hf_weights_set_pins(scene.weights, &pins));
  ROW("a lock beyond", HF_ERROR_OUT_OF_RANGE, 1, locks[1] = 3, hf_weights_set_locks(scene.weights, 2, locks, NULL));
  ROW("a lock twice", HF_ERROR_DUPLICATE, 1, locks[1] = 0, hf_weights_set_locks(scene.weights, 2, locks, NULL));
  ROW("more locks than bones", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0,
      hf_weights_set_locks(scene.weights, 4, locks, NULL));
  ROW("no list of locks", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_weights_set_locks(scene.weights, 1, NULL, NULL));
  ROW("a kept weight NaN", HF_ERROR_NON_FINITE, 5, values[11] = NAN,
      hf_weights_set_locks(scene.weights, 2, locks, values));
  ROW("a kept weight above 1", HF_ERROR_INVALID_ARGUMENT, 7, values[14] = 1.5f,
      hf_weights_set_locks(scene.weights, 2, locks, values));
  finish_rows("pins");
  scene_destroy(&scene);
}

/* A progress object that stops the next call. */
static hf_progress cancelled(void) {
  static hf_progress progress;
  hf_progress_destroy(progress);
  assert_ok(hf_progress_create(&progress));
  assert_ok(hf_progress_cancel(progress));
  return progress;
}

static void a_cancelled_call_changes_nothing(void** state) {
  (void)state;
  scene_create(&scene);
  ROW("made", HF_ERROR_CANCELLED, NO_INDEX, bones.progress = cancelled(),
      hf_weights_create(scene.body, &bones, 4, &made));
  ROW("moved", HF_ERROR_CANCELLED, NO_INDEX, (bones.progress = cancelled(), heads[0] += 0.5),
      hf_weights_set_joints(scene.weights, &bones));
  ROW("pinned", HF_ERROR_CANCELLED, NO_INDEX, pins.progress = cancelled(), hf_weights_set_pins(scene.weights, &pins));
  /* the cancel stopped one call only */
  assert_ok(hf_weights_set_pins(scene.weights, &pins));
  hf_progress_destroy(pins.progress);
  finish_rows("cancelled weights");
  scene_destroy(&scene);
}

static void bad_outputs_are_refused(void** state) {
  (void)state;
  scene_create(&scene);
  hf_weights_out out = HF_INIT(hf_weights_out);
  uint32_t count = 0, flags[3];
  out.vertex_capacity = TUBE_VERTICES - 1;
  out.weights = values;
  ROW("capacity too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_weights_get(scene.weights, &out));
  assert_int_equal(out.vertex_count, TUBE_VERTICES);
  ROW("bones: capacity too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_weights_get_joints(scene.weights, 2, flags, NULL, &count));
  assert_int_equal(count, 3);
  ROW("bones: nothing asked", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_weights_get_joints(scene.weights, 0, NULL, NULL, NULL));
  finish_rows("outputs");
  scene_destroy(&scene);
}

/* Both widths of joints agree; weights descend and sum to exactly 1. */
static void get_all(hf_weights object, uint32_t* out_joints, float* out_weights) {
  static uint16_t narrow[8 * TUBE_VERTICES];
  static uint8_t origins[TUBE_VERTICES];
  hf_weights_out out = HF_INIT(hf_weights_out);
  assert_ok(hf_weights_get(object, &out));
  out.vertex_capacity = out.vertex_count;
  out.joints = out_joints;
  out.joints_u16 = narrow;
  out.weights = out_weights;
  out.origins = origins;
  assert_ok(hf_weights_get(object, &out));
  for (uint32_t v = 0; v < out.vertex_count; ++v) {
    float sum = 0;
    for (uint32_t k = v * out.influence_count; k < (v + 1) * out.influence_count; ++k) {
      assert_int_equal(narrow[k], out_joints[k]);
      assert_true(k == v * out.influence_count || out_weights[k] <= out_weights[k - 1]);
      sum += out_weights[k];
    }
    assert_true(sum == 1.0f);
    assert_true(origins[v] <= HF_WEIGHTS_ISOLATED);
  }
}

static void every_vertex_gets_weights(void** state) {
  (void)state;
  static uint32_t list[8 * TUBE_VERTICES];
  static float shares[8 * TUBE_VERTICES];
  scene_create(&scene);
  good();
  hf_weights wide = NULL;
  assert_ok(hf_weights_create(scene.body, &bones, 8, &wide));
  get_all(wide, list, shares);
  get_all(scene.weights, list, shares);
  assert_int_equal(list[4 * 2 * TUBE_AROUND], 0);
  assert_int_equal(list[4 * 12 * TUBE_AROUND], 2);
  /* joints without tails reach to their children */
  bones.tails = NULL;
  assert_ok(hf_weights_set_joints(wide, &bones));
  static const double up[9] = {0, 2, 0, 0, 0, 0, 0, 1, 0};
  bones.axes = up;
  assert_ok(hf_weights_set_joints(wide, &bones));
  get_all(wide, list, shares);
  hf_weights_destroy(wide);
  /* an isolated vertex, a piece without a bone and a seam */
  hf_weights cut = NULL;
  static const double head[6] = {1, 2, -0.5, 6, 2, -0.5}, tail[6] = {3, 2, -0.5, 7, 2, -0.5};
  hf_joints_desc two = HF_INIT(hf_joints_desc);
  two.joint_count = 2;
  two.heads = head;
  two.tails = tail;
  assert_ok(hf_weights_create(scene.sheet, &two, 4, &cut));
  get_all(cut, list, shares);
  hf_weights_info info = HF_INIT(hf_weights_info);
  assert_ok(hf_weights_get_info(cut, &info));
  assert_int_equal(info.isolated_count, 1);
  assert_int_equal(info.informed_count + info.solved_count + info.pinned_count + info.nearest_count + info.rigid_count +
                       info.isolated_count,
                   info.vertex_count);
  assert_memory_equal(list + 4 * CUT_SEAM_LEFT, list + 4 * CUT_SEAM_RIGHT, 16);
  assert_memory_equal(shares + 4 * CUT_SEAM_LEFT, shares + 4 * CUT_SEAM_RIGHT, 16);
  hf_weights_destroy(cut);
  scene_destroy(&scene);
}

static float weight_at(hf_weights object, uint32_t vertex, uint32_t bone) {
  static uint32_t list[8 * TUBE_VERTICES];
  static float shares[8 * TUBE_VERTICES];
  get_all(object, list, shares);
  float sum = 0;
  for (uint32_t k = 4 * vertex; k < 4 * vertex + 4; ++k) sum += list[k] == bone ? shares[k] : 0;
  return sum;
}

static void pins_and_locks_work_and_a_kept_clone_has_the_weights_of_then(void** state) {
  (void)state;
  scene_create(&scene);
  good();
  hf_weights w = scene.weights, before = NULL, copy = NULL;
  assert_ok(hf_weights_clone(w, &before));
  weights[0] = 3;
  weights[1] = 1; /* scaled to the sum 1 */
  assert_ok(hf_weights_set_pins(w, &pins));
  assert_true(weight_at(w, vertices[0], joints[0]) == 0.75f && weight_at(w, vertices[0], joints[1]) == 0.25f);
  assert_ok(hf_weights_clone(w, &copy));
  between_corners();
  radii[1] = 1.5;
  assert_ok(hf_weights_set_pins(w, &pins));
  assert_true(weight_at(copy, vertices[0], joints[0]) == 0.75f);
  hf_weights_destroy(copy);
  hf_weights_destroy(w);
  w = scene.weights = before; /* undo */
  assert_true(weights_unchanged(&scene));
  assert_ok(hf_weights_set_locks(scene.weights, 2, locks, values));
  assert_true(weight_at(w, 65, 0) == 0.25f && weight_at(w, 65, 2) == 0.25f && weight_at(w, 65, 1) == 0.5f);
  assert_ok(hf_weights_set_locks(scene.weights, 0, locks, NULL));
  assert_true(weights_unchanged(&scene));
  bones.sources = sources;
  bones.joint_count = 2;
  assert_ok(hf_weights_set_joints(scene.weights, &bones));
  assert_true(weight_at(w, 130, 1) == 1.0f);
  hf_weights_info info = HF_INIT(hf_weights_info);
  assert_ok(hf_weights_get_info(w, &info));
  assert_int_equal(info.joint_count, 2);
  uint32_t flags[2], counts[2];
  assert_ok(hf_weights_get_joints(w, 2, flags, counts, NULL));
  assert_true(counts[0] > 20 && counts[1] > 20);
  assert_int_equal(flags[0] | flags[1], 0);
  scene_destroy(&scene);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bad_bones_are_named),
      cmocka_unit_test(bad_pins_and_locks_are_named),
      cmocka_unit_test(bad_outputs_are_refused),
      cmocka_unit_test(every_vertex_gets_weights),
      cmocka_unit_test(pins_and_locks_work_and_a_kept_clone_has_the_weights_of_then),
      cmocka_unit_test(a_cancelled_call_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
