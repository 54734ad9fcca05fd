// Animations sampled: channels -> node transforms -> world matrices -> posed vertices.
//
// Interpolation as glTF 2.0, appendix C: STEP holds the key before; LINEAR is a straight line, for rotations the
// spherical one on the shorter arc; CUBICSPLINE is the Hermite polynomial
//   p(s) = (2s^3 - 3s^2 + 1) v_k + d (s^3 - 2s^2 + s) b_k + (-2s^3 + 3s^2) v_k+1 + d (s^3 - s^2) a_k+1,
// s = (t - t_k) / d, d = t_k+1 - t_k, a = in-tangent, b = out-tangent, rotations normalised afterwards. Before the
// first and after the last key the value is held. Skinning is the linear blend sum_j w_j J_j B_j p, J the joint's world
// matrix and B its inverse bind matrix; morph targets are added before it.
//
// Everything is computed in double. Cost: keys logarithmic, nodes and vertices linear. No recursion.
#ifndef HF_GLTF_ANIMATE_H
#define HF_GLTF_ANIMATE_H

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/model.h"

namespace hf_gltf {

// One node's local state.
struct NodePose {
  glm::dvec3 translation{0, 0, 0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1, 1, 1};
  bool fixed = false;  // use matrix
  glm::dmat4 matrix{1};
  std::vector<double> weights;  // morph weights of the node's mesh, full length
};

// One per node.
using Pose = std::vector<NodePose>;

Pose rest_pose(const Model& model);
Pose sample(const Model& model, const Animation& animation, double time);

// The value of one channel: width numbers (rotations x y z w, unit length).
std::vector<double> sample_channel(const Channel& channel, double time);

glm::dmat4 local_matrix(const NodePose& pose);
// World matrix of every node, parents first. A cycle, which read_gltf refuses, is a std::runtime_error.
std::vector<glm::dmat4> global_matrices(const Model& model, const Pose& pose);

// Last key of all channels, in seconds; 0 without keys. Clips start at 0.
double clip_duration(const Animation& animation);
// All distinct key times, increasing.
std::vector<double> key_times(const Animation& animation);
// 0, 1/rate, ... and the end.
std::vector<double> frame_times(const Animation& animation, double rate);

// World positions of the flat mesh's vertices.
std::vector<glm::dvec3> posed_positions(const Model& model, const FlatMesh& mesh, const Pose& pose);
std::vector<glm::dvec3> posed_positions(const Model& model, const FlatMesh& mesh, const Animation& animation,
                                        double time);

// The given nodes and all above them, parents first.
std::vector<int> with_parents(const Model& model, const std::vector<int>& nodes);

// Poses a surface at many times. Nodes that move none of its vertices cost nothing: a file can have 30,000 of them.
// Keeps references to the model and the mesh.
class SurfacePoser {
 public:
  SurfacePoser(const Model& model, const FlatMesh& mesh);
  // What posed_positions() gives.
  std::vector<glm::dvec3> at(const Animation& animation, double time);

 private:
  const Model& model_;
  const FlatMesh& mesh_;
  std::vector<int> nodes_;  // those that move a vertex, and all above them
  std::vector<char> moves_;
  Pose rest_, pose_;
  std::vector<glm::dmat4> globals_;
};

// The same for one primitive; normals (may be null) are moved by the inverse transposed of the same blend.
std::vector<glm::dvec3> posed_primitive(const Model& model, const Pose& pose, const std::vector<glm::dmat4>& globals,
                                        int node, const Primitive& primitive, std::vector<glm::vec3>* normals);

// Blend matrix of every vertex of a primitive: sum_j w_j J_j B_j, or the node's world matrix without a skin.
std::vector<glm::dmat4> vertex_matrices(const Model& model, const std::vector<glm::dmat4>& globals, int node,
                                        const Primitive& primitive);

// Index by name, or -1.
int find_node(const Model& model, const std::string& name);
int find_animation(const Model& model, const std::string& name);

}  // namespace hf_gltf

#endif
