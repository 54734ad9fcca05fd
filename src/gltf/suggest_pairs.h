// Proposes a PAIRS.json from the landmarks of two models: the places that both have. The user should check and edit it.
#ifndef HF_GLTF_SUGGEST_PAIRS_H
#define HF_GLTF_SUGGEST_PAIRS_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf/landmarks.h"

namespace hf_gltf {

struct SuggestedPair {
  std::string name;
  double confidence = 0;  // the smaller of the two
  std::string source_found, target_found;
};

struct Suggestion {
  nlohmann::json file;  // the file for read_pairs
  std::vector<SuggestedPair> pairs;
  std::vector<std::string> notes;  // places only one of them has, axes, things to check
  Landmarks source, target;        // the findings on each
};

// Proposes only pairs that a session accepts. Throws std::runtime_error when the two models have too little in common;
// the message says what each has.
Suggestion suggest_pairs(const Body& source, const Body& target);

}  // namespace hf_gltf

#endif
