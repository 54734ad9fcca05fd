// The rig of a model: joints and the surface they move, in the space in which the surface was bound to them.
#ifndef HF_SAMPLES_WEIGHTS_RIG_H
#define HF_SAMPLES_WEIGHTS_RIG_H

#include <set>
#include <string>
#include <vector>

#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "hf/hf.hpp"

namespace samples {

using namespace hf_gltf;

// A primitive that a skin moves. Its vertices stand behind those of the parts before.
struct RigPart {
  int node = -1, mesh = -1, primitive = -1, skin = -1;
  uint32_t first_vertex = 0;
};

// Joints and weights per vertex of the rig.
struct RigWeights {
  uint32_t per_vertex = 8;
  std::vector<uint32_t> joints;
  std::vector<float> weights;
};

struct Rig {
  size_t joint_count() const { return joints.size() - end_count; }  // those of the skins
  std::vector<RigPart> parts;
  std::vector<glm::dvec3> positions;  // bind space of the first skin
  std::vector<uint32_t> triangles;
  std::vector<uint8_t> loose;  // 1 for vertices that no triangle has
  std::vector<int> joints;     // nodes; the joints of all skins, each once, then the ends
  size_t end_count = 0;        // nodes in no skin that say where their parents end, as exporters write tails
  std::vector<std::string> names;
  std::vector<glm::dmat4> inverse_bind;  // from the bind space of the first skin
  hf::Joints bones;                       // heads and parents of the joints; a joint deforms if a vertex has it
  RigWeights given;                      // the weights of the file
  double diagonal = 0;                   // of the box of positions that are not loose
};

// The skins that meshes use, by skeleton. Skins are of one skeleton if they share a joint, or if the next joint above
// one of a skin's joints belongs to the other. Throws std::runtime_error if the model has no skin.
std::vector<std::vector<int>> skeletons_of(const Model& model);
// The rig of some skins; without vertices if no triangle has their joints.
Rig read_rig(const Model& model, const std::vector<int>& skins);
// The rig of all skins. Throws std::runtime_error if no triangle has their joints.
Rig read_rig(const Model& model);

// The joint of a name, or of a node's number ("#34"). Throws std::runtime_error, behind `where`, if there is none, or
// if several joints have the name.
uint32_t joint_named(const Rig& rig, const std::string& name, const std::string& where = "");

// Moves the vertices: sum of w J B p, J the world matrices of the joints.
std::vector<glm::dvec3> pose_rig(const Rig& rig, const std::vector<glm::dmat4>& globals, const RigWeights& weights);

// Poses of the model's clips, 40 to 54 in all. A model without clips gets one in which every joint swings.
std::vector<Pose> clip_poses(const Model& model, const Rig& rig);

// The rest pose with joints turned about axes of their own. Each text is JOINT,AXIS,DEGREES with x, y or z. Throws
// std::runtime_error naming what is wrong with a text.
Pose bent_pose(const Model& model, const Rig& rig, const std::vector<std::string>& bends);

// Puts weights into the primitives. A mesh that another node has with other weights is copied. written: the meshes that
// have new weights already, for a model of several skeletons.
void write_weights(Model& model, const Rig& rig, const RigWeights& weights, std::set<int>& written);

}  // namespace samples

#endif
