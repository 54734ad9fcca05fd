// The walk of hoofed animals: footfalls left hind, left fore, right hind, right fore a quarter cycle apart; the pelvis
// turns with the hind legs, the trunk answers, the shoulder blades swing with the fore legs, the head nods twice.
#include "quadruped.h"

namespace samples {
namespace {

constexpr double quarter = 0.25;

Leg leg_of(const Design& d, const QuadrupedStyle& style, bool front, bool left, bool walking) {
  const std::string side = left ? "_L" : "_R", part = front ? "front_" : "hind_";
  Leg leg;
  leg.joints = {d.joint(part + "upper_leg" + side), d.joint(part + "lower_leg" + side), d.joint(part + "cannon" + side),
                d.joint(part + "pastern" + side), d.joint(part + "hoof" + side)};
  leg.tip = front ? style.front_tip : style.hind_tip;
  if (!left) leg.tip.x = -leg.tip.x;
  leg.phase = (left ? 0 : 0.5) + (front ? quarter : 0);
  leg.bend_lower = front ? -1 : 1;
  leg.bend_cannon = front ? 0 : -0.85;
  if (!walking) return leg;
  leg.stance_shift = front ? style.front_shift : style.hind_shift;
  leg.lift = front ? style.front_lift : style.hind_lift;
  const double on = style.duty, air = 1 - style.duty;
  // break-over: the heel rises before the toe leaves the ground
  leg.hoof = PhaseCurve({{0, 0},
                         {0.80 * on, 0},
                         {on, 0.50},
                         {on + 0.30 * air, front ? 1.25 : 0.95},
                         {on + 0.65 * air, 0.40},
                         {on + 0.92 * air, -0.06}});
  leg.pastern = PhaseCurve({{0, 0},
                            {0.45 * on, -0.22},
                            {0.82 * on, 0.02},
                            {on, 0.45},
                            {on + 0.30 * air, front ? 1.05 : 0.75},
                            {on + 0.70 * air, 0.25},
                            {on + 0.95 * air, 0}});
  if (front) {
    leg.fold =
        PhaseCurve({{0, 0}, {0.86 * on, 0}, {on, 0.22}, {on + 0.36 * air, style.front_fold}, {on + 0.90 * air, 0}});
  }
  return leg;
}

Gait walk(const Design& d, const QuadrupedStyle& style) {
  Gait gait;
  gait.name = "walk";
  gait.duration = style.duration;
  gait.stride = style.stride;
  gait.duty = style.duty;
  for (bool front : {false, true}) {
    for (bool left : {true, false}) gait.legs.push_back(leg_of(d, style, front, left, true));
  }
  const auto turn = [&](const char* joint, int axis, double mean, double first, double first_at, double second = 0,
                        double second_at = 0) {
    gait.rotations.push_back({d.joint(joint), axis, mean, first, first_at, second, second_at});
  };
  const double sway = style.sway, middle = 0.5 * style.duty;
  // trunk: highest over the middle of each hind stance
  gait.translations.push_back({d.joint("hips"), 1, -style.sink, 0, 0, style.bob, 0.125 - middle});
  gait.translations.push_back({d.joint("hips"), 0, 0, 0.010 * sway, quarter - middle, 0, 0});
  turn("hips", 1, 0, 0.055 * sway, -quarter);
  turn("hips", 2, 0, 0.030 * sway, quarter - middle);
  turn("hips", 0, 0, 0, 0, 0.012, 0.02);
  turn("spine_1", 1, 0, -0.040 * sway, -quarter);
  turn("spine_1", 2, 0, -0.015 * sway, quarter - middle);
  turn("spine_2", 1, 0, -0.035 * sway, -quarter);
  turn("spine_2", 2, 0, -0.015 * sway, quarter - middle);
  turn("chest", 1, 0, -0.020 * sway, -quarter + 0.05);
  turn("chest", 0, 0, 0, 0, 0.014, 0.10);
  // neck and head
  turn("neck_1", 0, 0.03, 0, 0, 0.045 * style.nod, 0.06);
  turn("neck_1", 1, 0, 0.025 * sway, -quarter);
  turn("neck_2", 0, 0.01, 0, 0, 0.022 * style.nod, 0.04);
  turn("neck_3", 0, 0, 0, 0, -0.012 * style.nod, 0.04);
  turn("head", 0, -0.02, 0, 0, -0.040 * style.nod, 0.04);
  turn("head", 1, 0, 0.020 * sway, -quarter);
  turn("ear_L", 0, 0, 0.06, 0.1);
  turn("ear_R", 0, 0, 0.06, 0.35);
  // tail, each part later than the one above
  const char* tail[4] = {"tail_1", "tail_2", "tail_3", "tail_4"};
  const double swing[4] = {0.05, 0.09, 0.12, 0.14};
  for (int i = 0; i < 4; ++i) {
    turn(tail[i], 2, 0, swing[i] * style.tail, -0.08 * i);
    turn(tail[i], 0, 0.02, 0, 0, 0.03 * style.tail, -0.05 * i);
  }
  // shoulder blades: the lower end forward at touch down, back at lift off
  for (bool left : {true, false}) {
    const double phase = (left ? 0 : 0.5) + quarter;
    turn(left ? "shoulder_L" : "shoulder_R", 0, 0, 0.13, 0.06 - phase - quarter);
  }
  return gait;
}

Gait idle(const Design& d, const QuadrupedStyle& style) {
  Gait gait;
  gait.name = "idle";
  gait.duration = 4.0;
  gait.duty = 1;
  gait.intervals = 64;
  for (bool front : {false, true}) {
    for (bool left : {true, false}) gait.legs.push_back(leg_of(d, style, front, left, false));
  }
  const auto turn = [&](const char* joint, int axis, double mean, double first, double first_at, double second = 0,
                        double second_at = 0) {
    gait.rotations.push_back({d.joint(joint), axis, mean, first, first_at, second, second_at});
  };
  // weight from side to side, breathing, a slow nod and a look around
  gait.translations.push_back({d.joint("hips"), 1, -0.012, 0, 0, 0.004, 0});
  gait.translations.push_back({d.joint("hips"), 0, 0, 0.016, 0, 0, 0});
  turn("hips", 2, 0, 0.014, 0);
  turn("spine_1", 2, 0, -0.008, 0);
  turn("chest", 0, 0, 0, 0, 0.006, 0.1);
  turn("neck_1", 0, 0.10 * style.nod, 0.10 * style.nod, -quarter);
  turn("neck_2", 0, 0.07 * style.nod, 0.07 * style.nod, -quarter - 0.03);
  turn("neck_3", 0, 0, 0.03 * style.nod, -quarter - 0.05);
  turn("head", 0, -0.03, -0.09 * style.nod, -quarter - 0.08);
  turn("neck_1", 1, 0, 0.05, 0.1);
  turn("neck_2", 1, 0, 0.08, 0.07);
  turn("head", 1, 0, 0.08, 0.04);
  turn("jaw", 0, 0.02, 0, 0, 0.02, 0);
  turn("ear_L", 1, 0, 0.25, 0, 0.12, 0.2);
  turn("ear_R", 1, 0, 0.12, 0.3, 0.22, 0);
  const char* tail[4] = {"tail_1", "tail_2", "tail_3", "tail_4"};
  for (int i = 0; i < 4; ++i) turn(tail[i], 2, 0, 0.03 * style.tail, -0.07 * i, 0.07 * style.tail, -0.05 * i);
  return gait;
}

}  // namespace

void add_quadruped_joints(Design& d, const QuadrupedJoints& at) {
  d.add_joint("root", "", {0, 0, 0});
  d.add_joint("hips", "root", at.hips);
  d.add_joint("spine_1", "hips", at.spine_1);
  d.add_joint("spine_2", "spine_1", at.spine_2);
  d.add_joint("chest", "spine_2", at.chest);
  d.add_joint("neck_1", "chest", at.neck_1);
  d.add_joint("neck_2", "neck_1", at.neck_2);
  d.add_joint("neck_3", "neck_2", at.neck_3);
  d.add_joint("head", "neck_3", at.head);
  d.add_joint("jaw", "head", at.jaw);
  d.add_pair("ear", "head", at.ear);
  d.add_joint("tail_1", "hips", at.tail_1);
  d.add_joint("tail_2", "tail_1", at.tail_2);
  d.add_joint("tail_3", "tail_2", at.tail_3);
  d.add_joint("tail_4", "tail_3", at.tail_4);
  d.add_pair("shoulder", "chest", at.shoulder);
  d.add_pair("front_upper_leg", "shoulder", at.front_upper_leg);
  d.add_pair("front_lower_leg", "front_upper_leg", at.front_lower_leg);
  d.add_pair("front_cannon", "front_lower_leg", at.front_cannon);
  d.add_pair("front_pastern", "front_cannon", at.front_pastern);
  d.add_pair("front_hoof", "front_pastern", at.front_hoof);
  d.add_pair("hind_upper_leg", "hips", at.hind_upper_leg);
  d.add_pair("hind_lower_leg", "hind_upper_leg", at.hind_lower_leg);
  d.add_pair("hind_cannon", "hind_lower_leg", at.hind_cannon);
  d.add_pair("hind_pastern", "hind_cannon", at.hind_pastern);
  d.add_pair("hind_hoof", "hind_pastern", at.hind_hoof);
}

void add_quadruped_charts(Design& d, const dvec3& left_ear_axis) {
  d.chart({"root", "hips", "spine_1", "spine_2", "chest", "shoulder_L", "shoulder_R"});
  d.chart({"neck_1", "neck_2", "neck_3"});
  d.chart({"head", "jaw"});
  d.chart({"tail_1", "tail_2", "tail_3", "tail_4"});
  d.chart_pair({"ear"}, left_ear_axis);
  d.chart_pair({"front_upper_leg", "front_lower_leg", "front_cannon", "front_pastern", "front_hoof"});
  d.chart_pair({"hind_upper_leg", "hind_lower_leg", "hind_cannon", "hind_pastern", "hind_hoof"});
}

void add_quadruped_clips(Design& design, const QuadrupedStyle& style) {
  design.clips.push_back(make_clip(design.joints, design.rest, walk(design, style)));
  design.clips.push_back(make_clip(design.joints, design.rest, idle(design, style)));
}

}  // namespace samples
