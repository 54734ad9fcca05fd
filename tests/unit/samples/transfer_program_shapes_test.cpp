// hf_transfer --shapes: morph targets in, morph targets out.
#include <gtest/gtest.h>

#include "assets/face_gltf.h"
#include "gltf/animate.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

struct Heads {
  samples::Face face = samples::make_face(110, 90, false), other = samples::make_face(110, 90, true);
  fs::path source = folder() / "face.glb", target = folder() / "face_other.glb";
  Heads() {
    hf_gltf::write_gltf(samples::to_model(face, "face", true), source);
    hf_gltf::Model model = samples::to_model(other, "face_other", false);
    // a target with a node that turns and scales, and a morph target and a clip of its own
    model.nodes[0].rotation = glm::angleAxis(0.5f, glm::vec3(0, 1, 0));
    model.nodes[0].scale = glm::vec3(1, 2, 1);
    hf_gltf::Primitive& primitive = model.meshes[0].primitives[0];
    for (glm::vec3& p : primitive.positions) {
      p = glm::conjugate(model.nodes[0].rotation) * p;
      p.y /= 2;
    }
    hf_gltf::MorphTarget own;
    own.positions.assign(primitive.positions.size(), glm::vec3(0, 0.25f, 0));
    primitive.targets.push_back(own);
    model.meshes[0].target_names = {"blink_left"};
    model.meshes[0].weights = {0};
    hf_gltf::Animation clip;
    clip.name = "blink";
    hf_gltf::Channel channel;
    channel.node = 0;
    channel.path = hf_gltf::Path::weights;
    channel.width = 1;
    channel.times = {0, 1};
    channel.values = {0, 1};
    clip.channels.push_back(channel);
    model.animations.push_back(clip);
    hf_gltf::write_gltf(model, target);
  }
};

TEST(TransferProgramShapes, TheShapesOfAFaceStandBehindThoseThatTheOtherHas) {
  const Heads heads;
  const fs::path out = folder() / "shapes.glb", report = folder() / "shapes.json", sheet = folder() / "shapes.png";
  std::string said;
  ASSERT_EQ(
      transfer(quoted(heads.source) + " " + quoted(heads.target) + " --pairs " + quoted(pairs("face_to_other.json")) +
                   " --shapes --clip all -o " + quoted(out) + " --json " + quoted(report) + " --sheet " + quoted(sheet),
               said),
      0)
      << said;
  EXPECT_TRUE(fs::exists(sheet));
  const json figures = read_json(report);
  ASSERT_EQ(figures["shapes"].size(), 52u);
  for (const json& shape : figures["shapes"]) {
    const double from = shape["source_moved"], to = shape["target_moved"];
    EXPECT_GT(to, 0.5 * from) << shape["name"];
    EXPECT_LT(to, 2 * from) << shape["name"];
  }
  const hf_gltf::Model model = hf_gltf::read_gltf(out);
  const hf_gltf::MeshData& mesh = model.meshes[0];
  ASSERT_EQ(mesh.target_names.size(), 53u);
  EXPECT_EQ(mesh.target_names[0], "blink_left");
  EXPECT_EQ(mesh.target_names[1], "blink_left (2)");
  EXPECT_EQ(mesh.target_names[2], "blink_right");
  // the clips: the source's first, with its weights behind the target's own; then the target's, which is wider now
  ASSERT_EQ(model.animations.size(), 2u);
  EXPECT_EQ(model.animations[0].name, "blink (2)");
  EXPECT_EQ(model.animations[1].name, "blink");
  for (const hf_gltf::Animation& clip : model.animations) ASSERT_EQ(clip.channels[0].width, 53u);
  EXPECT_EQ(model.animations[0].channels[0].values[53 + 1], 1);
  EXPECT_EQ(model.animations[1].channels[0].values[53], 1);
  EXPECT_EQ(model.animations[1].channels[0].values[53 + 1], 0);
  // where the file's blink puts the lids, in the world
  const hf_gltf::FlatMesh flat = hf_gltf::flatten(model);
  const std::vector<glm::dvec3> closed = hf_gltf::posed_positions(model, flat, model.animations[0], 0.15);
  double gap = 0, open = 0;
  for (const auto& [upper, lower] : heads.other.lids) {
    gap = std::max(gap, glm::distance(closed[upper], closed[lower]));
    open = std::max(open, glm::distance(flat.positions[upper], flat.positions[lower]));
  }
  EXPECT_GT(open, 0.1);
  EXPECT_LT(gap, 0.1 * open);
}

TEST(TransferProgramShapes, WhatDoesNotGoTogetherIsRefused) {
  const Heads heads;
  const std::string two =
      quoted(heads.source) + " " + quoted(heads.target) + " --shapes -o " + quoted(folder() / "refused.glb") + " ";
  const std::string list = "--pairs " + quoted(pairs("face_to_other.json"));
  std::string said;
  EXPECT_NE(transfer(two, said), 0);
  EXPECT_NE(said.find("--pairs"), std::string::npos) << said;
  EXPECT_NE(transfer(two + list + " --as morph", said), 0);
  EXPECT_NE(said.find("--as"), std::string::npos) << said;
  EXPECT_NE(transfer(both() + " --shapes -o " + quoted(folder() / "refused.glb") + " --pairs " +
                         quoted(pairs("horse_to_bull.json")),
                     said),
            0);
  EXPECT_NE(said.find("no morph targets"), std::string::npos) << said;
}

}  // namespace
