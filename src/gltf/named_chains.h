// Chains of PAIRS.json: a caller says which joints of each body are an arm, a leg, a tail.
//
//   "chains": [{"name": "left arm", "source": ["LeftArm", "LeftForeArm"], "target": ["Bone.012", "Bone.013"]}]
//
// What is said stands above names and shapes in know_character, and so decides which chains are partners.
#ifndef HF_GLTF_NAMED_CHAINS_H
#define HF_GLTF_NAMED_CHAINS_H

#include <string>
#include <vector>

#include "gltf/json_file.h"
#include "gltf/model.h"

namespace hf_gltf {

struct NamedChain {
  std::string name, part;
  int side = 0;                             // 1: left, 2: right
  std::vector<std::string> source, target;  // names of joints; one of the two may be empty
  std::string where;                        // the place in the file, for messages
};

// Throws std::runtime_error "file: key path: what is wrong".
std::vector<NamedChain> read_chains(const JsonReader& json);

// Writes the chains into Model::said of both. Throws std::runtime_error that names the chain: there is no such joint,
// several have the name, a joint is of two chains.
void say_chains(const std::vector<NamedChain>& chains, Model& source, Model& target);

}  // namespace hf_gltf

#endif
