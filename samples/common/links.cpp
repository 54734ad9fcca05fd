// See links.h.
#include "common/links.h"

#include "common/model.h"

namespace samples {

ModelLinks::ModelLinks(const Model* model, const FlatMesh& mesh) {
  desc.mode = HF_LINK_PIECES;
  if (!model) return;
  constexpr uint32_t slots = 8;
  bool any = false;
  std::vector<uint16_t> found(size_t{slots} * mesh.vertex_count(), 0);
  std::vector<float> shares(found.size(), 0.0f);
  for (const FlatPart& part : mesh.parts) {
    const Primitive& primitive =
        model->meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    const int skin = model->nodes[static_cast<size_t>(part.node)].skin;
    if (model->nodes.size() > 0xffff) return;
    for (uint32_t i = 0; i < part.vertex_count; ++i) {
      const size_t row = size_t{slots} * (part.first_vertex + i);
      if (skin < 0 || primitive.influences.empty()) {  // moves with its node, like a joint
        found[row] = static_cast<uint16_t>(part.node), shares[row] = 1;
        continue;
      }
      any = true;
      const std::vector<int>& nodes = model->skins[static_cast<size_t>(skin)].joints;
      for (size_t k = 0; k < slots; ++k) {
        const float weight = primitive.influences[i].weights[k];
        if (weight <= 0) continue;
        found[row + k] = static_cast<uint16_t>(nodes[primitive.influences[i].joints[k]]);
        shares[row + k] = weight;
      }
    }
  }
  if (!any) return;
  joints = std::move(found), weights = std::move(shares);
  desc.influence_count = slots, desc.joints = joints.data(), desc.weights = weights.data();
}

}  // namespace samples
