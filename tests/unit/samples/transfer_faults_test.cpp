// The faults that the report of hf_transfer names, each put into a good clip by hand; the confidence falls with each.
#include <gtest/gtest.h>

#include "gltf/animate.h"
#include "transfer/faults.h"
#include "transfer/soles.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;
using namespace samples;
using namespace hf_gltf;

struct Walk {
  Model horse = to_model(make_creature("horse", 1500)), bull = to_model(make_creature("bull", 1500));
  ProgressBar bar{true};
  Session session{horse, bull, read_pairs(pairs("horse_to_bull.json")), 1, true, bar};
  PlayedClip clip = session.play(horse.animations[static_cast<size_t>(find_animation(horse, "walk"))], 30, bar);
  double box = session.target_mesh().bounding_box_diagonal;
};

const Walk& walk() {
  static const Walk made;
  return made;
}

TEST(TransferFaults, AGoodWalkHasNone) {
  const ClipFaults faults = find_faults(walk().session, walk().clip);
  EXPECT_EQ(faults.spikes, 0u);
  EXPECT_TRUE(faults.lost.empty());
  EXPECT_GT(faults.confidence, 0.8);
  EXPECT_TRUE(fault_sentences(faults, "walk", walk().clip.target_frames.size()).empty());
}

// Each fault is found, said, and halves the confidence or more.
TEST(TransferFaults, WhatIsPutInIsFoundAndSaid) {
  const Walk& w = walk();
  const ClipFaults good = find_faults(w.session, w.clip);
  const auto expect = [&](const PlayedClip& clip, const char* said) {
    const ClipFaults faults = find_faults(w.session, clip);
    EXPECT_LT(faults.confidence, 0.6 * good.confidence) << said;
    std::string all;
    for (const std::string& sentence : fault_sentences(faults, "walk", clip.target_frames.size()))
      all += sentence + "\n";
    EXPECT_NE(all.find(said), std::string::npos) << all;
    return faults;
  };
  PlayedClip jump = w.clip;  // one vertex, one frame
  jump.target_frames[5][0] += 0.1 * w.box;
  EXPECT_EQ(expect(jump, "jump").spikes, 3u);  // it leaves, is away, comes back

  PlayedClip shake = w.clip;
  for (size_t f = 0; f < shake.target_frames.size(); ++f)
    for (double& x : shake.target_frames[f]) x += (f % 2 ? 0.01 : -0.01) * w.box;
  EXPECT_GT(expect(shake, "accelerates").acceleration, 2);

  PlayedClip flat = w.clip;  // a tenth of the height, in every frame
  for (std::vector<double>& frame : flat.target_frames)
    for (size_t i = 1; i < frame.size(); i += 3) frame[i] *= 0.1;
  EXPECT_GT(expect(flat, "stretched or squashed").stretch, 0.5);

  PlayedClip sunk = w.clip;
  sunk.feet.surface_sunk = 0.03;
  EXPECT_EQ(expect(sunk, "sinks").sunk, 0.03);
  PlayedClip open = w.clip;
  open.gap = 0.03;
  EXPECT_EQ(expect(open, "come apart").gap, 0.03);

  PlayedClip frozen = w.clip;  // feet that follow the body, not their source
  for (std::vector<double>& frame : frozen.target_frames) {
    for (size_t i = 0; i < frame.size(); ++i)
      frame[i] = w.clip.target_frames[0][i] + (frame[0] - w.clip.target_frames[0][0]) * (i % 3 == 0);
  }
  EXPECT_GE(expect(frozen, "does not move as its source").lost.size(), 4u);
}

// A sword in the ground: an artist mends it by hand, so it is said and lowers the confidence, less than a foot would.
TEST(TransferFaults, AHeldThingInTheGroundIsSaidAndCountsLessThanTheBody) {
  ClipFaults good, held, sunk;
  held.held = sunk.sunk = 0.14;
  EXPECT_LT(confidence_of(held, 30), 0.6 * confidence_of(good, 30));
  EXPECT_GT(confidence_of(held, 30), 5 * confidence_of(sunk, 30));
  const std::vector<std::string> said = fault_sentences(held, "walk", 30);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("what a hand holds is 14.0 %"), std::string::npos) << said[0];
}

// A walker in the air, and one whose turns count from a stride, are broken.
TEST(TransferFaults, ABodyThatFloatsOrRestsInAStrideIsSaidAndLowersTheConfidence) {
  ClipFaults good, high, uneven;
  high.hover = 0.06;
  uneven.uneven = 1;
  for (const auto& [faults, part] :
       {std::pair<const ClipFaults&, const char*>(high, "it floats"), {uneven, "--source-rest"}}) {
    EXPECT_LE(confidence_of(faults, 30), 0.5 * confidence_of(good, 30));
    const std::vector<std::string> said = fault_sentences(faults, "walk", 30);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
  }
}

// A hat beside a body: the body goes two units aside, and the hat goes along or stays.
TEST(TransferFaults, AMeshThatStaysBehindComesOff) {
  Model model = make_model("body", {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}}, {0, 1, 2, 0, 2, 3});
  const Model hat = make_model("hat", {{0, 2, 0}, {1, 3, 0}, {0, 3, 1}}, {0, 1, 2});
  Node node = hat.nodes[0];
  node.mesh = 1;
  model.meshes.push_back(hat.meshes[0]);
  model.nodes.push_back(node);
  model.scene_roots.push_back(1);
  const FlatMesh mesh = flatten(model);
  std::vector<double> along = double_positions(mesh.positions), stays = along;
  for (const FlatPart& part : mesh.parts) {
    for (size_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      along[3 * v] += 2;
      if (part.node == 0) stays[3 * v] += 2;
    }
  }
  EXPECT_NEAR(comes_off(model, mesh, 1, {along}), 0, 1e-12);
  EXPECT_NEAR(comes_off(model, mesh, 1, {along, stays}), 2 / SurfaceBox(mesh).diagonal(), 1e-12);
}

TEST(TransferFaults, TheReportHoldsThem) {
  const fs::path out = folder() / "faults.glb", report = folder() / "faults.json";
  std::string said;
  ASSERT_EQ(transfer(both() + " --pairs " + quoted(pairs("horse_to_bull.json")) + " -o " + quoted(out) + " --json " +
                         quoted(report),
                     said),
            0)
      << said;
  EXPECT_NE(said.find("confidence"), std::string::npos) << said;
  const json clip = read_json(report)["clips"][0];
  EXPECT_GT(clip["confidence"].get<double>(), 0.5);
  for (const char* key : {"spikes", "acceleration", "stretch", "sunk", "held", "gap", "lost", "sentences"})
    EXPECT_TRUE(clip["faults"].contains(key)) << key;
}

}  // namespace
