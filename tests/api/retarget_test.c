/* Skeletons and retargets through the C ABI: what is found, what follows, what is copied, and every bad argument named.
 */
#include "bad_scene.h"
#include "support/stick_man.h"

typedef float Pose[MAN_JOINTS][10];

static StickMan man, other;
static hf_skeleton_desc desc;
static hf_skin_desc skin;
static hf_retarget_desc options;
static int32_t roles[MAN_JOINTS], sides[MAN_JOINTS];
static float axis[3], travels[6];
static hf_skeleton source, target, made_skeleton;
static hf_retarget retarget, made;
static Pose pose, posed;

static hf_skeleton skeleton_of(const StickMan* of, hf_progress progress) {
  const hf_skin_desc s = man_skin(of);
  hf_skeleton_desc d = man_desc(of, &s);
  hf_skeleton out = NULL;
  d.progress = progress;
  assert_ok(hf_skeleton_create(&d, &out));
  return out;
}

static void setup(float size, float arms_down) {
  man = stick_man(1, 0);
  other = stick_man(size, arms_down);
  source = skeleton_of(&man, NULL);
  target = skeleton_of(&other, NULL);
  assert_ok(hf_retarget_create(source, target, NULL, &retarget));
}

static void teardown(void) {
  hf_retarget_destroy(retarget);
  hf_skeleton_destroy(source);
  hf_skeleton_destroy(target);
}

/* The place and rotation of a joint in the space of the model, for rests that turn about z and y alone: by quaternions.
 */
static void turned(const float* q, const float* v, float* out) {
  const float t[3] = {2 * (q[1] * v[2] - q[2] * v[1]), 2 * (q[2] * v[0] - q[0] * v[2]),
                      2 * (q[0] * v[1] - q[1] * v[0])};
  out[0] = v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1];
  out[1] = v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2];
  out[2] = v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0];
}

static void place_of(Pose of, uint32_t joint, float* out) {
  memcpy(out, of[joint], 3 * sizeof(float));
  for (uint32_t p = man.parents[joint]; p != HF_NO_INDEX; p = man.parents[p]) {
    float moved[3];
    turned(of[p] + 3, out, moved);
    for (int c = 0; c < 3; ++c) out[c] = moved[c] + of[p][c];
  }
}

/* The unit vector from one joint to another. */
static void bone_of(Pose of, uint32_t a, uint32_t b, float* out) {
  float from[3], length = 0;
  place_of(of, a, from);
  place_of(of, b, out);
  for (int c = 0; c < 3; ++c) {
    out[c] -= from[c];
    length += out[c] * out[c];
  }
  for (int c = 0; c < 3; ++c) out[c] /= sqrtf(length);
}

