// What programs take from a skeleton: axes, sides, parts and the scale of a transfer.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gltf/suggest_pairs.h"
#include "rig_model.h"

namespace hf_test {
namespace {

using hf_gltf::AxesFrom;
using hf_gltf::BodyPart;
using hf_gltf::find_landmarks;
using hf_gltf::flatten;
using hf_gltf::know_body;
using hf_gltf::KnownBody;
using hf_gltf::Landmarks;
using hf_gltf::Model;

glm::dvec3 glm_of(Vec3 v) { return {v.x, v.y, v.z}; }

Model model_of(const Rig& rig, const Placing& placing = {}, const std::string& name = "body.glb") {
  return make_rig_model(PlacedRig(rig, placing), name);
}

Landmarks landmarks_of(const Model& model) {
  const hf_gltf::FlatMesh mesh = flatten(model);
  return find_landmarks({model, mesh, {}, nullptr});
}

KnownBody known(const Model& model) { return know_body(model, flatten(model)); }

class Conventions : public testing::TestWithParam<std::string> {};

// Wherever the body looks, landmarks have its own left, and feet are the ends of its legs.
TEST_P(Conventions, LandmarksStandOnTheSkeletonsAxes) {
  const Rig rig = make_biped(GetParam(), {});
  for (const Placing& placing : {Placing{}, Placing{100, 90, false, false, {}}, Placing{0.01, 180, false, false, {}},
                                 Placing{1, 60, false, false, {}}}) {
    const Landmarks found = landmarks_of(model_of(rig, placing));
    SCOPED_TRACE(hf_gltf::axes_sentence(found));
    EXPECT_EQ(found.axes_from, AxesFrom::skeleton);
    EXPECT_GT(glm::dot(found.axes.up, glm_of(placing.along({0, 1, 0}))), 0.99);
    EXPECT_GT(glm::dot(found.axes.forward, glm_of(placing.along({0, 0, 1}))), 0.99);
    EXPECT_TRUE(found.upright);
    EXPECT_EQ(found.leg_pairs, 1u);
    const glm::dvec3 left = glm_of(placing.along({1, 0, 0}));
    for (const auto& [name, side] : {std::pair{"foot left", 1.0}, std::pair{"foot right", -1.0},
                                     std::pair{"hand left", 1.0}, std::pair{"hand right", -1.0}}) {
      ASSERT_NE(found.get(name), nullptr) << name;
      EXPECT_GT(side * glm::dot(found.get(name)->position, left), 0.05 * placing.scale) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, Conventions, testing::ValuesIn(biped_conventions), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

// Joints that control legs are named like them and lead up from the ground. They carry nothing, so they do not vote.
TEST(KnownBody, ControlsBelowTheLegsDoNotTurnTheBodyOver) {
  Rig rig = make_biped("words", {});
  for (int k = 0; k < 40; ++k) {
    const std::string side = k % 2 ? ".L" : ".R";
    const int foot = rig.add_helper("foot_IK" + side, -1, {k % 2 ? 0.1 : -0.1, 0.08, 0});
    rig.add_helper("knee" + side, foot, {k % 2 ? 0.1 : -0.1, 1.5, 0.2});
  }
  const Landmarks found = landmarks_of(model_of(rig));
  EXPECT_EQ(found.axes.up, glm::dvec3(0, 1, 0)) << hf_gltf::axes_sentence(found);
  EXPECT_EQ(found.axes.forward, glm::dvec3(0, 0, 1)) << hf_gltf::axes_sentence(found);
  EXPECT_EQ(found.axes_from, AxesFrom::skeleton);
  EXPECT_NE(hf_gltf::axes_sentence(found).find("up +y from the skeleton"), std::string::npos);
  EXPECT_NE(hf_gltf::axes_sentence(found).find("legs down, head up"), std::string::npos);
}

// The humanoid of a VRM file as its extension writes it.
std::string vrm_0(const Rig& rig) {
  nlohmann::json bones = nlohmann::json::array();
  for (const auto& [bone, name] : {std::pair{"hips", "hips"}, std::pair{"head", "head"},
                                   std::pair{"leftUpperLeg", "thigh left"}, std::pair{"rightUpperLeg", "thigh right"}})
    bones.push_back({{"bone", bone}, {"node", rig.find(name) + 1}});
  return nlohmann::json({{"VRM", {{"humanoid", {{"humanBones", bones}}}}}}).dump();
}

std::string vrm_1(const Rig& rig) {
  nlohmann::json bones;
  for (const auto& [bone, name] : {std::pair{"hips", "hips"}, std::pair{"head", "head"},
                                   std::pair{"leftUpperLeg", "thigh left"}, std::pair{"rightUpperLeg", "thigh right"}})
    bones[bone] = {{"node", rig.find(name) + 1}};
  return nlohmann::json({{"VRMC_vrm", {{"humanoid", {{"humanBones", bones}}}}}}).dump();
}

// A body of boxes that are the same in front and behind: only a declaration says where it looks.
Rig make_post() {
  Rig rig;
  const int hips = rig.add("hips", -1, {0, 1, 0}, Role::spine);
  rig.add_block(hips, {-0.2, 0.9, -0.1}, {0.2, 1.2, 0.1});
  const int chest = rig.add("chest", hips, {0, 1.2, 0}, Role::spine);
  rig.add_block(chest, {-0.2, 1.2, -0.1}, {0.2, 1.5, 0.1});
  const int head = rig.add("head", chest, {0, 1.55, 0}, Role::head);
  rig.add_block(head, {-0.1, 1.55, -0.1}, {0.1, 1.8, 0.1});
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const std::string word = s > 0 ? " left" : " right";
    const int thigh = rig.add("thigh" + word, hips, {s * 0.12, 0.9, 0}, Role::leg, side);
    rig.add_box(thigh, {s * 0.12, 0.9, 0}, {s * 0.12, 0.5, 0}, 0.06);
    const int shin = rig.add("shin" + word, thigh, {s * 0.12, 0.5, 0}, Role::leg, side);
    rig.add_box(shin, {s * 0.12, 0.5, 0}, {s * 0.12, 0.1, 0}, 0.05);
    const int foot = rig.add("foot" + word, shin, {s * 0.12, 0.1, 0}, Role::foot, side);
    rig.add_block(foot, {s * 0.12 - 0.05, 0, -0.1}, {s * 0.12 + 0.05, 0.1, 0.1});
  }
  return rig;
}

void forget_names(Model& model) {
  for (auto& node : model.nodes) node.name.clear();
}

TEST(KnownBody, AVrmFileOfTheFirstVersionFacesMinusZAndOneOfTheNextPlusZ) {
  const Rig rig = make_post();
  Model old = model_of(rig, {1, 180, false, false, {}}), next = model_of(rig);
  old.carried.extensions = vrm_0(rig);
  next.carried.extensions = vrm_1(rig);
  for (Model* model : {&old, &next}) {
    forget_names(*model);
    const KnownBody found = known(*model);
    const double forward = model == &old ? -1 : 1;
    EXPECT_EQ(found.axes.forward.z, forward);
    EXPECT_GE(found.forward_confidence, 0.9);
    EXPECT_EQ(found.nodes[static_cast<std::size_t>(rig.find("thigh left") + 1)].side, 1);
    EXPECT_EQ(found.nodes[static_cast<std::size_t>(rig.find("head") + 1)].part, BodyPart::head);
  }
}

TEST(KnownBody, ABrokenDeclarationIsNoDeclaration) {
  const Rig rig = make_biped("mixamo", {});
  for (const char* text :
       {R"({"VRM":3})", R"({"VRM":{"humanoid":[]}})", R"({"VRM":{"humanoid":{"humanBones":7}}})",
        R"({"VRM":{"humanoid":{"humanBones":[{"bone":1,"node":"a"},{"bone":"hips","node":99999}]}}})",
        R"({"VRMC_vrm":{"humanoid":{"humanBones":{"hips":{"node":-5},"head":3}}}})"}) {
    Model model = model_of(rig);
    model.carried.extensions = text;
    EXPECT_EQ(known(model).axes.forward, glm::dvec3(0, 0, 1)) << text;
  }
}

// The clip of a walk moves the hips from its first key to its last.
void add_walk(Model& model, int node, glm::dvec3 way) {
  hf_gltf::Node& hips = model.nodes[static_cast<std::size_t>(node)];
  hips.translation = glm::dvec3((*hips.matrix)[3]);
  hips.rotation = glm::quat(glm::dquat(glm::dmat3(*hips.matrix)));
  hips.matrix.reset();
  hf_gltf::Channel channel;
  channel.node = node;
  channel.times = {0, 1};
  for (const double part : {0.0, 1.0})
    for (int c = 0; c < 3; ++c) channel.values.push_back(static_cast<float>(hips.translation[c] + part * way[c]));
  hf_gltf::Animation clip;
  clip.channels.push_back(channel);
  model.animations.push_back(clip);
}

TEST(KnownBody, AClipThatWalksSaysWhereABodyWithoutNamesLooks) {
  const Rig rig = make_post();
  for (const double way : {1.0, -1.0}) {
    Model model = model_of(rig);
    forget_names(model);
    add_walk(model, 1, {0, 0, 2 * way});
    const KnownBody found = known(model);
    EXPECT_EQ(found.axes.forward, glm::dvec3(0, 0, way)) << found.forward_why;
    EXPECT_GE(found.forward_confidence, 0.85);
    EXPECT_NE(found.forward_why.find("clips lead forward"), std::string::npos) << found.forward_why;
  }
  Model still = model_of(rig);
  forget_names(still);
  EXPECT_LT(known(still).forward_confidence, 0.6);
}

TEST(KnownBody, TheScaleIsTheRatioOfTheLengthsOfLegs) {
  for (const double leg : {0.45, 1.0, 1.5}) {
    BodyShape shape;
    shape.leg = leg;
    const Rig one = make_biped("mixamo", {}), other = make_biped("unreal", shape);
    for (const double unit : {0.01, 1.0, 100.0}) {
      const double truth = unit * (0.45 * leg + 0.42 * leg + 0.08) / (0.45 + 0.42 + 0.08);
      const double scale =
          hf_gltf::leg_scale(known(model_of(one)), known(model_of(other, {unit, 90, false, false, {}})));
      EXPECT_NEAR(scale / truth, 1, 0.1) << leg << " " << unit;
    }
  }
  // a horse stands on bent legs, so the height of its hips counts; between two of them the surfaces say more
  const KnownBody man = known(model_of(make_biped("mixamo", {}))), horse = known(model_of(make_beast("horse", true)));
  EXPECT_NEAR(hf_gltf::leg_scale(man, horse), 1.05 / man.leg_length, 1e-6);
  EXPECT_EQ(hf_gltf::leg_scale(horse, horse), 0);
  // a fish has no legs
  EXPECT_EQ(hf_gltf::leg_scale(known(model_of(make_biped("mixamo", {}))), known(model_of(make_beast("fish", true)))),
            0);
}

TEST(KnownBody, AModelWithoutASkeletonHasTheAxesOfItsSurface) {
  const Rig rig = make_post();
  const PlacedRig placed(rig, {});
  std::vector<glm::dvec3> positions;
  for (std::size_t k = 0; k < placed.positions.size(); k += 3)
    positions.emplace_back(placed.positions[k], placed.positions[k + 1], placed.positions[k + 2]);
  const Landmarks found = landmarks_of(hf_gltf::make_model("still", positions, placed.triangles));
  EXPECT_EQ(found.axes_from, AxesFrom::surface);
  EXPECT_NE(hf_gltf::axes_sentence(found).find("from the surface"), std::string::npos);
  EXPECT_EQ(found.leg_pairs, 1u);
}

TEST(KnownBody, GivenAxesHoldAndSidesFollowThem) {
  const Model model = model_of(make_biped("mixamo", {}));
  const hf_gltf::FlatMesh mesh = flatten(model);
  hf_gltf::Axes given;
  given.forward = {0, 0, -1};
  given.right = {-1, 0, 0};
  const Landmarks found = find_landmarks({model, mesh, {}, &given});
  EXPECT_EQ(found.axes_from, AxesFrom::caller);
  EXPECT_EQ(found.axes.forward, given.forward);
  ASSERT_NE(found.get("hand left"), nullptr);
  EXPECT_LT(found.get("hand left")->position.x, 0);
  EXPECT_LT(found.get("foot left")->position.x, 0);
  // on its head, as the caller says against all joints: left is on the other side
  given.up = {0, -1, 0};
  given.forward = {0, 0, 1};
  const Landmarks over = find_landmarks({model, mesh, {}, &given});
  ASSERT_NE(over.get("foot left"), nullptr);
  EXPECT_LT(over.get("foot left")->position.x, 0);
}

// What hangs on a joint without a skin is of its part; what a hand holds is not.
TEST(KnownBody, AMeshOnAJointIsOfThePartOfTheJoint) {
  const Rig rig = make_biped("mixamo", {});
  Model model = model_of(rig);
  const auto hang = [&](const char* joint) {
    hf_gltf::Node node;
    node.name = "thing";
    node.parent = rig.find(joint) + 1;
    model.nodes[static_cast<std::size_t>(node.parent)].children.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
    return model.nodes.size() - 1;
  };
  const std::size_t hat = hang("mixamorig:Head"), shoe = hang("mixamorig:LeftFoot"), sword = hang("mixamorig:LeftHand");
  const KnownBody found = known(model);
  EXPECT_EQ(found.nodes[hat].part, BodyPart::head);
  EXPECT_EQ(found.nodes[shoe].part, BodyPart::leg);
  EXPECT_EQ(found.nodes[shoe].limb, found.nodes[static_cast<std::size_t>(rig.find("mixamorig:LeftUpLeg") + 1)].limb);
  EXPECT_EQ(found.nodes[sword].part, BodyPart::other);
}

}  // namespace
}  // namespace hf_test
