// Proposes a PAIRS.json from the landmarks of two models: the places that both have. The user should check and edit it.
#ifndef HF_SAMPLES_TRANSFER_SUGGEST_PAIRS_H
#define HF_SAMPLES_TRANSFER_SUGGEST_PAIRS_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "transfer/landmarks.h"

namespace samples {

struct SuggestedPair {
  std::string name;
  double confidence = 0;  // the smaller of the two
  std::string source_found, target_found;
};

struct Suggestion {
  nlohmann::json file;  // what read_pairs reads
  std::vector<SuggestedPair> pairs;
  std::vector<std::string> notes;  // places only one of them has, axes, what to check
};

// Proposes only pairs that a session accepts. Throws std::runtime_error when the two models have too little in common;
// the message says what each has. Axes: null to find them.
Suggestion suggest_pairs(const Model& source, const FlatMesh& source_mesh, const Model& target,
                         const FlatMesh& target_mesh, const Axes* source_axes = nullptr,
                         const Axes* target_axes = nullptr);

}  // namespace samples

#endif
