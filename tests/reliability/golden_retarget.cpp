// See golden_retarget.h.
#include "golden_retarget.h"

#include <algorithm>
#include <array>

#include "../support/stick_man.h"
#include "base/elementary.h"
#include "surfaces.h"

namespace reliability {
namespace {

using Pose = std::array<float[10], MAN_JOINTS>;

// Joints rest without a turn, so a turn about one axis is a sine and a cosine. The sines are the library's, and nothing
// is added to a product, so every machine makes the same numbers.
void turn(Pose& pose, int joint, int axis, double half) {
  pose[static_cast<std::size_t>(joint)][3 + axis] = static_cast<float>(hf_inner::sine(half));
  pose[static_cast<std::size_t>(joint)][6] = static_cast<float>(hf_inner::cosine(half));
}

Pose walk(const StickMan& man, int frame) {
  Pose pose;
  for (std::size_t j = 0; j < MAN_JOINTS; ++j) std::copy(man.rest[j], man.rest[j] + 10, pose[j]);
  const double time = 0.25 * frame, swing = 0.25 * hf_inner::sine(time), bend = hf_inner::cosine(time);
  turn(pose, MAN_LEFT_LEG, 0, -swing);
  turn(pose, MAN_RIGHT_LEG, 0, swing);
  turn(pose, MAN_LEFT_KNEE, 0, bend > 0 ? 0.5 * bend : 0);
  turn(pose, MAN_RIGHT_KNEE, 0, bend < 0 ? -0.5 * bend : 0);
  turn(pose, MAN_LEFT_ARM, 1, swing);
  turn(pose, MAN_RIGHT_ARM, 2, 0.03125 * frame);
  turn(pose, MAN_LEFT_ELBOW, 1, -0.5);
  turn(pose, MAN_CHEST, 1, 0.5 * swing);
  turn(pose, MAN_NECK, 0, 0.25 * swing);
  pose[MAN_HIPS][1] = frame < 24 ? 1.0f : 1.0f - static_cast<float>(frame - 24) / 64;
  pose[MAN_HIPS][2] = static_cast<float>(frame) / 16;
  return pose;
}

hf_skeleton make(const StickMan& man) {
  const hf_skin_desc skin = man_skin(&man);
  const hf_skeleton_desc d = man_desc(&man, &skin);
  hf_skeleton out = nullptr;
  must(hf_skeleton_create(&d, &out), "hf_skeleton_create");
  return out;
}

}  // namespace

std::vector<float> retargeted_poses() {
  const StickMan man = stick_man(1, 0), other = stick_man(1.25f, 0);
  // Its arms hang at the rest that counts: sine and cosine of the half angle are 0.28 and 0.96.
  Pose rest;
  for (std::size_t j = 0; j < MAN_JOINTS; ++j) std::copy(other.rest[j], other.rest[j] + 10, rest[j]);
  for (const int arm : {MAN_LEFT_ARM, MAN_RIGHT_ARM}) {
    rest[static_cast<std::size_t>(arm)][5] = arm == MAN_LEFT_ARM ? -0.28f : 0.28f;
    rest[static_cast<std::size_t>(arm)][6] = 0.96f;
  }
  const hf_skeleton source = make(man), target = make(other);
  std::vector<float> out;
  const auto play = [&](hf_retarget retarget, int from, int to) {
    Pose posed;
    for (int frame = from; frame < to; ++frame) {
      const Pose pose = walk(man, frame);
      must(hf_retarget_solve(retarget, pose[0], 0.0625, posed[0]), "hf_retarget_solve");
      out.insert(out.end(), posed[0], posed[0] + 10 * MAN_JOINTS);
    }
  };
  for (const int leave_out : {0, HF_RETARGET_KEEP_RESTS | HF_RETARGET_NO_GOALS, +HF_RETARGET_NO_LOCK}) {
    hf_retarget_desc d = desc<hf_retarget_desc>();
    d.leave_out = static_cast<std::uint32_t>(leave_out | HF_RETARGET_NO_COPY);
    d.target_rest = rest[0];
    hf_retarget retarget = nullptr, clone = nullptr;
    must(hf_retarget_create(source, target, &d, &retarget), "hf_retarget_create");
    play(retarget, 0, 24);
    must(hf_retarget_clone(retarget, &clone), "hf_retarget_clone");
    play(clone, 24, 40);
    hf_retarget_destroy(clone);
    hf_retarget_destroy(retarget);
  }
  hf_skeleton_destroy(source);
  hf_skeleton_destroy(target);
  return out;
}

}  // namespace reliability
