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
  Model horse = to_model(hf_test::creature("horse", 1500)), bull = to_model(hf_test::creature("bull", 1500));
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
  EXPECT_EQ(expect(sunk, "under the ground").sunk, 0.03);
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

// A hat beside a body without legs: the body goes two units aside, and the hat goes along or stays. The floor may stay.
TEST(TransferFaults, AMeshThatStaysBehindComesOff) {
  Model model = make_model("body", {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}}, {0, 1, 2, 0, 2, 3});
  for (const Model& beside : {make_model("hat", {{0, 2, 0}, {1, 3, 0}, {0, 3, 1}}, {0, 1, 2}),
                              make_model("floor", {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {0, 1, 2})}) {
    Node node = beside.nodes[0];
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(beside.meshes[0]);
    model.scene_roots.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
  }
  const FlatMesh mesh = flatten(model);
  KnownBody known;
  known.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  known.nodes.resize(3);
  known.nodes[0].part = BodyPart::trunk;
  const std::vector<Fastening> found = fastenings_of({model, mesh, known}, {1, 2});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].node, 1);
  const Fastening& fastening = found[0];
  std::vector<double> along = double_positions(mesh.positions), stays = along;
  for (const FlatPart& part : mesh.parts) {
    for (size_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      along[3 * v] += 2;
      if (part.node == 0) stays[3 * v] += 2;
    }
  }
  EXPECT_NEAR(comes_off(fastening, {along}), 0, 1e-12);
  EXPECT_NEAR(comes_off(fastening, {along, stays}), 2 / SurfaceBox(mesh).diagonal(), 1e-12);
}

// A block on two feet, 2 high, and something in its hand that hangs lower than the feet.
struct Walker {
  Model model;
  FlatMesh mesh;
  KnownBody known;

  explicit Walker(bool holds) {
    add({-0.4, 0.8, -0.2}, {0.4, 2, 0.2}, BodyPart::trunk, -1, 0);
    add({0.1, 0, -0.2}, {0.3, 0.8, 0.3}, BodyPart::leg, 1, 1);
    add({-0.3, 0, -0.2}, {-0.1, 0.8, 0.3}, BodyPart::leg, 2, -1);
    if (holds) {
      add({-0.6, 1, 0}, {-0.4, 1.2, 0.2}, BodyPart::hand, -1, -1);
      add({-0.6, -0.5, 0}, {-0.5, 1, 0.1}, BodyPart::other, -1, 0);
      model.nodes[4].parent = 3;  // the pickaxe hangs on the hand
      model.nodes[3].children = {4};
      model.scene_roots.pop_back();
    }
    mesh = flatten(model);
    known.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  }
  StandingBody body() const { return {model, mesh, known}; }
  // The body at a height.
  std::vector<double> at(double height) const {
    std::vector<double> out = double_positions(mesh.positions);
    for (size_t i = 1; i < out.size(); i += 3) out[i] += height;
    return out;
  }
  double box() const { return SurfaceBox(mesh).diagonal(); }

 private:
  void add(const glm::dvec3& low, const glm::dvec3& high, BodyPart part, int limb, int side) {
    std::vector<glm::dvec3> corners;
    for (int k = 0; k < 8; ++k)
      corners.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
    const Model made = make_model("part", corners, {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6});
    Node node = made.nodes[0];
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(made.meshes[0]);
    model.scene_roots.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(node);
    known.nodes.push_back({part, side, limb});
  }
};

// The second frame is in the air on the source: it does not count.
TEST(TransferFaults, ABodyHoversByTheMeanHeightOfItsSolesWhileTheSourceStands) {
  const Walker walker(false);
  const std::vector<std::vector<double>> source = {walker.at(0), walker.at(0.5), walker.at(0), walker.at(0)};
  const auto hover = [&](double a, double b, double c, double scale = 1) {
    return hover_of(walker.body(), walker.body(), scale, source,
                    {walker.at(a), walker.at(0.9), walker.at(b), walker.at(c)});
  };
  EXPECT_EQ(hover(0, 0, 0), 0);
  EXPECT_NEAR(hover(0.1, 0.2, 0.3), 0.2 / walker.box(), 1e-6);
  EXPECT_NEAR(hover(0.3, -0.4, 0), 0.1 / walker.box(), 1e-6);  // a body that sinks does not hover less
  EXPECT_LT(hover_of(walker.body(), walker.body(), 1, {walker.at(0.5)}, {walker.at(0.5)}), 0);  // nothing stands
  // A source that stands a bit over the ground, scaled.
  EXPECT_NEAR(hover_of(walker.body(), walker.body(), 2, {walker.at(0.02)}, {walker.at(0.1)}), 0.06 / walker.box(),
              1e-6);
  // One that sinks a bit stands. One whose clip puts it as deep as its shins does not.
  EXPECT_NEAR(hover_of(walker.body(), walker.body(), 1, {walker.at(-0.05)}, {walker.at(0.1)}), 0.1 / walker.box(),
              1e-6);
  EXPECT_LT(hover_of(walker.body(), walker.body(), 1, {walker.at(-0.4)}, {walker.at(0.1)}), 0);
}

// The other foot is in the air on both. A knee of the target that is bent down to the ground is no sole.
TEST(TransferFaults, ABodyThatStandsOnOneFootHoversByThatFoot) {
  const Walker walker(false);
  for (const uint32_t lifted : {1u, 2u}) {
    std::vector<double> source = walker.at(0), target = walker.at(0.1);
    for (const FlatPart& part : walker.mesh.parts) {
      for (uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
        if (part.node == static_cast<int>(lifted))
          for (std::vector<double>* frame : {&source, &target}) (*frame)[3 * v + 1] += 0.5;
        else if (part.node > 0 && walker.mesh.positions[v].y > 0.5)
          target[3 * v + 1] = 0;
      }
    }
    EXPECT_NEAR(hover_of(walker.body(), walker.body(), 1, {source}, {target}), 0.1 / walker.box(), 1e-6) << lifted;
  }
}

// A pickaxe that hangs lower than the feet of the source does not say that these are in the air.
TEST(TransferFaults, TheGroundIsUnderTheFeetAndNotUnderWhatAHandHolds) {
  const Walker holds(true), bare(false);
  const std::vector<std::vector<double>> standing = {holds.at(0), holds.at(0), holds.at(0)};
  EXPECT_NEAR(hover_of(holds.body(), bare.body(), 1, standing, {bare.at(0.1), bare.at(0.1), bare.at(0.1)}),
              0.1 / bare.box(), 1e-6);
  // Its feet stand, and those of the target slide by .5 a second.
  std::vector<std::vector<double>> slides = {bare.at(0), bare.at(0), bare.at(0)};
  for (size_t f = 0; f < slides.size(); ++f)
    for (size_t i = 0; i < slides[f].size(); i += 3) slides[f][i] += 0.5 * static_cast<double>(f);
  EXPECT_NEAR(slide_of(holds.body(), bare.body(), 1, {0, 1, 2}, standing, slides), 0.5 / bare.box(), 1e-6);
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
