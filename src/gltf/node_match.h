// Matches the nodes of one model with the nodes of another, where names can occur several times.
//
// A name that both have once decides. The nodes above two such nodes follow from them. All other nodes are found from
// above: among the children of their parent's node. Children of one name are told apart by the directions of their rest
// translations, then by their order. A prefix up to a ':' counts only where a name without it is not enough.
#ifndef HF_GLTF_NODE_MATCH_H
#define HF_GLTF_NODE_MATCH_H

#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

struct NodeMatch {
  std::vector<int> there;    // by node of the first model: the node of the second, or -1
  std::vector<char> shared;  // by node of the first model: 1 if another node of either model has its name
};

// Looks for the given nodes and all above them.
NodeMatch match_nodes(const Model& from, const std::vector<int>& nodes, const Model& to);

// The nodes of a name. Where some of them are joints of a skin, those alone. "#34" is node 34, unless one is called so.
std::vector<int> nodes_named(const Model& model, const std::string& name);
// "2 joints "hand"; ...": what a refusal says after the name of the model.
std::string several_joints(const std::string& name, const std::vector<int>& nodes);
// The node of "#34", or -1.
int node_number(const std::string& name);

// Where a node is at rest below its parent.
glm::dvec3 rest_translation(const Node& node);

}  // namespace hf_gltf

#endif
