#include "gltf_character.h"

#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>

namespace hf_test {

using hf_inner::Role;

GltfCharacter::GltfCharacter(const hf_gltf::Model& model) {
  add_nodes(model);
  add_surface(model);
  add_declared(model);
}

void GltfCharacter::add_nodes(const hf_gltf::Model& model) {
  const std::size_t n = model.nodes.size();
  bound.assign(n, model.skins.empty());
  inverse_binds.assign(16 * n, 0.0);
  for (const auto& node : model.nodes) {
    texts.push_back(node.name);
    parents.push_back(node.parent);
    const glm::dmat4 local = node.matrix ? glm::dmat4(*node.matrix)
                                         : glm::translate(glm::dmat4(1.0), glm::dvec3(node.translation)) *
                                               glm::dmat4(glm::mat4_cast(node.rotation)) *
                                               glm::dmat4(glm::scale(glm::mat4(1.0f), node.scale));
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r) matrices.push_back(local[c][r]);
    }
  }
  for (const auto& text : texts) names.push_back(text.c_str());
  for (const auto& skin : model.skins) {
    for (std::size_t k = 0; k < skin.joints.size(); ++k) {
      const std::size_t j = static_cast<std::size_t>(skin.joints[k]);
      bound[j] = 1;
      for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r)
          inverse_binds[16 * j + static_cast<std::size_t>(4 * c + r)] = skin.inverse_bind[k][c][r];
      }
    }
  }
}

void GltfCharacter::add_surface(const hf_gltf::Model& model) {
  const hf_gltf::FlatMesh mesh = hf_gltf::flatten(model);
  positions = hf_gltf::double_positions(mesh.positions);
  triangles = mesh.triangles;
  starts.push_back(0);
  for (const auto& part : mesh.parts) {
    const auto& node = model.nodes[static_cast<std::size_t>(part.node)];
    const auto& primitive =
        model.meshes[static_cast<std::size_t>(part.mesh)].primitives[static_cast<std::size_t>(part.primitive)];
    for (std::uint32_t v = 0; v < part.vertex_count; ++v) {
      const bool skinned = node.skin >= 0 && !primitive.influences.empty();
      vertex_joints.push_back(skinned ? -1 : part.node);
      if (skinned) {
        const auto& skin = model.skins[static_cast<std::size_t>(node.skin)];
        for (std::size_t k = 0; k < 8; ++k) {
          const float w = primitive.influences[v].weights[k];
          if (w > 0) {
            joints.push_back(static_cast<std::uint32_t>(skin.joints[primitive.influences[v].joints[k]]));
            weights.push_back(w);
          }
        }
      }
      starts.push_back(static_cast<std::uint32_t>(joints.size()));
    }
  }
}

void GltfCharacter::declare(const std::string& bone, int node) {
  if (node < 0 || static_cast<std::size_t>(node) >= roles.size()) return;
  const bool left = bone.rfind("left", 0) == 0, right = bone.rfind("right", 0) == 0;
  const std::string part = left ? bone.substr(4) : right ? bone.substr(5) : bone;
  static const std::vector<std::pair<const char*, Role>> parts = {
      {"hips", Role::spine},  {"spine", Role::spine},  {"hest", Role::spine},   {"neck", Role::neck},
      {"head", Role::head},   {"jaw", Role::jaw},      {"Eye", Role::eye},      {"Shoulder", Role::shoulder},
      {"Arm", Role::arm},     {"Hand", Role::hand},    {"Leg", Role::leg},      {"Foot", Role::foot},
      {"Toes", Role::toe},    {"Thumb", Role::finger}, {"Index", Role::finger}, {"Middle", Role::finger},
      {"Ring", Role::finger}, {"Little", Role::finger}};
  for (const auto& [word, role] : parts) {
    if (part.find(word) == std::string::npos) continue;
    roles[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(role);
    sides[static_cast<std::size_t>(node)] = left ? 1 : right ? 2 : 0;
    declared = true;
  }
}

void GltfCharacter::add_declared(const hf_gltf::Model& model) {
  roles.assign(names.size(), -1);
  sides.assign(names.size(), 0);
  if (model.carried.extensions.empty()) return;
  const auto all = nlohmann::json::parse(model.carried.extensions, nullptr, false);
  if (all.contains("VRM") && all["VRM"].contains("humanoid")) {
    for (const auto& bone : all["VRM"]["humanoid"]["humanBones"])
      declare(bone.value("bone", ""), bone.value("node", -1));
  }
  if (all.contains("VRMC_vrm") && all["VRMC_vrm"].contains("humanoid")) {
    for (const auto& [bone, value] : all["VRMC_vrm"]["humanoid"]["humanBones"].items())
      declare(bone, value.value("node", -1));
  }
}

hf_inner::CharacterInput GltfCharacter::input(bool with_names, bool with_up, bool with_declared) const {
  hf_inner::CharacterInput in;
  in.joint_count = static_cast<std::uint32_t>(parents.size());
  in.names = with_names ? names.data() : nullptr;
  in.parents = parents.data();
  in.matrices = matrices.data();
  in.inverse_binds = inverse_binds.data();
  in.bound = bound.data();
  in.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
  in.positions = positions.data();
  in.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
  in.triangles = triangles.data();
  in.influence_starts = starts.data();
  in.influence_joints = joints.data();
  in.influence_weights = weights.data();
  in.vertex_joints = vertex_joints.data();
  if (with_up) in.up = up;
  if (with_declared && declared) {
    in.roles = roles.data();
    in.sides = sides.data();
  }
  return in;
}

}  // namespace hf_test
