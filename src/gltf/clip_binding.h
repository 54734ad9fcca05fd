// Clips of a file without a surface (an animation library) put on a model of the same skeleton.
#ifndef HF_GLTF_CLIP_BINDING_H
#define HF_GLTF_CLIP_BINDING_H

#include <string>
#include <vector>

#include "gltf/model.h"

namespace hf_gltf {

// Whether a model shows anything: a triangle or a line.
bool has_surface(const Model& model);

// The clips of a name: the exact one, the part after the last '|', or an index; "all", or empty for the first. Throws
// with a list of the existing clips, and where several have the name.
std::vector<const Animation*> choose_clips(const Model& model, const std::string& wanted);

// Tells whether a mesh of the model has a skin.
bool has_skin(const Model& model);

// Puts a clip at a place in the list, under a name of its own. Nodes that it moves lose their matrix.
void insert_clip(Model& model, size_t place, Animation clip);

struct BoundClips {
  Model model;                       // the model, the clips before its own
  size_t clips = 0;                  // how many were put in
  size_t joints = 0, animated = 0;   // joints that the clips move: found in the model, and all
  size_t shared = 0;                 // joints that the clips move and whose name is not theirs alone
  std::vector<std::string> missing;  // joints that the model lacks
  double scale = 1;                  // lengths of the model's skeleton over lengths of the clips'
};

// Joints are found by name and, where several have it, by the tree (node_match.h). Rotations are taken as they are.
// Translations count from the rest pose of their own file, scaled, so that the model keeps the lengths of its bones.
// wanted: as for choose_clips. Throws std::runtime_error if the model has less than half of the joints.
BoundClips bind_clips(const Model& model, const Model& clips, const std::string& wanted);

// A node's matrix as translation, rotation and scale: a node that is animated may not have a matrix.
void split_matrix(Node& node);

}  // namespace hf_gltf

#endif
