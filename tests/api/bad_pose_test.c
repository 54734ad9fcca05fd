/* Bad input to hf/pose.h and hf/transfer.h: one thing wrong per row; pose, transfer and outputs stay as they were. */
#include "bad_scene.h"

static Scene scene;

/* The good input of every call; a row spoils one thing. */
static uint32_t counts[2], target_counts[2], region[6], target_region[6], flags[2], out_numbers[2], numbers[3];
static hf_handles_desc handles;
static hf_pairs_desc pairs;
static hf_pose_desc pose_desc;
static hf_transfer_desc transfer_desc;
static hf_transform transforms[3];
static double matrices[2 * 16], points[2 * 3], radii[2];
static hf_deform_desc deform;
static hf_transfer_frame frame;
static hf_skin_info skin;
static float source[3 * TUBE_VERTICES], floats[3 * TUBE_VERTICES], normals[3 * TUBE_VERTICES];
static double doubles[3 * TUBE_VERTICES];
static hf_pose out_pose;
static hf_transfer out_transfer;
static hf_handle_proposals_desc propose;
static double joints[2 * 3];
static uint32_t parents[2], proposal_count;

static void good_input(void) {
  for (uint32_t i = 0; i < 6; ++i) region[i] = target_region[i] = 5 * TUBE_AROUND + i;
  counts[0] = target_counts[0] = 2;
  counts[1] = target_counts[1] = 4;
  flags[0] = 0;
  flags[1] = HF_PAIR_ANCHOR;
  out_numbers[0] = 777;
  numbers[0] = scene.handles[0];
  numbers[1] = scene.handles[1];
  numbers[2] = 0;
  handles = HF_INIT(hf_handles_desc);
  pairs = HF_INIT(hf_pairs_desc);
  pose_desc = HF_INIT(hf_pose_desc);
  transfer_desc = HF_INIT(hf_transfer_desc);
  deform = HF_INIT(hf_deform_desc);
  frame = HF_INIT(hf_transfer_frame);
  skin = HF_INIT(hf_skin_info);
  handles.handle_count = 2;
  handles.region_counts = counts;
  handles.region_vertices = region;
  pairs.pair_count = 2;
  pairs.flags = flags;
  pairs.source_counts = counts;
  pairs.source_vertices = region;
  pairs.target_counts = target_counts;
  pairs.target_vertices = target_region;
  memset(transforms, 0, sizeof transforms);
  memset(matrices, 0, sizeof matrices);
  for (int i = 0; i < 4; ++i) matrices[5 * i] = matrices[16 + 5 * i] = 1;
  for (int i = 0; i < 6; ++i) points[i] = (double)scene.tube.positions[3 * (5 * TUBE_AROUND + i / 3 * 20) + i % 3];
  radii[0] = radii[1] = 0.2;
  transforms[0].rotation[3] = transforms[1].rotation[3] = 1;
  transforms[0].translation[0] = 3;
  deform.positions = ROWS_OUT(floats);
  memcpy(source, scene.posed, sizeof source);
  frame.source_positions = HF_ARRAY(source, TUBE_VERTICES);
  frame.target_positions = ROWS_OUT(floats);
  propose = HF_INIT(hf_handle_proposals_desc);
  memset(joints, 0, sizeof joints);
  parents[0] = NO_INDEX;
  parents[1] = 0;
  propose.joint_count = 2;
  propose.joints = joints;
  propose.parents = parents;
  proposal_count = 777;
  floats[0] = 777;
  doubles[0] = 777;
  normals[0] = 777;
  out_pose = scene.pose;
  out_transfer = scene.transfer;
}

static int outputs_unwritten(void) {
  return out_numbers[0] == 777 && floats[0] == 777 && doubles[0] == 777 && normals[0] == 777;
}
static int pose_as_before(void) { return outputs_unwritten() && pose_unchanged(&scene); }
static int transfer_as_before(void) { return outputs_unwritten() && transfer_unchanged(&scene); }
static int proposals_as_before(void) { return proposal_count == 777 && pose_as_before(); }
static int no_pose(void) { return out_pose == NULL && pose_as_before(); }
static int no_transfer(void) { return out_transfer == NULL && transfer_as_before(); }

#define GOOD good_input
#define UNCHANGED no_pose
#define CREATE_POSE(what, expected, change) \
  ROW(what, expected, NO_INDEX, change, hf_pose_create(scene.body, &pose_desc, &out_pose))

static void bad_poses_are_not_made(void** state) {
  (void)state;
  scene_create(&scene);
  CREATE_POSE("1 band", HF_ERROR_INVALID_ARGUMENT, pose_desc.band_count = 1);
  CREATE_POSE("65 bands", HF_ERROR_INVALID_ARGUMENT, pose_desc.band_count = 65);
  CREATE_POSE("2^32 - 1 bands", HF_ERROR_INVALID_ARGUMENT, pose_desc.band_count = UINT32_MAX);
  CREATE_POSE("1001 iterations", HF_ERROR_INVALID_ARGUMENT, pose_desc.iteration_count = 1001);
  CREATE_POSE("2^31 iterations", HF_ERROR_INVALID_ARGUMENT, pose_desc.iteration_count = 0x80000000u);
  CREATE_POSE("2001 groups", HF_ERROR_INVALID_ARGUMENT, pose_desc.group_count = 2001);
  CREATE_POSE("2^32 - 1 groups", HF_ERROR_INVALID_ARGUMENT, pose_desc.group_count = UINT32_MAX);
  ROW("no surface", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_pose_create(NULL, NULL, &out_pose));
  ROW("no pose to clone", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0, hf_pose_clone(scene.stale_pose, &out_pose));
#undef UNCHANGED
#define UNCHANGED pose_as_before
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_create(scene.body, NULL, NULL));
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_clone(scene.pose, NULL));
  scene_destroy(&scene);
  finish_rows("making poses");
}

