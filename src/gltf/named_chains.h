// Reads the chains of PAIRS.json, with which a caller says which joints of a body are an arm, a leg or a tail.
//
//   "chains": [{"name": "left arm", "source": ["LeftArm", "LeftForeArm"], "target": ["Bone.012", "Bone.013"]}]
//
// In know_character these chains take precedence over names and shapes. So they decide which chains are partners.
#ifndef HF_GLTF_NAMED_CHAINS_H
#define HF_GLTF_NAMED_CHAINS_H

#include <string>
#include <vector>

#include "gltf/json_file.h"
#include "gltf/model.h"

namespace hf_gltf {

struct NamedChain {
  std::string name, part;                   // part: the word for the part in `name`, such as "arm"
  int side = 0;                             // 0: none, 1: left, 2: right
  std::vector<std::string> source, target;  // names of joints; one of the two may be empty
  std::string where;                        // the place in the file, for messages
};

// Throws std::runtime_error that names the file, the key and the fault.
std::vector<NamedChain> read_chains(const JsonReader& json);

// Writes the chains of both models into Model::said. Throws std::runtime_error that names the chain and the joint: the
// model has no such joint, several joints have the name, or a joint is in two chains. Model::said may then be partial.
void say_chains(const std::vector<NamedChain>& chains, Model& source, Model& target);

}  // namespace hf_gltf

#endif
