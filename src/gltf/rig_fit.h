// Fits joint rotations of a model's own rig, so that its skin comes nearest to given vertex positions.
//
// For each frame it minimises sum_v a_v |sum_j w_vj G_j B_j p_v - y_v|^2 + k sum_j |turn of j from rest|^2 over the
// local rotations. It takes steps of Levenberg and Marquardt from the frame before. A step that raises the sum is taken
// back and damped. Let x_j = G_j B_j p_v, and o_a be the origin of joint a. A small turn w of joint a, in world space,
// moves vertex v by w x (sum_{j below a} w_vj (x_j - o_a)). The sums over vertices are quadratic in the matrices G_j
// B_j. So they are added up once for each pair of joints, and a step costs O(J^3), whatever the number of vertices.
// Joints that the model's own clips move (roots, and feet that a rig places by inverse kinematics) may shift too. If
// several move the same vertices, one of them shifts. All others keep the lengths of their bones. Positions are in
// world space, in double. A ground (RigGround) adds k_g sum_v a_v d_v^2, where v lies d_v under it. It comes in without
// a step: neither the sum nor its slope jumps where a vertex touches the ground. A vertex under it adds a row to the
// system. Over a clip, misses change evenly. Let r_f be the residual of the fit of frame f: place minus goal, of each
// vertex. The sum over the clip has k_m |r_f - r_g|^2 for each two frames f and g beside each other. For one frame with
// n others beside it this is the fit above with the goals y_f + k_m (sum_g r_g) / (1 + n k_m), where the other terms
// count by 1 / (1 + n k_m). Feet that stand and the ground keep their full weight. So a leg that is shorter in the
// frames than its bones does not snap from one bend of its knee to the other.
#ifndef HF_GLTF_RIG_FIT_H
#define HF_GLTF_RIG_FIT_H

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gltf/animate.h"

namespace hf_gltf {

// A vertex that belongs to a point of a triangle, such as a link between two pieces.
struct RigTie {
  uint32_t vertex = 0, corners[3] = {0, 0, 0};
  double shares[3] = {0, 0, 0};  // barycentric
};

// The ground under frames. A vertex that lies deeper is raised.
struct RigGround {
  glm::dvec3 up{0, 1, 0};        // a unit vector
  std::vector<double> heights;   // along `up`, of each frame
  std::vector<uint8_t> sinking;  // by flat vertex: 1 if it may sink; empty: none may
};

// A pose of the nodes that move vertices, and of those above them. Others move nothing, and there can be many.
struct RigPose {
  Pose nodes;
};

class RigFit {
 public:
  // Throws std::runtime_error when no mesh of the model has a skin, or when its skins have too many joints.
  RigFit(const Model& model, const FlatMesh& mesh, const std::vector<RigTie>& ties = {});

  // The terms of a frame for a pose beside its own places.
  struct Beside {
    const RigPose* middle = nullptr;             // turns that the frame leaves open follow it
    const std::vector<double>* moved = nullptr;  // x y z of every flat vertex that is not met firmly, instead
    double rest = 1, firm = 1;  // factors of weights: of rest pose, middle and ties, and of feet and ground
  };
  // The model at rest.
  const RigPose& rest() const { return rest_; }
  // The pose of every node of the model.
  Pose whole(const RigPose& pose) const;
  // Finds the pose of a frame, starting from `start`. frame: x y z of every flat vertex. The list `firm`: empty, or 0
  // to 1 for every flat vertex. At 1 the fit meets the vertex as exactly as a planted foot. ground: NULL, or the
  // ground; heights[number] counts.
  RigPose fit(const std::vector<double>& frame, const RigPose& start, const std::vector<double>& firm,
              const Beside& beside, const RigGround* ground = nullptr, size_t number = 0) const;
  // The poses of frames, each from the one before, then from those beside it. Frames beside each other that are alike
  // get one pose, and so do the first and the last of a loop. firm: of a frame's number.
  std::vector<RigPose> fit_all(const std::vector<double>& times, const std::vector<std::vector<double>>& frames,
                               const std::function<std::vector<double>(size_t)>& firm,
                               const RigGround* ground = nullptr) const;
  // Returns a copy of the given model whose only clip has the poses at the times.
  Animation clip(const std::string& name, const std::vector<double>& times, const std::vector<RigPose>& poses) const;

  size_t turning() const { return joints_.size(); }
  size_t shifting() const { return shifting_; }

 private:
  struct Joint {
    int node = -1, parent = -1;           // node: in nodes_; parent: in joints_, -1 at the top
    int rotation = -1, translation = -1;  // first unknown
  };
  struct Slot {                 // movers of vertices: a joint of a skin, or a node
    int node = -1, joint = -1;  // node: in nodes_; joint: in joints_, the lowest that may move; -1 when none above does
    glm::dmat4 bind{1};
  };
  struct Term {
    size_t slot;
    glm::dvec4 at;  // weight times place, before `bind`
  };
  struct Row {  // a sum over slots that shall come to a goal
    double weight = 0;
    std::vector<Term> terms;
  };
  struct Tie {
    RigTie tie;
    Row row;
    double length = 0;  // at rest
  };
  class Moments;
  struct System;
  struct Task {  // what a frame asks of a pose
    const Moments& moments;
    glm::dvec3 centre;
    const RigPose* middle;
    const RigGround* ground;
    double floor;                         // height of the ground over the centre
    double stiffness, evenness, lifting;  // weights of the rest pose, of the middle and of the ground
  };
  struct Kept {
    int of_model = -1, parent = -1;  // parent: in nodes_, -1 at the top
  };
  void find_joints(), number_unknowns(const std::vector<char>&carries);
  void find_vertices(const FlatMesh&mesh), keep_moving_nodes();
  // The joint of a node, or of the nearest above it; -1 for none.
  int joint_above(int node) const;
  void find_ties(const FlatMesh& mesh, const std::vector<RigTie>& ties);
  size_t slot_of(int node, const glm::dmat4& bind, int key);
  std::vector<glm::dmat4x3> slot_matrices(const std::vector<glm::dmat4>& globals, const glm::dvec3& centre) const;
  std::vector<glm::dmat4> globals_of(const RigPose& pose) const;
  glm::dvec3 turned(const RigPose& pose, const RigPose& from, const std::vector<glm::dmat4>& globals,
                    const Joint& joint) const;
  double depth(const Task& task, const std::vector<glm::dmat4x3>& at, size_t vertex) const;
  double energy(const Task& task, const RigPose& pose) const;
  System system(const Task& task, const RigPose& pose) const;
  void add_ground(const Task& task, const std::vector<glm::dmat4>& globals, const std::vector<glm::dmat4x3>& at,
                  System& to) const;
  RigPose stepped(const RigPose& pose, const std::vector<double>& step) const;
  std::vector<double> missed(const RigPose& pose, const std::vector<double>& frame) const;

  const Model& model_;
  Pose whole_rest_;          // of every node of the model
  std::vector<Kept> nodes_;  // joints of RigPose, parents first
  RigPose rest_;
  std::vector<Joint> joints_;
  std::vector<int> joint_of_node_;
  std::vector<Slot> slots_;
  std::map<std::pair<int, int>, size_t> slot_number_;
  std::vector<Row> vertices_;  // one for each flat vertex
  std::vector<Tie> ties_;
  std::shared_ptr<const Moments> still_;  // of all vertices, none of them firm
  size_t unknowns_ = 0, shifting_ = 0;
  double diagonal_ = 1, stiffness_ = 0, evenness_ = 0;
};

}  // namespace hf_gltf

#endif
