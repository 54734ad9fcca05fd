// Bodies whose file pose is no stance: the middle of a stride, limbs stretched flat. And rigs of blocks.
#include "gltf/stance.h"

#include <gtest/gtest.h>

#include "gltf/clip_binding.h"
#include "gltf/pose_numbers.h"
#include "gltf/skeleton_body.h"
#include "gltf/skeleton_pair.h"
#include "rig_blocks.h"
#include "rig_model.h"

namespace hf_test {
namespace {

using hf_gltf::find_stance;
using hf_gltf::flatten;
using hf_gltf::global_matrices;
using hf_gltf::Model;
using hf_gltf::Pose;
using hf_gltf::rest_pose;

constexpr double degree = 3.14159265358979323846 / 180;

hf_inner::skeleton::Character known_in(const PlacedRig& placed) {
  static hf_inner::Memory memory;
  auto input = placed.input();
  static const double up[] = {0, 1, 0};
  input.up = up;
  return know_character(input, memory);
}

TEST(BlockRig, CollarsStartInTheMiddleAndLegsHangWhereTheyBegin) {
  for (const double yaw : {0.0, 90.0, 200.0}) {
    const Rig rig = make_block_rig(false);
    const PlacedRig placed(rig, Placing{1, yaw, false, false, {}});
    const hf_inner::skeleton::Character found = known_in(placed);
    EXPECT_EQ(placed.faults(found), "") << yaw;
    EXPECT_GE(found.role_confidence, 0.5);
    EXPECT_GE(found.forward_confidence, 0.5);
    EXPECT_NEAR(found.leg_length, 1, 0.03);  // from the hip to the middle of the sole, not to the toes
  }
}

TEST(BlockRig, ALegHangsAsItsMateWhereABoneAboveOwnsNothing) {
  const Rig rig = make_block_rig(true);
  const PlacedRig placed(rig, {});
  EXPECT_EQ(placed.faults(known_in(placed)), "");
}

TEST(BlockRig, TwoJointsBehindACollarAreAnArmWithoutAHand) {
  const Rig rig = make_block_rig(false, false);
  const PlacedRig placed(rig, {});
  const hf_inner::skeleton::Character found = known_in(placed);
  EXPECT_EQ(placed.faults(found), "");
  for (std::size_t j = 0; j < found.roles.size(); ++j) EXPECT_NE(found.roles[j], Role::hand) << rig.joints[j].name;
}

// Eight legs of three bones that lie level, or stand, and two fangs below. Names say the sides alone. lifted: the pair
// that is in the air.
Rig make_spider(bool stands, int lifted) {
  Rig rig;
  const double high = stands ? 0.4 : 0.05;
  const int body = rig.add("Bone.000", -1, {0, high, 0}, Role::spine);
  rig.add_block(body, {-0.15, high - 0.04, -0.3}, {0.15, high + 0.2, 0.3});
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const std::string end = s > 0 ? ".L" : ".R";
    const int fang = rig.add("Bone.501" + end, body, {s * 0.05, high, 0.3}, Role::other, side);
    rig.joints.back().judged = false;
    rig.add_box(fang, {s * 0.05, high, 0.3}, {s * 0.05, high - 0.1, 0.32}, 0.02);
    for (int leg = 0; leg < 4; ++leg) {
      const double z = 0.24 - 0.16 * leg, up = leg == lifted ? 0.3 : 0;
      const Vec3 p[] = {{s * 0.15, high, z},
                        {s * 0.5, stands ? 0.7 : high, 2 * z},
                        {s * 0.9, stands ? 0.35 + up : high, 3 * z},
                        {s * 1.1, stands ? up : high, 3.5 * z}};
      int parent = body;
      for (int k = 0; k < 3; ++k) {
        const std::string name = "Bone." + std::to_string(100 * leg + 101 + k) + end;
        parent = rig.add(name, parent, p[k], Role::leg, side);
        rig.joints.back().judged = stands && k < 2;  // the last may be a foot
        rig.add_box(parent, p[k], p[k + 1], 0.02);
      }
    }
  }
  return rig;
}

TEST(Spider, IsUnderstoodWhereItStandsAndNotWhereItLiesFlat) {
  for (const int lifted : {-1, 1, 2}) {
    const Rig standing = make_spider(true, lifted);
    const PlacedRig placed(standing, {});
    const hf_inner::skeleton::Character found = known_in(placed);
    EXPECT_EQ(placed.faults(found), "") << lifted;
    EXPECT_GE(found.role_confidence, 0.5) << lifted;
  }
  const Rig flat = make_spider(false, -1);
  EXPECT_LT(known_in(PlacedRig(flat, {})).role_confidence, 0.5);
}

// Turns a node about an axis of the world.
void turn_node(Model& model, const std::string& name, const glm::dvec3& axis, double degrees) {
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  const int n = hf_gltf::find_node(model, name);
  auto& node = model.nodes[static_cast<size_t>(n)];
  const glm::dmat3 world(globals[static_cast<size_t>(n)]);
  const glm::dvec3 own = glm::normalize(glm::inverse(world) * axis);
  node.matrix = *node.matrix * glm::dmat4(glm::mat4_cast(glm::angleAxis(degrees * degree, own)));
}

std::string bone(int number) { return "Bone." + std::to_string(number); }

// Left arm 1 to 4, right arm 5 to 8, head 9, left leg 10 to 12, right leg 13 to 15.
void stride(Model& model, double share = 1) {
  turn_node(model, bone(0), {1, 0, 0}, share * 25);
  turn_node(model, bone(2), {1, 0, 0}, share * 50);
  turn_node(model, bone(6), {1, 0, 0}, share * -60);
  turn_node(model, bone(10), {1, 0, 0}, share * -50);
  turn_node(model, bone(13), {1, 0, 0}, share * 40);
  turn_node(model, bone(14), {1, 0, 0}, share * 60);
}

double apart(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double most = 0;
  for (size_t v = 0; v < a.size(); ++v) most = std::max(most, glm::distance(a[v], b[v]));
  return most;
}

TEST(Stance, ABodyStoredInMidStrideStandsAsItsSkinWasBound) {
  for (const double yaw : {0.0, 90.0}) {
    const Rig rig = make_block_rig(false);
    const Model even = make_rig_model(PlacedRig(rig, Placing{1, yaw, false, false, {}}), "body.glb");
    EXPECT_FALSE(find_stance(even, flatten(even), nullptr)) << "an even body stands as it is";
    Model model = even;
    const glm::dmat4 turned(glm::mat4_cast(glm::angleAxis(yaw * degree, glm::dvec3(0, 1, 0))));
    const auto across = [&](double x) { return glm::dvec3(turned * glm::dvec4(x, 0, 0, 0)); };
    for (const auto& [joint, angle] : {std::pair{0, 25.0}, {2, 50.0}, {6, -60.0}, {10, -50.0}, {13, 40.0}, {14, 60.0}})
      turn_node(model, bone(joint), across(1), angle);
    const auto found = find_stance(model, flatten(model), nullptr);
    ASSERT_TRUE(found) << yaw;
    EXPECT_EQ(found->from, "as bound");
    EXPECT_LT(apart(hf_gltf::posed_positions(model, flatten(model), found->pose), flatten(even).positions), 1e-4);
  }
}

double lowest(const std::vector<glm::dvec3>& positions) {
  double low = positions[0].y;
  for (const glm::dvec3& p : positions) low = std::min(low, p.y);
  return low;
}

// A file from a program that stood at a frame of a clip: knees are bent, one more than the other. Its limbs would all
// be counted from there.
TEST(Stance, ABodyStoredInAFrameOfAnIdleClipStandsAsBoundOnTheGroundOfTheFile) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "body.glb");
  Model model = even;
  for (const auto& [joint, angle] :
       {std::pair{2, 50.0}, {10, -40.0}, {11, 60.0}, {12, -20.0}, {13, -20.0}, {14, 50.0}, {15, -30.0}})
    turn_node(model, bone(joint), {1, 0, 0}, angle);
  const hf_gltf::FlatMesh stored = flatten(model);
  const hf_gltf::Axes given;  // with them the body is understood
  const auto found = find_stance(model, stored, &given);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->from, "as bound");
  EXPECT_FALSE(found->needed);
  std::vector<glm::dvec3> stands = hf_gltf::posed_positions(model, stored, found->pose);
  EXPECT_NEAR(lowest(stands), lowest(stored.positions), 1e-6);
  EXPECT_GT(lowest(stored.positions), lowest(flatten(even).positions) + 0.03);  // knees bend, hips stay
  const double raised = lowest(stands) - lowest(flatten(even).positions);
  for (glm::dvec3& p : stands) p.y -= raised;
  EXPECT_LT(apart(stands, flatten(even).positions), 1e-4);
}

