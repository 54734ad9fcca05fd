// Which way a motion goes, by the skeleton or by the surface, and what the skeleton's way keeps and gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "assets/creature_rig.h"
#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

fs::path written(const hf_gltf::Model& model, const std::string& name) {
  const fs::path file = folder() / name;
  hf_gltf::write_gltf(model, file);
  return file;
}

hf_gltf::Model rigged(const std::string& name) { return samples::to_model(samples::make_rigged(name, 800)); }

hf_gltf::Model biped() { return samples::to_model(hf_test::creature("biped", 800)); }

// Runs it on the biped's walk; the report.
json walked(const fs::path& target, const std::string& name, const std::string& more, int code = 0) {
  static const fs::path source = written(biped(), "way_biped.glb");
  const fs::path report = folder() / (name + ".json");
  std::string said;
  EXPECT_EQ(transfer(quoted(source) + " " + quoted(target) + " --clip walk --fps 12 -o " +
                         quoted(folder() / (name + ".glb")) + " --json " + quoted(report) + " " + more,
                     said),
            code)
      << said;
  if (code != 0) return said;
  json out = read_json(report);
  out["said"] = said;
  return out;
}

// Two bodies with other names, other rests and other proportions.
TEST(TransferWay, TheSkeletonLeadsWhereLimbsMatch) {
  for (const std::string& name : samples::rigged_names()) {
    const json figures = walked(written(rigged(name), name + ".glb"), name + "_walk", "");
    EXPECT_EQ(figures["way"], "skeleton") << name;
    const json clip = figures["clips"][0];
    EXPECT_LT(clip["limbs"]["degrees"], 3) << name;
    double sum = 0;
    for (const json& limb : clip["limbs"]["each"]) sum += limb["mean"].get<double>();
    EXPECT_NEAR(clip["limbs"]["degrees"].get<double>(), sum / 4, 1e-9) << name;
    EXPECT_EQ(clip["limbs"]["partners"], 4) << name;
    EXPECT_LT(clip["depth"], 0.003) << name;
    EXPECT_GT(clip["confidence"], 0.8) << name;
    EXPECT_TRUE(has(figures["said"], "limbs         follow the source to ")) << figures["said"];
  }
}

// A run whose hands hang low, on a body with a sword in its hand.
// Legs alone follow. An artist sees arms in the T pose, so the run may not be sure.
TEST(TransferWay, ArmsThatNothingFollowsLowerTheConfidence) {
  hf_gltf::Model bare = rigged("biped_tall");
  for (hf_gltf::Node& node : bare.nodes) {
    if (has(node.name, "Arm") || has(node.name, "Hand") || has(node.name, "Shoulder")) node.name += "_ribbon";
  }
  const json figures = walked(written(bare, "bare.glb"), "bare_walk", "");
  EXPECT_EQ(figures["way"], "skeleton");
  EXPECT_EQ(figures["clips"][0]["limbs"]["partners"], 2);
  EXPECT_EQ(figures["clips"][0]["limbs"]["of"], 4);
  EXPECT_LT(figures["clips"][0]["confidence"], 0.7);
  EXPECT_TRUE(has(figures["said"], "of the arms and legs of one body have no partner")) << figures["said"];
}

// A body without arms has none to move.
TEST(TransferWay, ArmsThatTheTargetDoesNotHaveAreNoFault) {
  hf_gltf::Model bare = rigged("biped_tall");
  const std::vector<int>& joints = bare.skins[0].joints;
  const auto is_arm = [&](uint16_t joint) {
    const std::string& name = bare.nodes[static_cast<size_t>(joints[joint])].name;
    return has(name, "Arm") || has(name, "Hand") || has(name, "Shoulder");
  };
  const auto chest = std::find_if(joints.begin(), joints.end(),
                                  [&](int node) { return has(bare.nodes[static_cast<size_t>(node)].name, "Spine2"); });
  ASSERT_NE(chest, joints.end());
  for (hf_gltf::MeshData& mesh : bare.meshes)
    for (hf_gltf::Primitive& primitive : mesh.primitives)
      for (hf_gltf::Influences& influences : primitive.influences)
        for (size_t k = 0; k < 8; ++k)
          if (is_arm(influences.joints[k])) influences.joints[k] = static_cast<uint16_t>(chest - joints.begin());
  const json figures = walked(written(bare, "armless.glb"), "armless_walk", "");
  EXPECT_EQ(figures["way"], "skeleton");
  EXPECT_EQ(figures["clips"][0]["limbs"]["partners"], 2);
  EXPECT_GT(figures["clips"][0]["confidence"], 0.8);
}