static void a_man_is_known(void** state) {
  (void)state;
  setup(1, 0);
  hf_skeleton_info info = HF_INIT(hf_skeleton_info);
  assert_ok(hf_skeleton_get_info(source, &info));
  assert_int_equal(info.joint_count, MAN_JOINTS);
  assert_true(info.up[1] > 0.999 && info.forward[2] > 0.999 && info.left[0] > 0.999);
  assert_true(info.up_confidence > 0.5 && info.forward_confidence > 0.5 && info.left_confidence > 0.5);
  assert_true(fabs(info.arm_length - 0.6) < 1e-6 && fabs(info.hip_height - 0.95) < 1e-6);
  hf_joint_info joints[MAN_JOINTS];
  uint32_t count = 0, chain_count = 0, joint_count = 0;
  assert_ok(hf_skeleton_get_joints(source, MAN_JOINTS, joints, &count));
  assert_int_equal(count, MAN_JOINTS);
  assert_int_equal(joints[MAN_HEAD].role, HF_ROLE_HEAD);
  assert_int_equal(joints[MAN_LEFT_ELBOW].role, HF_ROLE_ARM);
  assert_int_equal(joints[MAN_LEFT_ELBOW].side, HF_SIDE_LEFT);
  assert_int_equal(joints[MAN_RIGHT_KNEE].role, HF_ROLE_LEG);
  assert_int_equal(joints[MAN_RIGHT_KNEE].side, HF_SIDE_RIGHT);
  assert_int_equal(joints[MAN_RIGHT_FOOT].mate, MAN_LEFT_FOOT);
  assert_int_equal(joints[MAN_HIPS].mate, HF_NO_INDEX);
  assert_ok(hf_skeleton_get_chains(source, 0, NULL, &chain_count));
  assert_int_equal(chain_count, info.chain_count);
  assert_ok(hf_skeleton_get_chain_joints(source, 0, NULL, &joint_count));
  hf_chain* const chains = calloc(chain_count, sizeof *chains);
  uint32_t* const list = calloc(joint_count, sizeof *list);
  assert_ok(hf_skeleton_get_chains(source, chain_count, chains, NULL));
  assert_ok(hf_skeleton_get_chain_joints(source, joint_count, list, NULL));
  for (uint32_t c = 0; c < chain_count; ++c) {
    assert_true(chains[c].first + chains[c].joint_count <= joint_count);
    for (uint32_t k = 0; k < chains[c].joint_count; ++k) assert_int_equal(joints[list[chains[c].first + k]].chain, c);
  }
  free(chains);
  free(list);
  size_t size = 0;
  assert_ok(hf_skeleton_get_reasons(source, 0, NULL, &size));
  char* const text = calloc(size, 1);
  assert_ok(hf_skeleton_get_reasons(source, size, text, NULL));
  assert_int_equal(strlen(text) + 1, size);
  assert_true(strncmp(text, "up: ", 4) == 0);
  free(text);
  teardown();
}

/* A skin bound in an armature of its own: centimetres, z up. */
static void a_skin_in_the_space_of_its_binding_stands_at_rest(void** state) {
  (void)state;
  const StickMan at_rest = stick_man(1, 0);
  StickMan bound = at_rest;
  float binds[MAN_JOINTS][16] = {{0}};
  for (int v = 0; v < MAN_VERTICES; ++v) {
    const float* const p = at_rest.positions[v];
    const float moved[3] = {100 * p[0], -100 * p[2], 100 * p[1]};
    memcpy(bound.positions[v], moved, sizeof moved);
  }
  for (int j = 0; j < MAN_JOINTS; ++j) {
    binds[j][0] = binds[j][9] = 0.01f;
    binds[j][6] = -0.01f;
    for (int c = 0; c < 3; ++c) binds[j][12 + c] = -at_rest.positions[3 * j][c]; /* its first vertex is its place */
    binds[j][15] = 1;
  }
  hf_skeleton_info info[3];
  for (int k = 0; k < 3; ++k) { /* at rest, bound, and bound vertices given as if they were at rest */
    const hf_skin_desc plain = man_skin(&at_rest);
    hf_skin_desc other_space = man_skin(&bound);
    other_space.at_rest = k == 2;
    hf_skeleton_desc d = man_desc(&at_rest, k == 0 ? &plain : &other_space);
    if (k > 0) d.inverse_binds = binds[0];
    hf_skeleton known = NULL;
    assert_ok(hf_skeleton_create(&d, &known));
    info[k] = HF_INIT(hf_skeleton_info);
    assert_ok(hf_skeleton_get_info(known, &info[k]));
    hf_skeleton_destroy(known);
  }
  for (int c = 0; c < 3; ++c) assert_true(fabs(info[0].up[c] - info[1].up[c]) < 1e-6);
  assert_true(fabs(info[0].height - info[1].height) < 1e-6);
  assert_true(fabs(info[0].hip_height - info[1].hip_height) < 1e-6);
  assert_true(fabs(info[0].height - info[2].height) > 1);
}

static void equal_skeletons_copy_keys(void** state) {
  (void)state;
  setup(1, 0);
  hf_retarget_info info = HF_INIT(hf_retarget_info);
  man_walk(&man, 0.4f, pose);
  assert_ok(hf_retarget_solve(retarget, pose[0], 0, posed[0]));
  assert_memory_equal(pose, posed, sizeof pose);
  assert_ok(hf_retarget_get_info(retarget, &info));
  assert_true(info.same_skeleton == 1 && info.frame_count == 1 && info.scale == 1);
  uint32_t partners[MAN_JOINTS];
  assert_ok(hf_retarget_get_partners(retarget, MAN_JOINTS, partners, NULL));
  for (uint32_t j = 0; j < MAN_JOINTS; ++j) assert_int_equal(partners[j], j);
  teardown();
}

