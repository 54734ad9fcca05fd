// hf_weights run as a user runs it: a skinned cylinder gets new weights, pins and kept joints hold, and what bad input
// is answered.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "gltf/gltf_read.h"
#include "gltf/gltf_write.h"
#include "gltf/json_file.h"
#include "gltf/skin_write.h"
#include "support/program_support.h"
#include "unit/gltf/gltf_support.h"

namespace {

namespace fs = std::filesystem;
using namespace hf_gltf;
using samples_test::TemporaryFolder;

constexpr uint32_t around = 12, rings = 21;

int run(const std::string& arguments, std::string& output) {
  return hf_test::run(hf_test::quoted(HF_WEIGHTS_PROGRAM) + " " + arguments, output);
}

// A cylinder of length 20 with a joint near either end; each half belongs to one of them. The clip turns the second.
Model bent() {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t k = 0; k < around; ++k)
      positions.push_back({i, std::cos(2 * M_PI * k / around), std::sin(2 * M_PI * k / around)});
  }
  for (uint32_t i = 0; i + 1 < rings; ++i) {
    for (uint32_t k = 0; k < around; ++k) {
      const uint32_t a = i * around + k, b = i * around + (k + 1) % around;
      triangles.insert(triangles.end(), {a, b, b + around, a, b + around, a + around});
    }
  }
  const Model source = make_model("cylinder", positions, triangles);
  SkinDescription skin;
  skin.joints = {{"left", {5, 0, 0}}, {"right", {15, 0, 0}}};
  skin.influences_per_vertex = 1;
  for (size_t v = 0; v < positions.size(); ++v) {
    skin.vertex_joints.push_back(positions[v].x > 10 ? 1 : 0);
    skin.vertex_weights.push_back(1);
  }
  SkinClip clip;
  clip.name = "turn";
  clip.times = {0, 1};
  const glm::dquat still(1, 0, 0, 0), turned = glm::angleAxis(0.5, glm::dvec3(1, 0, 0));
  clip.rotations = {still, still, still, turned};
  clip.translations.assign(4, glm::dvec3(0));
  skin.clips = {clip};
  return skin_model(source, flatten(source), skin);
}

TEST(WeightsProgram, ComputesComparesAndKeeps) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return "\"" + (folder.path / name).string() + "\""; };
  write_gltf(bent(), folder.path / "in.glb");
  std::string text;
  ASSERT_EQ(run(path("in.glb") + " -o " + path("out.glb") + " --report " + path("report.json") + " --sheet " +
                    path("sheet.png"),
                text),
            0)
      << text;
  EXPECT_NE(text.find("bare: 0"), std::string::npos) << text;
  EXPECT_GT(fs::file_size(folder.path / "sheet.png"), 10000u);
  const JsonFile report(folder.path / "report.json");
  EXPECT_EQ(report.root().at("bare").integer(0, 1000000), 0);
  EXPECT_EQ(report.root().at("bones").size(), 2u);
  EXPECT_GT(report.root().at("distance").at("mean").number(), 0.01);  // it blends where the file does not
  const Model out = read_gltf(folder.path / "out.glb");
  const Primitive& primitive = out.meshes[0].primitives[0];
  ASSERT_EQ(primitive.influences.size(), around * rings);
  EXPECT_GT(primitive.influences[2 * around].weights[0], 0.95f);
  EXPECT_NEAR(primitive.influences[10 * around].weights[0], 0.5, 0.05);

  ASSERT_EQ(run(path("in.glb") + " --keep left --table", text), 0) << text;
  EXPECT_NE(text.find(" 0.000 "), std::string::npos) << text;  // what left keeps, right takes the rest of
  std::ofstream(folder.path / "pins.json") << R"({"pins": [{"vertex": 24, "weights": {"right": 1}}, {"vertex": 130}]})";
  ASSERT_EQ(run(path("in.glb") + " --pins " + path("pins.json") + " -o " + path("pinned.glb"), text), 0) << text;
  const Model pinned = read_gltf(folder.path / "pinned.glb");
  EXPECT_EQ(pinned.meshes[0].primitives[0].influences[24].joints[0], 1);
  EXPECT_EQ(pinned.meshes[0].primitives[0].influences[24].weights[0], 1.0f);
  ASSERT_EQ(run(path("in.glb") + " --guide 3", text), 0) << text;
  EXPECT_NE(text.find("3 pinned"), std::string::npos) << text;
}

// A second node has the cylinder's mesh, with joints and a skin of its own.
Model two_skins(bool reversed) {
  Model model = bent();
  const std::vector<int> joints = model.skins[0].joints;
  Skin second = model.skins[0];
  for (size_t j = 0; j < joints.size(); ++j) {
    Node node = model.nodes[static_cast<size_t>(joints[j])];
    node.name += " 2";
    node.parent = -1;
    node.children.clear();
    second.joints[j] = static_cast<int>(model.nodes.size());
    model.scene_roots.push_back(second.joints[j]);
    model.nodes.push_back(node);
  }
  if (reversed) {
    std::reverse(second.joints.begin(), second.joints.end());
    std::reverse(second.inverse_bind.begin(), second.inverse_bind.end());
  }
  const auto first =
      std::find_if(model.nodes.begin(), model.nodes.end(), [](const Node& node) { return node.mesh >= 0; });
  Node other = *first;
  other.name = "other";
  other.skin = 1;
  other.parent = -1;
  other.children.clear();
  model.scene_roots.push_back(static_cast<int>(model.nodes.size()));
  model.nodes.push_back(other);
  model.skins.push_back(second);
  return model;
}

