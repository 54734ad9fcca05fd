// Finds the joints that meshes without a skin follow (riders), such as a helmet or a pack beside the skeleton.
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
  std::vector<int> unknown;  // nodes with a mesh for which no clip shows a joint to follow, scenery too
};

// Reads the clips of the model: a node follows the joint of the body against which it does not move, while that joint
// moves. Among several such joints it follows the one against which it moves least, then the nearest. A node at rest
// while the body moves follows no joint and is not listed. A node whose scale is 0 at rest is not listed either. body:
// of each node, 1: a joint that the body moves. Cost: bounded; a file of thousands of such nodes has the last ones as
// unknown. Polls.
Riders find_riders(const Model& model, const FlatMesh& mesh, const Pose& rest, const std::vector<uint8_t>& body);

// Puts the riders on their joints. A rider under a node or on a joint of scale 0 stays as it is.
void place_riders(const Model& model, const Riders& riders, Pose& pose);

}  // namespace hf_gltf

#endif
