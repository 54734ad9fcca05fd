// hf_transfer run as a user runs it: on the generated creatures, and on real animals when the shared data is there. The
// files are read back, compared and validated.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "gltf/flat_mesh.h"
#include "support/full.h"
#include "unit/samples/transfer_program_support.h"

namespace {

using namespace transfer_program;

// The target's surface and looks, a new skin, the clip.
void check_output(const fs::path& file, const fs::path& target, size_t clips) {
  const hf_gltf::Model made = hf_gltf::read_gltf(file), given = hf_gltf::read_gltf(target);
  ASSERT_EQ(made.skins.size(), 1u);
  EXPECT_GT(made.skins[0].joints.size(), 20u);
  ASSERT_EQ(made.animations.size(), clips);
  EXPECT_EQ(made.animations[0].channels.size(), 2 * made.skins[0].joints.size());
  std::vector<const hf_gltf::Primitive*> before, after;
  for (const hf_gltf::Node& node : given.nodes) {
    if (node.mesh < 0) continue;
    for (const hf_gltf::Primitive& primitive : given.meshes[static_cast<size_t>(node.mesh)].primitives)
      before.push_back(&primitive);
  }
  for (const hf_gltf::MeshData& mesh : made.meshes) {
    for (const hf_gltf::Primitive& primitive : mesh.primitives) after.push_back(&primitive);
  }
  ASSERT_EQ(before.size(), after.size());
  EXPECT_EQ(made.materials.size(), given.materials.size());
  for (size_t p = 0; p < before.size(); ++p) {
    EXPECT_EQ(after[p]->indices, before[p]->indices);
    EXPECT_EQ(after[p]->texcoords, before[p]->texcoords);
    EXPECT_EQ(after[p]->material, before[p]->material);
    EXPECT_EQ(after[p]->positions.size(), before[p]->positions.size());
  }
}

void check_figures(const json& report) {
  EXPECT_LT(report["replay_key_max"].get<double>(), 1e-5);
  EXPECT_LT(report["replay_half_rms"].get<double>(), 0.003);
  for (const json& clip : report["clips"]) {
    EXPECT_LT(clip["foot_path_mean"].get<double>(), 0.005);
    EXPECT_LT(clip["foot_path_max"].get<double>(), 0.012);
    EXPECT_LT(clip["foot_sunk"].get<double>(), 0.01);
  }
  for (const json& pair : report["pairs"]) {
    EXPECT_LT(pair["source_leak"].get<double>(), 1e-9);
    EXPECT_LT(pair["target_leak"].get<double>(), 1e-9);
  }
}

TEST(TransferProgram, TheHorsesWalkGoesToTheBullAndPairsAreEditedInTheSameSession) {
  const fs::path horse = creature("horse"), bull = creature("bull"), out = folder() / "horse_on_bull.glb",
                 report = folder() / "horse_on_bull.json";
  std::string said;
  ASSERT_EQ(
      transfer(quoted(horse) + " " + quoted(bull) + " --pairs " + quoted(pairs("horse_to_bull.json")) + " -o " +
                   quoted(out) + " --as skin --key-tolerance 0 --clip all --fps 10 --sheet " +
                   quoted(folder() / "horse_on_bull.png") + " --report " + quoted(folder() / "horse_on_bull.txt") +
                   " --json " + quoted(report) + " --edit " + quoted(pairs("horse_to_bull_edit.json")),
               said),
      0)
      << said;
  check_output(out, bull, 2);
  check_output(folder() / "horse_on_bull_edited.glb", bull, 2);
  const json figures = read_json(report);
  check_figures(figures);
  check_figures(figures["edited"]);
  EXPECT_EQ(figures["edited"]["source_factorisations"], figures["source_factorisations"]);
  EXPECT_EQ(figures["edited"]["target_factorisations"], figures["target_factorisations"]);
  EXPECT_EQ(figures["edited"]["pairs"].size(), figures["pairs"].size());
  for (const char* name : {"horse_on_bull.png", "horse_on_bull_edited.png", "horse_on_bull.txt"})
    EXPECT_GT(fs::file_size(folder() / name), 500u) << name;
  // no temporary file is left behind, and the two runs differ
  EXPECT_NE(read_json(report)["pairs"], figures["edited"]["pairs"]);
}

// A creature, read and written again, with one more vertex in no triangle if stray is set.
fs::path rewritten(const std::string& name, const glm::dvec3* stray, const std::string& suffix) {
  hf_gltf::Model model = hf_gltf::read_gltf(creature(name));
  hf_gltf::Primitive& to = model.meshes.at(0).primitives.at(0);
  const auto again = [&](auto& list) {
    if (stray && !list.empty()) list.push_back(list.back());
  };
  again(to.positions);
  again(to.normals);
  again(to.tangents);
  again(to.colors);
  again(to.influences);
  for (auto& set : to.texcoords) again(set);
  for (auto& target : to.targets) {
    again(target.positions);
    again(target.normals);
  }
  if (stray) to.positions.back() = glm::vec3(*stray);
  const fs::path file = folder() / (name + suffix + ".glb");
  hf_gltf::write_gltf(model, file);
  return file;
}

// Far away, before the nose and under a foot, of the source and of the target: pairs are proposed and taken as without.
// The quick form gives the first two to one of the two: under feet, grounds of the source and of the target differ.
TEST(TransferProgram, AVertexInNoTriangleChangesNothing) {
  const auto figures_of = [&](const fs::path& source, const fs::path& target, const std::string& name) {
    std::string said;
    const fs::path report = folder() / (name + ".json");
    EXPECT_EQ(transfer(quoted(source) + " " + quoted(target) + " -o " + quoted(folder() / (name + ".glb")) +
                           " --json " + quoted(report) + few_frames,
                       said),
              0)
        << name << ": " << said;
    json out = read_json(report);
    for (json& clip : out["clips"]) {
      clip.erase("frame_ms");
      clip.erase("ms_per_frame");
    }
    return out;
  };
  const hf_gltf::Model horse = hf_gltf::read_gltf(creature("horse"));
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(horse);
  glm::dvec3 nose = mesh.positions[0], foot = nose;
  for (const glm::dvec3& p : mesh.positions) {
    if (p.z > nose.z) nose = p;
    if (p.y < foot.y) foot = p;
  }
  const fs::path source = rewritten("horse", nullptr, "_as_is"), target = rewritten("bull", nullptr, "_as_is");
  const json plain = figures_of(source, target, "no_stray");
  ASSERT_GT(plain["pairs"].size(), 5u);
  const struct {
    const char* name;
    glm::dvec3 place;
  } strays[] = {
      {"_far", {1e5, 2e4, -3e4}}, {"_nose", nose + glm::dvec3(0, 0, 0.01)}, {"_foot", foot - glm::dvec3(0, 0.02, 0)}};
  for (const auto& stray : strays) {
    for (const bool of_source : {true, false}) {
      if (!hf_test::is_full() && &stray != strays + 2 && of_source == (&stray - strays) % 2) continue;
      const fs::path changed = rewritten(of_source ? "horse" : "bull", &stray.place, stray.name);
      const json found = figures_of(of_source ? changed : source, of_source ? target : changed,
                                    std::string("stray") + stray.name + (of_source ? "_source" : "_target"));
      EXPECT_EQ(found["pairs"], plain["pairs"]) << stray.name << of_source;
      EXPECT_EQ(found["clips"], plain["clips"]) << stray.name << of_source;
    }
  }
}

// Every clip of a source on a target: whole outputs, feet and ground within the bars. The quick form has a target of
// the source's rig and one of another.
void check_real(const std::string& source, const std::string& target, const std::string& list) {
  if (!hf_test::is_full() && target != "q_Wolf.glb" && target != "farm_Cow.glb")
    GTEST_SKIP() << "set HF_FULL_TESTS to run it";
  if (!fs::exists(data() / source) || !fs::exists(data() / target))
    GTEST_SKIP() << "no " << source << " or " << target << " under " << data();
  const std::string stem = fs::path(source).stem().string() + "_on_" + target;
  std::string said;
  ASSERT_EQ(transfer(quoted(data() / source) + " " + quoted(data() / target) + " --pairs " + quoted(pairs(list)) +
                         " -o " + quoted(folder() / stem) + " --as skin --key-tolerance 0 --clip all --fps 30 --json " +
                         quoted(folder() / (stem + ".json")),
                     said),
            0)
      << said;
  json report = read_json(folder() / (stem + ".json"));
  check_output(folder() / stem, data() / target, report["clips"].size());
  json upright = json::array();
  for (const json& clip : report["clips"]) {
    const std::string name = clip["name"];
    EXPECT_LT(clip["surface_sunk"].get<double>(), 0.002) << name;
    if (name.find("Death") != std::string::npos) continue;  // lies on its side: its feet do not stand
    EXPECT_LT(clip["planted_mean"].get<double>(), 0.002) << name;
    EXPECT_LT(clip["planted_max"].get<double>(), 0.005) << name;
    upright.push_back(clip);
  }
  report["clips"] = upright;
  check_figures(report);
}

TEST(TransferProgram, EveryClipOfTheHorseOnTheWolf) {
  check_real("q_Horse.glb", "q_Wolf.glb", "q_horse_to_q_wolf.json");
}
TEST(TransferProgram, EveryClipOfTheHorseOnTheFox) { check_real("q_Horse.glb", "q_Fox.glb", "q_horse_to_q_fox.json"); }
TEST(TransferProgram, EveryClipOfTheHorseOnTheDeer) {
  check_real("q_Horse.glb", "q_Deer.glb", "q_horse_to_q_deer.json");
}
TEST(TransferProgram, EveryClipOfTheHorseOnACowOfAnotherRig) {
  check_real("q_Horse.glb", "farm_Cow.glb", "q_horse_to_farm_cow.json");
}
TEST(TransferProgram, EveryClipOfTheHorseOnAFoxOfAnotherRig) {
  check_real("q_Horse.glb", "khr_Fox.glb", "q_horse_to_khr_fox.json");
}
TEST(TransferProgram, TheWalkingManOnTheKnight) {
  check_real("CesiumMan.glb", "q_KnightCharacter.glb", "cesium_man_to_q_knight.json");
}

TEST(TransferProgram, DialsOfTheFileAndOfTheCommandLineAreTheSame) {
  const fs::path horse = creature("horse"), bull = creature("bull"), file = folder() / "dialled.json";
  std::ifstream from(pairs("horse_to_bull.json"));
  nlohmann::json json = nlohmann::json::parse(from);
  json["dials"] = {{"stride", 1.3}, {"neck_follow", 0.5}};
  std::ofstream(file) << json;
  std::string said;
  const auto play = [&](const fs::path& list, const std::string& more, const char* name) {
    const fs::path out = folder() / name;
    EXPECT_EQ(transfer(quoted(horse) + " " + quoted(bull) + " --clip walk --pairs " + quoted(list) + " -o " +
                           quoted(out) + more + few_frames,
                       said),
              0)
        << said;
    std::ifstream bytes(out, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(bytes), {});
  };
  const std::string plain = play(pairs("horse_to_bull.json"), "", "plain.glb"), of_file = play(file, "", "dialled.glb"),
                    of_line = play(pairs("horse_to_bull.json"), " --dials stride=1.3,neck_follow=0.5", "line.glb"),
                    neutral = play(file, " --dials stride=1,neck_follow=0", "neutral.glb");
  EXPECT_FALSE(of_file.empty());
  EXPECT_EQ(of_file, of_line);
  EXPECT_EQ(neutral, plain);
  EXPECT_NE(of_file, plain);
  const std::string stride = play(pairs("horse_to_bull.json"), " --dials stride=1.3", "stride.glb");
  EXPECT_NE(stride, plain);
  EXPECT_NE(stride, of_line);  // each of the two dials counts
  // what turns nothing is said: neither has arms
  play(file, " --dials arm_space_degrees=10", "armless.glb");
  EXPECT_NE(said.find("dial arm_space_degrees turns nothing"), std::string::npos) << said;
  EXPECT_EQ(said.find("neck_follow turns nothing"), std::string::npos) << said;
  EXPECT_EQ(transfer(quoted(horse) + " " + quoted(bull) + " -o never.glb --dials stride=9", said), 1);
  EXPECT_NE(said.find("stride is 9"), std::string::npos) << said;
  EXPECT_EQ(transfer(quoted(horse) + " " + quoted(bull) + " -o never.glb --dials speed=1", said), 1);
  EXPECT_NE(said.find("\"speed\""), std::string::npos) << said;
}

TEST(TransferProgram, WhatIsWrongIsNamedWithFileAndKeyPath) {
  const fs::path horse = creature("horse"), bull = creature("bull"), file = folder() / "bad.json";
  const auto refused = [&](const std::string& text, const std::string& expected) {
    std::ofstream(file) << text;
    std::string said;
    const int status = transfer(
        quoted(horse) + " " + quoted(bull) + " --pairs " + quoted(file) + " -o " + quoted(folder() / "never.glb"),
        said);
    EXPECT_EQ(status, 1) << text;
    EXPECT_NE(said.find(expected), std::string::npos) << text << "\n  said: " << said;
    EXPECT_NE(said.find("bad.json"), std::string::npos) << said;
    EXPECT_FALSE(fs::exists(folder() / "never.glb"));
  };
  const auto pair = [](const std::string& selector) {
    return "{\"pairs\": [{\"name\": \"a\", \"both\": " + selector + "}]}";
  };
  refused("{\"pairs\": [", "bad.json");
  refused("{}", "pairs");
  refused("{\"pairs\": []}", "pairs");
  refused("{\"pears\": []}", "pears");
  refused("{\"pairs\": [{\"both\": {\"joint\": \"head\"}}]}", "pairs[0]");
  refused("{\"pairs\": [{\"name\": \"a\", \"source\": {\"joint\": \"head\"}}]}", "pairs[0]");
  refused(pair("{}"), "pairs[0].both");
  refused(pair("{\"joint\": 7}"), "pairs[0].both.joint");
  refused(pair("{\"joint\": \"antler\"}"), "no joint \"antler\"");
  refused(pair("{\"joint\": \"head\", \"extreme\": \"sideways\"}"), "pairs[0].both.extreme");
  refused(pair("{\"joint\": \"head\", \"extreme\": \"sideways\"}"), "left and right of one who looks at its face");
  refused(pair("{\"joint\": \"head\", \"radius\": 9}"), "pairs[0].both.radius");
  refused(pair("{\"position\": [0, 1]}"), "pairs[0].both.position");
  refused(pair("{\"vertices\": [4000000]}"), "no vertex 4000000");
  refused(pair("{\"vertices\": [-1]}"), "pairs[0].both.vertices[0]");
  refused(pair("{\"joint\": \"head\", \"colour\": 1}"), "colour");
  refused("{\"settings\": {\"clusters\": 9999}, \"pairs\": []}", "settings.clusters");
  refused("{\"source_axes\": {\"up\": \"+y\", \"forward\": \"-y\"}, \"pairs\": []}", "source_axes");
  refused("{\"dials\": {\"stride\": 9}, \"pairs\": []}", "dials.stride");
  refused("{\"dials\": {\"strut\": 1}, \"pairs\": []}", "strut");
  refused("{\"pairs\": [{\"name\": \"a\", \"limb\": \"leg\", \"both\": {\"joint\": \"head\"}}]}", "pairs[0].limb");
  refused(
      "{\"pairs\": [{\"name\": \"a\", \"both\": {\"joint\": \"head\"}}, {\"name\": \"a\", \"both\": {\"joint\": "
      "\"jaw\"}}]}",
      "pairs[1].name");

  std::string said;
  EXPECT_EQ(transfer("--help", said), 0);
  EXPECT_NE(said.find("usage"), std::string::npos);
  EXPECT_EQ(transfer(quoted(horse), said), 1);
  EXPECT_EQ(transfer("--fps 0", said), 1);
  EXPECT_NE(said.find("--fps"), std::string::npos);
  EXPECT_EQ(transfer("--joints " + quoted(horse), said), 0);
  EXPECT_NE(said.find("front_hoof_L"), std::string::npos);
  EXPECT_EQ(transfer(quoted(horse) + " " + quoted(bull) + " --clip dance --pairs " +
                         quoted(pairs("horse_to_bull.json")) + " -o never.glb",
                     said),
            1);
  EXPECT_NE(said.find("\"walk\""), std::string::npos) << said;
  // a wrong rest pose is said under its own option
  for (const auto& [choice, expected] : {std::pair<const char*, const char*>("dance@0", "--source-rest: "),
                                         {"walk@99", "must lie within it"},
                                         {"walk", "CLIP@TIME"}}) {
    EXPECT_EQ(transfer(quoted(horse) + " " + quoted(bull) + " -o never.glb --source-rest " + choice, said), 1);
    EXPECT_NE(said.find(expected), std::string::npos) << said;
    EXPECT_EQ(said.find("--clip:"), std::string::npos) << said;
  }
}

// What is written has no errors under the Khronos validator: new skins, the target's own, morph targets.
TEST(TransferProgramValidation, TheFilesHaveNoErrorsUnderTheKhronosValidator) {
  std::string searched, said;
  const fs::path modules = node_modules("gltf-validator", searched), out = folder() / "validated";
  if (modules.empty()) GTEST_SKIP() << searched;
  fs::remove_all(out);
  fs::create_directories(out);
  for (const std::string kind : {"skin", "own-skin", "morph"}) {
    ASSERT_EQ(transfer(both() + " --pairs " + quoted(pairs("horse_to_bull.json")) + " --fps 30 --as " + kind + " -o " +
                           quoted(out / ("bull_" + kind + ".glb")),
                       said),
              0)
        << said;
    if (!fs::exists(data() / "q_Horse.glb")) continue;
    for (const auto& [name, list] : {std::pair<const char*, const char*>("q_Wolf.glb", "q_horse_to_q_wolf.json"),
                                     {"farm_Cow.glb", "q_horse_to_farm_cow.json"}}) {
      ASSERT_EQ(
          transfer(quoted(data() / "q_Horse.glb") + " " + quoted(data() / name) + " --pairs " + quoted(pairs(list)) +
                       " --clip Walk --as " + kind + " -o " + quoted(out / (kind + "_" + name)),
                   said),
          0)
          << said;
    }
  }
  EXPECT_EQ(run("node " + quoted(fs::path(HF_SOURCE_DIR) / "tests/unit/gltf/validate.mjs") + " " + quoted(modules) +
                    " " + quoted(out),
                said),
            0)
      << said;
  std::printf("%s", said.c_str());
}

}  // namespace