// Binds the skin in the pose of the nodes.
void bind(Model& model) {
  const std::vector<glm::dvec3> placed = flatten(model).positions;
  auto& stored = model.meshes[0].primitives[0].positions;
  for (size_t v = 0; v < placed.size(); ++v) stored[v] = glm::vec3(placed[v]);
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  for (size_t k = 0; k < model.skins[0].joints.size(); ++k)
    model.skins[0].inverse_bind[k] = glm::mat4(glm::inverse(globals[static_cast<size_t>(model.skins[0].joints[k])]));
  for (auto& node : model.nodes)
    if (node.matrix) hf_gltf::split_matrix(node);
  EXPECT_LT(apart(flatten(model).positions, placed), 1e-4);
}

// In the stride, and bound in it: only a clip can say how the body stands.
Model bound_in_stride(const Model& even, double share = 1) {
  Model model = even;
  stride(model, share);
  bind(model);
  return model;
}

// The pose of a model in numbers that a clip can hold.
Pose parts_of(const Model& model) {
  std::vector<double> numbers;
  hf_gltf::append_trs(rest_pose(model), numbers);
  return hf_gltf::pose_of(rest_pose(model), numbers);
}

// Turns since rest mean little where a body rests in a stride: a pair says how uneven its rests are.
TEST(Stance, APairSaysThatOneRestsInAStride) {
  const Rig standing = make_biped("mixamo", {});
  Rig striding = standing;
  striding.turn(striding.find("mixamorig:LeftUpLeg"), {1, 0, 0}, -50);
  striding.turn(striding.find("mixamorig:RightUpLeg"), {1, 0, 0}, 50);
  const hf_gltf::Model a = make_rig_model(PlacedRig(standing, {}), "a.glb"),
                       b = make_rig_model(PlacedRig(striding, {}), "b.glb");
  const hf_gltf::FlatMesh mesh_a = hf_gltf::flatten(a), mesh_b = hf_gltf::flatten(b);
  EXPECT_EQ(hf_gltf::SkeletonPair({a, mesh_a}, {a, mesh_a}).unevenness(), 0);
  EXPECT_GT(hf_gltf::SkeletonPair({a, mesh_a}, {b, mesh_b}).unevenness(), 0.5);
  EXPECT_GT(hf_gltf::SkeletonPair({b, mesh_b}, {a, mesh_a}).unevenness(), 0.5);
}

