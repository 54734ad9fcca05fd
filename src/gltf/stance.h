// Finds the standing pose of a body. In most files the nodes have that pose. Some files store the middle of a clip, or
// a pose that no clip uses: the skeleton is then hard to understand, and motion counts from the wrong pose.
#ifndef HF_GLTF_STANCE_H
#define HF_GLTF_STANCE_H

#include <optional>
#include <string>

#include "gltf/animate.h"
#include "gltf/regions.h"

namespace hf_gltf {

struct Stance {
  Pose pose;
  bool needed = false;  // in the pose of the file the body is not understood
  std::string from;     // "as bound", "as at the start of the clip \"idle\""
};

// Returns a pose of the file that is a better standing pose. Its joints mirror each other, its parts are known, its
// legs are on the ground. It is the pose in which the skin was bound, else the pose at the start or the end of a clip.
// A pose of the nodes that stands, but is uneven by more than two degrees of a limb, gives way to the bound pose alone.
// None: the pose of the nodes is good enough, or no pose is better. axes: given by the caller, or null.
std::optional<Stance> find_stance(const Model& model, const FlatMesh& mesh, const Axes* axes);

// The mesh with its positions in a pose.
FlatMesh standing(FlatMesh mesh, const Model& model, const Pose& pose);

}  // namespace hf_gltf

#endif
