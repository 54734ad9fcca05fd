#include "gltf/character_arrays.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "skeleton/character.h"

namespace hf_gltf {
namespace {

using hf_inner::skeleton::Role;

// A file may hold hundreds of clips; the first ones tell enough.
constexpr size_t most_clips = 100;

// Words in the names of VRM's bones, the first that fits counts.
constexpr std::pair<const char*, Role> bone_words[] = {
    {"hips", Role::spine},    {"spine", Role::spine},  {"hest", Role::spine},    {"neck", Role::neck},
    {"head", Role::head},     {"jaw", Role::jaw},      {"Eye", Role::eye},       {"Shoulder", Role::shoulder},
    {"Thumb", Role::finger},  {"Index", Role::finger}, {"Middle", Role::finger}, {"Ring", Role::finger},
    {"Little", Role::finger}, {"Arm", Role::arm},      {"Hand", Role::hand},     {"Leg", Role::leg},
    {"Foot", Role::foot},     {"Toes", Role::toe}};

void append(const glm::dmat4& matrix, std::vector<double>& out) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) out.push_back(matrix[c][r]);
}

// The middle of the joints of all skins.
glm::dvec3 middle_of_joints(const Model& model, const Pose& pose) {
  const std::vector<glm::dmat4> globals = global_matrices(model, pose);
  glm::dvec3 sum(0);
  double count = 0;
  for (const Skin& skin : model.skins) {
    for (const int joint : skin.joints) {
      sum += glm::dvec3(globals[static_cast<size_t>(joint)][3]);
      count += 1;
    }
  }
  return sum / count;
}

}  // namespace

CharacterArrays::CharacterArrays(const Model& model, const FlatMesh& mesh, const Pose& pose) {
  add_nodes(model, mesh, pose);
  add_surface(model, mesh);
  add_declared(model);
  add_said(model);
  add_travels(model);
}

void CharacterArrays::add_nodes(const Model& model, const FlatMesh& mesh, const Pose& pose) {
  const size_t n = model.nodes.size();
  bound.assign(n, model.skins.empty() || mesh.positions.empty());
  inverse_binds.assign(16 * n, 0.0);
  for (size_t k = 0; k < n; ++k) {
    texts.push_back(model.nodes[k].name);
    parents.push_back(model.nodes[k].parent);
    append(local_matrix(pose[k]), matrices);
  }
  for (const std::string& text : texts) names.push_back(text.c_str());
  for (const Skin& skin : model.skins) {
    for (size_t k = 0; k < skin.joints.size(); ++k) {
      const size_t j = static_cast<size_t>(skin.joints[k]);
      bound[j] = 1;
      std::vector<double> matrix;
      append(glm::dmat4(skin.inverse_bind[k]), matrix);
      std::copy(matrix.begin(), matrix.end(), inverse_binds.begin() + static_cast<std::ptrdiff_t>(16 * j));
    }
  }
}

void CharacterArrays::add_surface(const Model& model, const FlatMesh& mesh) {
  // vertices in no triangle are no part of the body
  std::vector<uint32_t> number(mesh.positions.size(), 0);
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    number[v] = static_cast<uint32_t>(positions.size() / 3);
    for (int c = 0; c < 3 && !mesh.loose[v]; ++c) positions.push_back(mesh.positions[v][c]);
  }
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const uint32_t* corner = mesh.triangles.data() + t;
    if (std::any_of(corner, corner + 3, [&](uint32_t v) { return mesh.loose[v] != 0; })) continue;
    for (int c = 0; c < 3; ++c) triangles.push_back(number[corner[c]]);
  }
  starts.push_back(0);
  for (const FlatPart& part : mesh.parts) {
    const Node& node = model.nodes[static_cast<size_t>(part.node)];
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    const bool skinned = node.skin >= 0 && !primitive.influences.empty();
    for (uint32_t v = 0; v < part.vertex_count; ++v) {
      if (mesh.loose[part.first_vertex + v]) continue;
      vertex_joints.push_back(skinned ? -1 : part.node);
      for (size_t k = 0; skinned && k < 8; ++k) {
        const Influences& influences = primitive.influences[v];
        if (!(influences.weights[k] > 0)) continue;
        joints.push_back(
            static_cast<uint32_t>(model.skins[static_cast<size_t>(node.skin)].joints[influences.joints[k]]));
        weights.push_back(static_cast<double>(influences.weights[k]));
      }
      starts.push_back(static_cast<uint32_t>(joints.size()));
    }
  }
}

void CharacterArrays::declare(const std::string& bone, int node) {
  if (node < 0 || static_cast<size_t>(node) >= roles.size()) return;
  const bool left = bone.rfind("left", 0) == 0, right = bone.rfind("right", 0) == 0;
  for (const auto& [word, role] : bone_words) {
    if (bone.find(word) == std::string::npos) continue;
    roles[static_cast<size_t>(node)] = static_cast<std::int32_t>(role);
    sides[static_cast<size_t>(node)] = left ? 1 : right ? 2 : 0;
    declared = true;
    return;
  }
}

// The humanoid of a VRM file. By their specifications a body of VRM 0 faces -z, one of VRM 1 faces +z.
void CharacterArrays::add_declared(const Model& model) {
  roles.assign(names.size(), -1);
  sides.assign(names.size(), 0);
  if (model.carried.extensions.empty()) return;
  const auto all = nlohmann::json::parse(model.carried.extensions, nullptr, false);
  const auto bones_of = [&](const char* extension) {
    const auto found = all.find(extension);
    if (found == all.end() || !found->is_object() || !found->contains("humanoid")) return nlohmann::json();
    const auto& humanoid = (*found)["humanoid"];
    return humanoid.is_object() && humanoid.contains("humanBones") ? humanoid["humanBones"] : nlohmann::json();
  };
  const auto node_of = [](const nlohmann::json& bone) {
    return bone.is_object() && bone.contains("node") && bone["node"].is_number_integer() ? bone["node"].get<int>() : -1;
  };
  for (const nlohmann::json& bone : bones_of("VRM")) {
    if (bone.is_object() && bone.contains("bone") && bone["bone"].is_string())
      declare(bone["bone"].get<std::string>(), node_of(bone));
  }
  faces = declared;
  if (declared) forward[2] = -1;
  const nlohmann::json newer = bones_of("VRMC_vrm");
  for (const auto& bone : newer.items()) {
    declare(bone.key(), node_of(bone.value()));
    faces = declared;
    forward[2] = 1;
  }
}

void CharacterArrays::add_said(const Model& model) {
  for (const SaidJoint& joint : model.said) {
    for (std::int32_t r = 0; r < hf_inner::skeleton::role_count; ++r)
      if (joint.part == role_name(static_cast<Role>(r))) roles[static_cast<size_t>(joint.node)] = r;
    sides[static_cast<size_t>(joint.node)] = joint.side;
    declared = true;
  }
}

void CharacterArrays::add_travels(const Model& model) {
  if (model.skins.empty() || model.skins.front().joints.empty()) return;
  for (size_t k = 0; k < std::min(model.animations.size(), most_clips); ++k) {
    const Animation& clip = model.animations[k];
    const glm::dvec3 way = middle_of_joints(model, sample(model, clip, clip_duration(clip))) -
                           middle_of_joints(model, sample(model, clip, 0));
    if (std::isfinite(glm::length(way))) travels.insert(travels.end(), {way.x, way.y, way.z});
  }
}

}  // namespace hf_gltf