static void limbs_point_as_the_source_points_though_rests_and_sizes_differ(void** state) {
  (void)state;
  setup(2, 50);
  static const uint32_t bones[][2] = {{MAN_LEFT_ARM, MAN_LEFT_ELBOW},   {MAN_LEFT_ELBOW, MAN_LEFT_HAND},
                                      {MAN_RIGHT_ARM, MAN_RIGHT_ELBOW}, {MAN_LEFT_LEG, MAN_LEFT_KNEE},
                                      {MAN_RIGHT_KNEE, MAN_RIGHT_FOOT}, {MAN_NECK, MAN_HEAD}};
  for (int f = 0; f < 8; ++f) {
    man_walk(&man, 0.25f * (float)f, pose);
    assert_ok(hf_retarget_solve(retarget, pose[0], f ? 0.1 : 0, posed[0]));
    for (size_t b = 0; b < COUNT_OF(bones); ++b) {
      float a[3], t[3];
      bone_of(pose, bones[b][0], bones[b][1], a);
      bone_of(posed, bones[b][0], bones[b][1], t);
      /* goals bend legs so that soles stand */
      const float least = bones[b][0] >= MAN_LEFT_LEG ? 0.99f : 0.999999f;
      assert_true(a[0] * t[0] + a[1] * t[1] + a[2] * t[2] > least);
    }
  }
  hf_retarget_info info = HF_INIT(hf_retarget_info);
  assert_ok(hf_retarget_get_info(retarget, &info));
  assert_true(fabs(info.scale - 2) < 1e-6 && info.scale_from == HF_SCALE_LEGS && info.same_skeleton == 0);
  assert_true(info.frame_count == 8 && info.limb_angle < 0.05 && info.matched_joint_count == MAN_JOINTS);
  uint32_t count = 0;
  assert_ok(hf_retarget_get_chains(retarget, 0, NULL, &count));
  assert_int_equal(count, info.chain_count);
  hf_chain_match* const chains = calloc(count, sizeof *chains);
  assert_ok(hf_retarget_get_chains(retarget, count, chains, NULL));
  for (uint32_t c = 0; c < count; ++c) {
    if (chains[c].role == HF_ROLE_ARM) assert_true(chains[c].mean_angle < 0.01);
    assert_true(chains[c].mean_angle <= chains[c].worst_angle + 1e-12);
  }
  free(chains);
  assert_ok(hf_retarget_reset(retarget));
  assert_ok(hf_retarget_get_info(retarget, &info));
  assert_int_equal(info.frame_count, 0);
  teardown();
}

static void a_clone_goes_on_as_its_original_goes_on(void** state) {
  (void)state;
  setup(1.3f, 30);
  for (int f = 0; f < 5; ++f) {
    man_walk(&man, 0.1f * (float)f, pose);
    assert_ok(hf_retarget_solve(retarget, pose[0], 0.05, posed[0]));
  }
  hf_retarget clone = NULL;
  assert_ok(hf_retarget_clone(retarget, &clone));
  hf_skeleton_destroy(source);
  hf_skeleton_destroy(target);
  Pose again;
  for (int f = 5; f < 9; ++f) {
    man_walk(&man, 0.1f * (float)f, pose);
    assert_ok(hf_retarget_solve(retarget, pose[0], 0.05, posed[0]));
    assert_ok(hf_retarget_solve(clone, pose[0], 0.05, again[0]));
    assert_memory_equal(posed, again, sizeof posed);
  }
  hf_retarget_info a = HF_INIT(hf_retarget_info), b = HF_INIT(hf_retarget_info);
  assert_ok(hf_retarget_get_info(retarget, &a));
  assert_ok(hf_retarget_get_info(clone, &b));
  assert_memory_equal(&a, &b, sizeof a);
  hf_retarget_destroy(clone);
  hf_retarget_destroy(retarget);
}

