// Which of two joints a mesh beside the skeleton rides on.
#include <gtest/gtest.h>

#include "gltf/flat_mesh.h"
#include "gltf/riders.h"

namespace {

using namespace hf_gltf;

// A body whose box is 10 long, so riders may lag by .1. It hangs on a chest, which a clip lifts by 2 in a second. A
// collar hangs 3 beside the chest. A pin stands beside the skeleton.
struct ChestAndCollar {
  static constexpr int chest = 0, collar = 1, torso = 2, pin = 3;
  Model model = make_model("body", {{0, 0, 0}, {6, 0, 0}, {0, 8, 0}}, {0, 1, 2});
  std::vector<uint8_t> body{1, 1, 0, 0};

  explicit ChestAndCollar(const glm::vec3& at) {
    model.meshes.push_back(make_model("pin", {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {0, 1, 2}).meshes[0]);
    model.nodes.assign(4, Node{});
    model.nodes[chest].children = {collar, torso};
    for (const int below : {collar, torso}) model.nodes[static_cast<size_t>(below)].parent = chest;
    model.nodes[collar].translation = {3, 0, 0};
    model.nodes[torso].mesh = 0;
    model.nodes[pin].mesh = 1;
    model.nodes[pin].translation = at;
    model.scene_roots = {chest, pin};
    model.skins.resize(1);
    model.skins[0].joints = {chest, collar};
    model.animations.resize(1);
    lift(chest, 2);
  }
  void lift(int node, float height) {
    const glm::vec3 at = model.nodes[static_cast<size_t>(node)].translation;
    key(node, Path::translation, {at.x, at.y, at.z, at.x, at.y + height, at.z});
  }
  void key(int node, Path path, std::vector<float> values) {
    Channel channel;
    channel.node = node;
    channel.path = path;
    channel.width = path == Path::rotation ? 4 : 3;
    channel.times = {0, 1};
    channel.values = std::move(values);
    model.animations[0].channels.push_back(channel);
  }
  Riders riders() const { return find_riders(model, flatten(model), rest_pose(model), body); }
  // -1: it rides on none.
  int joint() const {
    const Riders found = riders();
    return found.known.size() == 1 && found.known[0].node == pin ? found.known[0].joint : -1;
  }
};

TEST(RiderJoints, OfJointsThatMoveAlikeTheNearestCounts) {
  for (const auto& [x, joint] : {std::pair<float, int>(0.2f, ChestAndCollar::chest), {2.8f, ChestAndCollar::collar}}) {
    ChestAndCollar made({x, 1, 0});
    made.lift(ChestAndCollar::pin, 2);
    EXPECT_EQ(made.joint(), joint) << x;
  }
}

// The pin moves to the last digit as the collar, which is 3 away, and the chest by .0002 less.
TEST(RiderJoints, ADifferenceOfRoundingDoesNotOutweighTheNearestJoint) {
  ChestAndCollar made({0.2f, 1, 0});
  made.lift(ChestAndCollar::collar, 0.0002f);
  made.lift(ChestAndCollar::pin, 2.0002f);
  EXPECT_EQ(made.joint(), ChestAndCollar::chest);
}

// The collar is beside the pin and moves by .05 against it, which a constraint may lag too. The chest moves as it.
TEST(RiderJoints, ACollarThatHardlyMovesIsNotTheChest) {
  ChestAndCollar made({2.8f, 1, 0});
  made.lift(ChestAndCollar::collar, 0.05f);
  made.lift(ChestAndCollar::pin, 2);
  EXPECT_EQ(made.joint(), ChestAndCollar::chest);
}

// A clip that hides it: on its joint it would be flat, and hidden in every other clip.
TEST(RiderJoints, WhatAClipHidesAllTheTimeIsNotKnown) {
  ChestAndCollar made({0.2f, 1, 0});
  made.lift(ChestAndCollar::pin, 2);
  made.key(ChestAndCollar::pin, Path::scale, {0, 0, 0, 0, 0, 0});
  const Riders found = made.riders();
  EXPECT_TRUE(found.known.empty());
  EXPECT_EQ(found.unknown, std::vector<int>{ChestAndCollar::pin});
}

// A constraint of the clip: at rest the pin is elsewhere.
TEST(RiderJoints, WhatClipsAlonePutOnAJointRidesOnIt) {
  ChestAndCollar made({0.2f, 1, 0});
  made.lift(ChestAndCollar::pin, 2);
  made.model.nodes[ChestAndCollar::pin].translation = {5, 4, 0};
  EXPECT_EQ(made.joint(), ChestAndCollar::chest);
}

// The clip moves the collar aside first, so at rest the pin is elsewhere on it. The chest is .02 off.
TEST(RiderJoints, AJointOnWhichItRidesFromItsRestOnIsBetterThanOneOfClips) {
  ChestAndCollar made({0.2f, 1, 0});
  made.key(ChestAndCollar::collar, Path::translation, {4, 0, 0, 4, 0.02f, 0});
  made.lift(ChestAndCollar::pin, 2.02f);
  EXPECT_EQ(made.joint(), ChestAndCollar::chest);
}

// A rider needs the space of its joint at rest and in the clip. There the chest is thin and the collar lies across, so
// all axes of the collar are in one plane.
TEST(RiderJoints, AJointThatIsFlatAtRestOrInTheClipCarriesNothing) {
  for (const bool at_rest : {true, false}) {
    ChestAndCollar made({2.8f, 1, 1});
    made.lift(ChestAndCollar::collar, 1);
    made.lift(ChestAndCollar::pin, 3);
    ASSERT_EQ(made.joint(), ChestAndCollar::collar);
    if (at_rest) {
      made.model.nodes[ChestAndCollar::collar].scale = {0, 0, 0};
      made.key(ChestAndCollar::collar, Path::scale, {1, 1, 1, 1, 1, 1});
    } else {
      made.key(ChestAndCollar::chest, Path::scale, {1, 1, 1e-11f, 1, 1, 1e-11f});
      made.key(ChestAndCollar::collar, Path::rotation, {0.6f, 0, 0, 0.8f, 0.6f, 0, 0, 0.8f});
    }
    EXPECT_EQ(made.riders().unknown, std::vector<int>{ChestAndCollar::pin}) << at_rest;
  }
}

TEST(RiderJoints, ARiderOnAJointOfScaleZeroStays) {
  ChestAndCollar made({0.2f, 1, 0});
  made.lift(ChestAndCollar::pin, 2);
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 1u);
  for (const double side : {0.0, 1.0}) {
    Pose pose = rest_pose(made.model);
    pose[ChestAndCollar::chest].scale = {side, side, 0};
    place_riders(made.model, riders, pose);
    EXPECT_EQ(pose[ChestAndCollar::pin].scale, glm::dvec3(1));
    EXPECT_EQ(pose[ChestAndCollar::pin].translation, rest_pose(made.model)[ChestAndCollar::pin].translation);
  }
}

// All pins are .05 off the chest and ride on the collar. Each costs 100 comparisons of the 1,000,000, and the first
// one, which stands still, 64: the last pin that is looked at is compared with the chest alone, and rides on none.
TEST(RiderJoints, APinThatWasNotComparedWithEachJointRidesOnNone) {
  ChestAndCollar made({2.8f, 1, 0});
  made.lift(ChestAndCollar::collar, 0.05f);
  Animation& clip = made.model.animations[0];
  for (int k = 0; k < 11000; ++k) {
    Node node = made.model.nodes[ChestAndCollar::pin];
    made.model.scene_roots.push_back(static_cast<int>(made.model.nodes.size()));
    made.model.nodes.push_back(node);
    made.body.push_back(0);
    made.lift(made.model.scene_roots.back(), 2.05f);
  }
  made.model.animations.resize(8, Animation(clip));
  const Riders riders = made.riders();
  EXPECT_EQ(riders.known.size(), 9999u);
  EXPECT_EQ(riders.unknown.size(), 1001u);
  for (const Rider& rider : riders.known) ASSERT_EQ(rider.joint, ChestAndCollar::collar) << rider.node;
}

}  // namespace
