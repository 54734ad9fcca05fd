// Parts of the goals whose truth is known: the velocity of the ground, dragged toes, hands and trunks over the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poses.h"
#include "retarget/legs_bend.h"
#include "retarget/turns.h"
#include "rig_actor.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::retarget::Retarget;
using hf_inner::retarget::RetargetOptions;
using hf_inner::retarget::Turn;

constexpr double degree = 3.14159265358979323846 / 180;

hf_inner::retarget::Linear linear_at(const std::vector<double>& world, std::size_t j) {
  const double* p = &world[12 * j];
  return {{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}};
}

Vec3 place_at(const std::vector<double>& world, std::size_t j) {
  return {world[12 * j + 9], world[12 * j + 10], world[12 * j + 11]};
}

// Turns a joint in the world; what hangs on it follows.
void turn_joint(const RigActor& actor, std::vector<double>& pose, const std::string& name, Turn turn) {
  const std::size_t j = static_cast<std::size_t>(actor.rig().find(name));
  const auto world = world_of(actor.parents(), pose.data());
  const int p = actor.parents()[j];
  const Turn own = turn * hf_inner::retarget::turn_of(linear_at(world, j));
  const Turn q =
      p < 0 ? own : inverse(hf_inner::retarget::turn_of(linear_at(world, static_cast<std::size_t>(p)))) * own;
  const double numbers[] = {q.x, q.y, q.z, q.w};
  std::copy(numbers, numbers + 4, &pose[10 * j + 3]);
}

// The lowest vertex of the joints of some roles over the ground, in heights.
double lowest_of(const RigActor& actor, const std::vector<double>& pose, std::initializer_list<Role> roles) {
  const auto& input = actor.side().input;
  const auto rest = world_of(actor.parents(), rest_trs(input).data());
  const auto world = world_of(actor.parents(), pose.data());
  double low = 1e300;
  for (std::size_t v = 0; v < actor.rig().points.size(); ++v) {
    const std::size_t j = static_cast<std::size_t>(actor.rig().owners[v]);
    if (std::find(roles.begin(), roles.end(), actor.rig().joints[j].role) == roles.end()) continue;
    const Vec3 p = actor.rig().points[v];  // the rig stands as it was made
    const Vec3 now =
        linear_at(world, j) * hf_inner::retarget::solve(linear_at(rest, j), p - place_at(rest, j)) + place_at(world, j);
    low = std::min(low, now.y - actor.side().character.ground);
  }
  return low / actor.height();
}

std::vector<double> played(const RigActor& source, const RigActor& target, const std::vector<double>& pose,
                           bool goals) {
  Memory memory;
  RetargetOptions options;
  options.goals = goals;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> out(10 * target.parents().size());
  retarget.frame(pose.data(), 0, out.data());
  return out;
}

std::size_t joint_of(const RigActor& actor, Role role, bool last = false) {
  std::size_t found = 0;
  for (std::size_t j = 0; j < actor.parents().size(); ++j) {
    const RigJoint& joint = actor.rig().joints[j];
    if (joint.role != role || joint.side != Side::left || joint.helper || !joint.judged) continue;
    found = j;
    if (!last) break;
  }
  return found;
}

// The whole body slides: 20 steps with the ground, 8 steps otherwise. The most common velocity wins.
TEST(GroundVelocity, IsTheMostCommonVelocityOfTheSoles) {
  const RigActor actor("mixamo", {});
  const Vec3 often{0.3, 0, -1.4}, seldom{0, 0, 2.5};
  for (const double times : {0.0, 1.0}) {
    std::vector<double> poses;
    Vec3 place;
    for (int f = 0; f < 29; ++f) {
      std::vector<double> pose = rest_trs(actor.side().input);
      for (std::size_t j = 0; j < actor.parents().size(); ++j) {
        if (actor.parents()[j] >= 0) continue;
        pose[10 * j] += place.x;
        pose[10 * j + 2] += place.z;
      }
      poses.insert(poses.end(), pose.begin(), pose.end());
      place = place + (times / 30) * (f % 7 < 2 ? seldom : often);
    }
    double found[3] = {9, 9, 9};
    Memory memory;
    hf_inner::retarget::find_ground_velocity(actor.side(), poses.data(), 29, 1.0 / 30, found, memory);
    EXPECT_NEAR(found[0], times * often.x, 1e-9);
    EXPECT_NEAR(found[1], 0, 1e-9);
    EXPECT_NEAR(found[2], times * often.z, 1e-9);
  }
}

