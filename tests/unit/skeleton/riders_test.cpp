// Meshes without a skin that stand beside the skeleton ride on the joint with which clips move them.
#include "gltf/riders.h"

#include <gtest/gtest.h>

#include "base/progress.h"
#include "gltf/clip_binding.h"
#include "gltf/skeleton_pair.h"
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

// A body whose clip nods. Boxes can be put beside its skeleton, and keys of a box baked from a joint.
struct NoddingBody {
  Model model = make_rig_model(PlacedRig(make_biped("mixamo", {}), {}), "body.glb");
  int spine = hf_gltf::find_node(model, "mixamorig:Spine1"), head = hf_gltf::find_node(model, "mixamorig:Head");
  std::vector<uint8_t> body = std::vector<uint8_t>(model.nodes.size(), 1);
  std::vector<Pose> poses;
  std::vector<float> times;

  NoddingBody() {
    body[0] = 0;
    Animation nod;
    nod.name = "nod";
    for (const int joint : {spine, head}) {
      hf_gltf::split_matrix(model.nodes[static_cast<size_t>(joint)]);
      Channel turn;
      turn.node = joint;
      turn.path = Path::rotation;
      turn.width = 4;
      for (int f = 0; f < 9; ++f)
        add(turn, 0.1f * static_cast<float>(f),
            rest_pose(model)[static_cast<size_t>(joint)].rotation *
                glm::angleAxis((joint == head ? 0.2 : 0.1) * f, glm::dvec3(1, 0, 0)));
      nod.channels.push_back(turn);
    }
    times = nod.channels[0].times;
    model.animations.push_back(nod);
    for (const float time : times) poses.push_back(sample(model, nod, time));
  }
  // The parent of -1 is the scene.
  int add_node(const char* name, int parent, const glm::vec3& place, bool with_mesh = true) {
    const int number = static_cast<int>(model.nodes.size());
    Node node;
    node.name = name;
    node.translation = place;
    node.parent = parent;
    if (with_mesh) {
      node.mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back(
          hf_gltf::make_model("box", {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}, {0, 1, 2, 0, 2, 3}).meshes[0]);
    }
    model.nodes.push_back(node);
    if (parent < 0)
      model.scene_roots.push_back(number);
    else
      model.nodes[static_cast<size_t>(parent)].children.push_back(number);
    body.push_back(0);
    hf_gltf::NodePose pose_of_node;
    pose_of_node.translation = node.translation;
    for (Pose& pose : poses) pose.push_back(pose_of_node);
    return number;
  }
  // Keys of a node that keep it where it is on a joint at rest.
  void bake(int node, int joint) {
    const auto n = static_cast<size_t>(node), j = static_cast<size_t>(joint);
    const auto rest = global_matrices(model, rest_pose(model));
    const int parent = model.nodes[n].parent;
    const glm::dmat4 above = parent < 0 ? glm::dmat4(1) : rest[static_cast<size_t>(parent)];
    Channel move, spin;
    move.node = spin.node = node;
    spin.path = Path::rotation;
    spin.width = 4;
    for (size_t f = 0; f < poses.size(); ++f) {
      const glm::dmat4 placed =
          glm::inverse(above) * global_matrices(model, poses[f])[j] * glm::inverse(rest[j]) * rest[n];
      move.times.push_back(times[f]);
      for (int c = 0; c < 3; ++c) move.values.push_back(static_cast<float>(placed[3][c]));
      add(spin, times[f], glm::quat_cast(glm::dmat3(placed)));
    }
    model.animations[0].channels.insert(model.animations[0].channels.end(), {move, spin});
  }
  Riders riders() const { return hf_gltf::find_riders(model, flatten(model), rest_pose(model), body); }
  const std::string& name_of(int node) const { return model.nodes[static_cast<size_t>(node)].name; }

 private:
  static void add(Channel& channel, float time, const glm::dquat& q) {
    channel.times.push_back(time);
    for (const double x : {q.x, q.y, q.z, q.w}) channel.values.push_back(static_cast<float>(x));
  }
};

struct Helmet : NoddingBody {
  int node = add_node("helmet", -1, {0, 1.7f, 0});
  explicit Helmet(bool rides, bool clips = true) {
    if (rides) bake(node, head);
    if (!clips) model.animations.clear();
  }
};

// How far a node is from where another pose has it.
double apart(const Model& model, const Pose& a, const Pose& b, int node) {
  const auto x = global_matrices(model, a), y = global_matrices(model, b);
  double out = 0;
  for (int c = 0; c < 4; ++c)
    out = std::max(out, glm::distance(x[static_cast<size_t>(node)][c], y[static_cast<size_t>(node)][c]));
  return out;
}

