/* hf_play SOURCE.glb TARGET.glb OUT.glb [CLIP]: a clip of one character played on the joints of another, in C with both
 * libraries. CLIP: its number in the source, 0 without one. */
#include <hf/hf.h>
#include <hf_gltf/gltf.h>
#include <stdio.h>
#include <stdlib.h>

enum { FRAMES_A_SECOND = 30 };

static void end(const hf_error_detail* detail) {
  fprintf(stderr, "hf_play: %s: %s\n", detail->function, detail->message);
  exit(1);
}
static void ok(hf_result result) { /* of hf */
  hf_error_detail detail;
  if (result != HF_OK) {
    hf_error_get_detail(&detail);
    end(&detail);
  }
}
static void good(hf_result result) { /* of hf_gltf */
  hf_error_detail detail;
  if (result != HF_OK) {
    hf_gltf_error_get_detail(&detail);
    end(&detail);
  }
}
static void* space(size_t bytes) {
  void* block = malloc(bytes + 1);
  if (!block) exit(2);
  return block;
}

static hf_gltf_model model_of(const char* file, hf_gltf_model_info* info) {
  hf_gltf_model model;
  hf_gltf_read_desc read = HF_INIT(hf_gltf_read_desc);
  read.file = file;
  good(hf_gltf_model_read(&read, &model));
  *info = HF_INIT(hf_gltf_model_info);
  good(hf_gltf_model_get_info(model, info));
  return model;
}

/* The joints of a model with its skin: the skin says where soles are. The skeleton keeps a copy. */
static hf_skeleton skeleton_of(hf_gltf_model model, const hf_gltf_model_info* info) {
  const size_t joints = info->joint_count, vertices = info->vertex_count;
  hf_gltf_skeleton from = HF_INIT(hf_gltf_skeleton);
  from.name_capacity = info->name_byte_count;
  from.names = space(info->name_byte_count);
  from.parents = space(sizeof(uint32_t) * joints);
  from.rest = space(sizeof(float) * 10 * joints);
  from.inverse_binds = space(sizeof(float) * 16 * joints);
  good(hf_gltf_model_get_skeleton(model, &from));
  hf_skeleton_desc desc = HF_INIT(hf_skeleton_desc);
  desc.joint_count = info->joint_count;
  desc.names = from.names;
  desc.parents = from.parents;
  desc.rest = from.rest;
  desc.inverse_binds = info->has_skin ? from.inverse_binds : NULL;

  hf_gltf_surface shape = HF_INIT(hf_gltf_surface);
  hf_skin_desc skin = HF_INIT(hf_skin_desc);
  double* const places = shape.positions = space(sizeof(double) * 3 * vertices);
  uint16_t* const owners = shape.joints = space(sizeof(uint16_t) * 8 * vertices);
  float* const weights = shape.weights = space(sizeof(float) * 8 * vertices);
  uint32_t* const triangles = shape.triangles = space(sizeof(uint32_t) * 3 * info->triangle_count);
  float* const positions = space(sizeof(float) * 3 * vertices);
  uint32_t* const numbers = space(sizeof(uint32_t) * 8 * vertices);
  if (info->triangle_count > 0) { /* a file can hold a skeleton and clips alone */
    good(hf_gltf_model_get_surface(model, &shape));
    for (size_t i = 0; i < 3 * vertices; ++i) positions[i] = (float)places[i];
    for (size_t i = 0; i < 8 * vertices; ++i) numbers[i] = owners[i];
    skin.vertex_count = info->vertex_count;
    skin.triangle_count = info->triangle_count;
    skin.influence_count = 8;
    skin.at_rest = 1;
    skin.positions = positions;
    skin.triangles = triangles;
    skin.joints = numbers;
    skin.weights = weights;
    desc.skin = &skin;
  }
  hf_skeleton skeleton;
  ok(hf_skeleton_create(&desc, &skeleton));
  void* const blocks[] = {from.names, from.parents, from.rest, from.inverse_binds, places,
                          owners,     weights,      triangles, positions,          numbers};
  for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; ++i) free(blocks[i]);
  return skeleton;
}

int main(int count, char** words) {
  if (count < 4 || count > 5) {
    fprintf(stderr, "usage: hf_play SOURCE.glb TARGET.glb OUT.glb [CLIP]\n");
    return 2;
  }
  const uint32_t clip = count > 4 ? (uint32_t)strtoul(words[4], NULL, 10) : 0;
  hf_gltf_model_info from, to;
  const hf_gltf_model source = model_of(words[1], &from), target = model_of(words[2], &to);
  const hf_skeleton source_skeleton = skeleton_of(source, &from), target_skeleton = skeleton_of(target, &to);
  hf_retarget retarget;
  ok(hf_retarget_create(source_skeleton, target_skeleton, NULL, &retarget));

  hf_gltf_clip_info played = HF_INIT(hf_gltf_clip_info);
  good(hf_gltf_model_get_clip(source, clip, &played));
  const uint32_t frames = 1 + (uint32_t)(played.duration * FRAMES_A_SECOND + 0.5);
  float* const pose = space(sizeof(float) * 10 * from.joint_count);
  float* const poses = space(sizeof(float) * 10 * to.joint_count * frames);
  double* const times = space(sizeof(double) * frames);
  for (uint32_t f = 0; f < frames; ++f) { /* a game does this in every frame */
    times[f] = (double)f / FRAMES_A_SECOND;
    good(hf_gltf_model_pose_joints(source, clip, times[f], pose));
    ok(hf_retarget_solve(retarget, pose, 1.0 / FRAMES_A_SECOND, poses + (size_t)10 * to.joint_count * f));
  }
  hf_gltf_joints_desc keys = HF_INIT(hf_gltf_joints_desc);
  keys.frame_count = frames;
  keys.name = played.name;
  keys.times = times;
  keys.joints = poses;
  good(hf_gltf_model_add_joint_clip(target, &keys));
  good(hf_gltf_model_save(target, words[3]));

  hf_retarget_info info = HF_INIT(hf_retarget_info);
  ok(hf_retarget_get_info(retarget, &info));
  printf("%s: \"%s\", %u frames; %u joints follow, limbs to %.1f degrees\n", words[3], played.name, frames,
         info.matched_joint_count, 57.29578 * info.limb_angle);
  free(pose);
  free(poses);
  free(times);
  hf_retarget_destroy(retarget);
  hf_skeleton_destroy(source_skeleton);
  hf_skeleton_destroy(target_skeleton);
  hf_gltf_model_destroy(source);
  hf_gltf_model_destroy(target);
  return 0;
}