// A knee is bent as far as the toe, which points down, touches the ground. The toe of long legs would not touch.
TEST(Feet, ToesThatDragDoNotStretchALegThatLiftsThem) {
  const RigActor source("mixamo", {0.45, 1, 1, 3, Rest::t}), target("unreal", {1.5, 1, 1, 3, Rest::t});
  std::vector<double> pose;
  double bent = 95, low = 1;
  while (low > 0.001 && bent > 0) {
    bent -= 1;
    pose = rest_trs(source.side().input);
    turn_joint(source, pose, "mixamorig:RightUpLeg", hf_inner::retarget::turn_about({1, 0, 0}, -90 * degree));
    turn_joint(source, pose, "mixamorig:LeftLeg", hf_inner::retarget::turn_about({1, 0, 0}, bent * degree));
    low = lowest_of(source, pose, {Role::foot, Role::toe});
  }
  ASSERT_GT(bent, 40);
  Memory memory;
  Retarget retarget(source.side(), target.side(), {}, memory);
  std::vector<double> out(10 * target.parents().size());
  retarget.frame(pose.data(), 0, out.data());
  for (const auto& chain : retarget.report().chains) {
    if (chain.role == Role::leg) {
      EXPECT_LT(chain.worst_degrees, 1);
    }
  }
}

// Two toes touch the ground under legs that are folded to one side, since the feet are large. Small feet under legs
// that point alike hover. On the scaled path of the feet they stand.
TEST(Feet, ThatHoverStandOnTheScaledPath) {
  const RigActor source("mixamo", {0.45, 1, 1, 3, Rest::t}), target("unreal", {1.5, 1, 1, 3, Rest::t});
  std::vector<double> pose;
  double bent = 100, low = 1;
  while (low > 0.001 && bent > 0) {
    bent -= 1;
    pose = rest_trs(source.side().input);
    for (const char* leg : {"mixamorig:RightLeg", "mixamorig:LeftLeg"})
      turn_joint(source, pose, leg, hf_inner::retarget::turn_about({1, 0, 0}, bent * degree));
    low = lowest_of(source, pose, {Role::foot, Role::toe});
  }
  ASSERT_GT(bent, 40);
  const std::vector<double> first = pose;
  for (const bool path : {false, true}) {
    pose = first;
    Memory memory;
    RetargetOptions options;
    options.foot_path = path;
    Retarget retarget(source.side(), target.side(), options, memory);
    std::vector<double> out(10 * target.parents().size());
    // It slides along, so fast that no foot counts as standing.
    for (int f = 0; f < 8; ++f) {
      retarget.frame(pose.data(), f == 0 ? 0 : 1.0 / 30, out.data());
      pose[10 * static_cast<std::size_t>(source.rig().find("mixamorig:Hips")) + 2] += 0.2;
    }
    const double height = lowest_of(target, out, {Role::foot, Role::toe}) * target.height();
    if (path) {
      EXPECT_NEAR(height, 0, 0.01 * target.height());
      EXPECT_LT(retarget.report().hover, 0.02);
    } else {
      EXPECT_GT(height, 0.1 * target.height());
      EXPECT_NEAR(retarget.report().hover, height / target.side().character.leg_length, 0.03);
    }
  }
}