// Each skin by itself: the weights are those of the cylinder alone, though joints and surfaces lie on one another. The
// mesh is copied where the skins count their joints in another order.
TEST(WeightsProgram, OneMeshUnderTwoSkinsIsComputedForEach) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return "\"" + (folder.path / name).string() + "\""; };
  std::string text;
  write_gltf(bent(), folder.path / "alone.glb");
  ASSERT_EQ(run(path("alone.glb") + " -o " + path("alone_out.glb"), text), 0) << text;
  const Model alone = read_gltf(folder.path / "alone_out.glb");
  const std::vector<Influences>& expected = alone.meshes[0].primitives[0].influences;
  for (const bool reversed : {false, true}) {
    write_gltf(two_skins(reversed), folder.path / "two.glb");
    ASSERT_EQ(run(path("two.glb") + " -o " + path("out.glb") + " --report " + path("report.json"), text), 0) << text;
    EXPECT_EQ(text.find("1 coincident"), std::string::npos) << text;
    EXPECT_EQ(JsonFile(folder.path / "report.json").root().at("skeletons").size(), 2u);
    const Model out = read_gltf(folder.path / "out.glb");
    EXPECT_EQ(out.meshes.size(), reversed ? 2u : 1u);
    for (const Node& node : out.nodes) {
      if (node.mesh < 0) continue;
      const std::vector<Influences>& got = out.meshes[static_cast<size_t>(node.mesh)].primitives[0].influences;
      ASSERT_EQ(got.size(), expected.size());
      for (size_t v = 0; v < got.size(); ++v) {
        for (size_t k = 0; k < 4; ++k) {
          EXPECT_EQ(got[v].weights[k], expected[v].weights[k]) << node.name << v;
          if (!(got[v].weights[k] > 0)) continue;
          EXPECT_EQ(got[v].joints[k], reversed && node.skin == 1 ? 1 - expected[v].joints[k] : expected[v].joints[k]);
        }
      }
    }
  }
}

// A sleeve without joints takes those of the cylinder, and its weights; the cylinder's halves mirror each other.
TEST(WeightsProgram, CarriesMirrorsAndTakesSkeletons) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return "\"" + (folder.path / name).string() + "\""; };
  const Model body = bent();
  write_gltf(body, folder.path / "in.glb");
  std::vector<glm::dvec3> positions;
  for (const glm::vec3& p : body.meshes[0].primitives[0].positions) positions.push_back({p.x, 1.05 * p.y, 1.05 * p.z});
  write_gltf(make_model("sleeve", positions, body.meshes[0].primitives[0].indices), folder.path / "sleeve.glb");
  std::string text;
  ASSERT_EQ(run(path("sleeve.glb") + " --carry " + path("in.glb") + " -o " + path("worn.glb") + " --report " +
                    path("report.json"),
                text),
            0)
      << text;
  EXPECT_NE(text.find("252 matched"), std::string::npos) << text;
  EXPECT_NE(text.find("the file has no weights"), std::string::npos) << text;
  const Model worn = read_gltf(folder.path / "worn.glb");
  ASSERT_EQ(worn.skins.size(), 1u);
  EXPECT_EQ(worn.nodes[static_cast<size_t>(worn.skins[0].joints[1])].name, "right");
  EXPECT_EQ(worn.meshes[0].primitives[0].influences[5].joints[0], 0);
  EXPECT_EQ(worn.meshes[0].primitives[0].influences[250].joints[0], 1);
  const JsonFile report(folder.path / "report.json");
  EXPECT_EQ(report.root().at("carry").at("matched").integer(0, 1000), 252);
  EXPECT_EQ(report.root().at("bones").at(0).at("helper").boolean(), false);

  ASSERT_EQ(run(path("in.glb") + " --mirror negative", text), 0) << text;
  EXPECT_NE(text.find("plane of the joints; joints: 2 by name"), std::string::npos) << text;
  ASSERT_EQ(run(path("sleeve.glb") + " --skeleton " + path("in.glb") + " -o " + path("own.glb"), text), 0) << text;
  const Model own = read_gltf(folder.path / "own.glb");
  EXPECT_NEAR(own.nodes[static_cast<size_t>(own.skins[0].joints[1])].translation.x, 15, 1e-4);
  EXPECT_EQ(run(path("in.glb") + " --skeleton " + path("in.glb"), text), 1);
  EXPECT_NE(text.find("has joints"), std::string::npos) << text;
  ASSERT_EQ(run(path("in.glb") + " --bend right,x,90 --sheet " + path("bend.png"), text), 0) << text;
  EXPECT_NE(text.find("1 poses"), std::string::npos) << text;
  for (const char* wrong : {"nose,x,90", "right,w,90", "right,x,far", "right", ",x,1", "x,1"}) {
    EXPECT_EQ(run(path("in.glb") + " --bend " + wrong, text), 1) << wrong;
    EXPECT_NE(text.find("--bend"), std::string::npos) << text;
  }
  EXPECT_EQ(run(path("in.glb") + " --mirror up", text), 1);
  EXPECT_NE(text.find("--mirror"), std::string::npos) << text;
}