static void without_a_lock_a_frame_has_no_state(void** state) {
  (void)state;
  setup(1.3f, 30);
  options = HF_INIT(hf_retarget_desc);
  options.leave_out = HF_RETARGET_NO_LOCK;
  hf_retarget_destroy(retarget);
  assert_ok(hf_retarget_create(source, target, &options, &retarget));
  Pose first;
  man_walk(&man, 0.3f, pose);
  assert_ok(hf_retarget_solve(retarget, pose[0], 0, first[0]));
  for (int f = 0; f < 6; ++f) {
    man_walk(&man, 0.2f * (float)f, pose);
    assert_ok(hf_retarget_solve(retarget, pose[0], 0.05, posed[0]));
  }
  man_walk(&man, 0.3f, pose);
  assert_ok(hf_retarget_solve(retarget, pose[0], 0.05, posed[0]));
  assert_memory_equal(first, posed, sizeof first);
  teardown();
}

static void a_clip_in_place_keeps_the_hips_over_one_point(void** state) {
  (void)state;
  setup(2, 0);
  options = HF_INIT(hf_retarget_desc);
  options.leave_out = HF_RETARGET_NO_GOALS | HF_RETARGET_NO_COPY;
  man_walk(&man, 0, pose);
  pose[MAN_HIPS][2] += 3;
  hf_retarget in_place = NULL, kept = NULL;
  assert_ok(hf_retarget_create(source, target, &options, &kept));
  assert_ok(hf_retarget_solve(kept, pose[0], 0, posed[0]));
  assert_true(fabsf(posed[MAN_HIPS][2] - 6) < 1e-4f);
  options.root_motion = HF_ROOT_MOTION_IN_PLACE;
  assert_ok(hf_retarget_create(source, target, &options, &in_place));
  assert_ok(hf_retarget_solve(in_place, pose[0], 0, posed[0]));
  assert_true(fabsf(posed[MAN_HIPS][2]) < 1e-4f);
  hf_retarget_destroy(in_place);
  hf_retarget_destroy(kept);
  teardown();
}

static void the_ground_under_a_walk_on_the_spot_moves(void** state) {
  (void)state;
  setup(1, 0);
  enum { FRAMES = 41 };
  static Pose clip[FRAMES];
  double velocity[3];
  for (int f = 0; f < FRAMES; ++f) man_walk(&man, 0.1f * (float)f, clip[f]);
  assert_ok(hf_skeleton_get_ground_velocity(source, FRAMES, clip[0][0], 0.05, velocity));
  assert_true(velocity[2] < -0.2 && fabs(velocity[0]) < 0.2);
  for (int f = 0; f < FRAMES; ++f) memcpy(clip[f], man.rest, sizeof man.rest);
  assert_ok(hf_skeleton_get_ground_velocity(source, FRAMES, clip[0][0], 0.05, velocity));
  assert_true(velocity[0] == 0 && velocity[1] == 0 && velocity[2] == 0);
  teardown();
}

static void a_frame_allocates_nothing_and_all_memory_is_the_hosts(void** state) {
  (void)state;
  CountingAllocator allocator = {0};
  man = stick_man(1, 0);
  other = stick_man(1.4f, 40);
  source = skeleton_of(&man, NULL);
  const hf_skin_desc s = man_skin(&other);
  hf_skeleton_desc d = man_desc(&other, &s);
  d.allocator = counting_hooks(&allocator);
  assert_ok(hf_skeleton_create(&d, &target));
  assert_ok(hf_retarget_create(source, target, NULL, &retarget));
  const size_t calls = allocator.calls;
  for (int f = 0; f < 8; ++f) {
    man_walk(&man, 0.2f * (float)f, pose);
    assert_ok(hf_retarget_solve(retarget, pose[0], 0.05, posed[0]));
  }
  assert_int_equal(allocator.calls, calls);
  hf_retarget whole = NULL;
  for (size_t k = 1; !whole; k += 3) { /* every refusal leaves nothing behind */
    CountingAllocator poor = {0};
    hf_skeleton some = NULL;
    poor.refuse_at = k;
    poor.refuse_on = 1;
    d.allocator = counting_hooks(&poor);
    hf_result result = hf_skeleton_create(&d, &some);
    if (some) result = hf_retarget_create(source, some, NULL, &whole);
    assert_code(whole ? HF_OK : HF_ERROR_OUT_OF_MEMORY, result);
    hf_skeleton_destroy(some);
    hf_retarget_destroy(whole);
    assert_int_equal(poor.live_blocks, 0);
  }
  teardown();
  assert_true(allocator.live_blocks == 0 && allocator.mismatches == 0);
}