// The same pose, and one in which the knees are bent less and the body is higher: the toes stay where they are. On the
// scaled path the toes of the other body stay too.
TEST(Feet, OnTheScaledPathStayWhereTheyStand) {
  const RigActor source("mixamo", {0.45, 1, 1, 3, Rest::t}), target("unreal", {1.5, 1, 1, 3, Rest::t});
  const std::size_t hips = static_cast<std::size_t>(source.rig().find("mixamorig:Hips"));
  const auto toe = [](const RigActor& actor, const std::vector<double>& pose) {
    return place_at(world_of(actor.parents(), pose.data()), joint_of(actor, Role::toe));
  };
  Memory memory;
  RetargetOptions options;
  options.foot_path = true;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<Vec3> by, own;
  for (int f = 0; f < 8; ++f) {
    std::vector<double> pose = rest_trs(source.side().input);
    for (const char* leg : {"mixamorig:RightLeg", "mixamorig:LeftLeg"})
      turn_joint(source, pose, leg, hf_inner::retarget::turn_about({1, 0, 0}, (70 - 3 * f) * degree));
    pose[10 * hips + 1] -= lowest_of(source, pose, {Role::foot, Role::toe}) * source.height();
    if (f > 0) pose[10 * hips + 2] += by[0].z - toe(source, pose).z;
    std::vector<double> out(10 * target.parents().size());
    retarget.frame(pose.data(), f == 0 ? 0 : 1.0 / 30, out.data());
    by.push_back(toe(source, pose));
    own.push_back(toe(target, out));
  }
  EXPECT_LT(std::fabs(by.back().z - by[0].z), 1e-6);
  EXPECT_LT(std::fabs(own.back().z - own[0].z), 0.03 * target.height());
}

// The whole source is put into the ground, straight legs and all. A little of it is an error: soles stay on the ground.
// Legs do not fold to keep away from more.
TEST(Feet, SolesSinkAsDeepAsTheSourceIsPutAndDipsAreHeld) {
  const RigActor source("mixamo", {}), target("unreal", {0.8, 1, 1, 3, Rest::t});
  for (const double depth : {0.01, 0.1}) {
    std::vector<double> pose = rest_trs(source.side().input);
    for (std::size_t j = 0; j < source.parents().size(); ++j) {
      if (source.parents()[j] < 0) pose[10 * j + 1] -= depth * source.height();
    }
    Memory memory;
    Retarget retarget(source.side(), target.side(), {}, memory);
    std::vector<double> out(10 * target.parents().size());
    retarget.frame(pose.data(), 0, out.data());
    const double low = lowest_of(target, out, {Role::foot, Role::toe}) * target.height();
    if (depth < 0.05) {
      EXPECT_NEAR(low, 0, 1e-3 * target.height());
      continue;
    }
    EXPECT_NEAR(low, -retarget.report().scale * depth * source.height(), 1e-3 * target.height());
    for (const auto& chain : retarget.report().chains) {
      if (chain.role == Role::leg) {
        EXPECT_LT(chain.worst_degrees, 1);
      }
    }
  }
}

// Hips sink until the foot of a leg folded to the front would need the place of the hip: the thigh does not turn over.
TEST(Feet, ALegDoesNotFoldIntoItsHip) {
  const RigActor source("mixamo", {}), target("unreal", {0.45, 1, 1, 3, Rest::t});
  std::vector<double> pose = rest_trs(source.side().input);
  const auto world = world_of(source.parents(), pose.data());
  const double hip = place_at(world, static_cast<std::size_t>(source.rig().find("mixamorig:LeftUpLeg"))).y;
  for (const char* side : {"mixamorig:Left", "mixamorig:Right"}) {
    turn_joint(source, pose, std::string(side) + "UpLeg", hf_inner::retarget::turn_about({1, 0, 0}, -75 * degree));
    turn_joint(source, pose, std::string(side) + "Leg", hf_inner::retarget::turn_about({1, 0, 0}, 150 * degree));
  }
  pose[10 * static_cast<std::size_t>(source.rig().find("mixamorig:Hips")) + 1] -= 0.93 * hip;
  Memory memory;
  Retarget retarget(source.side(), target.side(), {}, memory);
  std::vector<double> out(10 * target.parents().size());
  retarget.frame(pose.data(), 0, out.data());
  for (const auto& chain : retarget.report().chains) {
    if (chain.role == Role::leg) {
      EXPECT_LT(chain.worst_degrees, 60);
    }
  }
}