TEST(Riders, AHelmetRidesOnTheHeadWithWhichClipsMoveIt) {
  const Helmet made(true);
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 1u);
  EXPECT_TRUE(riders.unknown.empty());
  // The end of the head moves as the head does, and is as good.
  EXPECT_EQ(made.name_of(riders.known[0].joint).find("mixamorig:Head"), 0u);
  const Pose wanted = hf_gltf::sample(made.model, made.model.animations[0], 0.35);
  Pose pose = wanted;
  pose[static_cast<size_t>(made.node)] = rest_pose(made.model)[static_cast<size_t>(made.node)];
  EXPECT_GT(apart(made.model, pose, wanted, made.node), 0.1);
  hf_gltf::place_riders(made.model, riders, pose);
  EXPECT_LT(apart(made.model, pose, wanted, made.node), 2e-3);
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

// Exporters bake keys of the group too.
TEST(Riders, TwoPropsOfOneGroupRideOnTheirOwnJoints) {
  NoddingBody made;
  const int group = made.add_node("props", -1, {0.3f, 0.2f, 0}, false),
            helmet = made.add_node("helmet", group, {-0.3f, 1.5f, 0}),
            pack = made.add_node("pack", group, {-0.3f, 0.9f, -0.2f});
  made.bake(helmet, made.head);
  made.bake(pack, made.spine);
  Channel still;
  still.node = group;
  still.times = {0, 0.8f};
  still.values = {0.3f, 0.2f, 0, 0.3f, 0.2f, 0};
  made.model.animations[0].channels.push_back(still);
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 2u);
  const Pose wanted = hf_gltf::sample(made.model, made.model.animations[0], 0.8);
  Pose pose = wanted;
  for (const int node : {helmet, pack})
    pose[static_cast<size_t>(node)] = rest_pose(made.model)[static_cast<size_t>(node)];
  hf_gltf::place_riders(made.model, riders, pose);
  for (const int node : {helmet, pack}) EXPECT_LT(apart(made.model, pose, wanted, node), 2e-3) << made.name_of(node);
}

// A feather that hangs on a helmet is placed after it.
TEST(Riders, ARiderOnARiderComesAlong) {
  Helmet made(true);
  const int feather = made.add_node("feather", made.node, {0, 0.1f, 0});
  Channel still;
  still.node = feather;
  still.times = {0};
  still.values = {0, 0.1f, 0};
  made.model.animations[0].channels.push_back(still);
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 2u);
  const Pose wanted = hf_gltf::sample(made.model, made.model.animations[0], 0.8);
  Pose pose = wanted;
  pose[static_cast<size_t>(made.node)] = rest_pose(made.model)[static_cast<size_t>(made.node)];
  hf_gltf::place_riders(made.model, riders, pose);
  EXPECT_LT(apart(made.model, pose, wanted, feather), 2e-3);
}

bool is_finite(const Pose& pose) {
  for (const hf_gltf::NodePose& node : pose)
    for (const double x : {node.translation.x, node.translation.y, node.translation.z, node.rotation.x, node.rotation.y,
                           node.rotation.z, node.rotation.w, node.scale.x, node.scale.y, node.scale.z})
      if (!std::isfinite(x)) return false;
  return true;
}

// A prop that a clip makes appear has the scale 0 at rest.
TEST(Riders, AScaleOfZeroGivesNoNumberThatIsNotFinite) {
  for (const char* flat : {"helmet", "group", "joint"}) {
    NoddingBody made;
    const int group = made.add_node("props", -1, {0, 0, 0}, false),
              helmet = made.add_node("helmet", group, {0, 1.7f, 0});
    made.bake(helmet, made.head);
    const std::string which = flat;
    int end = -1;  // a joint at the head, which is as near as the head is
    for (size_t n = 0; n < made.model.nodes.size(); ++n)
      if (made.model.nodes[n].parent == made.head) end = static_cast<int>(n);
    ASSERT_GE(end, 0);
    const int node = which == "helmet" ? helmet : which == "group" ? group : end;
    hf_gltf::split_matrix(made.model.nodes[static_cast<size_t>(node)]);
    made.model.nodes[static_cast<size_t>(node)].scale = glm::vec3(0);
    const Riders riders = made.riders();
    EXPECT_EQ(riders.known.size(), which == "joint" ? 1u : 0u) << which;
    EXPECT_TRUE(riders.unknown.empty()) << which;
    for (const hf_gltf::Rider& rider : riders.known) {
      EXPECT_NE(rider.joint, end);
      for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(glm::length(rider.on_joint[c])));
    }
    Pose pose = hf_gltf::sample(made.model, made.model.animations[0], 0.5);
    hf_gltf::place_riders(made.model, riders, pose);
    EXPECT_TRUE(is_finite(pose)) << which;
  }
}

