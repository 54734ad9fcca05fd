// See suggest_pairs.h.
#include "gltf/suggest_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "gltf/file_name.h"

namespace hf_gltf {
namespace {

using nlohmann::json;

json direction_json(const glm::dvec3& direction) {
  if (glm::distance(direction, glm::round(direction)) == 0) return axis_name(direction);
  return {direction.x, direction.y, direction.z};
}

json axes_json(const Axes& axes) {
  return {{"up", direction_json(axes.up)}, {"forward", direction_json(axes.forward)}};
}

// Five digits are enough for a place a ball is put round.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return std::strtod(text, nullptr);
}

std::string short_name(const Model& model) { return file_named(model.name).stem().string(); }

json selector_json(const Selector& selector) {
  json out;
  if (!selector.joints.empty()) {
    out["joint"] = selector.joints.front();
    if (!selector.extreme.empty()) out["extreme"] = selector.extreme;
  } else {
    out["position"] = {rounded(selector.position.x), rounded(selector.position.y), rounded(selector.position.z)};
  }
  out["radius"] = selector.radius;
  return out;
}

std::string names_of(const Landmarks& landmarks) {
  std::string out;
  for (const Landmark& landmark : landmarks.list) out += (out.empty() ? "" : ", ") + landmark.name;
  return out;
}

// The name of a place of the source on a body of the other build: four legs on two, or the reverse.
std::string counterpart(const std::string& name, const Landmarks& from, const Landmarks& to) {
  if (to.get(name)) return name;
  static const char* const across[][2] = {{"nose", "head"},
                                          {"wing left", "fin left"},
                                          {"wing right", "fin right"},
                                          {"front foot left", "hand left"},
                                          {"front foot right", "hand right"},
                                          {"hind foot left", "foot left"},
                                          {"hind foot right", "foot right"},
                                          {"rump", "seat"},
                                          {"withers", "upper back"}};
  if (from.leg_pairs > 2 || to.leg_pairs > 2) return "";
  // A place that both have pairs with itself: the wing of a body with hands is no hand.
  for (const auto& pair : across) {
    if (name == pair[0] && to.get(pair[1]) && !from.get(pair[1])) return pair[1];
    if (name == pair[1] && to.get(pair[0]) && !from.get(pair[0])) return pair[0];
  }
  // Arms flap as wings and fins do. But arms that hang would fold these down, and their strokes would splay front legs.
  // Steps of front legs paddle with fins.
  for (const std::string side : {" left", " right"}) {
    if ((name == "wing" + side || name == "fin" + side) && to.get("hand" + side) && !from.get("hand" + side))
      return "hand" + side;
    if (name == "front foot" + side && to.get("fin" + side)) return "fin" + side;
  }
  return "";
}

// A pair that is proposed, with its two places.
struct Candidate {
  json pair;
  SuggestedPair said;
  Selector source, target;
};

// "hand" of "hand left"; empty: the place is in the middle.
std::string without_side(const std::string& name) {
  for (const std::string side : {" left", " right"}) {
    if (name.size() > side.size() && name.compare(name.size() - side.size(), side.size(), side) == 0)
      return name.substr(0, name.size() - side.size());
  }
  return "";
}

// Takes out pairs that the program itself would refuse: a region without a vertex, or inside the regions of other
// pairs. The less certain of two pairs goes, and its mirror image too: one arm that follows beside one that hangs is
// worse than two that hang.
void keep_accepted(const RegionFinder& source, const RegionFinder& target, std::vector<Candidate>& candidates,
                   std::vector<std::string>& notes) {
  std::vector<Candidate> ordered = candidates;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Candidate& a, const Candidate& b) { return a.said.confidence > b.said.confidence; });
  std::vector<std::string> kept;
  std::vector<uint8_t> done(ordered.size(), 0);
  std::vector<Region> sources, targets;
  for (size_t k = 0; k < ordered.size(); ++k) {
    if (done[k]) continue;
    const std::string limb = without_side(ordered[k].said.name);
    std::vector<size_t> both;
    for (size_t i = k; i < ordered.size(); ++i)
      if (i == k || (!limb.empty() && without_side(ordered[i].said.name) == limb)) both.push_back(i);
    std::vector<Region> a = sources, b = targets;
    bool good = true;
    try {
      for (const size_t i : both) {
        a.push_back(source.find({ordered[i].source}));
        b.push_back(target.find({ordered[i].target}));
      }
      std::vector<Region> left = a, right = b;
      good = source.separate(left) < 0 && target.separate(right) < 0;
    } catch (const std::runtime_error&) {
      good = false;
    }
    if (good) {
      sources.swap(a);
      targets.swap(b);
    }
    for (const size_t i : both) {
      done[i] = 1;
      if (good)
        kept.push_back(ordered[i].said.name);
      else
        notes.push_back("\"" + ordered[i].said.name + "\" lies inside other places on one of the two; it is left out" +
                        (both.size() > 1 ? ", as its mirror image is" : ""));
    }
  }
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& candidate) {
                                    return std::find(kept.begin(), kept.end(), candidate.said.name) == kept.end();
                                  }),
                   candidates.end());
}