#define ADD(what, expected, index, change) \
  ROW(what, expected, index, change, hf_pose_add_handles(scene.pose, &handles, out_numbers))

static void bad_handles_are_not_added(void** state) {
  (void)state;
  scene_create(&scene);
  ADD("none", HF_ERROR_EMPTY, NO_INDEX, handles.handle_count = 0);
  ADD("region_counts NULL", HF_ERROR_NULL_POINTER, NO_INDEX, handles.region_counts = NULL);
  ADD("region_vertices NULL", HF_ERROR_NULL_POINTER, NO_INDEX, handles.region_vertices = NULL);
  ADD("an empty region", HF_ERROR_EMPTY, 1, counts[1] = 0);
  ADD("vertex = vertex_count", HF_ERROR_OUT_OF_RANGE, 3, region[3] = TUBE_VERTICES);
  ADD("vertex UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 0, region[0] = UINT32_MAX);
  ADD("vertex 2^31", HF_ERROR_OUT_OF_RANGE, 5, region[5] = 0x80000000u);
  ADD("overlaps a handle that is there", HF_ERROR_CONFLICT, 1, region[1] = 0);
  ADD("overlaps the other region", HF_ERROR_CONFLICT, 4, region[4] = region[0]);
  ADD("257 handles", HF_ERROR_TOO_LARGE, NO_INDEX, handles.handle_count = 257);
  ADD("2^31 handles", HF_ERROR_TOO_LARGE, NO_INDEX, handles.handle_count = 0x80000000u);
  ADD("2^32 - 1 handles", HF_ERROR_TOO_LARGE, NO_INDEX, handles.handle_count = UINT32_MAX);
  ADD("a region of 2^32 - 1", HF_ERROR_TOO_LARGE, 1, counts[1] = UINT32_MAX);
  ADD("a region of 2^31", HF_ERROR_TOO_LARGE, 0, counts[0] = 0x80000000u);
  ADD("layer 8", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, handles.layer = 8);
  ADD("layer 2^32 - 1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, handles.layer = UINT32_MAX);
  ADD("overlap on a higher layer", HF_ERROR_CONFLICT, 1, (region[1] = 0, handles.layer = 3));
  ADD("in_place 2", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, handles.in_place = 2);
  ADD("in_place -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, handles.in_place = -1);
  ADD("free_rotation 2", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, handles.free_rotation = 2);
  ADD("free_rotation -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, handles.free_rotation = -1);
  ADD("handles with reserved set", HF_ERROR_INVALID_DESC, NO_INDEX, handles.reserved = 1);
  ADD("regions and points", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (handles.points = points, handles.radii = radii));
#define NEAR(what, expected, index, change)                                                                    \
  ADD(what, expected, index,                                                                                   \
      (handles.region_counts = handles.region_vertices = NULL, handles.points = points, handles.radii = radii, \
       change))
  NEAR("radii NULL", HF_ERROR_NULL_POINTER, NO_INDEX, handles.radii = NULL);
  NEAR("points NULL", HF_ERROR_NULL_POINTER, NO_INDEX, handles.points = NULL);
  NEAR("point NaN", HF_ERROR_NON_FINITE, 1, points[4] = (double)NAN);
  NEAR("radius infinite", HF_ERROR_NON_FINITE, 0, radii[0] = HUGE_VAL);
  NEAR("radius negative", HF_ERROR_INVALID_ARGUMENT, 1, radii[1] = -1);
  NEAR("a radius of 0", HF_ERROR_INVALID_ARGUMENT, 1, radii[1] = 0);
  NEAR("a radius that holds one vertex", HF_ERROR_INVALID_ARGUMENT, 0, radii[0] = 1e-6);
  NEAR("a point 1,000 boxes away", HF_ERROR_TOO_LARGE, 1, points[3] = 14000);
  NEAR("a point 1e300 away", HF_ERROR_TOO_LARGE, 0, points[2] = -1e300);
  NEAR("a point in a handle that is there", HF_ERROR_CONFLICT, 1,
       memcpy(points + 3,
              (double[3]){(double)scene.tube.positions[0], (double)scene.tube.positions[1],
                          (double)scene.tube.positions[2]},
              24));
#define NEAR_ONE(what, expected, index, change) \
  ROW(what, expected, index, change, hf_pose_add_handle_at(scene.pose, points, radii[0], out_numbers))
  NEAR_ONE("point NaN", HF_ERROR_NON_FINITE, 0, points[1] = (double)NAN);
  NEAR_ONE("radius NaN", HF_ERROR_NON_FINITE, 0, radii[0] = (double)NAN);
  NEAR_ONE("radius negative", HF_ERROR_INVALID_ARGUMENT, 0, radii[0] = -1);
  NEAR_ONE("a point 1,000 boxes away", HF_ERROR_TOO_LARGE, 0, points[0] = 14000);
  NEAR_ONE("a radius that reaches a handle", HF_ERROR_CONFLICT, 0, radii[0] = 1000);
  ROW("point NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_add_handle_at(scene.pose, NULL, 0, out_numbers));
  scene_destroy(&scene);
  finish_rows("adding handles");
}

/* A joint that moves one vertex. */
static hf_skeleton skeleton_of_another_mesh(void) {
  const uint32_t no_parent = NO_INDEX, joint = 0;
  const float rest[10] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1}, position[3] = {0, 0, 0}, weight = 1;
  hf_skin_desc one = HF_INIT(hf_skin_desc);
  one.vertex_count = 1;
  one.influence_count = 1;
  one.positions = position;
  one.joints = &joint;
  one.weights = &weight;
  hf_skeleton_desc desc = HF_INIT(hf_skeleton_desc);
  desc.joint_count = 1;
  desc.parents = &no_parent;
  desc.rest = rest;
  desc.skin = &one;
  hf_skeleton out;
  assert_ok(hf_skeleton_create(&desc, &out));
  return out;
}

static void give_skeleton(hf_skeleton skeleton) {
  propose.skeleton = skeleton;
  propose.joint_count = 0;
}

#define PROPOSE(what, expected, index, change) \
  ROW(what, expected, index, change, hf_surface_propose_handles(scene.body, &propose, 0, NULL, &proposal_count))

static void handles_are_not_proposed_from_bad_input(void** state) {
  (void)state;
  scene_create(&scene);
#undef UNCHANGED
#define UNCHANGED proposals_as_before
  PROPOSE("reserved set", HF_ERROR_INVALID_DESC, NO_INDEX, propose.reserved = 1);
  PROPOSE("joints NULL", HF_ERROR_NULL_POINTER, NO_INDEX, propose.joints = NULL);
  PROPOSE("parents NULL", HF_ERROR_NULL_POINTER, NO_INDEX, propose.parents = NULL);
  PROPOSE("65537 joints", HF_ERROR_TOO_LARGE, NO_INDEX, propose.joint_count = 65537);
  PROPOSE("2^32 - 1 joints", HF_ERROR_TOO_LARGE, NO_INDEX, propose.joint_count = UINT32_MAX);
  PROPOSE("joint NaN", HF_ERROR_NON_FINITE, 1, joints[4] = (double)NAN);
  PROPOSE("a parent beyond the list", HF_ERROR_OUT_OF_RANGE, 0, parents[0] = 2);
  PROPOSE("up NaN", HF_ERROR_NON_FINITE, NO_INDEX, propose.up[2] = (double)NAN);
  PROPOSE("up infinite", HF_ERROR_NON_FINITE, NO_INDEX, propose.up[0] = HUGE_VAL);
  PROPOSE("least_length_share NaN", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, propose.least_length_share = NAN);
  PROPOSE("least_length_share -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, propose.least_length_share = -1);
  PROPOSE("least_length_share 11", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, propose.least_length_share = 11);
  PROPOSE("257 proposals", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, propose.limit = 257);
  const hf_skeleton other = skeleton_of_another_mesh();
  PROPOSE("joints and a skeleton", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, propose.skeleton = other);
  PROPOSE("a skin of another mesh", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, give_skeleton(other));
  PROPOSE("a pose as a skeleton", HF_ERROR_INVALID_OBJECT, NO_INDEX, give_skeleton((hf_skeleton)(void*)scene.pose));
  hf_skeleton_destroy(other);
  ROW("no output", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_surface_propose_handles(scene.body, &propose, 0, NULL, NULL));
  ROW("no surface", HF_ERROR_INVALID_OBJECT, NO_INDEX, (void)0,
      hf_surface_propose_handles(NULL, &propose, 0, NULL, &proposal_count));
#undef UNCHANGED
#define UNCHANGED pose_as_before
  scene_destroy(&scene);
  finish_rows("proposing handles");
}

static void isolated_vertices_and_welded_copies_in_regions_are_found(void** state) {
  (void)state;
  scene_create(&scene);
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(scene.sheet, NULL, &pose));
  uint32_t sizes[2] = {2, 2}, vertices[4] = {0, 1, CUT_SEAM_LEFT, CUT_SEAM_RIGHT};
  hf_handles_desc d = HF_INIT(hf_handles_desc);
  d.handle_count = 2;
  d.region_counts = sizes;
  d.region_vertices = vertices;
  assert_ok(hf_pose_add_handles(pose, &d, NULL)); /* two copies in one region are one vertex */
  hf_handle_info info = HF_INIT(hf_handle_info);
  assert_ok(hf_pose_get_handle(pose, 1, &info));
  assert_int_equal(info.vertex_count, 1);
  const uint32_t both[] = {0, 1};
  assert_ok(hf_pose_remove_handles(pose, 2, both));
  vertices[1] = CUT_SEAM_RIGHT;
  vertices[3] = 9;
  check_row(__LINE__, "copies in two regions", "hf_pose_add_handles", hf_pose_add_handles(pose, &d, NULL),
            HF_ERROR_CONFLICT, 2);
  vertices[1] = 1;
  vertices[3] = CUT_ISOLATED;
  check_row(__LINE__, "an isolated vertex", "hf_pose_add_handles", hf_pose_add_handles(pose, &d, NULL),
            HF_ERROR_INVALID_ARGUMENT, 3);
  assert_int_equal(hf_pose_get_handle_count(pose), 0);
  hf_pose_destroy(pose);
  scene_destroy(&scene);
  finish_rows("welded regions");
}

static void a_pose_takes_256_handles_and_no_more(void** state) {
  (void)state;
  Surface tube = surface_tube(16, 40);
  hf_surface surface = surface_on(&tube);
  hf_pose pose = NULL;
  assert_ok(hf_pose_create(surface, NULL, &pose));
  uint32_t sizes[200], vertices[200];
  for (uint32_t i = 0; i < 200; ++i) {
    sizes[i] = 1;
    vertices[i] = 3 * i;
  }
  hf_handles_desc d = HF_INIT(hf_handles_desc);
  d.handle_count = 200;
  d.region_counts = sizes;
  d.region_vertices = vertices;
  assert_ok(hf_pose_add_handles(pose, &d, NULL));
  for (uint32_t i = 0; i < 200; ++i) vertices[i] = 3 * i + 1;
  d.handle_count = 57;
  assert_code(HF_ERROR_TOO_LARGE, hf_pose_add_handles(pose, &d, NULL));
  assert_int_equal(hf_pose_get_handle_count(pose), 200);
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  surface_free(&tube);
}

static void other_calls_of_a_pose_refuse_bad_arguments(void** state) {
  (void)state;
  scene_create(&scene);
  hf_handle_info info = HF_INIT(hf_handle_info);
  ROW("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_pose_remove_handles(scene.pose, 0, numbers));
  ROW("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_remove_handles(scene.pose, 1, NULL));
  ROW("no such handle", HF_ERROR_NOT_FOUND, 1, numbers[1] = 2, hf_pose_remove_handles(scene.pose, 2, numbers));
  ROW("UINT32_MAX", HF_ERROR_NOT_FOUND, 0, numbers[0] = UINT32_MAX, hf_pose_remove_handles(scene.pose, 2, numbers));
  ROW("named twice", HF_ERROR_NOT_FOUND, 2, (void)0, hf_pose_remove_handles(scene.pose, 3, numbers));
  ROW("2^31 of them", HF_ERROR_NOT_FOUND, 2, (void)0, hf_pose_remove_handles(scene.pose, 0x80000000u, numbers));

#define PLACE(what, expected, index, change) \
  ROW(what, expected, index, change, hf_pose_set_transforms(scene.pose, 2, numbers, transforms))
  ROW("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_pose_set_transforms(scene.pose, 0, numbers, transforms));
  ROW("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_set_transforms(scene.pose, 2, NULL, transforms));
  ROW("transforms NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0,
      hf_pose_set_transforms(scene.pose, 2, numbers, NULL));
  ROW("2^32 - 1 of them", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0,
      hf_pose_set_transforms(scene.pose, UINT32_MAX, numbers, transforms));
  PLACE("no such handle", HF_ERROR_NOT_FOUND, 1, numbers[1] = 9);
#define PLACE_ONE(what, expected, change) \
  ROW(what, expected, 0, change, hf_pose_set_transform(scene.pose, numbers[0], transforms))
  ROW("transform NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_set_transform(scene.pose, 0, NULL));
  PLACE_ONE("no such handle", HF_ERROR_NOT_FOUND, numbers[0] = 9);
  PLACE_ONE("handle UINT32_MAX", HF_ERROR_NOT_FOUND, numbers[0] = UINT32_MAX);
  PLACE_ONE("rotation NaN", HF_ERROR_NON_FINITE, transforms[0].rotation[1] = (double)NAN);
  PLACE_ONE("translation infinite", HF_ERROR_NON_FINITE, transforms[0].translation[2] = HUGE_VAL);
  ROW("output NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_deform(scene.pose, NULL, NULL));
  PLACE("rotation NaN", HF_ERROR_NON_FINITE, 1, transforms[1].rotation[0] = (double)NAN);
  PLACE("rotation w infinite", HF_ERROR_NON_FINITE, 0, transforms[0].rotation[3] = HUGE_VAL);
  PLACE("translation NaN", HF_ERROR_NON_FINITE, 1, transforms[1].translation[2] = (double)NAN);
  PLACE("translation infinite", HF_ERROR_NON_FINITE, 0, transforms[0].translation[0] = -HUGE_VAL);
  PLACE("translation absurd", HF_ERROR_NON_FINITE, 1, transforms[1].translation[1] = 1e300);

  ROW("no such handle", HF_ERROR_NOT_FOUND, NO_INDEX, (void)0, hf_pose_get_handle(scene.pose, 2, &info));
  ROW("UINT32_MAX", HF_ERROR_NOT_FOUND, NO_INDEX, (void)0, hf_pose_get_handle(scene.pose, UINT32_MAX, &info));
  ROW("no such handle", HF_ERROR_NOT_FOUND, NO_INDEX, (void)0, hf_pose_get_field(scene.pose, 2, OUT(floats)));
  ROW("output NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_get_field(scene.pose, 0, NULL));
  ROW("stride 3", HF_ERROR_TOO_SMALL, NO_INDEX, (void)0, hf_pose_get_field(scene.pose, 0, OUT_ROWS(floats, 3)));

#define DEFORM(what, expected, change) ROW(what, expected, NO_INDEX, change, hf_pose_deform(scene.pose, &deform, NULL))
  DEFORM("no output", HF_ERROR_NULL_POINTER, deform.positions = (hf_array_out){0});
  DEFORM("no room", HF_ERROR_TOO_SMALL, deform.positions.count = TUBE_VERTICES - 1);
  DEFORM("another type", HF_ERROR_INVALID_ARGUMENT, deform.positions.type = HF_TYPE_UINT16);
  DEFORM("stride 11", HF_ERROR_TOO_SMALL, deform.positions.stride = 11);
  DEFORM("stride of floats", HF_ERROR_TOO_SMALL, (deform.positions = ROWS_OUT(doubles), deform.positions.stride = 12));
  DEFORM("normal stride 4", HF_ERROR_TOO_SMALL, (deform.normals = ROWS_OUT(normals), deform.normals.stride = 4));
  DEFORM("1001 iterations", HF_ERROR_INVALID_ARGUMENT, deform.iteration_count = 1001);
  DEFORM("2^32 - 1 iterations", HF_ERROR_INVALID_ARGUMENT, deform.iteration_count = UINT32_MAX);
  DEFORM("refine 65", HF_ERROR_INVALID_ARGUMENT, deform.refine = 65);
  DEFORM("refine -1", HF_ERROR_INVALID_ARGUMENT, deform.refine = -1);
  DEFORM("no steps from the last surface", HF_ERROR_INVALID_ARGUMENT, deform.refine_from_last = 1);
  DEFORM("reserved set", HF_ERROR_INVALID_DESC, deform.reserved = 1);
  DEFORM("refine_from_last 2", HF_ERROR_INVALID_ARGUMENT, (deform.refine = 1, deform.refine_from_last = 2));
  DEFORM("a range from beyond the end", HF_ERROR_OUT_OF_RANGE, deform.first_vertex = TUBE_VERTICES + 1);
  DEFORM("a range to beyond the end", HF_ERROR_OUT_OF_RANGE,
         (deform.first_vertex = 5, deform.vertex_count = TUBE_VERTICES));
  DEFORM("a range that wraps", HF_ERROR_OUT_OF_RANGE, (deform.first_vertex = 1, deform.vertex_count = UINT32_MAX));

#define MATRICES(what, expected, index, change) \
  ROW(what, expected, index, change, hf_pose_set_matrices(scene.pose, 2, numbers, matrices))
  ROW("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_pose_set_matrices(scene.pose, 0, numbers, matrices));
  ROW("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_set_matrices(scene.pose, 2, NULL, matrices));
  ROW("matrices NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_pose_set_matrices(scene.pose, 2, numbers, NULL));
  ROW("257 of them", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0, hf_pose_set_matrices(scene.pose, 257, numbers, matrices));
  MATRICES("no such handle", HF_ERROR_NOT_FOUND, 1, numbers[1] = 9);
  MATRICES("NaN", HF_ERROR_NON_FINITE, 1, matrices[16 + 13] = (double)NAN);
  MATRICES("scaled", HF_ERROR_INVALID_ARGUMENT, 0, matrices[5] = 1.01);
  MATRICES("sheared", HF_ERROR_INVALID_ARGUMENT, 1, matrices[16 + 4] = 0.1);
  MATRICES("mirrored", HF_ERROR_INVALID_ARGUMENT, 1, matrices[16] = -1);
  MATRICES("projective", HF_ERROR_INVALID_ARGUMENT, 0, matrices[3] = 0.5);
  MATRICES("row by row", HF_ERROR_INVALID_ARGUMENT, 1,
           (matrices[16 + 3] = 1, matrices[16 + 7] = 2, matrices[16 + 12] = matrices[16 + 13] = matrices[16 + 14] = 0));
  MATRICES("too far", HF_ERROR_NON_FINITE, 0, matrices[12] = 1e300);

#define FREE(what, expected, index, change, count, list, flag) \
  ROW(what, expected, index, change, hf_pose_set_free_rotations(scene.pose, count, list, flag))
  FREE("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, 0, numbers, 1);
  FREE("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, 2, NULL, 1);
  FREE("257 of them", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0, 257, numbers, 1);
  FREE("free_rotation 2", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, 2, numbers, 2);
  FREE("free_rotation -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, 2, numbers, -1);
  FREE("no such handle", HF_ERROR_NOT_FOUND, 1, numbers[1] = 9, 2, numbers, 1);

#define FOLLOW(what, expected, index, change, count, list, share) \
  ROW(what, expected, index, change, hf_pose_set_following(scene.pose, count, list, share))
  FOLLOW("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, 0, numbers, 0.5);
  FOLLOW("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, 2, NULL, 0.5);
  FOLLOW("257 of them", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0, 257, numbers, 0.5);
  FOLLOW("following NaN", HF_ERROR_NON_FINITE, NO_INDEX, (void)0, 2, numbers, (double)NAN);
  FOLLOW("following -0.1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, 2, numbers, -0.1);
  FOLLOW("following 1.1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, 2, numbers, 1.1);
  FOLLOW("no such handle", HF_ERROR_NOT_FOUND, 1, numbers[1] = 9, 2, numbers, 0.5);

#define LIMB(what, expected, index, change, count, list, refine) \
  ROW(what, expected, index, change, hf_pose_set_limb_refine(scene.pose, count, list, refine))
  LIMB("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, 0, numbers, 1);
  LIMB("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, 2, NULL, 1);
  LIMB("257 of them", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0, 257, numbers, 1);
  LIMB("refine -1", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, 2, numbers, -1);
  LIMB("refine 65", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, (void)0, 2, numbers, 65);
  LIMB("no such handle", HF_ERROR_NOT_FOUND, 1, numbers[1] = 9, 2, numbers, 1);

#define RIGID(what, expected, index, change, count, list) \
  ROW(what, expected, index, change, hf_pose_set_rigid_pieces(scene.pose, count, list))
  RIGID("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, 2, NULL);
  RIGID("too many", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0, UINT32_MAX, numbers);
  RIGID("no such vertex", HF_ERROR_OUT_OF_RANGE, 1, numbers[1] = UINT32_MAX, 2, numbers);
  RIGID("a handle has a part", HF_ERROR_CONFLICT, 0, (void)0, 1, numbers);

#define POSE_SKIN(what, expected, change) ROW(what, expected, NO_INDEX, change, hf_pose_get_skin(scene.pose, &skin))
  POSE_SKIN("5 weights", HF_ERROR_INVALID_ARGUMENT, skin.influence_count = 5);
  POSE_SKIN("no room for the joints", HF_ERROR_TOO_SMALL, skin.pivots = doubles);
  POSE_SKIN("no room for the vertices", HF_ERROR_TOO_SMALL, (skin.joint_capacity = 1000, skin.vertex_weights = floats));
  POSE_SKIN("2^32 - 1 weights", HF_ERROR_INVALID_ARGUMENT, skin.influence_count = UINT32_MAX);
  GOOD();
  assert_ok(hf_pose_create(scene.body, NULL, &out_pose));
  check_row(__LINE__, "no handle", "hf_pose_deform", hf_pose_deform(out_pose, &deform, NULL), HF_ERROR_EMPTY, NO_INDEX);
  check_row(__LINE__, "no handle", "hf_deform", hf_deform(out_pose, floats, NULL), HF_ERROR_EMPTY, NO_INDEX);
  check_row(__LINE__, "no handle", "hf_pose_get_skin", hf_pose_get_skin(out_pose, &skin), HF_ERROR_EMPTY, NO_INDEX);
  check_row(__LINE__, "no handle", "hf_pose_get_handle", hf_pose_get_handle(out_pose, 0, &info), HF_ERROR_NOT_FOUND,
            NO_INDEX);
  check_row(__LINE__, "no handle", "hf_pose_get_field", hf_pose_get_field(out_pose, 0, OUT(floats)), HF_ERROR_NOT_FOUND,
            NO_INDEX);
  check_row(__LINE__, "no handle", "hf_pose_remove_handles", hf_pose_remove_handles(out_pose, 1, numbers),
            HF_ERROR_NOT_FOUND, 0);
  hf_pose_destroy(out_pose);
  scene_destroy(&scene);
  finish_rows("poses");
}

#undef UNCHANGED
#define UNCHANGED no_transfer
#define CREATE_TRANSFER(what, expected, change) \
  ROW(what, expected, NO_INDEX, change, hf_transfer_create(scene.body, scene.body, &transfer_desc, &out_transfer))

static void bad_transfers_are_not_made(void** state) {
  (void)state;
  scene_create(&scene);
  CREATE_TRANSFER("mode -1", HF_ERROR_INVALID_ARGUMENT, transfer_desc.mode = -1);
  CREATE_TRANSFER("mode 2", HF_ERROR_INVALID_ARGUMENT, transfer_desc.mode = 2);
  CREATE_TRANSFER("513 clusters", HF_ERROR_INVALID_ARGUMENT, transfer_desc.cluster_count = 513);
  CREATE_TRANSFER("2^32 - 1 clusters", HF_ERROR_INVALID_ARGUMENT, transfer_desc.cluster_count = UINT32_MAX);
  CREATE_TRANSFER("kernel 0.001", HF_ERROR_INVALID_ARGUMENT, transfer_desc.kernel_width = 0.001);
  CREATE_TRANSFER("kernel 0.6", HF_ERROR_INVALID_ARGUMENT, transfer_desc.kernel_width = 0.6);
  CREATE_TRANSFER("kernel negative", HF_ERROR_INVALID_ARGUMENT, transfer_desc.kernel_width = -0.1);
  CREATE_TRANSFER("kernel NaN", HF_ERROR_INVALID_ARGUMENT, transfer_desc.kernel_width = NAN);
  CREATE_TRANSFER("scale negative", HF_ERROR_INVALID_ARGUMENT, transfer_desc.scale = -1.0);
  CREATE_TRANSFER("scale NaN", HF_ERROR_INVALID_ARGUMENT, transfer_desc.scale = NAN);
  CREATE_TRANSFER("scale infinite", HF_ERROR_INVALID_ARGUMENT, transfer_desc.scale = INFINITY);
  CREATE_TRANSFER("scale absurd", HF_ERROR_INVALID_ARGUMENT, transfer_desc.scale = 1e30);
  CREATE_TRANSFER("ground -1", HF_ERROR_INVALID_ARGUMENT, transfer_desc.ground = -1);
  CREATE_TRANSFER("ground 2", HF_ERROR_INVALID_ARGUMENT, transfer_desc.ground = 2);
  static float rest[3 * TUBE_AROUND * (TUBE_RINGS + 2)];
  rest[3 * 5 + 1] = 1e30f;
  ROW("rest of the source 1e29 boxes away", HF_ERROR_TOO_LARGE, 5,
      transfer_desc.source_rest = HF_ARRAY(rest, TUBE_VERTICES),
      hf_transfer_create(scene.body, scene.body, &transfer_desc, &out_transfer));
  rest[3 * 5 + 1] = (float)NAN;
  ROW("rest of the source NaN", HF_ERROR_NON_FINITE, 5, transfer_desc.source_rest = HF_ARRAY(rest, TUBE_VERTICES),
      hf_transfer_create(scene.body, scene.body, &transfer_desc, &out_transfer));
  ROW("rest of the target NaN", HF_ERROR_NON_FINITE, 5, transfer_desc.target_rest = HF_ARRAY(rest, TUBE_VERTICES),
      hf_transfer_create(scene.body, scene.body, &transfer_desc, &out_transfer));
  CREATE_TRANSFER("angle NaN", HF_ERROR_NON_FINITE, transfer_desc.alignment_angle = NAN);
  CREATE_TRANSFER("angle infinite", HF_ERROR_NON_FINITE, transfer_desc.alignment_angle = INFINITY);
  CREATE_TRANSFER("source axis NaN", HF_ERROR_NON_FINITE, transfer_desc.source_axes[4] = NAN);
  CREATE_TRANSFER("target axis infinite", HF_ERROR_NON_FINITE, transfer_desc.target_axes[8] = INFINITY);
  CREATE_TRANSFER("source axes incomplete", HF_ERROR_INVALID_ARGUMENT, transfer_desc.source_axes[0] = 1.0);
  CREATE_TRANSFER("target axes no frame", HF_ERROR_INVALID_ARGUMENT,
                  (transfer_desc.target_axes[0] = transfer_desc.target_axes[3] = transfer_desc.target_axes[8] = 1.0));
  ROW("no source", HF_ERROR_INVALID_OBJECT, 0, (void)0, hf_transfer_create(NULL, scene.body, NULL, &out_transfer));
  ROW("no target", HF_ERROR_INVALID_OBJECT, 1, (void)0, hf_transfer_create(scene.body, NULL, NULL, &out_transfer));
  ROW("a solver as source", HF_ERROR_INVALID_OBJECT, 0, (void)0,
      hf_transfer_create((hf_surface)(void*)scene.solver, scene.body, NULL, &out_transfer));
  ROW("a direction field as target", HF_ERROR_INVALID_OBJECT, 1, (void)0,
      hf_transfer_create(scene.body, (hf_surface)(void*)scene.direction, NULL, &out_transfer));
#undef UNCHANGED
#define UNCHANGED transfer_as_before
  ROW("out NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_transfer_create(scene.body, scene.body, NULL, NULL));
  scene_destroy(&scene);
  finish_rows("making transfers");
}

#define PAIRS(what, expected, index, change) \
  ROW(what, expected, index, change, hf_transfer_add_pairs(scene.transfer, &pairs, out_numbers))

static void bad_pairs_are_not_added(void** state) {
  (void)state;
  scene_create(&scene);
  PAIRS("none", HF_ERROR_EMPTY, NO_INDEX, pairs.pair_count = 0);
  PAIRS("257", HF_ERROR_TOO_LARGE, NO_INDEX, pairs.pair_count = 257);
  PAIRS("2^31", HF_ERROR_TOO_LARGE, NO_INDEX, pairs.pair_count = 0x80000000u);
  PAIRS("2^32 - 1", HF_ERROR_TOO_LARGE, NO_INDEX, pairs.pair_count = UINT32_MAX);
  PAIRS("source_counts NULL", HF_ERROR_NULL_POINTER, NO_INDEX, pairs.source_counts = NULL);
  PAIRS("source_vertices NULL", HF_ERROR_NULL_POINTER, NO_INDEX, pairs.source_vertices = NULL);
  PAIRS("target_counts NULL", HF_ERROR_NULL_POINTER, NO_INDEX, pairs.target_counts = NULL);
  PAIRS("target_vertices NULL", HF_ERROR_NULL_POINTER, NO_INDEX, pairs.target_vertices = NULL);
  PAIRS("empty source region", HF_ERROR_EMPTY, 0, counts[0] = 0);
  PAIRS("empty target region", HF_ERROR_EMPTY, 1, target_counts[1] = 0);
  PAIRS("source vertex = vertex_count", HF_ERROR_OUT_OF_RANGE, 2, region[2] = TUBE_VERTICES);
  PAIRS("target vertex UINT32_MAX", HF_ERROR_OUT_OF_RANGE, 5, target_region[5] = UINT32_MAX);
  PAIRS("source overlaps a pair that is there", HF_ERROR_CONFLICT, 1, region[1] = 3);
  PAIRS("target overlaps a pair that is there", HF_ERROR_CONFLICT, 0, target_region[0] = 3);
  PAIRS("source regions overlap", HF_ERROR_CONFLICT, 3, region[3] = region[0]);
  PAIRS("target regions overlap", HF_ERROR_CONFLICT, 4, target_region[4] = target_region[1]);
  PAIRS("unknown flag", HF_ERROR_INVALID_ARGUMENT, 1, flags[1] = 512);
  PAIRS("all flags", HF_ERROR_INVALID_ARGUMENT, 0, flags[0] = UINT32_MAX);
  PAIRS("a source region of 2^31", HF_ERROR_TOO_LARGE, 0, counts[0] = 0x80000000u);
  PAIRS("a target region of 2^32 - 1", HF_ERROR_TOO_LARGE, 1, target_counts[1] = UINT32_MAX);
  scene_destroy(&scene);
  finish_rows("adding pairs");
}

#define APPLY(what, expected, index, change) \
  ROW(what, expected, index, change, hf_transfer_apply(scene.transfer, &frame))
#define DIALS(what, expected, change)                                         \
  ROW(what, expected, NO_INDEX, (dials = HF_INIT(hf_transfer_dials), change), \
      hf_transfer_set_dials(scene.transfer, &dials))
#define SKIN(what, expected, change) ROW(what, expected, NO_INDEX, change, hf_transfer_get_skin(scene.transfer, &skin))

static void other_calls_of_a_transfer_refuse_bad_arguments(void** state) {
  (void)state;
  scene_create(&scene);
  hf_pair_info info = HF_INIT(hf_pair_info);
  ROW("none", HF_ERROR_EMPTY, NO_INDEX, (void)0, hf_transfer_remove_pairs(scene.transfer, 0, numbers));
  ROW("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, hf_transfer_remove_pairs(scene.transfer, 1, NULL));
  ROW("no such pair", HF_ERROR_NOT_FOUND, 1, numbers[1] = 2, hf_transfer_remove_pairs(scene.transfer, 2, numbers));
  ROW("UINT32_MAX", HF_ERROR_NOT_FOUND, 0, numbers[0] = UINT32_MAX,
      hf_transfer_remove_pairs(scene.transfer, 2, numbers));
  ROW("named twice", HF_ERROR_NOT_FOUND, 2, (void)0, hf_transfer_remove_pairs(scene.transfer, 3, numbers));
  ROW("2^31 of them", HF_ERROR_NOT_FOUND, 2, (void)0, hf_transfer_remove_pairs(scene.transfer, 0x80000000u, numbers));
  ROW("no such pair", HF_ERROR_NOT_FOUND, 2, (void)0, hf_transfer_get_pair(scene.transfer, 2, &info));
  ROW("UINT32_MAX", HF_ERROR_NOT_FOUND, NO_INDEX, (void)0, hf_transfer_get_pair(scene.transfer, UINT32_MAX, &info));

  APPLY("no source", HF_ERROR_NULL_POINTER, NO_INDEX, frame.source_positions = (hf_array){0});
  APPLY("another source", HF_ERROR_INVALID_ARGUMENT, NO_INDEX, frame.source_positions.count = CUT_VERTICES);
  APPLY("no room", HF_ERROR_TOO_SMALL, NO_INDEX, frame.target_positions.count = CUT_VERTICES);
  APPLY("source stride 11", HF_ERROR_TOO_SMALL, NO_INDEX, frame.source_positions.stride = 11);
  APPLY("target stride 8", HF_ERROR_TOO_SMALL, NO_INDEX, frame.target_positions.stride = 8);
  APPLY("normal stride 1", HF_ERROR_TOO_SMALL, NO_INDEX,
        (frame.target_normals = ROWS_OUT(normals), frame.target_normals.stride = 1));
  APPLY("source NaN", HF_ERROR_NON_FINITE, 17, source[3 * 17 + 2] = (float)NAN);
  APPLY("source 1e30 boxes away", HF_ERROR_TOO_LARGE, 17, source[3 * 17] = 1e31f);
  APPLY("source infinite", HF_ERROR_NON_FINITE, TUBE_VERTICES - 1, source[3 * TUBE_VERTICES - 1] = (float)INFINITY);

#define RIGID_TARGET(what, expected, index, change, count, list) \
  ROW(what, expected, index, change, hf_transfer_set_rigid_pieces(scene.transfer, count, list))
  RIGID_TARGET("list NULL", HF_ERROR_NULL_POINTER, NO_INDEX, (void)0, 2, NULL);
  RIGID_TARGET("too many", HF_ERROR_TOO_LARGE, NO_INDEX, (void)0, UINT32_MAX, numbers);
  RIGID_TARGET("no such vertex", HF_ERROR_OUT_OF_RANGE, 1, numbers[1] = UINT32_MAX, 2, numbers);

  hf_transfer_dials dials = HF_INIT(hf_transfer_dials);
  DIALS("reserved set", HF_ERROR_INVALID_DESC, dials.reserved = 1);
  DIALS("stride 0.09", HF_ERROR_INVALID_ARGUMENT, dials.stride = 0.09);
  DIALS("stride -1", HF_ERROR_INVALID_ARGUMENT, dials.stride = -1);
  DIALS("stride 5", HF_ERROR_INVALID_ARGUMENT, dials.stride = 5);
  DIALS("stride NaN", HF_ERROR_NON_FINITE, dials.stride = NAN);
  DIALS("hip height 0.6", HF_ERROR_INVALID_ARGUMENT, dials.hip_height_share = 0.6);
  DIALS("hip height -0.6", HF_ERROR_INVALID_ARGUMENT, dials.hip_height_share = -0.6);
  DIALS("hip height infinite", HF_ERROR_NON_FINITE, dials.hip_height_share = INFINITY);
  DIALS("neck follow 2", HF_ERROR_INVALID_ARGUMENT, dials.neck_follow = 2);
  DIALS("neck follow NaN", HF_ERROR_NON_FINITE, dials.neck_follow = NAN);
  DIALS("tail follow -2", HF_ERROR_INVALID_ARGUMENT, dials.tail_follow = -2);
  DIALS("tail follow NaN", HF_ERROR_NON_FINITE, dials.tail_follow = NAN);
  DIALS("arm space in degrees", HF_ERROR_INVALID_ARGUMENT, dials.arm_space = 20);
  DIALS("arm space NaN", HF_ERROR_NON_FINITE, dials.arm_space = NAN);
  DIALS("long follow 1.1", HF_ERROR_INVALID_ARGUMENT, dials.long_follow = 1.1);
  DIALS("long follow -0.1", HF_ERROR_INVALID_ARGUMENT, dials.long_follow = -0.1);
  DIALS("long follow NaN", HF_ERROR_NON_FINITE, dials.long_follow = NAN);

  SKIN("5 weights", HF_ERROR_INVALID_ARGUMENT, skin.influence_count = 5);
  SKIN("no room for the joints", HF_ERROR_TOO_SMALL, skin.pivots = doubles);
  SKIN("no room for the vertices", HF_ERROR_TOO_SMALL, (skin.joint_capacity = 1000, skin.vertex_weights = floats));
  SKIN("2^32 - 1 weights", HF_ERROR_INVALID_ARGUMENT, skin.influence_count = UINT32_MAX);

  GOOD();
  assert_ok(hf_transfer_create(scene.body, scene.body, NULL, &out_transfer));
  check_row(__LINE__, "no pair", "hf_transfer_apply", hf_transfer_apply(out_transfer, &frame), HF_ERROR_EMPTY,
            NO_INDEX);
  check_row(__LINE__, "no pair", "hf_transfer_get_skin", hf_transfer_get_skin(out_transfer, &skin), HF_ERROR_EMPTY,
            NO_INDEX);
  check_row(__LINE__, "no pair", "hf_transfer_get_pair", hf_transfer_get_pair(out_transfer, 0, &info),
            HF_ERROR_NOT_FOUND, 0);
  check_row(__LINE__, "no pair", "hf_transfer_remove_pairs", hf_transfer_remove_pairs(out_transfer, 1, numbers),
            HF_ERROR_NOT_FOUND, 0);
  hf_transfer_destroy(out_transfer);
  scene_destroy(&scene);
  finish_rows("transfers");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bad_poses_are_not_made),
      cmocka_unit_test(bad_handles_are_not_added),
      cmocka_unit_test(handles_are_not_proposed_from_bad_input),
      cmocka_unit_test(isolated_vertices_and_welded_copies_in_regions_are_found),
      cmocka_unit_test(a_pose_takes_256_handles_and_no_more),
      cmocka_unit_test(other_calls_of_a_pose_refuse_bad_arguments),
      cmocka_unit_test(bad_transfers_are_not_made),
      cmocka_unit_test(bad_pairs_are_not_added),
      cmocka_unit_test(other_calls_of_a_transfer_refuse_bad_arguments),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