// The hips sink with knees that bend backward, so that feet would be in the ground: the knees go forward.
TEST(Feet, AKneeThatBendsBackwardComesForward) {
  const RigActor source("mixamo", {}), target("mixamo", {0.7, 1, 1, 3, Rest::t});
  std::vector<double> pose = rest_trs(source.side().input);
  pose[10 * static_cast<std::size_t>(source.rig().find("mixamorig:Hips")) + 1] -= 0.15;
  for (const char* side : {"Left", "Right"}) {
    turn_joint(source, pose, std::string("mixamorig:") + side + "UpLeg",
               hf_inner::retarget::turn_about({1, 0, 0}, 10 * degree));
    turn_joint(source, pose, std::string("mixamorig:") + side + "Leg",
               hf_inner::retarget::turn_about({1, 0, 0}, -20 * degree));
  }
  const auto world = world_of(target.parents(), played(source, target, pose, true).data());
  const Vec3 hip = place_at(world, joint_of(target, Role::leg)),
             knee = place_at(world, joint_of(target, Role::leg, true)),
             ankle = place_at(world, joint_of(target, Role::foot));
  EXPECT_GT(knee.z - 0.5 * (hip.z + ankle.z), 0);
}

// A shin twice as long as its thigh is folded up, so that the ankle is over the hip: a small way of the ankle is a
// small way of the knee.
TEST(Feet, ALongShinFoldsAndItsKneeStays) {
  hf_inner::Memory memory;
  const hf_inner::Vec3 hip{0, 1.38, -0.06}, knee{0, 1.05, 0.28}, ankle{0, 1.24, -0.69}, step{0.01, 0, -0.02};
  hf_inner::Vector<hf_inner::Vec3> places(&memory);
  for (const hf_inner::Vec3& place : {hip, knee, ankle}) places.push_back(place);
  const hf_inner::Vec3 front = hf_inner::unit_vector(hf_inner::cross(hf_inner::Vec3{1, 0, 0}, hip - knee));
  for (const double side : {1.0, -1.0}) {  // a knee of people, and the same picture turned to the other side
    for (hf_inner::Vec3& place : places) place.z *= side;
    hf_inner::Vector<Turn> bends(2, Turn{}, &memory);
    hf_inner::retarget::bend_leg(places, {}, places[2] + hf_inner::Vec3{step.x, step.y, side * step.z},
                                 {front.x, front.y, side * front.z}, bends);
    const hf_inner::Vec3 bent = places[0] + bends[0] * (places[1] - places[0]),
                         end = bent + bends[1] * (places[2] - places[1]);
    EXPECT_LT(norm(bent - places[1]), 3 * norm(step));
    EXPECT_LT(norm(end - places[2] - hf_inner::Vec3{step.x, step.y, side * step.z}), 1e-9);
    for (hf_inner::Vec3& place : places) place.z *= side;
  }
}

TEST(Feet, ToesTurnAsThoseOfTheSource) {
  const RigActor source("mixamo", {}), target("unreal", {1.2, 1, 1, 3, Rest::t});
  const std::size_t from = joint_of(source, Role::toe), to = joint_of(target, Role::toe);
  const Turn bent = hf_inner::retarget::turn_about({1, 0, 0}, -30 * degree);
  std::vector<double> pose = rest_trs(source.side().input);
  turn_joint(source, pose, source.rig().joints[from].name, bent);
  const auto turn = [&](const std::vector<double>& trs) {
    return hf_inner::retarget::turn_of(linear_at(world_of(target.parents(), trs.data()), to));
  };
  const Turn since = turn(played(source, target, pose, false)) * inverse(turn(rest_trs(target.side().input)));
  EXPECT_GT(std::fabs(dot(since, bent)), 1 - 1e-9);
}

