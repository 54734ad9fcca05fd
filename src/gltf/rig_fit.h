// Fits joint rotations of a model's own rig, so that its skin comes nearest to given vertex positions.
//
// For each frame it minimises sum_v a_v |sum_j w_vj G_j B_j p_v - y_v|^2 + k sum_j |turn of j from rest|^2 over the
// local rotations, by damped Gauss-Newton from the frame before. Let x_j = G_j B_j p_v, and o_a be the origin of joint
// a. A small world turn w of a moves v by w x (sum_{j below a} w_vj (x_j - o_a)). So a vertex only involves the joints
// above those that influence it, and an iteration costs O(V d^2 + J^3). Joints that the model's own clips move (roots,
// and feet that a rig places by inverse kinematics) may shift too. All others keep the lengths of their bones.
// Positions are in world space, in double.
#ifndef HF_GLTF_RIG_FIT_H
#define HF_GLTF_RIG_FIT_H

#include <functional>
#include <vector>

#include "gltf/animate.h"

namespace hf_gltf {

class RigFit {
 public:
  // Throws std::runtime_error when no mesh of the model has a skin.
  RigFit(const Model& model, const FlatMesh& mesh);

  // Finds the pose of the frame (x y z of every flat vertex), starting from `start`. iterations: number of Gauss-Newton
  // steps. firm: empty, or per flat vertex from 0 to 1 how firmly it must be met: a foot that stands.
  Pose fit(const std::vector<double>& frame, const Pose& start, int iterations,
           const std::vector<double>& firm = {}) const;
  // The poses of frames, each from the one before. firm: of a frame's number.
  std::vector<Pose> fit_all(const std::vector<std::vector<double>>& frames,
                            const std::function<std::vector<double>(size_t)>& firm) const;
  // Returns a copy of the given model whose only clip has the poses at the times.
  Animation clip(const std::string& name, const std::vector<double>& times, const std::vector<Pose>& poses) const;

  size_t turning() const { return joints_.size(); }
  size_t shifting() const { return shifting_; }

 private:
  struct Joint {
    int node = -1, parent = -1;           // parent: in joints_, -1 at the top
    int rotation = -1, translation = -1;  // first unknown
  };
  struct Influence {
    int joint;  // in joints_, the lowest that may move; -1 when none above does
    double weight;
    glm::dvec3 rest;  // B p, in the space of `node`
    int node;
  };
  struct Vertex {
    double area = 0;
    uint32_t flat = 0;
    std::vector<Influence> influences;
  };
  void find_joints(), find_vertices(const FlatMesh&mesh);

  const Model& model_;
  std::vector<Joint> joints_;
  std::vector<int> joint_of_node_;
  std::vector<Vertex> vertices_;
  size_t unknowns_ = 0, shifting_ = 0;
  double diagonal_ = 1;
};

}  // namespace hf_gltf

#endif
