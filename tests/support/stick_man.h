/* A man of 19 joints for tests of skeletons and retargets: pelvis to head, arms, legs. Up is y, forward is z, left is
 * x.
 */
#ifndef HF_TEST_STICK_MAN_H
#define HF_TEST_STICK_MAN_H

#include <math.h>
#include <string.h>

#include "hf/retarget.h"

enum {
  MAN_HIPS,
  MAN_SPINE,
  MAN_CHEST,
  MAN_NECK,
  MAN_HEAD,
  MAN_LEFT_ARM,
  MAN_LEFT_ELBOW,
  MAN_LEFT_HAND,
  MAN_RIGHT_ARM,
  MAN_RIGHT_ELBOW,
  MAN_RIGHT_HAND,
  MAN_LEFT_LEG,
  MAN_LEFT_KNEE,
  MAN_LEFT_FOOT,
  MAN_LEFT_TOES,
  MAN_RIGHT_LEG,
  MAN_RIGHT_KNEE,
  MAN_RIGHT_FOOT,
  MAN_RIGHT_TOES,
  MAN_JOINTS,
  MAN_VERTICES = 3 * MAN_JOINTS
};

typedef struct StickMan {
  const char* names;
  uint32_t parents[MAN_JOINTS];
  float rest[MAN_JOINTS][10];
  float positions[MAN_VERTICES][3];
  uint32_t triangles[MAN_JOINTS][3];
  uint32_t joints[MAN_VERTICES];
  float weights[MAN_VERTICES];
} StickMan;

/* size: over that of a man of 1.9 units. arms_down: the angle of the arms under the horizontal at rest, in degrees. */
static inline StickMan stick_man(float size, float arms_down) {
  static const char* const names =
      "hips\nspine\nchest\nneck\nhead\n"
      "left_upper_arm\nleft_lower_arm\nleft_hand\nright_upper_arm\nright_lower_arm\nright_hand\n"
      "left_upper_leg\nleft_lower_leg\nleft_foot\nleft_toes\nright_upper_leg\nright_lower_leg\nright_foot\nright_toes";
  static const int parents[MAN_JOINTS] = {-1, 0, 1, 2, 3, 2, 5, 6, 2, 8, 9, 0, 11, 12, 13, 0, 15, 16, 17};
  static const float offsets[MAN_JOINTS][3] = {
      {0, 1, 0},          {0, 0.2f, 0},       {0, 0.2f, 0},        {0, 0.2f, 0},        {0, 0.1f, 0},
      {0.2f, 0.15f, 0},   {0.3f, 0, 0},       {0.3f, 0, 0},        {-0.2f, 0.15f, 0},   {-0.3f, 0, 0},
      {-0.3f, 0, 0},      {0.1f, -0.05f, 0},  {0, -0.45f, 0.02f},  {0, -0.45f, -0.02f}, {0, -0.05f, 0.15f},
      {-0.1f, -0.05f, 0}, {0, -0.45f, 0.02f}, {0, -0.45f, -0.02f}, {0, -0.05f, 0.15f}};
  StickMan man;
  memset(&man, 0, sizeof man);
  man.names = names;
  for (int j = 0; j < MAN_JOINTS; ++j) {
    man.parents[j] = parents[j] < 0 ? HF_NO_INDEX : (uint32_t)parents[j];
    for (int c = 0; c < 3; ++c) man.rest[j][c] = size * offsets[j][c];
    man.rest[j][6] = man.rest[j][7] = man.rest[j][8] = man.rest[j][9] = 1;
  }
  for (int side = 0; side < 2; ++side) {
    const float half = (side ? 0.5f : -0.5f) * arms_down * 3.14159265f / 180;
    float* const arm = man.rest[side ? MAN_RIGHT_ARM : MAN_LEFT_ARM];
    arm[5] = sinf(half);
    arm[6] = cosf(half);
  }
  /* One small triangle at each joint. Rotations at rest are about z, and those of a chain add up. */
  for (int j = 0; j < MAN_JOINTS; ++j) {
    float place[3] = {0, 0, 0};
    for (int k = j; k >= 0; k = parents[k]) {
      float angle = 0;
      for (int p = parents[k]; p >= 0; p = parents[p]) angle += 2 * asinf(man.rest[p][5]);
      const float *t = man.rest[k], c = cosf(angle), s = sinf(angle);
      place[0] += c * t[0] - s * t[1];
      place[1] += s * t[0] + c * t[1];
      place[2] += t[2];
    }
    for (int v = 3 * j; v < 3 * j + 3; ++v) {
      memcpy(man.positions[v], place, sizeof place);
      man.joints[v] = (uint32_t)j;
      man.weights[v] = 1;
      man.triangles[j][v - 3 * j] = (uint32_t)v;
    }
    man.positions[3 * j + 1][0] += 0.02f * size;
    man.positions[3 * j + 2][2] += 0.02f * size;
  }
  return man;
}

static inline hf_skin_desc man_skin(const StickMan* man) {
  hf_skin_desc skin = HF_INIT(hf_skin_desc);
  skin.vertex_count = MAN_VERTICES;
  skin.triangle_count = MAN_JOINTS;
  skin.influence_count = 1;
  skin.positions = man->positions[0];
  skin.triangles = man->triangles[0];
  skin.joints = man->joints;
  skin.weights = man->weights;
  return skin;
}

static inline hf_skeleton_desc man_desc(const StickMan* man, const hf_skin_desc* skin) {
  hf_skeleton_desc desc = HF_INIT(hf_skeleton_desc);
  desc.joint_count = MAN_JOINTS;
  desc.names = man->names;
  desc.parents = man->parents;
  desc.rest = man->rest[0];
  desc.skin = skin;
  return desc;
}

/* Turns a joint of a pose further about an axis of its own frame (0, 1, 2), in degrees. */
static inline void man_turn(float (*pose)[10], int joint, int axis, float degrees) {
  float* const q = pose[joint] + 3;
  const float half = 0.5f * degrees * 3.14159265f / 180, s = sinf(half), c = cosf(half);
  const int a = axis, b = (axis + 1) % 3, d = (axis + 2) % 3;
  const float old[4] = {q[0], q[1], q[2], q[3]};
  q[a] = c * old[a] + s * old[3];
  q[b] = c * old[b] + s * old[d];
  q[d] = c * old[d] - s * old[b];
  q[3] = c * old[3] - s * old[a];
}

/* A frame of a walk on the spot: time in steps. */
static inline void man_walk(const StickMan* man, float time, float (*pose)[10]) {
  memcpy(pose, man->rest, sizeof man->rest);
  const float swing = 25 * sinf(3.14159265f * time);
  man_turn(pose, MAN_LEFT_LEG, 0, -swing);
  man_turn(pose, MAN_RIGHT_LEG, 0, swing);
  man_turn(pose, MAN_LEFT_KNEE, 0, 20 + 15 * cosf(3.14159265f * time));
  man_turn(pose, MAN_RIGHT_KNEE, 0, 20 - 15 * cosf(3.14159265f * time));
  man_turn(pose, MAN_LEFT_ARM, 1, swing);
  man_turn(pose, MAN_RIGHT_ARM, 1, swing);
  man_turn(pose, MAN_CHEST, 1, 0.3f * swing);
}

#endif