TEST(Stance, ABodyIsAsUnevenAsItsArmsAndLegs) {
  hf_inner::Memory memory;
  hf_inner::skeleton::Character c(memory);
  c.left = {1, 0, 0};
  c.height = 2;
  const auto add_pair = [&](Role role, hf_inner::Vec3 left, hf_inner::Vec3 right) {
    const auto first = static_cast<std::int32_t>(c.roles.size());
    for (const auto& [mate, origin] : {std::pair{first + 1, left}, std::pair{first, right}}) {
      c.roles.push_back(role);
      c.mates.push_back(mate);
      hf_inner::skeleton::RestFrame frame;
      frame.origin = origin;
      c.frames.push_back(frame);
    }
  };
  add_pair(Role::head, {0.1, 2, 0}, {-0.1, 1, 0});  // ears, which say nothing
  for (const Role role : {Role::leg, Role::arm, Role::hand, Role::foot}) {
    add_pair(role, {0.2, 1, 0}, {-0.2, 1, 0.4});  // 0.4 apart once mirrored, a fifth of the height
    EXPECT_NEAR(hf_gltf::unevenness(c), 0.2, 1e-12);
  }
}

TEST(Stance, AClipThatBeginsEvenlyStandsForAPoseThatIsNot) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "body.glb");
  Model model = bound_in_stride(even);
  EXPECT_FALSE(find_stance(model, flatten(model), nullptr)) << "there is no other pose";
  model.animations.push_back(hf_gltf::clip_of_poses(model, "idle", {0}, {parts_of(even)}));
  const auto found = find_stance(model, flatten(model), nullptr);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->from, "as at the start of the clip \"idle\"");
}

TEST(Stance, AClipThatGetsUpStandsAtItsEnd) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "body.glb");
  Model model = bound_in_stride(even), other = even;
  stride(other, 1.3);
  model.animations.push_back(hf_gltf::clip_of_poses(model, "get up", {0, 1}, {parts_of(other), parts_of(even)}));
  const auto found = find_stance(model, flatten(model), nullptr);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->from, "as at the end of the clip \"get up\"");
}

TEST(Stance, AClipThatIsHardlyMoreEvenIsNone) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "body.glb");
  const hf_gltf::Axes given;  // with them the body is understood
  for (const double own : {0.6, 0.8, 1.0}) {
    Model model = bound_in_stride(even, own), other = even;
    stride(other, 0.8 * own);
    model.animations.push_back(hf_gltf::clip_of_poses(model, "walk", {0}, {parts_of(other)}));
    EXPECT_FALSE(find_stance(model, flatten(model), &given)) << own;
  }
}

