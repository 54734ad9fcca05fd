// See transfer_inputs.h.
#include "transfer/transfer_inputs.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "common/mesh_file.h"
#include "gltf/clip_binding.h"
#include "gltf/file_kind.h"
#include "gltf/gltf_read.h"
#include "gltf/regions.h"
#include "transfer/outputs.h"

namespace samples {

using namespace hf_gltf;

void list_joints(const std::filesystem::path& file) {
  const Model model = read_gltf(file);
  const FlatMesh mesh = flatten(model);
  const RegionFinder finder(model, mesh, {});
  if (mesh.vertex_count() > 0)
    std::printf("%s: %u vertices, box diagonal %.4f\n", file.string().c_str(), mesh.vertex_count(), finder.diagonal());
  else
    std::printf("%s: joints and clips without a surface\n", file.string().c_str());
  for (const std::string& line : finder.describe_joints()) std::printf("  %s\n", line.c_str());
  for (const Animation& clip : model.animations)
    std::printf("  clip \"%s\", %.2f s\n", clip.name.c_str(), clip_duration(clip));
}

Model read_model(const std::filesystem::path& file) {
  if (is_model(kind_of_file(file))) return read_gltf(file);
  const SurfaceMesh mesh = read_mesh_file(file);
  Model model = make_model(file.string(), mesh.positions, mesh.triangles);
  model.warnings = mesh.warnings;
  return model;
}

std::optional<Pose> pose_of(const Model& model, const std::string& choice, const std::string& option) {
  if (choice.empty()) return {};
  const size_t cut = choice.rfind('@');
  char* end = nullptr;
  const double time = cut == std::string::npos ? 0 : std::strtod(choice.c_str() + cut + 1, &end);
  if (cut == std::string::npos || end == choice.c_str() + cut + 1 || *end != 0)
    throw std::runtime_error(option + " takes CLIP@TIME with the time in seconds, not \"" + choice + "\"");
  const Animation& clip = [&]() -> const Animation& {
    try {
      return *choose_clips(model, choice.substr(0, cut)).front();
    } catch (const std::exception& error) {
      throw std::runtime_error(option + ": " + error.what());
    }
  }();
  if (!(time >= 0 && time <= clip_duration(clip)))
    throw std::runtime_error(option + ": clip \"" + clip.name + "\" lasts " + std::to_string(clip_duration(clip)) +
                             " s; the time must lie within it");
  return sample(model, clip, time);
}

Model rested(Model out, const std::optional<Pose>& chosen) {
  if (!chosen) return out;
  const Pose& pose = *chosen;
  for (size_t n = 0; n < pose.size(); ++n) {
    Node& node = out.nodes[n];
    if (pose[n].weights.size() == node.weights.size())
      for (size_t k = 0; k < node.weights.size(); ++k) node.weights[k] = static_cast<float>(pose[n].weights[k]);
    if (pose[n].fixed) continue;
    node.matrix.reset();
    node.translation = pose[n].translation;
    node.rotation = glm::quat(pose[n].rotation);
    node.scale = glm::vec3(pose[n].scale);
  }
  return out;
}

Motion read_motion(const Model& source, const TransferCommand& command) {
  Motion out;
  if (command.poses.empty()) {
    if (source.animations.empty())
      throw std::runtime_error(source.name +
                               " has no clip; --clips FILE takes the clips of another file with its skeleton");
    out.clips = choose_clips(source, command.clip);  // a wrong name should not cost a factorisation
    return out;
  }
  const size_t vertices = flatten(source).positions.size();
  for (const std::filesystem::path& file : command.poses) {
    const SurfaceMesh mesh = read_mesh_file(file);
    if (mesh.positions.size() != vertices) {
      throw std::runtime_error(file.string() + ": " + std::to_string(mesh.positions.size()) + " vertices; a pose of " +
                               source.name + " needs " + std::to_string(vertices) + " in its order");
    }
    out.poses.push_back(double_positions(mesh.positions));
  }
  return out;
}

std::vector<std::vector<double>> some_poses(const Model& source, const FlatMesh& mesh, const Animation& clip) {
  SurfacePoser surface(source, mesh);
  std::vector<std::vector<double>> out;
  for (int k = 0; k < 24; ++k) out.push_back(double_positions(surface.at(clip, clip_duration(clip) * k / 23)));
  return out;
}

}  // namespace samples