// Two, four or more legs, and whether the trunk stands upright: how a head is carried and a tail hangs depends on it.
bool same_build(const Landmarks& a, const Landmarks& b) { return a.leg_pairs == b.leg_pairs && a.upright == b.upright; }

}  // namespace

Suggestion suggest_pairs(const Body& source_body, const Body& target_body) {
  const Model &source = source_body.model, &target = target_body.model;
  const Landmarks from = find_landmarks(source_body), to = find_landmarks(target_body);
  Suggestion out;
  std::vector<Candidate> candidates;
  std::vector<std::string> taken;  // a flying fish has wings and fins for two hands
  for (const Landmark& a : from.list) {
    const std::string other = counterpart(a.name, from, to);
    if (other.empty() || std::find(taken.begin(), taken.end(), other) != taken.end()) {
      out.notes.push_back("only " + short_name(source) + " has \"" + a.name + "\"");
      continue;
    }
    taken.push_back(other);
    const Landmark& b = *to.get(other);
    json pair = {{"name", a.name}};
    const json first = selector_json(a.place), second = selector_json(b.place);
    if (first == second) {
      pair["both"] = first;
    } else {
      pair["source"] = first;
      pair["target"] = second;
    }
    const bool same_kind = other == a.name;
    // a hand is no foot
    if (a.name.find("foot") != std::string::npos && other.find("foot") != std::string::npos) pair["foot"] = true;
    const bool is_trunk = a.name == "withers" || a.name == "rump" || a.name == "seat" || a.name == "upper back";
    if (is_trunk) pair["trunk"] = pair["anchor"] = true;
    // How a head is carried and a tail hangs belongs to the build of a body, and whether it comes to the ground too.
    // They are aligned, and searched for contacts, between like bodies only.
    const bool is_end = a.name == "nose" || a.name == "head" || a.name == "tail";
    if (is_end && !same_build(from, to)) pair["align"] = pair["contact"] = false;
    // How high a neck carries its head belongs to the kind: a horse with the neck of a camel looks at the sky.
    if (a.name == "nose") pair["align"] = false;
    // a tail that is carried low is no contact: drawn to the ground in a jump it whips
    if (a.name == "tail") pair["contact"] = false;
    // an ear is thin all along; held above the ground it would lift the head
    if (a.name.rfind("ear ", 0) == 0) {
      pair["contact"] = false;
      pair["sinks"] = true;
    }
    // a fin or a wing points to the side and a leg down: each keeps its own direction
    const auto is_fin = [](const std::string& name) {
      return name.rfind("fin ", 0) == 0 || name.rfind("wing ", 0) == 0;
    };
    if (is_fin(a.name) != is_fin(other)) pair["align"] = false;
    if (a.name.find("hand") != std::string::npos || other.find("hand") != std::string::npos) pair["limb"] = "arm";
    const double confidence = std::min(a.confidence, b.confidence) * (same_kind ? 1 : 0.6);
    candidates.push_back({pair, {a.name, confidence, a.found, b.found}, a.place, b.place});
  }
  keep_accepted(RegionFinder(source, source_body.mesh, from.axes), RegionFinder(target, target_body.mesh, to.axes),
                candidates, out.notes);
  json pairs = json::array();
  bool trunk = false, feet = false;
  for (const Candidate& candidate : candidates) {
    pairs.push_back(candidate.pair);
    out.pairs.push_back(candidate.said);
    trunk = trunk || candidate.pair.contains("trunk");
    feet = feet || candidate.pair.contains("foot");
  }
  for (const Landmark& b : to.list) {
    if (std::find(taken.begin(), taken.end(), b.name) == taken.end())
      out.notes.push_back("only " + short_name(target) + " has \"" + b.name + "\"");
  }
  if (out.pairs.size() < 3) {
    throw std::runtime_error("too little in common to propose pairs: " + short_name(source) + " has " + names_of(from) +
                             "; " + short_name(target) + " has " + names_of(to) +
                             "; write PAIRS.json by hand (--joints lists the joints)");
  }
  if (feet && !trunk)
    out.notes.push_back("no place on the trunk was found on both: add withers and rump, else the trunk floats");
  for (const auto& [model, side] : {std::pair<const Model*, const Landmarks*>(&source, &from), {&target, &to}}) {
    out.notes.push_back(
        short_name(*model) + ": " + axes_sentence(*side) + (side->upright ? "; stands upright" : "; stands") +
        (side->leg_pairs > 0 ? " on " + std::to_string(2 * side->leg_pairs) + " legs" : " without feet"));
  }
  out.source = from;
  out.target = to;
  out.file = {
      {"about", "Proposed for " + short_name(source) + " and " + short_name(target) + ": look at it before use."},
      {"source_axes", axes_json(from.axes)},
      {"target_axes", axes_json(to.axes)},
      {"pairs", pairs}};
  if (from.known.swims() || to.known.swims()) {
    out.file["settings"] = {{"ground", false}};
    out.notes.push_back(short_name(from.known.swims() ? source : target) +
                        " has fins and no legs: there is no ground (\"settings\": {\"ground\": false})");
  }
  return out;
}

}  // namespace hf_gltf
