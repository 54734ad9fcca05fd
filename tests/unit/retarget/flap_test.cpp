// Wings and fins lead arms where the source has none; arms lead no wings.
#include <gtest/gtest.h>

#include <cmath>

#include "../skeleton/rig_family.h"
#include "base/memory.h"
#include "poses.h"
#include "retarget/retarget.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::retarget::Retarget;

// A rig as it stands, and its character.
struct Flyer {
  explicit Flyer(Rig given)
      : rig(std::move(given)), placed(rig, {}), input(placed.input()), character(know_character(input, memory)) {}
  hf_inner::retarget::RetargetSide side() const { return {input, character, nullptr}; }
  // From a joint to the next one of its limb, in a pose.
  Vec3 way(const char* from, const char* to, const std::vector<double>& pose) const {
    const auto world = world_of(placed.parents, pose.data());
    const auto place = [&](const char* name) {
      const double* p = &world[12 * static_cast<std::size_t>(rig.find(name)) + 9];
      return Vec3{p[0], p[1], p[2]};
    };
    const Vec3 out = place(to) - place(from);
    return (1 / norm(out)) * out;
  }
  Rig rig;
  Memory memory;
  PlacedRig placed;
  hf_inner::skeleton::CharacterInput input;
  hf_inner::skeleton::Character character;
};

// Turns a joint about an axis of its parent.
void lift(const Flyer& body, const std::string& joint, double degrees, std::vector<double>& pose) {
  const double half = degrees * 3.14159265358979323846 / 360, c = std::cos(half), s = std::sin(half);
  double* q = &pose[10 * static_cast<std::size_t>(body.rig.find(joint)) + 3];
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  q[0] = c * x - s * y;
  q[1] = c * y + s * x;
  q[2] = c * z + s * w;
  q[3] = c * w - s * z;
}

TEST(Flap, ArmsFollowWingsOfABodyWithoutArms) {
  const Flyer bird(make_beast("bird", true)), man(make_biped("words", {}));
  Memory memory;
  Retarget retarget(bird.side(), man.side(), {}, memory);
  std::vector<double> pose = rest_trs(bird.input), out(10 * man.placed.parents.size());
  lift(bird, "Wing1.L", 30, pose);
  lift(bird, "Wing1.R", -30, pose);
  retarget.frame(pose.data(), 0, out.data());
  const auto arm = [&](Side side, Role role) {
    for (const RigJoint& joint : man.rig.joints)
      if (joint.role == role && joint.side == side) return joint.name;
    return std::string();
  };
  for (const Side side : {Side::left, Side::right}) {
    const std::string word = side == Side::left ? ".L" : ".R";
    const Vec3 wing = bird.way(("Wing1" + word).c_str(), ("Wing3" + word).c_str(), pose),
               limb = man.way(arm(side, Role::arm).c_str(), arm(side, Role::hand).c_str(), out);
    EXPECT_GT(dot(wing, limb), 1 - 1e-9) << word << " " << limb.x << " " << limb.y << " " << limb.z;
  }
}

// A fin that is bent backward at rest beside a straight one: arms with bent elbows keep their twist on both sides.
TEST(Flap, TheBendOfAWingTwistsNoArm) {
  Rig bent = make_beast("bird", true);
  for (const std::string side : {".L", ".R"}) {  // two bones that end in a joint, straight but for the right tip
    for (const char* name : {"Wing1", "Wing2", "Wing3"})
      bent.joints[static_cast<std::size_t>(bent.find(name + side))].pivot.z = 0.1;
    for (int& owner : bent.owners) owner = owner == bent.find("Wing3" + side) ? bent.find("Wing2" + side) : owner;
  }
  bent.joints[static_cast<std::size_t>(bent.find("Wing3.R"))].pivot.z += 0.25;
  Rig arms = make_biped("words", {});
  arms.turn(arms.find("left_elbow"), {0, 0, 1}, 40);
  arms.turn(arms.find("right_elbow"), {0, 0, 1}, -40);
  const Flyer bird(bent), man(arms);
  Memory memory;
  Retarget retarget(bird.side(), man.side(), {}, memory);
  const std::vector<double> pose = rest_trs(bird.input), rest = rest_trs(man.input);
  std::vector<double> out(10 * man.placed.parents.size());
  retarget.frame(pose.data(), 0, out.data());
  const auto before = world_of(man.placed.parents, rest.data()), after = world_of(man.placed.parents, out.data());
  const auto turn_of = [&](const char* name, std::size_t i, std::size_t j) {  // of the joint since its rest
    const std::size_t at = 12 * static_cast<std::size_t>(man.rig.find(name));
    double sum = 0;
    for (std::size_t k = 0; k < 9; k += 3) sum += after[at + i + k] * before[at + j + k];
    return sum;
  };
  double trace = 0;  // of the left turn after the mirrored right one back: 1 + 2 cos of the angle between them
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      trace += turn_of("left_arm", i, j) * turn_of("right_arm", i, j) * ((i == 0) != (j == 0) ? -1 : 1);
  }
  EXPECT_GT((trace - 1) / 2, 0.9);
}

TEST(Flap, WingsDoNotHangAsArms) {
  const Flyer bird(make_beast("bird", true)), man(make_biped("words", {}));
  Memory memory;
  Retarget retarget(man.side(), bird.side(), {}, memory);
  std::vector<double> pose = rest_trs(man.input), out(10 * bird.placed.parents.size());
  for (const RigJoint& joint : man.rig.joints)
    if (joint.role == Role::arm && joint.name.find("_arm") != std::string::npos)
      lift(man, joint.name, joint.side == Side::left ? -70 : 70, pose);
  retarget.frame(pose.data(), 0, out.data());
  const std::vector<double> rest = rest_trs(bird.input);
  for (const char* name : {"Wing1.L", "Wing2.L", "Wing1.R", "Wing2.R"})
    for (std::size_t c = 3; c < 7; ++c)
      EXPECT_NEAR(out[10 * static_cast<std::size_t>(bird.rig.find(name)) + c],
                  rest[10 * static_cast<std::size_t>(bird.rig.find(name)) + c], 1e-9)
          << name;
}

}  // namespace
}  // namespace hf_test