// What was found while a node was seen is asked for where it is not.
TEST(Riders, ARiderBelowAGroupOfScaleZeroStays) {
  NoddingBody made;
  const int group = made.add_node("props", -1, {0, 0, 0}, false), helmet = made.add_node("helmet", group, {0, 1.7f, 0});
  made.bake(helmet, made.head);
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 1u);
  Pose pose = rest_pose(made.model);
  pose[static_cast<size_t>(group)].scale = glm::dvec3(0);
  hf_gltf::place_riders(made.model, riders, pose);
  EXPECT_TRUE(is_finite(pose));
  EXPECT_EQ(pose[static_cast<size_t>(helmet)].translation,
            rest_pose(made.model)[static_cast<size_t>(helmet)].translation);
}

// Each of the stones costs a look at every joint. The last ones are not looked at.
TEST(Riders, ASearchAmongThousandsOfNodesIsBoundedAndStopsWhenItIsCancelled) {
  Helmet made(true);
  for (int k = 0; k < 12000; ++k) made.add_node("stone", -1, {3, 0, 0.001f * static_cast<float>(k)});
  const Riders riders = made.riders();
  ASSERT_EQ(riders.known.size(), 1u);
  EXPECT_EQ(riders.known[0].node, made.node);
  EXPECT_GT(riders.unknown.size(), 1000u);
  hf_inner::Progress progress;
  const hf_inner::CallProgress call(&progress);
  progress.cancel();
  EXPECT_THROW(made.riders(), hf_inner::Error);
}

// The clip of a body that wears nothing, on the same body with a helmet.
TEST(Riders, AHelmetRidesOnTheSameSkeletonToo) {
  const NoddingBody source;
  const Helmet target(true);
  const hf_gltf::FlatMesh source_mesh = flatten(source.model), target_mesh = flatten(target.model);
  const hf_gltf::SkeletonPair pair({source.model, source_mesh}, {target.model, target_mesh});
  ASSERT_EQ(pair.refusal(), "");
  const hf_gltf::JointClip clip = pair.play(source.model.animations[0], {0, 0.4, 0.8}, {});
  EXPECT_TRUE(clip.same);
  EXPECT_EQ(clip.riders, std::vector<int>{target.node});
  EXPECT_LT(apart(target.model, clip.target[2], sample(target.model, target.model.animations[0], 0.8), target.node),
            2e-3);
}

// The clip moves the helmet itself, beside the head: its author's keys are kept to the last digit.
TEST(Riders, WhatAClipOfTheSameSkeletonMovesIsCopied) {
  Helmet source(true);
  for (float& x : source.model.animations[0].channels[2].values) x += 0.004f;
  const Helmet target(true);
  const hf_gltf::FlatMesh source_mesh = flatten(source.model), target_mesh = flatten(target.model);
  const hf_gltf::SkeletonPair pair({source.model, source_mesh}, {target.model, target_mesh});
  const hf_gltf::JointClip clip = pair.play(source.model.animations[0], {0, 0.4, 0.8}, {});
  EXPECT_TRUE(clip.same);
  EXPECT_TRUE(clip.riders.empty());
  EXPECT_LT(apart(target.model, clip.target[2], sample(source.model, source.model.animations[0], 0.8), target.node),
            1e-6);
}

// Clips of a file without a surface are put on the skeleton as they are.
TEST(Riders, AHelmetGoesAlongWithClipsThatArePutOnASkeleton) {
  NoddingBody clips;
  clips.model.meshes.clear();
  clips.model.nodes[0].mesh = clips.model.nodes[0].skin = -1;
  const Helmet target(true);
  hf_gltf::BoundClips bound = hf_gltf::bind_clips(target.model, clips.model, "");
  hf_gltf::add_riders(target.model, bound.model, bound.clips);
  EXPECT_LT(apart(target.model, sample(bound.model, bound.model.animations[0], 0.8),
                  sample(target.model, target.model.animations[0], 0.8), target.node),
            2e-3);
}

}  // namespace
}  // namespace hf_test