// New clips face as those that the file has.
TEST(Stance, ABodyThatAClipTurnsMovesAsThatClipFaces) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "body.glb");
  Model raised = even;
  turn_node(raised, bone(2), {1, 0, 0}, -70);
  turn_node(raised, bone(14), {1, 0, 0}, -40);
  Model source = even;
  for (auto& node : source.nodes)
    if (node.matrix) hf_gltf::split_matrix(node);
  const auto clip = hf_gltf::clip_of_poses(source, "raise", {0}, {parts_of(raised)});
  const auto source_mesh = flatten(source);
  for (const double yaw : {0.0, 60.0, 90.0, 180.0}) {
    const Model turned = make_rig_model(PlacedRig(rig, Placing{1, yaw, false, false, {}}), "body.glb");
    Model model = bound_in_stride(even);
    model.animations.push_back(hf_gltf::clip_of_poses(model, "idle", {0}, {parts_of(turned)}));
    const auto stance = find_stance(model, flatten(model), nullptr);
    ASSERT_TRUE(stance) << yaw;
    const auto mesh = hf_gltf::standing(flatten(model), model, stance->pose);
    const hf_gltf::SkeletonPair pair({source, source_mesh}, {model, mesh, nullptr, &stance->pose});
    ASSERT_EQ(pair.refusal(), "") << yaw;
    const hf_gltf::JointClip played = pair.play(clip, {0}, {});
    std::vector<glm::dvec3> wanted = hf_gltf::posed_positions(source, source_mesh, played.source[0]);
    const glm::dquat turn = glm::angleAxis(yaw * degree, glm::dvec3(0, 1, 0));
    for (glm::dvec3& p : wanted) p = turn * p;
    EXPECT_LT(apart(hf_gltf::posed_positions(model, mesh, played.target[0]), wanted), 2e-3) << yaw;
  }
}

TEST(Stance, AClipThatFacesElsewhereThanTheCallerSaysIsNone) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "body.glb");
  const hf_gltf::Axes given;  // up y, forward z
  for (const double yaw : {0.0, 90.0, 180.0}) {
    const Model turned = make_rig_model(PlacedRig(rig, Placing{1, yaw, false, false, {}}), "body.glb");
    Model model = bound_in_stride(even);
    model.animations.push_back(hf_gltf::clip_of_poses(model, "idle", {0}, {parts_of(turned)}));
    EXPECT_EQ(find_stance(model, flatten(model), &given).has_value(), yaw == 0) << yaw;
  }
}

TEST(Stance, MotionCountsFromTheStanceNotFromThePoseOfTheFile) {
  const Rig rig = make_block_rig(false);
  const Model even = make_rig_model(PlacedRig(rig, {}), "even.glb");
  Model moving = even, stored = even;
  stride(stored);
  // A clip of one pose: an arm and a leg are raised.
  turn_node(moving, bone(2), {1, 0, 0}, -70);
  turn_node(moving, bone(14), {1, 0, 0}, -40);
  hf_gltf::Animation clip;
  clip.name = "raise";
  std::vector<double> numbers;
  hf_gltf::append_trs(rest_pose(moving), numbers);
  Model source = even;
  for (auto& node : source.nodes)
    if (node.matrix) hf_gltf::split_matrix(node);
  clip = hf_gltf::clip_of_poses(source, "raise", {0}, {hf_gltf::pose_of(rest_pose(source), numbers)});
  const auto source_mesh = flatten(source);
  const auto stance = find_stance(stored, flatten(stored), nullptr);
  ASSERT_TRUE(stance);
  const auto stored_mesh = hf_gltf::standing(flatten(stored), stored, stance->pose);
  const hf_gltf::SkeletonPair pair({source, source_mesh}, {stored, stored_mesh, nullptr, &stance->pose});
  ASSERT_EQ(pair.refusal(), "");
  const hf_gltf::JointClip played = pair.play(clip, {0}, {});
  ASSERT_EQ(played.target.size(), 1u);
  EXPECT_LT(apart(hf_gltf::posed_positions(stored, stored_mesh, played.target[0]),
                  hf_gltf::posed_positions(source, source_mesh, played.source[0])),
            2e-3);
}

// The rest is even, with the front legs in the air: the body stands where a clip has all legs on the ground.
TEST(Stance, ABodyThatRearsStandsAsInAClip) {
  Rig rig = make_beast("fox with hands", true);
  for (RigJoint& joint : rig.joints)  // in the air, arms that end in feet are legs
    if (joint.name.find("Hand") == 0) joint.name.replace(0, 4, "FrontFoot");
  const Model even = make_rig_model(PlacedRig(rig, {}), "fox.glb");
  ASSERT_FALSE(find_stance(even, flatten(even), nullptr));
  Model model = even;
  for (const char* name : {"UpperArm.L", "UpperArm.R"}) turn_node(model, name, {1, 0, 0}, -100);
  bind(model);
  EXPECT_FALSE(find_stance(model, flatten(model), nullptr)) << "there is no other pose";
  model.animations.push_back(hf_gltf::clip_of_poses(model, "walk", {0}, {parts_of(even)}));
  const auto found = find_stance(model, flatten(model), nullptr);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->needed);
  EXPECT_EQ(found->from, "as at the start of the clip \"walk\"");
}

}  // namespace
}  // namespace hf_test
