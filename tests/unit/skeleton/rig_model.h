// A rig of the family as a model: its joints are a skin, every vertex hangs on one of them.
#pragma once
#include <glm/gtc/type_ptr.hpp>

#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "gltf/model.h"
#include "rig_family.h"

namespace hf_test {

// The joints are the nodes from 1 on; node 0 has the mesh.
inline hf_gltf::Model make_rig_model(const PlacedRig& rig, const std::string& name) {
  std::vector<glm::dvec3> positions;
  for (std::size_t k = 0; k < rig.positions.size(); k += 3)
    positions.emplace_back(rig.positions[k], rig.positions[k + 1], rig.positions[k + 2]);
  hf_gltf::Model model = hf_gltf::make_model(name, positions, rig.triangles);
  hf_gltf::Skin skin;
  for (std::size_t j = 0; j < rig.parents.size(); ++j) {
    hf_gltf::Node node;
    node.name = rig.names[j];
    node.matrix = glm::make_mat4(rig.matrices.data() + 16 * j);
    node.parent = rig.parents[j] < 0 ? -1 : rig.parents[j] + 1;
    const int number = static_cast<int>(model.nodes.size());
    if (node.parent < 0)
      model.scene_roots.push_back(number);
    else
      model.nodes[static_cast<std::size_t>(node.parent)].children.push_back(number);
    model.nodes.push_back(node);
    skin.joints.push_back(number);
  }
  const std::vector<glm::dmat4> globals = hf_gltf::global_matrices(model, hf_gltf::rest_pose(model));
  for (const int joint : skin.joints)
    skin.inverse_bind.push_back(glm::mat4(glm::inverse(globals[static_cast<std::size_t>(joint)])));
  model.nodes[0].skin = 0;
  model.skins.push_back(skin);
  auto& primitive = model.meshes[0].primitives[0];
  for (const std::int32_t joint : rig.vertex_joints) {
    hf_gltf::Influences influences;
    influences.joints[0] = static_cast<std::uint16_t>(joint);
    influences.weights[0] = 1;
    primitive.influences.push_back(influences);
  }
  return model;
}

}  // namespace hf_test
