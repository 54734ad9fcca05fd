// What hf_transfer reads: models, a pose that is named as rest, clips or posed meshes.
#ifndef HF_SAMPLES_TRANSFER_INPUTS_H
#define HF_SAMPLES_TRANSFER_INPUTS_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gltf/animate.h"
#include "transfer/transfer_options.h"

namespace samples {

// Prints the joints of a model, the vertices they own, and its clips.
void list_joints(const std::filesystem::path& file);

// A model of a file; a mesh file is a model without a skin, in its own vertex order.
hf_gltf::Model read_model(const std::filesystem::path& file);

// The pose of a clip at a time. choice: CLIP@TIME, the time in seconds; none if it is empty. Throws std::runtime_error
// that names the option.
std::optional<hf_gltf::Pose> pose_of(const hf_gltf::Model& model, const std::string& choice, const std::string& option);

// The model with a pose as its rest pose.
hf_gltf::Model rested(hf_gltf::Model model, const std::optional<hf_gltf::Pose>& pose);

// The source's motion: clips, or one sequence of posed meshes.
struct Motion {
  std::vector<const hf_gltf::Animation*> clips;
  std::vector<std::vector<double>> poses;
};

// Throws std::runtime_error: there is no clip of that name, a mesh has another count of vertices.
Motion read_motion(const hf_gltf::Model& source, const TransferCommand& command);

// Some poses of a clip, to look for contacts.
std::vector<std::vector<double>> some_poses(const hf_gltf::Model& source, const hf_gltf::FlatMesh& mesh,
                                            const hf_gltf::Animation& clip);

}  // namespace samples

#endif