static void creation_can_be_cancelled(void** state) {
  (void)state;
  setup(1, 20);
  hf_progress progress = NULL;
  assert_ok(hf_progress_create(&progress));
  assert_ok(hf_progress_cancel(progress));
  hf_skeleton_desc d = man_desc(&man, NULL);
  d.progress = progress;
  assert_code(HF_ERROR_CANCELLED, hf_skeleton_create(&d, &made_skeleton));
  assert_null(made_skeleton);
  options = HF_INIT(hf_retarget_desc);
  options.progress = progress;
  assert_ok(hf_progress_cancel(progress));
  assert_code(HF_ERROR_CANCELLED, hf_retarget_create(source, target, &options, &made));
  assert_null(made);
  hf_progress_destroy(progress);
  teardown();
}

static Pose expected, rest;

static void good(void) {
  man = stick_man(1, 0);
  other = stick_man(1.2f, 20);
  skin = man_skin(&man);
  desc = man_desc(&man, &skin);
  options = HF_INIT(hf_retarget_desc);
  memcpy(rest, man.rest, sizeof rest);
  memset(roles, -1, sizeof roles);
  memset(sides, 0, sizeof sides);
  axis[0] = axis[2] = 0;
  axis[1] = 1;
  memset(travels, 0, sizeof travels);
  man_walk(&man, 0.2f, pose);
}

/* The skeleton has the same roles, and the retarget gives the same frame. */
static int unchanged(void) {
  Pose now;
  hf_retarget clone = NULL;
  if (hf_retarget_clone(retarget, &clone) != HF_OK) return 0;
  const StickMan sound = stick_man(1, 0);
  man_walk(&sound, 0.5f, pose);
  const int ok = hf_retarget_solve(clone, pose[0], 0.05, now[0]) == HF_OK && same_bits(now, expected, sizeof now);
  hf_retarget_destroy(clone);
  return ok && !made && !made_skeleton;
}

#define GOOD good
#define UNCHANGED unchanged

static void set_expected(void) {
  setup(1.2f, 20);
  man_walk(&man, 0.5f, pose);
  hf_retarget clone = NULL;
  assert_ok(hf_retarget_clone(retarget, &clone));
  assert_ok(hf_retarget_solve(clone, pose[0], 0.05, expected[0]));
  hf_retarget_destroy(clone);
}

