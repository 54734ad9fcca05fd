// See pairs_file.h.
#include "gltf/pairs_file.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <stdexcept>

#include "hf/transfer.h"

namespace hf_gltf {
namespace {

std::vector<Selector> read_selectors(const JsonReader& json) {
  if (!json.value().is_array()) return {read_selector(json)};
  std::vector<Selector> out;
  for (size_t i = 0; i < json.size(); ++i) out.push_back(read_selector(json.at(i)));
  if (out.empty()) json.fail("the list of selectors is empty");
  return out;
}

PairEntry read_pair(const JsonReader& json) {
  json.expect_only(
      {"name", "both", "source", "target", "anchor", "foot", "trunk", "contact", "align", "sinks", "limb"});
  PairEntry pair;
  pair.name = json.at("name").string();
  if (pair.name.empty()) json.at("name").fail("a pair needs a name");
  if (json.has("both")) {
    if (json.has("source") || json.has("target")) json.fail("give \"both\", or \"source\" and \"target\"");
    pair.source = pair.target = read_selectors(json.at("both"));
  } else {
    pair.source = read_selectors(json.at("source"));
    pair.target = read_selectors(json.at("target"));
  }
  pair.anchor = json.boolean_or("anchor", false);
  pair.foot = json.boolean_or("foot", false);
  pair.trunk = json.boolean_or("trunk", false);
  pair.align = json.boolean_or("align", true);
  pair.contact_given = json.has("contact");
  pair.contact = json.boolean_or("contact", false);
  pair.sinks = json.boolean_or("sinks", false);
  pair.limb = json.string_or("limb", limb_of(pair.name));
  if (!pair.limb.empty() && pair.limb != "neck" && pair.limb != "tail" && pair.limb != "arm" && pair.limb != "none")
    json.at("limb").fail("expected \"neck\", \"tail\", \"arm\" or \"none\", found \"" + pair.limb + "\"");
  return pair;
}

struct DialKey {
  const char* name;
  double TransferDials::*value;
  double least, most;
};
constexpr DialKey dial_keys[] = {{"stride", &TransferDials::stride, 0.1, 4},
                                 {"hip_height_share", &TransferDials::hip_height_share, -0.5, 0.5},
                                 {"neck_follow", &TransferDials::neck_follow, -1, 1},
                                 {"tail_follow", &TransferDials::tail_follow, -1, 1},
                                 {"arm_space_degrees", &TransferDials::arm_space_degrees, -90, 90},
                                 {"long_follow", &TransferDials::long_follow, 0, 1}};

TransferDials read_dials(const JsonReader& json) {
  json.expect_only({"stride", "hip_height_share", "neck_follow", "tail_follow", "arm_space_degrees", "long_follow"});
  TransferDials out;
  for (const DialKey& key : dial_keys)
    if (json.has(key.name)) out.*key.value = json.at(key.name).number(key.least, key.most);
  return out;
}

std::vector<PairEntry> read_list(const JsonReader& json) {
  std::vector<PairEntry> out;
  for (size_t i = 0; i < json.size(); ++i) {
    out.push_back(read_pair(json.at(i)));
    for (size_t k = 0; k < i; ++k) {
      if (out[k].name == out[i].name)
        json.at(i).at("name").fail("the name \"" + out[i].name + "\" is taken by an earlier pair");
    }
  }
  return out;
}

// Errors found later, on the model, name the file too.
void name_file(std::vector<PairEntry>& pairs, const std::filesystem::path& file) {
  for (PairEntry& pair : pairs) {
    for (std::vector<Selector>* side : {&pair.source, &pair.target}) {
      for (Selector& selector : *side) selector.where = file.filename().string() + ": " + selector.where;
    }
  }
}

}  // namespace

std::string limb_of(const std::string& pair_name) {
  std::string name = pair_name;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  // A part of a word counts only where a word begins: "ear" is no part of "rear foot".
  const auto has = [&](const char* word) {
    for (size_t i = name.find(word); i != std::string::npos; i = name.find(word, i + 1))
      if (i == 0 || !std::isalpha(static_cast<unsigned char>(name[i - 1]))) return true;
    return false;
  };
  for (const char* word : {"nose", "head", "ear", "neck", "horn", "antler", "muzzle", "poll"})
    if (has(word)) return "neck";
  if (has("tail")) return "tail";
  return has("hand") || has("arm") ? "arm" : "";
}

uint32_t PairEntry::flags() const {
  return (anchor ? uint32_t{HF_PAIR_ANCHOR} : 0u) | (foot ? uint32_t{HF_PAIR_FOOT} : 0u) |
         (trunk ? uint32_t{HF_PAIR_TRUNK} : 0u) | (contact ? uint32_t{HF_PAIR_CONTACT} : 0u) |
         (sinks ? uint32_t{HF_PAIR_SINKS} : 0u) | (align ? 0u : uint32_t{HF_PAIR_NO_ALIGNMENT}) |
         (limb == "neck" ? uint32_t{HF_PAIR_NECK} : 0u) | (limb == "tail" ? uint32_t{HF_PAIR_TAIL} : 0u) |
         (limb == "arm" ? uint32_t{HF_PAIR_ARM} : 0u);
}

namespace {

PairsFile pairs_from(const JsonReader& root, const std::filesystem::path& file, bool chains_do) {
  root.expect_only({"about", "source_axes", "target_axes", "settings", "dials", "pairs", "chains"});
  PairsFile out;
  if (root.has("chains")) {
    out.chains = read_chains(root.at("chains"));
    for (NamedChain& chain : out.chains) chain.where = file.filename().string() + ": " + chain.where;
    if (chains_do && !root.has("pairs")) {
      root.expect_only({"about", "chains"});
      if (out.chains.empty()) root.at("chains").fail("at least one chain is needed");
      return out;
    }
  }
  if (root.has("source_axes")) out.source_axes = read_axes(root.at("source_axes"));
  if (root.has("target_axes")) out.target_axes = read_axes(root.at("target_axes"));
  if (root.has("settings")) {
    const JsonReader settings = root.at("settings");
    settings.expect_only({"mode", "clusters", "width", "scale", "alignment_degrees", "ground"});
    const std::string mode = settings.string_or("mode", "fields");
    if (mode != "fields" && mode != "paper" && mode != "stretch")
      settings.at("mode").fail("expected \"fields\", \"paper\" or \"stretch\", found \"" + mode + "\"");
    out.settings.paper = mode == "paper";
    out.settings.stretch = mode == "stretch";
    out.settings.clusters = static_cast<uint32_t>(settings.integer_or("clusters", 1, 512, 0));
    out.settings.ground = settings.boolean_or("ground", true);
    if (settings.has("width")) out.settings.width = settings.at("width").number(0.005, 0.5);
    if (settings.has("scale")) out.settings.scale = settings.at("scale").number(1e-6, 1e6);
    if (settings.has("alignment_degrees"))
      out.settings.alignment_degrees = settings.at("alignment_degrees").number(-1, 180);
  }
  if (root.has("dials")) out.dials = read_dials(root.at("dials"));
  out.pairs = read_list(root.at("pairs"));
  name_file(out.pairs, file);
  if (out.pairs.empty()) root.at("pairs").fail("at least one pair is needed");
  return out;
}

}  // namespace

PairsFile read_pairs(const std::filesystem::path& file, bool chains_do) {
  const JsonFile json(file);
  return pairs_from(json.root(), file, chains_do);
}

PairsFile parse_pairs(const nlohmann::json& value, const std::string& what) {
  return pairs_from(JsonReader(value, what, ""), what, false);
}

void add_regions(const std::vector<PairEntry>& pairs, const RegionFinder& source_finder,
                 const RegionFinder& target_finder, std::vector<Region>& source, std::vector<Region>& target) {
  const size_t before = source.size();
  for (const PairEntry& pair : pairs) {
    source.push_back(source_finder.find(pair.source));
    target.push_back(target_finder.find(pair.target));
  }
  const int covered_source = source_finder.separate(source, before),
            covered_target = target_finder.separate(target, before);
  for (const int covered : {covered_source, covered_target}) {
    if (covered < 0) continue;
    throw std::runtime_error("pair \"" + pairs[static_cast<size_t>(covered) - before].name + "\": its region on the " +
                             (covered_source >= 0 ? "source" : "target") +
                             " is inside the regions of other pairs; move it or make the radius smaller");
  }
}

void set_dial(TransferDials& dials, const std::string& key, double value) {
  std::string known;
  for (const DialKey& dial : dial_keys) {
    known += (known.empty() ? "" : ", ") + std::string(dial.name);
    if (key != dial.name) continue;
    if (!(value >= dial.least && value <= dial.most)) {
      char text[160];
      std::snprintf(text, sizeof text, "dial %s is %g; it must be %g to %g", dial.name, value, dial.least, dial.most);
      throw std::runtime_error(text);
    }
    dials.*dial.value = value;
    return;
  }
  throw std::runtime_error("there is no dial \"" + key + "\"; dials are " + known);
}

EditsFile read_edits(const std::filesystem::path& file) {
  const JsonFile json(file);
  const JsonReader root = json.root();
  root.expect_only({"about", "remove", "add"});
  EditsFile out;
  if (root.has("remove")) {
    for (size_t i = 0; i < root.at("remove").size(); ++i) out.remove.push_back(root.at("remove").at(i).string());
  }
  if (root.has("add")) out.add = read_list(root.at("add"));
  name_file(out.add, file);
  if (out.remove.empty() && out.add.empty())
    root.fail("nothing to do: give \"remove\" (names of pairs) or \"add\" (pairs)");
  return out;
}

}  // namespace hf_gltf