// A body lies on its belly. The other body has shorter legs, so that its hips would sink.
TEST(Ground, ATrunkThatLiesStaysOverTheGround) {
  const RigActor source("mixamo", {}), target("unreal", {0.45, 1, 1, 3, Rest::t});
  std::vector<double> pose = rest_trs(source.side().input);
  turn_joint(source, pose, "mixamorig:Hips", hf_inner::retarget::turn_about({1, 0, 0}, 90 * degree));
  const double height = lowest_of(source, pose, {Role::spine}) * source.height();
  pose[10 * static_cast<std::size_t>(source.rig().find("mixamorig:Hips")) + 1] -= height;
  ASSERT_NEAR(lowest_of(source, pose, {Role::spine}), 0, 1e-6);
  EXPECT_LT(lowest_of(target, played(source, target, pose, false), {Role::spine}), -0.02);
  EXPECT_GT(lowest_of(target, played(source, target, pose, true), {Role::spine}), -1e-6);
}

// The body bows until its hands nearly reach the ground. Longer arms would sink.
TEST(Ground, HandsOfLongerArmsStayOverTheGround) {
  const RigActor source("mixamo", {}), target("unreal", {1, 1.8, 1, 3, Rest::t});
  std::vector<double> pose = rest_trs(source.side().input);
  turn_joint(source, pose, "mixamorig:Hips", hf_inner::retarget::turn_about({1, 0, 0}, 90 * degree));
  turn_joint(source, pose, "mixamorig:LeftArm", hf_inner::retarget::turn_about({0, 0, 1}, -85 * degree));
  turn_joint(source, pose, "mixamorig:RightArm", hf_inner::retarget::turn_about({0, 0, 1}, 85 * degree));
  const double height = lowest_of(source, pose, {Role::hand, Role::finger}) * source.height();
  pose[10 * static_cast<std::size_t>(source.rig().find("mixamorig:Hips")) + 1] -= height;
  EXPECT_LT(lowest_of(target, played(source, target, pose, false), {Role::hand, Role::finger}), -0.05);
  EXPECT_GT(lowest_of(target, played(source, target, pose, true), {Role::hand, Role::finger}), -2e-3);
}

// Beasts of each kind, on themselves in another unit and facing.
TEST(Beasts, RestInIsRestOut) {
  for (const std::string& kind : beasts) {
    const Rig named = make_beast(kind, true);
    const PlacedRig small(named, {}), large(named, {100, 217, true, false, {5, -3, 8}});
    const hf_inner::skeleton::CharacterInput a = small.input(), b = large.input();
    Memory memory;
    const hf_inner::skeleton::Character ca = know_character(a, memory), cb = know_character(b, memory);
    RetargetOptions options;
    options.copy_same = false;
    Retarget retarget({a, ca, nullptr}, {b, cb, nullptr}, options, memory);
    const auto from = rest_trs(a), to = rest_trs(b);
    std::vector<double> out(to.size());
    retarget.frame(from.data(), 0, out.data());
    const auto is = world_of(large.parents, out.data()), should = world_of(large.parents, to.data());
    for (std::size_t j = 0; j < large.parents.size(); ++j)
      EXPECT_LT(norm(place_at(is, j) - place_at(should, j)), 1e-6 * cb.height) << kind << " " << named.joints[j].name;
  }
}

