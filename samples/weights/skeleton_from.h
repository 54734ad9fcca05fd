// Puts the skeleton of one model into another that has none.
#ifndef HF_SAMPLES_WEIGHTS_SKELETON_FROM_H
#define HF_SAMPLES_WEIGHTS_SKELETON_FROM_H

#include <filesystem>
#include <string>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/model.h"

namespace samples {

using namespace hf_gltf;

// A place of the model with the skeleton, and where it is on the other; world space at rest.
struct Landmark {
  glm::dvec3 from, to;
};

// Landmarks from a pairs file of hf_transfer: the middles of its regions. source: the model with the skeleton.
std::vector<Landmark> pair_landmarks(const std::filesystem::path& file, const Model& source, const Model& target);
// Landmarks from nodes of the target that have the names of joints.
std::vector<Landmark> name_landmarks(const Model& source, const Model& target);

struct TakenSkeleton {
  Model model;                   // the target, baked, with joints and all vertices on the first of them
  std::vector<uint8_t> deforms;  // by joint: 1 if it has weights in the source
};

// in_place: the joints stay where they are. Else they stand where the box of the source leads to in the box of the
// target, moved so that landmarks fit exactly. Throws std::runtime_error if the source has no skin.
TakenSkeleton take_skeleton(const Model& source, const Model& target, const std::vector<Landmark>& landmarks,
                            bool in_place = false);

}  // namespace samples

#endif
