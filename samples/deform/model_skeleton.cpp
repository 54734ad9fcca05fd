// Makes an hf_skeleton from the nodes, skins and rigid meshes of a model.
#include "deform/model_skeleton.h"

#include <algorithm>
#include <string>
#include <vector>

#include "common/links.h"
#include "deform/posable.h"
#include "gltf/character_arrays.h"
#include "gltf/pose_numbers.h"

namespace samples {

ModelSkeleton::ModelSkeleton(const Model& model, const FlatMesh& mesh) {
  const ModelLinks skin(&model, mesh);
  if (skin.joints.empty()) return;
  const CharacterArrays arrays(model, mesh);
  std::string names;
  for (std::string name : arrays.texts) {
    std::replace(name.begin(), name.end(), '\n', ' ');
    names += name + "\n";
  }
  std::vector<double> numbers;
  append_trs(rest_pose(model), numbers);
  const std::vector<float> rest(numbers.begin(), numbers.end());
  // a vertex in no triangle may be anywhere: it stands beside another one and has no joint
  std::vector<float> positions, weights = skin.weights;
  const size_t width = weights.size() / mesh.positions.size();
  const size_t used = mesh.triangles.front();
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(mesh.positions[mesh.loose[v] ? used : v][c]));
    if (mesh.loose[v]) std::fill_n(weights.begin() + static_cast<std::ptrdiff_t>(v * width), width, 0.0f);
  }
  const std::vector<uint32_t> joints(skin.joints.begin(), skin.joints.end());
  const std::vector<float> binds(arrays.inverse_binds.begin(), arrays.inverse_binds.end()),
      travels(arrays.travels.begin(), arrays.travels.end()), up(arrays.up, arrays.up + 3),
      forward(arrays.forward, arrays.forward + 3);
  hf_skin_desc surface = HF_INIT(hf_skin_desc);
  surface.vertex_count = mesh.vertex_count();
  surface.triangle_count = mesh.triangle_count();
  surface.influence_count = skin.desc.influence_count;
  surface.at_rest = 1;
  surface.positions = positions.data();
  surface.triangles = mesh.triangles.data();
  surface.joints = joints.data();
  surface.weights = weights.data();
  hf_skeleton_desc desc = HF_INIT(hf_skeleton_desc);
  desc.joint_count = static_cast<uint32_t>(skin.parents.size());
  desc.names = names.c_str();
  desc.parents = skin.parents.data();
  desc.rest = rest.data();
  desc.inverse_binds = binds.data();
  desc.up = up.data();
  desc.travel_count = static_cast<uint32_t>(travels.size() / 3);
  desc.travels = travels.data();
  desc.skin = &surface;
  if (arrays.declared) {
    desc.roles = arrays.roles.data();
    desc.sides = arrays.sides.data();
    desc.forward = forward.data();
  }
  expect_ok(hf_skeleton_create(&desc, &skeleton_), "the skeleton");
}

}  // namespace samples
