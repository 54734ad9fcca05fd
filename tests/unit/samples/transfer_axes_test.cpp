// hf_transfer takes axes and scale from skeletons, and says so.
#include <gtest/gtest.h>

#include "gltf/json_file.h"
#include "transfer_program_support.h"

namespace {

using namespace transfer_program;

// A creature whose skin has joints too that control its legs: they are named like them, lead up from the ground and
// move no vertex.
fs::path controlled(const std::string& name) {
  hf_gltf::Model model = hf_gltf::read_gltf(creature(name));
  for (int k = 0; k < 60; ++k) {
    hf_gltf::Node foot, knee;
    foot.name = "foot_ik." + std::to_string(k);
    knee.name = "knee." + std::to_string(k);
    knee.translation = {0, 20, 3};
    const int number = static_cast<int>(model.nodes.size());
    foot.children = {number + 1};
    knee.parent = number;
    model.scene_roots.push_back(number);
    for (const hf_gltf::Node& node : {foot, knee}) {
      model.skins.at(0).joints.push_back(static_cast<int>(model.nodes.size()));
      model.skins.at(0).inverse_bind.emplace_back(1.0f);
      model.nodes.push_back(node);
    }
  }
  const fs::path file = folder() / (name + "_controlled.glb");
  hf_gltf::write_gltf(model, file);
  return file;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

TEST(TransferAxes, ControlJointsDoNotTurnABodyOverAndTheReportSaysWhy) {
  const fs::path out = folder() / "controlled.glb", report = folder() / "controlled.json";
  std::string said;
  ASSERT_EQ(transfer(quoted(controlled("horse")) + " " + quoted(creature("bull")) + " --fps 10 -o " + quoted(out) +
                         " --json " + quoted(report),
                     said),
            0)
      << said;
  const json figures = read_json(report);
  for (const char* side : {"source", "target"}) {
    EXPECT_EQ(figures[side]["up"], "+y") << figures[side];
    EXPECT_EQ(figures[side]["forward"], "+z") << figures[side];
    EXPECT_TRUE(has(figures[side]["said"], "from the skeleton")) << figures[side];
    EXPECT_GE(figures[side]["skeleton"]["up_confidence"], 0.9);
    EXPECT_GE(figures[side]["skeleton"]["why"].size(), 2u);
  }
  EXPECT_EQ(figures["scale_from"], "the surfaces");  // two bodies on four legs
  EXPECT_TRUE(has(said, "legs down")) << said;
}

// The scale is a ratio of lengths: a body twice as large goes twice as far.
TEST(TransferAxes, TheScaleFollowsTheLengthsOfLegs) {
  hf_gltf::Model model = hf_gltf::read_gltf(creature("biped"));
  hf_gltf::Node top;
  top.name = "top";
  top.scale = {2, 2, 2};
  top.children = model.scene_roots;
  const int number = static_cast<int>(model.nodes.size());
  for (const int root : model.scene_roots) model.nodes[static_cast<size_t>(root)].parent = number;
  model.nodes.push_back(top);
  model.scene_roots = {number};
  if (!model.scenes.empty()) model.scenes[model.shown_scene].roots = {number};
  const fs::path large = folder() / "large_biped.glb", report = folder() / "large_biped.json";
  hf_gltf::write_gltf(model, large);
  std::string said;
  ASSERT_EQ(transfer(quoted(creature("biped")) + " " + quoted(large) + " --way surface --fps 5 -o " +
                         quoted(folder() / "large_biped_out.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  EXPECT_NEAR(read_json(report)["scale"].get<double>(), 2, 1e-4);
  EXPECT_EQ(read_json(report)["scale_from"], "the legs of the skeletons");
  EXPECT_TRUE(has(said, "from the legs of the skeletons")) << said;
}

TEST(TransferAxes, APairsFileThatContradictsTheSkeletonIsTakenAndTheReportSaysSo) {
  json file = read_json(pairs("horse_to_bull.json"));
  file["target_axes"] = {{"up", "+y"}, {"forward", {0, 0, -2}}};
  hf_gltf::write_json(folder() / "turned.json", file);
  std::string said;
  const fs::path report = folder() / "turned_report.json";
  ASSERT_EQ(transfer(both() + " --pairs " + quoted(folder() / "turned.json") + " --fps 5 -o " +
                         quoted(folder() / "turned.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  const json figures = read_json(report);
  EXPECT_EQ(figures["target"]["forward"], "-z");
  EXPECT_TRUE(has(figures["target"]["said"], "as the pairs file says"));
  EXPECT_TRUE(has(said, "are taken as given; its skeleton says up +y")) << said;
  EXPECT_TRUE(has(said, "forward +z")) << said;
}

TEST(TransferAxes, DirectionsOfThreeNumbersAreChecked) {
  for (const auto& [forward, part] :
       {std::pair<json, const char*>({0, 0, 0}, "three zeros"), {{1, 0}, "forward"}, {{0, 1, 1}, "right angle"}}) {
    json file = read_json(pairs("horse_to_bull.json"));
    file["target_axes"] = {{"up", "+y"}, {"forward", forward}};
    hf_gltf::write_json(folder() / "bad_axes.json", file);
    std::string said;
    EXPECT_EQ(
        transfer(both() + " --pairs " + quoted(folder() / "bad_axes.json") + " -o " + quoted(folder() / "bad_axes.glb"),
                 said),
        1);
    EXPECT_TRUE(has(said, part)) << said;
    EXPECT_TRUE(has(said, "bad_axes.json")) << said;
  }
}

}  // namespace
