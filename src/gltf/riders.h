// Finds the joints on which meshes without a skin ride, such as a helmet or a pack that stands beside the skeleton.
#ifndef HF_GLTF_RIDERS_H
#define HF_GLTF_RIDERS_H

#include <vector>

#include "gltf/animate.h"
#include "gltf/flat_mesh.h"

namespace hf_gltf {

// A node that keeps its place on a joint.
struct Rider {
  int node = -1, joint = -1;
  glm::dmat4 on_joint{1};  // the transform of the node in the space of the joint
};

struct Riders {
  std::vector<Rider> known;
  std::vector<int> unknown;  // nodes with a mesh of which no clip says where they ride, scenery too
};

// Reads the clips of the model: a node rides on the joint of the body against which it does not move, while that joint
// moves. Where several are such, on the one against which it moves least, then on the nearest. A node that stands still
// while the body moves rides on none, and is not listed; neither is one whose scale is 0 at rest. body: of each node,
// 1: a joint that the body moves. Cost: bounded; a file of thousands of such nodes has the last ones as unknown. Polls.
Riders find_riders(const Model& model, const FlatMesh& mesh, const Pose& rest, const std::vector<uint8_t>& body);

// Puts the riders on their joints. A rider under a node or on a joint of scale 0 stays as it is.
void place_riders(const Model& model, const Riders& riders, Pose& pose);

}  // namespace hf_gltf

#endif