uint32_t width_of_png(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  uint8_t head[24] = {};
  in.read(reinterpret_cast<char*>(head), sizeof head);
  return static_cast<uint32_t>(head[18] << 8 | head[19]);
}

// The joints of a straight body lay beside an arched one, and only a count of bones said so. The sheet had empty
// columns.
TEST(WeightsProgram, WarnsOfASkeletonThatDoesNotFit) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return "\"" + (folder.path / name).string() + "\""; };
  const Model body = bent();
  write_gltf(body, folder.path / "in.glb");
  const std::vector<uint32_t>& triangles = body.meshes[0].primitives[0].indices;
  std::vector<glm::dvec3> straight, arched;
  for (const glm::vec3& p : body.meshes[0].primitives[0].positions) {
    straight.push_back(glm::dvec3(p));
    arched.push_back({p.x, static_cast<double>(p.y) + 0.2 * std::pow(static_cast<double>(p.x) - 10, 2), p.z});
  }
  write_gltf(make_model("straight", straight, triangles), folder.path / "straight.glb");
  write_gltf(make_model("arched", arched, triangles), folder.path / "arched.glb");
  std::string text;
  ASSERT_EQ(run(path("straight.glb") + " --skeleton " + path("in.glb"), text), 0) << text;
  EXPECT_EQ(text.find("warning"), std::string::npos) << text;
  ASSERT_EQ(run(path("arched.glb") + " --skeleton " + path("in.glb") + " --sheet " + path("own.png"), text), 0) << text;
  EXPECT_NE(text.find("of 2 joints lie outside the mesh, so the skeleton does not fit this body; give --pairs"),
            std::string::npos)
      << text;
  ASSERT_EQ(run(path("in.glb") + " --sheet " + path("in.png"), text), 0) << text;
  EXPECT_LT(3 * width_of_png(folder.path / "own.png"), 2 * width_of_png(folder.path / "in.png") + 300)
      << "two columns, not three";
}

// A node below the last joint says where it ends. Without it, the joint ends 1.5 times as far as its parent is long.
TEST(WeightsProgram, ReadsWhereJointsEnd) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return "\"" + (folder.path / name).string() + "\""; };
  Model model = bent();
  const auto right = static_cast<size_t>(model.skins[0].joints[1]);
  for (const char* name : {"right_end", "other_end.001", "RightTip", "hook"}) {
    Model ends = model;
    Node end;
    end.name = name;
    end.parent = static_cast<int>(right);
    end.translation = {0, 3, 0};
    ends.nodes[right].children.push_back(static_cast<int>(ends.nodes.size()));
    ends.nodes.push_back(end);
    write_gltf(ends, folder.path / "ends.glb");
    std::string text;
    ASSERT_EQ(run(path("ends.glb") + " --report " + path("ends.json") + " -o " + path("out.glb"), text), 0) << text;
    EXPECT_NE(text.find("2 joints"), std::string::npos) << text;
    const JsonFile report(folder.path / "ends.json");
    EXPECT_EQ(report.root().at("joints").integer(0, 9), 2);
    EXPECT_EQ(report.root().at("bones").size(), 2u);
    EXPECT_EQ(report.root().at("ends").integer(0, 9), std::string(name) == "hook" ? 0 : 1) << name;
    EXPECT_EQ(read_gltf(folder.path / "out.glb").skins[0].joints.size(), 2u);
  }
}

TEST(WeightsProgram, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return "\"" + (folder.path / name).string() + "\""; };
  write_gltf(bent(), folder.path / "in.glb");
  std::string text;
  EXPECT_EQ(run("", text), 1);
  EXPECT_NE(text.find("no model"), std::string::npos) << text;
  EXPECT_EQ(run(path("in.glb") + " --keep nose", text), 1);
  EXPECT_NE(text.find("nose"), std::string::npos) << text;
  EXPECT_EQ(run(path("in.glb") + " --weights 5", text), 1);
  EXPECT_NE(text.find("influence_count is 5"), std::string::npos) << text;
  std::ofstream(folder.path / "pins.json") << R"({"pins": [{"vertex": 9999}]})";
  EXPECT_EQ(run(path("in.glb") + " --pins " + path("pins.json"), text), 1);
  EXPECT_NE(text.find("pins[0].vertex"), std::string::npos) << text;
  const Model still = make_model("still", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2});
  write_gltf(still, folder.path / "still.glb");
  EXPECT_EQ(run(path("still.glb"), text), 1);
  EXPECT_NE(text.find("no skin"), std::string::npos) << text;
}

}  // namespace