// In 3ds Max's Biped thighs may hang on the spine, above the pelvis.
TEST(Root, APelvisBelowTheHipsTravelsWithThem) {
  const RigActor source("mixamo", {});
  Rig rig = make_biped("biped", {});
  const int pelvis = rig.find("Bip01 Pelvis"), spine = rig.find("Bip01 Spine1");
  for (const char* name : {"Bip01 L Thigh", "Bip01 R Thigh"})
    rig.joints[static_cast<std::size_t>(rig.find(name))].parent = spine;
  const PlacedRig placed(rig, {});
  Memory memory;
  const auto input = placed.input();
  const auto character = hf_inner::skeleton::know_character(input, memory);
  Retarget retarget(source.side(), {input, character, nullptr}, {}, memory);
  std::vector<double> pose = source.act(0).trs, out(10 * rig.joints.size());
  pose[static_cast<std::size_t>(10 * source.rig().find("mixamorig:Hips") + 2)] += 3;  // three metres on
  retarget.frame(pose.data(), 0, out.data());
  const auto world = world_of(placed.parents, out.data());
  const double was =
      norm(rig.joints[static_cast<std::size_t>(spine)].pivot - rig.joints[static_cast<std::size_t>(pelvis)].pivot);
  EXPECT_NEAR(
      norm(place_at(world, static_cast<std::size_t>(spine)) - place_at(world, static_cast<std::size_t>(pelvis))), was,
      1e-6);
  EXPECT_GT(place_at(world, static_cast<std::size_t>(pelvis)).z, 2.5);
}

// A source without a skin rests in a stride. When it stands, the soles of both feet are on the ground.
TEST(Goals, AStrideWithoutASkinStandsOnBothFeet) {
  const RigActor target("unity", {});
  Rig rig = make_biped("mixamo", {});
  rig.turn(rig.find("mixamorig:RightUpLeg"), {1, 0, 0}, -40);
  rig.turn(rig.find("mixamorig:RightLeg"), {1, 0, 0}, 70);
  const PlacedRig placed(rig, {});
  auto input = placed.input();
  input.vertex_count = input.triangle_count = 0;
  input.influence_starts = nullptr;
  input.vertex_joints = nullptr;
  Memory memory;
  const auto character = hf_inner::skeleton::know_character(input, memory);
  Retarget retarget({input, character, nullptr}, target.side(), {}, memory);
  std::vector<double> pose = rest_trs(input);
  const auto rest = world_of(placed.parents, pose.data());
  const auto turn_of = [&](const char* name) {
    return hf_inner::retarget::turn_of(linear_at(rest, static_cast<std::size_t>(rig.find(name))));
  };
  const auto about_x = [](double degrees) { return hf_inner::retarget::turn_about({1, 0, 0}, degree * degrees); };
  const Turn hips = turn_of("mixamorig:Hips"), thigh = about_x(40) * turn_of("mixamorig:RightUpLeg"),
             shin = about_x(-30) * turn_of("mixamorig:RightLeg"), foot = about_x(-30) * turn_of("mixamorig:RightFoot");
  for (const auto& [name, q] : {std::pair{"mixamorig:RightUpLeg", inverse(hips) * thigh},
                                {"mixamorig:RightLeg", inverse(thigh) * shin},
                                {"mixamorig:RightFoot", inverse(shin) * foot}}) {
    const double numbers[] = {q.x, q.y, q.z, q.w};
    std::copy(numbers, numbers + 4, &pose[static_cast<std::size_t>(10 * rig.find(name)) + 3]);
  }
  std::vector<double> out(10 * target.rig().joints.size());
  for (int f = 0; f < 20; ++f) retarget.frame(pose.data(), f == 0 ? 0 : 1.0 / 30, out.data());
  const double sole = target.sole_height(world_of(target.parents(), out.data())) / target.height();
  EXPECT_NEAR(sole, 0, 0.003);
  const auto world = world_of(target.parents(), out.data());
  const double left = place_at(world, static_cast<std::size_t>(target.rig().find("LeftFoot"))).y,
               right = place_at(world, static_cast<std::size_t>(target.rig().find("RightFoot"))).y;
  EXPECT_NEAR(left, right, 0.02);  // the sole was tilted at rest
}

}  // namespace
}  // namespace hf_test