TEST(TransferWay, ASwordInTheGroundIsSaidAndTheBodyIsNot) {
  const fs::path source = data() / "q_KnightCharacter.glb", target = data() / "kk_Knight.glb";
  if (!fs::exists(source) || !fs::exists(target))
    GTEST_SKIP() << "the optional shared data is not there (HF_SHARED_DATA)";
  std::string said;
  const fs::path report = folder() / "sword.json";
  ASSERT_EQ(transfer(quoted(source) + " " + quoted(target) + " --clip \"HumanArmature|Run_swordRight\" --fps 12 -o " +
                         quoted(folder() / "sword.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  const json clip = read_json(report)["clips"][0];
  EXPECT_GT(clip["faults"]["held"], 0.05);
  EXPECT_LT(clip["faults"]["sunk"], 0.005);
  EXPECT_LT(clip["confidence"], 0.7);
  EXPECT_TRUE(has(said, "what a hand holds is")) << said;
}

// A box beside the skeleton, as a node of the scene.
void add_box(hf_gltf::Model& model, const char* name, const glm::dvec3& low, const glm::dvec3& high) {
  std::vector<glm::dvec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
  const hf_gltf::Model made =
      hf_gltf::make_model(name, corners, {0, 1, 3, 0, 3, 2, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4});
  hf_gltf::Node node = made.nodes[0];
  node.name = name;
  node.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(made.meshes[0]);
  model.scene_roots.push_back(static_cast<int>(model.nodes.size()));
  if (!model.scenes.empty()) model.scenes[model.shown_scene].roots = model.scene_roots;
  model.nodes.push_back(node);
}

// No clip says where a hat rides, so it stays behind. A tree, the ground and a house around the body may.
TEST(TransferWay, AHatThatStaysBehindIsAFaultAndSceneryIsNone) {
  hf_gltf::Model body = rigged("biped_tall");
  body.animations.clear();
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(body);
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 size = high - low, top(0.5 * (low.x + high.x), high.y, 0.5 * (low.z + high.z));
  hf_gltf::Model scene = body;
  add_box(scene, "tree", low + glm::dvec3(1.6 * size.x, 0, 0), high + glm::dvec3(1.2 * size.x, 0, 0));
  add_box(scene, "ground", low - glm::dvec3(0.1 * size.y), {high.x + 0.1 * size.y, low.y, high.z + 0.1 * size.y});
  add_box(scene, "house", low - 0.2 * size, high + 0.2 * size);
  hf_gltf::Model hat = scene;
  add_box(hat, "hat", top - 0.05 * size.y, top + 0.1 * size.y);
  const json plain = walked(written(body, "no_hat.glb"), "no_hat_walk", ""),
             among = walked(written(scene, "scene.glb"), "scene_walk", ""),
             worn = walked(written(hat, "hat.glb"), "hat_walk", "");
  EXPECT_GT(plain["clips"][0]["confidence"], 0.8);
  EXPECT_GT(among["clips"][0]["confidence"], 0.8);
  EXPECT_EQ(among["clips"][0]["faults"]["gap"], 0);
  EXPECT_FALSE(has(among["said"], "rides, so it stays")) << among["said"];
  EXPECT_GT(worn["clips"][0]["faults"]["gap"], 0.005);
  EXPECT_LT(worn["clips"][0]["confidence"], plain["clips"][0]["confidence"]);
  EXPECT_TRUE(has(worn["said"], "on which joint \"hat\" rides, so it stays")) << worn["said"];
  for (const char* name : {"tree", "ground", "house"})
    EXPECT_FALSE(has(worn["said"], (std::string("on which joint \"") + name).c_str())) << worn["said"];
}

json played(const char* source, const char* clip, const char* target, const char* name, const std::string& more = "") {
  std::string said;
  const fs::path report = folder() / (std::string(name) + ".json");
  EXPECT_EQ(transfer(quoted(data() / source) + " " + quoted(data() / target) + " --clip \"" + clip + "\" --fps 12 -o " +
                         quoted(folder() / (std::string(name) + ".glb")) + " --json " + quoted(report) + more,
                     said),
            0)
      << said;
  json out = read_json(report);
  out["said"] = said;
  return out;
}

// A fish of boxes, one for each joint, and a clip in which it dives and flaps.
hf_gltf::Model diving_fish() {
  struct Bone {
    const char* name;
    int parent;
    glm::dvec3 at, to;
    double thick;
  };
  std::vector<Bone> bones = {{"Spine1", -1, {0, 1, 0}, {0, 1, 0.5}, 0.2},
                             {"Head", 0, {0, 1, 0.5}, {0, 1, 0.9}, 0.2},
                             {"Tail1", 0, {0, 1, 0}, {0, 1, -0.7}, 0.08},
                             {"Tail2", 2, {0, 1, -0.7}, {0, 1, -1.3}, 0.05}};
  for (const double s : {1.0, -1.0}) {
    const int first = static_cast<int>(bones.size());
    bones.push_back({s > 0 ? "TopFlipper.L" : "TopFlipper.R", 0, {0.2 * s, 1, 0.2}, {0.7 * s, 0.95, 0.15}, 0.06});
    bones.push_back({s > 0 ? "MidFlipper.L" : "MidFlipper.R", first, {0.7 * s, 0.95, 0.15}, {1.2 * s, 0.8, 0.1}, 0.04});
    bones.push_back(
        {s > 0 ? "BottomFlipper.L" : "BottomFlipper.R", first + 1, {1.2 * s, 0.8, 0.1}, {1.5 * s, 0.6, 0}, 0.03});
  }
  std::vector<glm::dvec3> points;
  std::vector<uint32_t> triangles;
  for (const Bone& bone : bones) {
    const auto first = static_cast<uint32_t>(points.size());
    const glm::dvec3 low = glm::min(bone.at, bone.to) - bone.thick, high = glm::max(bone.at, bone.to) + bone.thick;
    for (int k = 0; k < 8; ++k)
      points.emplace_back(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
    for (const uint32_t corner :
         {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5})
      triangles.push_back(first + corner);
  }
  hf_gltf::Model model = hf_gltf::make_model("fish", points, triangles);
  hf_gltf::Skin skin;
  hf_gltf::Animation dive;
  dive.name = "dive";
  const auto channel = [&](int node, hf_gltf::Path path, size_t width, std::vector<float> values) {
    hf_gltf::Channel out;
    out.node = node;
    out.path = path;
    out.width = width;
    out.times = {0, 0.5f, 1};
    out.values = std::move(values);
    dive.channels.push_back(out);
  };
  for (size_t b = 0; b < bones.size(); ++b) {
    hf_gltf::Node node;
    node.name = bones[b].name;
    node.parent = bones[b].parent < 0 ? -1 : bones[b].parent + 1;
    node.translation =
        glm::vec3(bones[b].at - (bones[b].parent < 0 ? glm::dvec3(0) : bones[size_t(bones[b].parent)].at));
    const int number = static_cast<int>(model.nodes.size());
    if (node.parent < 0)
      model.scene_roots.push_back(number);
    else
      model.nodes[static_cast<size_t>(node.parent)].children.push_back(number);
    model.nodes.push_back(node);
    skin.joints.push_back(number);
    glm::mat4 inverse(1);
    inverse[3] = glm::vec4(glm::vec3(-bones[b].at), 1);
    skin.inverse_bind.push_back(inverse);
    if (b == 0) channel(number, hf_gltf::Path::translation, 3, {0, 1, 0, 0, 0.6f, 0.5f, 0, 1, 1});
    const float up = node.name == "TopFlipper.L" ? 0.26f : node.name == "TopFlipper.R" ? -0.26f : 0;
    if (up != 0)
      channel(number, hf_gltf::Path::rotation, 4, {0, 0, 0, 1, 0, 0, up, std::sqrt(1 - up * up), 0, 0, 0, 1});
  }
  if (!model.scenes.empty()) model.scenes[model.shown_scene].roots = model.scene_roots;
  model.nodes[0].skin = 0;
  model.skins.push_back(skin);
  for (size_t v = 0; v < points.size(); ++v) {
    hf_gltf::Influences influences;
    influences.joints[0] = static_cast<uint16_t>(v / 8);
    influences.weights[0] = 1;
    model.meshes[0].primitives[0].influences.push_back(influences);
  }
  model.animations.push_back(dive);
  return model;
}

// Nothing is under a fish, so a body that dives with it is not deep in the ground, and nothing lifts it.
TEST(TransferWay, AFishHasNoGround) {
  const hf_gltf::Model fish = diving_fish();
  hf_gltf::Model still = rigged("biped_tall");
  still.animations.clear();
  std::string said;
  const fs::path report = folder() / "dive.json";
  ASSERT_EQ(transfer(quoted(written(fish, "fish.glb")) + " " + quoted(written(still, "still.glb")) +
                         " --way skeleton -o " + quoted(folder() / "dive.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  const json clip = read_json(report)["clips"][0];
  EXPECT_EQ(clip["faults"]["sunk"], 0);
  EXPECT_EQ(clip["depth"], 0);
  EXPECT_FALSE(has(said, "under the ground")) << said;
  const hf_gltf::Model made = hf_gltf::read_gltf(folder() / "dive.glb");
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(made);
  const auto lowest = [&](double time) {
    double low = 1e300;
    for (const glm::dvec3& p : hf_gltf::posed_positions(made, mesh, made.animations[0], time)) low = std::min(low, p.y);
    return low;
  };
  std::printf("lowest %.4f, in the dive %.4f\n", lowest(0), lowest(0.5));
  EXPECT_LT(lowest(0.5), lowest(0) - 0.05);
}
// In the second half of its clip the source sinks by a tenth of its box. The arms of the target have no partner.
TEST(TransferWay, HowDeepTheSourceGoesAndWhatStaysIsTold) {
  hf_gltf::Model sinking = biped();
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : hf_gltf::flatten(sinking).positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  for (hf_gltf::Channel& channel : sinking.animations[0].channels) {
    if (channel.path != hf_gltf::Path::translation) continue;
    for (size_t k = channel.times.size() / 2; k < channel.times.size(); ++k)
      channel.values[3 * k + 1] -= static_cast<float>(0.1 * glm::length(high - low));
  }
  hf_gltf::Model bare = rigged("biped_tall");
  std::set<std::string> still;
  for (const int joint : bare.skins[0].joints) {
    hf_gltf::Node& node = bare.nodes[static_cast<size_t>(joint)];
    if (node.name == "Armature") continue;  // it moves no vertex
    if (has(node.name, "Arm") || has(node.name, "Hand") || has(node.name, "Shoulder")) {
      node.name += "_ribbon";
      still.insert(node.name);
    }
  }
  const fs::path source = written(sinking, "sinking.glb"), target = written(bare, "still_arms.glb");
  const fs::path report = folder() / "sinks.json";
  std::string said;
  ASSERT_EQ(transfer(quoted(source) + " " + quoted(target) + " --clip walk --fps 12 -o " +
                         quoted(folder() / "sinks.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  const json told = read_json(report);
  // in boxes of the target, which is slimmer
  EXPECT_NEAR(told["clips"][0]["source_depth"].get<double>(), 0.105, 0.01);
  EXPECT_LT(told["clips"][0]["depth"].get<double>(), 0.005);
  EXPECT_TRUE(has(said, "whose motion goes 10.")) << said;
  EXPECT_EQ(told["staying"].get<std::set<std::string>>(), still);
  EXPECT_TRUE(has(said, "of the target stay as they rest")) << said;

  const json level = walked(target, "level_walk", "");
  EXPECT_LT(level["clips"][0]["source_depth"].get<double>(), 0.01);
  EXPECT_FALSE(has(level["said"], "whose motion goes")) << level["said"];
}

// A person on a machine with bird's legs floats when its legs point as the person's. With its feet on the scaled path
// it stands. Another one hardly stands on that path, and keeps the way its legs point.
TEST(TransferWay, OfTwoMotionsOfTheFeetTheBetterOneIsWritten) {
  if (!fs::exists(data() / "q_Enemy_2Legs.glb") || !fs::exists(data() / "kenney.glb"))
    GTEST_SKIP() << "the optional shared data is not there (HF_SHARED_DATA)";
  const json led = played("mannequiny.glb", "run_root.001", "q_Enemy_2Legs.glb", "led");
  EXPECT_TRUE(has(led["said"], "feet follow the scaled path")) << led["said"];
  EXPECT_LT(led["clips"][0]["faults"]["hover"], 0.02);
  const json points = played("kenney.glb", "walk", "q_Enemy_2Legs.glb", "points");
  EXPECT_FALSE(has(points["said"], "feet follow the scaled path")) << points["said"];
}

// Without a folder for files of a trial the motion of the surface is written.
TEST(TransferWay, ATrialThatFailsLeavesTheMotionOfTheSurface) {
  if (!fs::exists(data() / "q_Cow.glb") || !fs::exists(data() / "farm_Pug.glb"))
    GTEST_SKIP() << "the optional shared data is not there (HF_SHARED_DATA)";
  const json tried = played("q_Cow.glb", "Walk", "farm_Pug.glb", "trial");
  EXPECT_EQ(tried["way"], "skeleton");
#ifndef _WIN32
  const char* const before = std::getenv("TMPDIR");
  const std::string was = before ? before : "";
  setenv("TMPDIR", (folder() / "no folder").c_str(), 1);
  const json failed = played("q_Cow.glb", "Walk", "farm_Pug.glb", "no_trial");
  if (before)
    setenv("TMPDIR", was.c_str(), 1);
  else
    unsetenv("TMPDIR");
  EXPECT_EQ(failed["way"], "surface");
  EXPECT_TRUE(has(failed["said"], "joints were tried too, and failed")) << failed["said"];
  EXPECT_TRUE(fs::exists(folder() / "no_trial.glb"));
#endif
}

// Their arms have the same joints, but the one nearest to the middle is another joint in each.
TEST(TransferWay, LimbsOfTheSameJointsAreComparedJointByJoint) {
  const fs::path source = data() / "q_Trex.glb", target = data() / "q_Velociraptor.glb";
  if (!fs::exists(source) || !fs::exists(target))
    GTEST_SKIP() << "the optional shared data is not there (HF_SHARED_DATA)";
  std::string said;
  const fs::path report = folder() / "raptor.json";
  ASSERT_EQ(transfer(quoted(source) + " " + quoted(target) + " --clip \"Armature|TRex_Walk\" --fps 12 -o " +
                         quoted(folder() / "raptor.glb") + " --json " + quoted(report),
                     said),
            0)
      << said;
  const json clip = read_json(report)["clips"][0];
  EXPECT_LT(clip["limbs"]["degrees"], 10);
  EXPECT_GT(clip["confidence"], 0.7);
}

TEST(TransferWay, TheWayIsTakenAsAskedAndTheReportSaysWhy) {
  const fs::path target = written(rigged("biped_tall"), "way_tall.glb");
  const json surface = walked(target, "asked_surface", "--way surface");
  EXPECT_EQ(surface["way"], "surface");
  EXPECT_TRUE(has(surface["said"], "way           surface: as asked"));
  EXPECT_GT(surface["pairs"].size(), 4u);
  const json skin = walked(target, "asked_skin", "--as skin");
  EXPECT_EQ(skin["way"], "surface");
  EXPECT_TRUE(has(skin["way_why"], "--as skin"));
  EXPECT_TRUE(has(walked(target, "refused_skin", "--way skeleton --as skin", 1), "--as skin"));
  EXPECT_TRUE(has(walked(target, "refused_word", "--way bones", 1), "--way takes skeleton or surface"));
  EXPECT_TRUE(has(walked(target, "refused_dial", "--way skeleton --dials neck_follow=1", 1), "neck_follow"));
  // a body on four legs has other limbs
  EXPECT_TRUE(has(walked(creature("bull"), "refused_bull", "--way skeleton", 1), "legs"));
}

TEST(TransferWay, FourLegsGoByTheSurfaceUnlessAsked) {
  const auto way = [](const std::string& name, const std::string& more) {
    std::string said;
    const fs::path report = folder() / (name + ".json");
    EXPECT_EQ(transfer(both() + " --clip walk --fps 5 -o " + quoted(folder() / (name + ".glb")) + " --json " +
                           quoted(report) + more,
                       said),
              0)
        << said;
    return read_json(report)["way"].get<std::string>();
  };
  EXPECT_EQ(way("four_default", ""), "surface");
  EXPECT_EQ(way("four_skeleton", " --way skeleton"), "skeleton");
}

// The walk of a body on the same body without clips, all joints with one name, under nodes of no skin: the surface of
// the result is that of the source.
TEST(TransferWay, TheSameSkeletonTakesTheKeysWhateverItsNames) {
  for (const bool named : {true, false}) {
    hf_gltf::Model source = biped();
    if (!named)
      for (hf_gltf::Node& node : source.nodes) node.name = "bone";
    hf_gltf::Model target = source;
    target.animations.clear();
    const fs::path from = written(source, "same_source.glb"), to = written(target, "same_target.glb"),
                   out = folder() / "same.glb", report = folder() / "same.json";
    std::string said;
    ASSERT_EQ(transfer(quoted(from) + " " + quoted(to) + " --clip walk -o " + quoted(out) + " --json " +
                           quoted(report) + " --way skeleton",
                       said),
              0)
        << said;
    EXPECT_TRUE(read_json(report)["same_skeleton"].get<bool>());
    const hf_gltf::Model made = hf_gltf::read_gltf(out);
    const hf_gltf::FlatMesh mesh = hf_gltf::flatten(source), again = hf_gltf::flatten(made);
    const double box = hf_gltf::SurfaceBox(mesh).diagonal();
    const auto& clip = source.animations[static_cast<size_t>(hf_gltf::find_animation(source, "walk"))];
    double worst = 0;
    for (const double time : {0.0, 0.013, 0.31, 0.77, 1.05}) {
      const auto a = hf_gltf::posed_positions(source, mesh, clip, time),
                 b = hf_gltf::posed_positions(made, again, made.animations[0], time);
      ASSERT_EQ(a.size(), b.size());
      for (size_t v = 0; v < a.size(); ++v) worst = std::max(worst, glm::distance(a[v], b[v]));
    }
    EXPECT_LE(worst, 1e-5 * box) << named;
  }
}

// All but the joints' keys is as it was: meshes, morph targets, two skins with the same joints, extensions, extras.
TEST(TransferWay, WhatTheTargetHoldsBesideItsJointsStays) {
  hf_gltf::Model target = rigged("biped_small");
  target.carried.extensions = R"({"VRMC_vrm":{"specVersion":"1.0"}})";
  target.carried.extras = R"({"made":"by hand"})";
  target.skins.push_back(target.skins.front());
  hf_gltf::Node twin =
      *std::find_if(target.nodes.begin(), target.nodes.end(), [](const hf_gltf::Node& node) { return node.mesh >= 0; });
  twin.skin = 1;
  twin.parent = -1;
  twin.children.clear();
  target.nodes.push_back(twin);
  target.scene_roots.push_back(static_cast<int>(target.nodes.size()) - 1);
  if (!target.scenes.empty()) target.scenes[target.shown_scene].roots = target.scene_roots;
  hf_gltf::Primitive& primitive = target.meshes[0].primitives[0];
  hf_gltf::MorphTarget smile;
  smile.positions.assign(primitive.positions.size(), glm::vec3(0, 0.01f, 0));
  primitive.targets.push_back(smile);
  target.meshes[0].target_names = {"smile"};
  const json figures = walked(written(target, "kept_target.glb"), "kept", "");
  EXPECT_EQ(figures["way"], "skeleton");
  const hf_gltf::Model made = hf_gltf::read_gltf(folder() / "kept.glb");
  EXPECT_EQ(json::parse(made.carried.extensions), json::parse(target.carried.extensions));
  EXPECT_EQ(json::parse(made.carried.extras), json::parse(target.carried.extras));
  ASSERT_EQ(made.skins.size(), 2u);
  EXPECT_EQ(made.skins[1].joints, target.skins[1].joints);
  EXPECT_EQ(made.meshes[0].target_names, target.meshes[0].target_names);
  EXPECT_EQ(made.meshes[0].primitives[0].targets.size(), 1u);
  ASSERT_EQ(made.nodes.size(), target.nodes.size());
  std::set<int> joints(target.skins[0].joints.begin(), target.skins[0].joints.end());
  for (const hf_gltf::Channel& channel : made.animations[0].channels) EXPECT_TRUE(joints.count(channel.node));
}

// The travel of a walk that goes over the ground is left out, or goes to the node over the joints.
TEST(TransferWay, TravelIsLeftOutOrGoesToTheRoot) {
  hf_gltf::Model source = biped();
  hf_gltf::Animation& walk = source.animations[static_cast<size_t>(hf_gltf::find_animation(source, "walk"))];
  int root = source.skins[0].joints[0];
  hf_gltf::Channel go;
  go.node = root;
  go.times = {0, walk.channels[0].times.back()};
  go.values = {0, 0, 0, 0, 0, 2};
  walk.channels.erase(std::remove_if(walk.channels.begin(), walk.channels.end(),
                                     [&](const hf_gltf::Channel& channel) {
                                       return channel.node == root && channel.path == hf_gltf::Path::translation;
                                     }),
                      walk.channels.end());
  walk.channels.push_back(go);
  const fs::path from = written(source, "travel_source.glb"), to = written(rigged("biped_tall"), "travel_target.glb");
  const auto middle = [](const hf_gltf::Model& model, double time) {
    const hf_gltf::FlatMesh mesh = hf_gltf::flatten(model);
    glm::dvec3 sum(0);
    const auto places = hf_gltf::posed_positions(model, mesh, model.animations[0], time);
    for (const glm::dvec3& p : places) sum += p / static_cast<double>(places.size());
    return sum;
  };
  double scale = 0;
  const auto way = [&](const std::string& name, const std::string& option) {
    std::string said;
    EXPECT_EQ(
        transfer(quoted(from) + " " + quoted(to) + " --clip walk --fps 12 -o " + quoted(folder() / (name + ".glb")) +
                     " --json " + quoted(folder() / (name + ".json")) + option,
                 said),
        0)
        << said;
    scale = read_json(folder() / (name + ".json"))["scale"];
    const hf_gltf::Model made = hf_gltf::read_gltf(folder() / (name + ".glb"));
    return (middle(made, go.times[1]) - middle(made, 0)).z;
  };
  for (const auto& [name, option, share] : {std::tuple<const char*, const char*, double>{"travel_kept", "", 2},
                                            {"travel_in_place", " --in-place", 0},
                                            {"travel_root", " --root-motion", 2},
                                            {"travel_stride", " --dials stride=0.5", 2}}) {
    const double gone = way(name, option);
    EXPECT_NEAR(gone, share * scale, 0.04) << name;  // a standing foot is held at the start, or at the end
  }
  EXPECT_NEAR(scale, 0.625, 0.01);  // half of the legs' 1.25
}

}  // namespace
