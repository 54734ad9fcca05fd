// PAIRS.json that names chains of joints: what is said decides, and what cannot be is refused with the chain's name.
#include <gtest/gtest.h>

#include "assets/creature_rig.h"
#include "gltf/json_file.h"
#include "transfer_program_support.h"

namespace {

using namespace transfer_program;

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

// A body whose arms have names of ribbons, so that no arm is found.
fs::path ribboned() {
  hf_gltf::Model model = samples::to_model(samples::make_rigged("biped_tall", 800));
  for (hf_gltf::Node& node : model.nodes)
    if (has(node.name, "Arm") || has(node.name, "Hand") || has(node.name, "Shoulder")) node.name += "_ribbon";
  const fs::path file = folder() / "ribboned.glb";
  hf_gltf::write_gltf(model, file);
  return file;
}

json chain(const std::string& name, const json& target) { return {{"name", name}, {"target", target}}; }

// The biped's walk on the ribboned body with these chains: its report, or what was said.
json walked(const json& file, int code = 0) {
  static const fs::path target = ribboned();
  const fs::path chains = folder() / "chains.json", report = folder() / "chains_report.json";
  hf_gltf::write_json(chains, file);
  std::string said;
  EXPECT_EQ(transfer(quoted(creature("biped")) + " " + quoted(target) + " --clip walk --fps 12 -o " +
                         quoted(folder() / "chains.glb") + " --json " + quoted(report) + " --pairs " + quoted(chains),
                     said),
            code)
      << said;
  if (code != 0) return said;
  return read_json(report);
}

TEST(TransferChains, ChainsThatAreNamedFollowWhereNamesSayNothing) {
  json list = json::array();
  for (const auto& [side, word] : {std::pair<std::string, std::string>("left ", "Left"), {"right ", "Right"}}) {
    const auto joint = [&](const char* name) { return "mixamorig:" + word + name + "_ribbon"; };
    list.push_back(chain(side + "shoulder", {joint("Shoulder")}));
    list.push_back(chain(side + "arm", {joint("Arm"), joint("ForeArm")}));
    list.push_back(chain(side + "hand", {joint("Hand")}));
  }
  const json figures = walked({{"about", "arms"}, {"chains", list}});
  EXPECT_EQ(figures["way"], "skeleton");
  EXPECT_EQ(figures["clips"][0]["limbs"]["partners"], 4);
  EXPECT_LT(figures["clips"][0]["limbs"]["degrees"], 3);
  EXPECT_GT(figures["clips"][0]["confidence"], 0.8);
}

json list_of(std::initializer_list<json> chains) {
  json out = json::array();
  for (const json& one : chains) out.push_back(one);
  return out;
}

TEST(TransferChains, WhatCannotBeIsRefusedWithTheChainsName) {
  const json arm = list_of({"mixamorig:LeftArm_ribbon"}), none = json::array();
  const std::pair<json, const char*> bad[] = {
      {list_of({chain("left wrist", arm)}), "chains.json: chains[0].name: expected a side, a part"},
      {list_of({chain("arm", arm)}), "chains.json: chains[0].name: expected a side, a part"},
      {list_of({chain("left arm two", arm)}), "chains.json: chains[0].name: expected a side, a part"},
      {list_of({chain("left arm 2 3", arm)}), "chains.json: chains[0].name: expected a side, a part"},
      {list_of({chain("left arm", arm), chain("left arm", arm)}),
       "chains.json: chains[1].name: the name \"left arm\" is taken by an earlier chain"},
      {list_of({chain("left arm", none)}), "chains.json: chains[0].target: the chain has no joint"},
      {list_of({{{"name", "left arm"}}}), "chains.json: chains[0]: give \"both\", \"source\" or \"target\""},
      {list_of({{{"name", "left arm"}, {"both", arm}, {"source", arm}}}),
       "chains.json: chains[0]: give \"both\", or \"source\" and"},
      {list_of({chain("left arm", list_of({"elbow"}))}), "chains.json: chains[0]: chain \"left arm\": "},
      {list_of({chain("left arm", list_of({"elbow"}))}), "has no joint \"elbow\""},
      {list_of({chain("left arm", arm), chain("left leg", arm)}), "chains.json: chains[1]: chain \"left leg\": "},
      {list_of({chain("left arm", arm), chain("left leg", arm)}), "is in chain \"left arm\" already"},
      {list_of({{{"name", "left arm"},
                 {"source", list_of({"upper_arm_L"})},
                 {"target", list_of({"mixamorig:RightArm_ribbon"})}}}),
       "chain \"left arm\": on "},
      {none, "chains.json: chains: at least one chain is needed"}};
  for (const auto& [list, sentence] : bad) {
    const std::string said = walked({{"chains", list}}, 1);
    EXPECT_TRUE(has(said, sentence)) << said << "\n" << sentence;
  }
  const std::string settings = walked({{"chains", list_of({chain("tail", arm)})}, {"settings", json::object()}}, 1);
  EXPECT_TRUE(has(settings, "settings")) << settings;
}

}  // namespace
