// A body of blocks as hobby rigs have it: joints without names, collars and hips that start in the middle, legs that
// hang on no joint of the trunk, a spine that owns nothing.
#pragma once
#include "rig_family.h"

namespace hf_test {

// half_owned: the right hip bone owns no vertex, as where both sides were painted by hand. hands: else forearms end the
// arms.
inline Rig make_block_rig(bool half_owned, bool hands = true) {
  Rig rig;
  const auto joint = [&](int parent, Vec3 pivot, Role role, Side side = Side::middle) {
    return rig.add("Bone." + std::to_string(rig.joints.size()), parent, pivot, role, side);
  };
  const int spine = joint(-1, {0, 1, 0}, Role::spine);
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const int collar = joint(spine, {0, 1.8, 0}, Role::shoulder, side);
    rig.add_block(collar, {s > 0 ? 0 : -0.4, 1.02, -0.2}, {s > 0 ? 0.4 : 0, 1.8, 0.2});
    const int arm = joint(collar, {s * 0.5, 1.75, 0}, Role::arm, side);
    rig.add_block(arm, {s * 0.5 - 0.09, 1.4, -0.1}, {s * 0.5 + 0.09, 1.8, 0.1});
    const int fore = joint(arm, {s * 0.5, 1.4, 0}, Role::arm, side);
    rig.add_block(fore, {s * 0.5 - 0.08, 1.05, -0.1}, {s * 0.5 + 0.08, 1.4, 0.1});
    const int hand = hands ? joint(fore, {s * 0.5, 1.05, 0}, Role::hand, side) : fore;
    rig.add_block(hand, {s * 0.5 - 0.08, 0.85, -0.1}, {s * 0.5 + 0.08, 1.05, 0.1});
  }
  const int head = joint(spine, {0, 1.8, 0}, Role::head);
  rig.add_block(head, {-0.35, 1.8, -0.3}, {0.35, 2.5, 0.4});
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const bool bare = half_owned && s < 0;
    const int hip = joint(-1, {0, 1, 0}, Role::shoulder, side);
    rig.joints.back().judged = !half_owned;
    if (!bare) rig.add_block(hip, {s * 0.2 - 0.12, 0.98, -0.12}, {s * 0.2 + 0.12, 1.02, 0.12});
    const int thigh = joint(hip, {s * 0.2, 1, 0}, Role::leg, side);
    // It touches the skin of the collar on its side.
    rig.add_block(thigh, {s > 0 ? 0.08 : -0.4, 0.5, -0.2}, {s > 0 ? 0.4 : -0.08, 1.02, 0.2});
    const int shin = joint(thigh, {s * 0.2, 0.48, 0}, Role::leg, side);
    rig.add_block(shin, {s * 0.2 - 0.12, 0.12, -0.12}, {s * 0.2 + 0.12, 0.5, 0.12});
    rig.add_block(shin, {s * 0.2 - 0.12, 0, -0.12}, {s * 0.2 + 0.12, 0.12, 0.35});
  }
  return rig;
}

}  // namespace hf_test
