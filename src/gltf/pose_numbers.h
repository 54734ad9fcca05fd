// Poses as plain numbers, 10 a node, and as channels of a clip.
#ifndef HF_GLTF_POSE_NUMBERS_H
#define HF_GLTF_POSE_NUMBERS_H

#include <string>
#include <vector>

#include "gltf/animate.h"

namespace hf_gltf {

// Appends 10 numbers a node: translation, rotation x y z w, scale. A matrix is split.
void append_trs(const Pose& pose, std::vector<double>& out);
// The pose of such numbers. The rest pose gives the parts that they leave out.
Pose pose_of(const Pose& rest, const std::vector<double>& trs);

// The clip of the poses: channels for nodes that leave the pose of the file.
Animation clip_of_poses(const Model& model, const std::string& name, const std::vector<double>& times,
                        const std::vector<Pose>& poses);

}  // namespace hf_gltf

#endif
