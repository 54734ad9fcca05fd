// Rigs whose limbs begin in other places than those of people, and files of clips whose surface is missing or a part.
#include <gtest/gtest.h>

#include "rig_family.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::skeleton::Character;
using hf_inner::skeleton::CharacterInput;
using hf_inner::skeleton::know_character;

std::string why(const Character& c) { return {c.why.begin(), c.why.end()}; }

// Puts a bone between the hips and a thigh, from a place beside the middle.
void add_hip_bone(Rig& rig, const char* thigh, Side side, double x) {
  const int leg = rig.find(thigh);
  const RigJoint by = rig.joints[static_cast<std::size_t>(leg)];
  const double s = side == Side::left ? 1 : -1;
  const int bone = rig.add("Bone." + std::to_string(side == Side::left ? 1 : 2), by.parent,
                           {s * x, by.pivot.y, by.pivot.z - 0.05}, Role::shoulder, side);
  rig.joints[static_cast<std::size_t>(leg)].parent = bone;
  rig.add_box(bone, rig.joints[static_cast<std::size_t>(bone)].pivot, by.pivot, 0.05);
}

// Dinosaurs have such bones. The limb below them has the name of the thigh, shin and foot.
TEST(Limbs, ALevelBoneOfTheHipsIsNoThigh) {
  Rig rig = make_biped("mixamo", {});
  add_hip_bone(rig, "mixamorig:LeftUpLeg", Side::left, 0.02);
  add_hip_bone(rig, "mixamorig:RightUpLeg", Side::right, 0.02);
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
  EXPECT_NEAR(found.leg_length, 0.95, 0.02);
}

// On a chair thighs lie level too, but they begin at the side of the body.
TEST(Limbs, ALevelThighIsAThigh) {
  Rig rig = make_biped("mixamo", {});
  for (const char* name : {"mixamorig:LeftUpLeg", "mixamorig:RightUpLeg"}) rig.turn(rig.find(name), {1, 0, 0}, -85);
  for (const char* name : {"mixamorig:LeftLeg", "mixamorig:RightLeg"}) rig.turn(rig.find(name), {1, 0, 0}, 85);
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// A stout body has flippers or floating hands.
TEST(Arms, AHandOnTheTrunkIsTheWholeArm) {
  Rig rig = make_biped("dots", {});
  for (RigJoint& joint : rig.joints) {
    if (joint.role != Role::arm && joint.role != Role::hand && joint.role != Role::finger) continue;
    joint.role = Role::other;
    joint.judged = false;
    joint.helper = true;
    joint.name = "";
  }
  for (std::size_t v = 0; v < rig.points.size(); ++v) {
    RigJoint& owner = rig.joints[static_cast<std::size_t>(rig.owners[v])];
    if (owner.role == Role::other && !owner.judged)
      rig.owners[v] = rig.find("shoulder." + std::string(owner.side == Side::left ? "l" : "r"));
  }
  for (const char* side : {"l", "r"}) {
    RigJoint& hand = rig.joints[static_cast<std::size_t>(rig.find(std::string("shoulder.") + side))];
    hand.name = std::string("hand.") + side;
    hand.role = Role::arm;
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  for (const char* side : {"l", "r"})
    EXPECT_EQ(found.roles[static_cast<std::size_t>(rig.find(std::string("hand.") + side))], Role::arm) << why(found);
}

CharacterInput bare(CharacterInput input) {
  input.vertex_count = input.triangle_count = 0;
  input.influence_starts = nullptr;
  input.vertex_joints = nullptr;
  return input;
}

// A file of clips rests in the first pose of a walk, beside cameras.
TEST(Lengths, OfABareSkeletonAreThoseOfTheStandingLeg) {
  Rig rig = make_biped("mixamo", {});
  rig.turn(rig.find("mixamorig:RightUpLeg"), {1, 0, 0}, 25);
  rig.turn(rig.find("mixamorig:RightLeg"), {1, 0, 0}, 80);
  rig.turn(rig.find("mixamorig:Hips"), {0, 1, 0}, 12);
  rig.add_helper("Camera01", -1, {-4, 1, 8});
  rig.add_helper("Camera01.Target", -1, {0, 9, 3});
  rig.add_helper("Sky01", -1, {1, 13, 6});
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(bare(placed.input()), memory);
  EXPECT_EQ(placed.faults(found, false), "") << why(found);
  EXPECT_GT(found.forward.z, 0.999);
  EXPECT_NEAR(found.leg_length, 0.95, 0.05);
  EXPECT_LT(found.height, 2);
}

// A file of clips that shows the head alone: the joints are those of a whole body.
TEST(Limbs, AreThoseOfTheJointsWhereTheSurfaceIsAHead) {
  const Rig whole = make_biped("unity", {});
  Rig rig = whole;
  rig.points.clear();
  rig.owners.clear();
  rig.triangles.clear();
  std::vector<std::uint8_t> bound(rig.joints.size(), 0);
  for (const char* name : {"Spine3", "Neck", "Head"}) bound[static_cast<std::size_t>(rig.find(name))] = 1;
  rig.add_block(rig.find("Head"), {-0.1, 1.55, -0.1}, {0.1, 1.8, 0.12});
  rig.add_block(rig.find("Neck"), {-0.05, 1.45, -0.05}, {0.05, 1.55, 0.05});
  rig.add_block(rig.find("Spine3"), {-0.1, 1.4, -0.05}, {0.1, 1.45, 0.05});
  Memory memory;
  const PlacedRig placed(rig, {});
  CharacterInput input = placed.input();
  input.bound = bound.data();
  const Character found = know_character(input, memory);
  EXPECT_TRUE(found.partial);
  EXPECT_EQ(placed.faults(found), "") << why(found);
  const PlacedRig clothed(whole, {});
  EXPECT_FALSE(know_character(clothed.input(), memory).partial);
}

}  // namespace
}  // namespace hf_test
