// See suggest_pairs.h.
#include "transfer/suggest_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace samples {
namespace {

using nlohmann::json;

std::string axis_name(const glm::dvec3& direction) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(direction[c]) > 0.5) return std::string(direction[c] > 0 ? "+" : "-") + "xyz"[c];
  }
  return "+y";
}

json axes_json(const Axes& axes) { return {{"up", axis_name(axes.up)}, {"forward", axis_name(axes.forward)}}; }

// Five digits are enough for a place a ball is put round.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return std::strtod(text, nullptr);
}

std::string short_name(const Model& model) { return std::filesystem::path(model.name).stem().string(); }

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

// What a place of the source is called on a body of the other build: four legs on two and the other way round.
std::string counterpart(const std::string& name, const Landmarks& from, const Landmarks& to) {
  if (to.get(name)) return name;
  static const char* const across[][2] = {{"nose", "head"},
                                          {"front foot left", "hand left"},
                                          {"front foot right", "hand right"},
                                          {"hind foot left", "foot left"},
                                          {"hind foot right", "foot right"},
                                          {"rump", "seat"},
                                          {"withers", "upper back"}};
  if (from.leg_pairs > 2 || to.leg_pairs > 2) return "";
  for (const auto& pair : across) {
    if (name == pair[0] && to.get(pair[1])) return pair[1];
    if (name == pair[1] && to.get(pair[0])) return pair[0];
  }
  return "";
}

}  // namespace

Suggestion suggest_pairs(const Model& source, const FlatMesh& source_mesh, const Model& target,
                         const FlatMesh& target_mesh) {
  const Landmarks from = find_landmarks(source, source_mesh, nullptr),
                  to = find_landmarks(target, target_mesh, nullptr);
  Suggestion out;
  json pairs = json::array();
  bool trunk = false, feet = false;
  for (const Landmark& a : from.list) {
    const std::string other = counterpart(a.name, from, to);
    if (other.empty()) {
      out.notes.push_back("only " + short_name(source) + " has \"" + a.name + "\"");
      continue;
    }
    const Landmark& b = *to.get(other);
    json pair = {{"name", a.name}};
    const json first = selector_json(a.place), second = selector_json(b.place);
    if (first == second) {
      pair["both"] = first;
    } else {
      pair["source"] = first, pair["target"] = second;
    }
    const bool same_kind = other == a.name;
    // a hand is no foot
    if (a.name.find("foot") != std::string::npos && other.find("foot") != std::string::npos) pair["foot"] = feet = true;
    const bool is_trunk = a.name == "withers" || a.name == "rump" || a.name == "seat" || a.name == "upper back";
    if (is_trunk) pair["trunk"] = pair["anchor"] = trunk = true;
    pairs.push_back(pair);
    out.pairs.push_back({a.name, std::min(a.confidence, b.confidence) * (same_kind ? 1 : 0.6), a.found, b.found});
  }
  for (const Landmark& b : to.list) {
    const std::string other = counterpart(b.name, to, from);
    if (other.empty()) out.notes.push_back("only " + short_name(target) + " has \"" + b.name + "\"");
  }
  if (out.pairs.size() < 3) {
    throw std::runtime_error("too little in common to propose pairs: " + short_name(source) + " has " + names_of(from) +
                             "; " + short_name(target) + " has " + names_of(to) +
                             "; write PAIRS.json by hand (--joints lists the joints)");
  }
  if (feet && !trunk)
    out.notes.push_back("no place on the trunk was found on both: add withers and rump, else the trunk floats");
  for (const auto& [model, side] : {std::pair<const Model*, const Landmarks*>(&source, &from), {&target, &to}}) {
    out.notes.push_back(short_name(*model) + " seems to face " + axis_name(side->axes.forward) +
                        (side->upright ? " and stands upright" : "") + " on " + std::to_string(2 * side->leg_pairs) +
                        " legs");
  }
  out.file = {
      {"about", "Proposed for " + short_name(source) + " and " + short_name(target) + ": look at it before use."},
      {"source_axes", axes_json(from.axes)},
      {"target_axes", axes_json(to.axes)},
      {"pairs", pairs}};
  return out;
}

}  // namespace samples
