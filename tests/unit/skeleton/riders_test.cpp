// Meshes without a skin that stand beside the skeleton ride on the joint with which clips move them.
#include "gltf/riders.h"

#include <gtest/gtest.h>

#include "gltf/clip_binding.h"
#include "rig_model.h"

namespace hf_test {
namespace {

using hf_gltf::Animation;
using hf_gltf::Channel;
using hf_gltf::flatten;
using hf_gltf::Model;
using hf_gltf::Node;
using hf_gltf::Path;
using hf_gltf::Pose;
using hf_gltf::rest_pose;
using hf_gltf::Riders;

// A body whose clip nods, with a mesh beside its skeleton; keys of that node are baked from the head if it rides.
struct Helmet {
  Model model = make_rig_model(PlacedRig(make_biped("mixamo", {}), {}), "body.glb");
  int node = 0, head = hf_gltf::find_node(model, "mixamorig:Head");
  std::vector<uint8_t> body = std::vector<uint8_t>(model.nodes.size() + 1, 1);

  explicit Helmet(bool rides, bool clips = true) {
    Node helmet;
    helmet.name = "helmet";
    helmet.mesh = static_cast<int>(model.meshes.size());
    helmet.translation = {0, 1.7f, 0};
    const Model box =
        hf_gltf::make_model("box", {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}, {0, 1, 2, 0, 2, 3});
    model.meshes.push_back(box.meshes[0]);
    node = static_cast<int>(model.nodes.size());
    model.nodes.push_back(helmet);
    model.scene_roots.push_back(node);
    body[0] = body[static_cast<size_t>(node)] = 0;
    if (!clips) return;
    const auto rest = hf_gltf::global_matrices(model, rest_pose(model));
    const glm::dmat4 on_head = glm::inverse(rest[static_cast<size_t>(head)]) * rest[static_cast<size_t>(node)];
    Animation nod;
    Channel turn, move, spin;
    turn.node = hf_gltf::find_node(model, "mixamorig:Spine1");
    move.node = spin.node = node;
    turn.path = spin.path = Path::rotation;
    turn.width = spin.width = 4;
    for (int f = 0; f < 9; ++f) {
      const float time = 0.1f * static_cast<float>(f);
      Pose pose = rest_pose(model);
      for (const int joint : {turn.node, head}) {
        auto& at = pose[static_cast<size_t>(joint)];
        Node whole;
        whole.matrix = at.matrix;
        hf_gltf::split_matrix(whole);
        at.fixed = false;
        at.translation = whole.translation;
        at.rotation = glm::dquat(whole.rotation) * glm::angleAxis((joint == head ? 0.2 : 0.1) * f, glm::dvec3(1, 0, 0));
        add(joint == head ? nods : turn, time, at.rotation);
      }
      nods.node = head;
      const auto globals = hf_gltf::global_matrices(model, pose);
      const glm::dmat4 placed = globals[static_cast<size_t>(head)] * on_head;
      move.times.push_back(time);
      for (int c = 0; c < 3; ++c) move.values.push_back(static_cast<float>(placed[3][c]));
      add(spin, time, glm::quat_cast(glm::dmat3(placed)));
    }
    nods.path = Path::rotation;
    nods.width = 4;
    nod.channels = {turn, nods};
    if (rides) nod.channels.insert(nod.channels.end(), {move, spin});
    model.animations.push_back(nod);
    for (const Channel& channel : nod.channels) hf_gltf::split_matrix(model.nodes[static_cast<size_t>(channel.node)]);
  }
  Riders riders() const { return hf_gltf::find_riders(model, flatten(model), rest_pose(model), body); }

 private:
  Channel nods;
  static void add(Channel& channel, float time, const glm::dquat& q) {
    channel.times.push_back(time);
    for (const double x : {q.x, q.y, q.z, q.w}) channel.values.push_back(static_cast<float>(x));
  }
};

TEST(Riders, AHelmetRidesOnTheHeadWithWhichClipsMoveIt) {
  const Helmet made(true);
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 1u);
  EXPECT_TRUE(riders.unknown.empty());
  // The end of the head moves as the head does, and is as good.
  EXPECT_EQ(made.model.nodes[static_cast<size_t>(riders.known[0].joint)].name.find("mixamorig:Head"), 0u);
  Pose pose = hf_gltf::sample(made.model, made.model.animations[0], 0.35);
  pose[static_cast<size_t>(made.node)] = rest_pose(made.model)[static_cast<size_t>(made.node)];
  const auto expected =
      hf_gltf::global_matrices(made.model, hf_gltf::sample(made.model, made.model.animations[0], 0.35));
  hf_gltf::place_riders(made.model, riders, pose);
  const auto placed = hf_gltf::global_matrices(made.model, pose);
  for (int c = 0; c < 4; ++c)
    EXPECT_LT(glm::distance(placed[static_cast<size_t>(made.node)][c], expected[static_cast<size_t>(made.node)][c]),
              2e-3);
}

// Its author left it where it is.
TEST(Riders, WhatStandsStillWhileTheBodyMovesRidesOnNone) {
  const Riders riders = Helmet(false).riders();
  EXPECT_TRUE(riders.known.empty());
  EXPECT_TRUE(riders.unknown.empty());
}

TEST(Riders, WithoutAClipItIsNotKnown) {
  const Riders riders = Helmet(false, false).riders();
  EXPECT_TRUE(riders.known.empty());
  EXPECT_EQ(riders.unknown.size(), 1u);
}

}  // namespace
}  // namespace hf_test