static void bad_skeletons_are_named(void** state) {
  (void)state;
  set_expected();
  const hf_skeleton stale = skeleton_of(&man, NULL);
  hf_skeleton_destroy(stale);
  ROW("desc NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_skeleton_create(NULL, &made_skeleton));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_skeleton_create(&desc, NULL));
  ROW("no size", HF_ERROR_INVALID_DESC, NO_INDEX, desc.struct_size = 0, hf_skeleton_create(&desc, &made_skeleton));
  ROW("no size of the skin", HF_ERROR_INVALID_DESC, NO_INDEX, skin.struct_size = 0,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("at_rest 2", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, skin.at_rest = 2, hf_skeleton_create(&desc, &made_skeleton));
  ROW("reserved of the skin", HF_ERROR_INVALID_DESC, NO_INDEX, skin.reserved = 1,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("reserved", HF_ERROR_INVALID_DESC, NO_INDEX, desc.reserved = 1, hf_skeleton_create(&desc, &made_skeleton));
  ROW("no joint", HF_ERROR_EMPTY, NO_INDEX, desc.joint_count = 0, hf_skeleton_create(&desc, &made_skeleton));
  ROW("too many joints", HF_ERROR_TOO_LARGE, NO_INDEX, desc.joint_count = UINT32_MAX,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("no parents", HF_ERROR_NULL_POINTER, NO_INDEX, desc.parents = NULL, hf_skeleton_create(&desc, &made_skeleton));
  ROW("no rest", HF_ERROR_NULL_POINTER, NO_INDEX, desc.rest = NULL, hf_skeleton_create(&desc, &made_skeleton));
  ROW("names of another count", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, desc.names = "a\nb",
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a parent beyond", HF_ERROR_OUT_OF_RANGE, 3, man.parents[3] = MAN_JOINTS,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("parents in a circle", HF_ERROR_INVALID_ARGUMENT, 0, man.parents[0] = 4,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a translation NaN", HF_ERROR_NON_FINITE, 5, man.rest[5][1] = NAN, hf_skeleton_create(&desc, &made_skeleton));
  ROW("a rotation of length 0", HF_ERROR_INVALID_ARGUMENT, 6, man.rest[6][6] = 0,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a role beyond", HF_ERROR_INVALID_ARGUMENT, 2, (desc.roles = roles, roles[2] = 18),
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a side beyond", HF_ERROR_INVALID_ARGUMENT, 2,
      (desc.roles = roles, desc.sides = sides, roles[2] = 1, sides[2] = 3), hf_skeleton_create(&desc, &made_skeleton));
  ROW("up of length 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (desc.up = axis, axis[1] = 0),
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("forward NaN", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (desc.forward = axis, axis[1] = NAN),
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("no travels", HF_ERROR_NULL_POINTER, NO_INDEX, desc.travel_count = 2, hf_skeleton_create(&desc, &made_skeleton));
  ROW("a travel NaN", HF_ERROR_NON_FINITE, 1, (desc.travel_count = 2, desc.travels = travels, travels[4] = NAN),
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("half an allocator", HF_ERROR_NULL_POINTER, NO_INDEX,
      desc.allocator.release = counting_hooks(&(CountingAllocator){0}).release,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a stale progress", HF_ERROR_INVALID_OBJECT, NO_INDEX, desc.progress = (hf_progress)stale,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("no vertex", HF_ERROR_EMPTY, NO_INDEX, skin.vertex_count = 0, hf_skeleton_create(&desc, &made_skeleton));
  ROW("no positions", HF_ERROR_NULL_POINTER, NO_INDEX, skin.positions = NULL,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("no triangles", HF_ERROR_NULL_POINTER, NO_INDEX, skin.triangles = NULL,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("no joints of vertices", HF_ERROR_NULL_POINTER, NO_INDEX, skin.joints = NULL,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("no weights", HF_ERROR_NULL_POINTER, NO_INDEX, skin.weights = NULL, hf_skeleton_create(&desc, &made_skeleton));
  ROW("no influence", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, skin.influence_count = 0,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("65 influences", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, skin.influence_count = 65,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("too many vertices", HF_ERROR_TOO_LARGE, NO_INDEX, skin.vertex_count = UINT32_MAX,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a position NaN", HF_ERROR_NON_FINITE, 8, man.positions[8][2] = NAN, hf_skeleton_create(&desc, &made_skeleton));
  ROW("a vertex beyond", HF_ERROR_OUT_OF_RANGE, 4, man.triangles[4][1] = MAN_VERTICES,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a joint beyond", HF_ERROR_OUT_OF_RANGE, 9, man.joints[9] = MAN_JOINTS,
      hf_skeleton_create(&desc, &made_skeleton));
  ROW("a weight NaN", HF_ERROR_NON_FINITE, 10, man.weights[10] = NAN, hf_skeleton_create(&desc, &made_skeleton));
  ROW("a weight below 0", HF_ERROR_INVALID_ARGUMENT, 11, man.weights[11] = -1,
      hf_skeleton_create(&desc, &made_skeleton));
  hf_skeleton_info info = HF_INIT(hf_skeleton_info);
  uint32_t count = 0;
  hf_joint_info joints[MAN_JOINTS];
  hf_chain chain;
  char text[4];
  size_t size = 0;
  double velocity[3];
  const hf_skeleton wrong[] = {NULL, stale, (hf_skeleton)retarget};
  for (size_t k = 0; k < COUNT_OF(wrong); ++k) {
    const hf_skeleton s = wrong[k];
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_skeleton_get_info(s, &info));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_skeleton_get_joints(s, MAN_JOINTS, joints, &count));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_skeleton_get_chains(s, 0, NULL, &count));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_skeleton_get_chain_joints(s, 0, NULL, &count));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_skeleton_get_reasons(s, 0, NULL, &size));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0,
        hf_skeleton_get_ground_velocity(s, 1, pose[0], 1, velocity));
    ROW("stale source", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_create(s, target, NULL, &made));
    ROW("stale target", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_create(source, s, NULL, &made));
  }
  ROW("info NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_skeleton_get_info(source, NULL));
  ROW("nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_skeleton_get_joints(source, 0, NULL, NULL));
  ROW("too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0,
      hf_skeleton_get_joints(source, MAN_JOINTS - 1, joints, &count));
  ROW("nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_skeleton_get_chains(source, 0, NULL, NULL));
  ROW("nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_skeleton_get_chain_joints(source, 0, NULL, NULL));
  ROW("too few chains", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_skeleton_get_chains(source, 1, &chain, NULL));
  ROW("too few joints", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_skeleton_get_chain_joints(source, 1, &count, NULL));
  ROW("nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_skeleton_get_reasons(source, 0, NULL, NULL));
  ROW("too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_skeleton_get_reasons(source, 4, text, NULL));
  ROW("no frame", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_skeleton_get_ground_velocity(source, 0, pose[0], 1, velocity));
  ROW("no poses", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_skeleton_get_ground_velocity(source, 1, NULL, 1, velocity));
  ROW("no time", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0,
      hf_skeleton_get_ground_velocity(source, 1, pose[0], 0, velocity));
  ROW("time NaN", HF_ERROR_NON_FINITE, NO_INDEX, (void)0,
      hf_skeleton_get_ground_velocity(source, 1, pose[0], (double)NAN, velocity));
  ROW("a pose NaN", HF_ERROR_NON_FINITE, 2, pose[2][3] = NAN,
      hf_skeleton_get_ground_velocity(source, 1, pose[0], 1, velocity));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_skeleton_get_ground_velocity(source, 1, pose[0], 1, NULL));
  finish_rows("skeletons");
  teardown();
}

static void bad_retargets_are_named(void** state) {
  (void)state;
  set_expected();
  const hf_retarget stale = (hf_retarget)source;
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_create(source, target, &options, NULL));
  ROW("no size", HF_ERROR_INVALID_DESC, NO_INDEX, options.struct_size = 0,
      hf_retarget_create(source, target, &options, &made));
  ROW("reserved", HF_ERROR_INVALID_DESC, NO_INDEX, options.reserved = 1,
      hf_retarget_create(source, target, &options, &made));
  ROW("root_motion 3", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, options.root_motion = 3,
      hf_retarget_create(source, target, &options, &made));
  ROW("no root above the hips", HF_ERROR_INVALID_ARGUMENT, MAN_HIPS, options.root_motion = HF_ROOT_MOTION_ROOT,
      hf_retarget_create(source, target, &options, &made));
  ROW("unknown flag", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, options.leave_out = 16,
      hf_retarget_create(source, target, &options, &made));
  ROW("scale NaN", HF_ERROR_NON_FINITE, NO_INDEX, options.scale = (double)NAN,
      hf_retarget_create(source, target, &options, &made));
  ROW("scale below 0", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, options.scale = -1,
      hf_retarget_create(source, target, &options, &made));
  ROW("ground NaN", HF_ERROR_NON_FINITE, NO_INDEX, options.ground_velocity[1] = (double)NAN,
      hf_retarget_create(source, target, &options, &made));
  ROW("a rest NaN", HF_ERROR_NON_FINITE, 3, (options.source_rest = rest[0], rest[3][9] = NAN),
      hf_retarget_create(source, target, &options, &made));
  ROW("a rest without rotation", HF_ERROR_INVALID_ARGUMENT, 4, (options.target_rest = rest[0], rest[4][6] = 0),
      hf_retarget_create(source, target, &options, &made));
  ROW("stale progress", HF_ERROR_INVALID_OBJECT, NO_INDEX, options.progress = (hf_progress)source,
      hf_retarget_create(source, target, &options, &made));
  hf_skeleton stone = NULL;
  good();
  desc.joint_count = 1;
  desc.skin = NULL;
  desc.names = "stone";
  assert_ok(hf_skeleton_create(&desc, &stone));
  ROW("nothing in common", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_retarget_create(source, stone, NULL, &made));
  hf_skeleton_destroy(stone);
  hf_retarget_info info = HF_INIT(hf_retarget_info);
  hf_chain_match chain;
  uint32_t count = 0;
  const hf_retarget wrong[] = {NULL, stale};
  for (size_t k = 0; k < COUNT_OF(wrong); ++k) {
    const hf_retarget r = wrong[k];
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_clone(r, &made));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_solve(r, pose[0], 0, posed[0]));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_reset(r));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_get_info(r, &info));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_get_chains(r, 1, &chain, &count));
    ROW("stale", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_retarget_get_partners(r, 0, NULL, &count));
  }
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_clone(retarget, NULL));
  ROW("no pose", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_solve(retarget, NULL, 0, posed[0]));
  ROW("no result", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_solve(retarget, pose[0], 0, NULL));
  ROW("back in time", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, hf_retarget_solve(retarget, pose[0], -1, posed[0]));
  ROW("time NaN", HF_ERROR_NON_FINITE, NO_INDEX, (void)0, hf_retarget_solve(retarget, pose[0], (double)NAN, posed[0]));
  ROW("a pose NaN", HF_ERROR_NON_FINITE, 7, pose[7][2] = NAN, hf_retarget_solve(retarget, pose[0], 0.1, posed[0]));
  ROW("a rotation of length 0", HF_ERROR_INVALID_ARGUMENT, 8, memset(pose[8], 0, sizeof pose[8]),
      hf_retarget_solve(retarget, pose[0], 0.1, posed[0]));
  ROW("info NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_get_info(retarget, NULL));
  ROW("nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_get_chains(retarget, 0, NULL, NULL));
  ROW("too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_retarget_get_chains(retarget, 1, &chain, NULL));
  ROW("nothing to write", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_retarget_get_partners(retarget, 0, NULL, NULL));
  ROW("too small", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_retarget_get_partners(retarget, 1, &count, NULL));
  const hf_skeleton no_skeletons[] = {NULL, (hf_skeleton)retarget};
  for (size_t k = 0; k < COUNT_OF(no_skeletons); ++k) {
    hf_skeleton_destroy(no_skeletons[k]);
    hf_retarget_destroy(wrong[k]);
    row_holds(__LINE__, "destroying what is no object", "the state is unchanged", UNCHANGED());
  }
  finish_rows("retargets");
  teardown();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_man_is_known),
      cmocka_unit_test(a_skin_in_the_space_of_its_binding_stands_at_rest),
      cmocka_unit_test(equal_skeletons_copy_keys),
      cmocka_unit_test(limbs_point_as_the_source_points_though_rests_and_sizes_differ),
      cmocka_unit_test(a_clone_goes_on_as_its_original_goes_on),
      cmocka_unit_test(without_a_lock_a_frame_has_no_state),
      cmocka_unit_test(a_clip_in_place_keeps_the_hips_over_one_point),
      cmocka_unit_test(the_ground_under_a_walk_on_the_spot_moves),
      cmocka_unit_test(a_frame_allocates_nothing_and_all_memory_is_the_hosts),
      cmocka_unit_test(creation_can_be_cancelled),
      cmocka_unit_test(bad_skeletons_are_named),
      cmocka_unit_test(bad_retargets_are_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
