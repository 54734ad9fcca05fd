// See links.h.
#include "common/links.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "gltf/model.h"

namespace samples {

using namespace hf_gltf;

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
        found[row] = static_cast<uint16_t>(part.node);
        shares[row] = 1;
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
  joints = std::move(found);
  weights = std::move(shares);
  desc.influence_count = slots;
  desc.joints = joints.data();
  desc.weights = weights.data();
  for (const Node& node : model->nodes) parents.push_back(node.parent < 0 ? HF_NO_INDEX : uint32_t(node.parent));
  desc.joint_count = static_cast<uint32_t>(parents.size());
  desc.joint_parents = parents.data();
}

namespace {

hf_gaps_info measure(hf_surface surface, const std::vector<double>& positions) {
  const hf_array posed = HF_ARRAY(positions.data(), positions.size() / 3);
  hf_gaps_info info = HF_INIT(hf_gaps_info);
  if (hf_surface_measure_gaps(surface, &posed, 0, nullptr, &info) == HF_OK) return info;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw std::runtime_error(std::string("gaps between linked pieces: ") + detail.message);
}

}  // namespace

std::string gaps_sentence(hf_surface surface, const std::vector<double>& positions, double diagonal) {
  const hf_gaps_info info = measure(surface, positions);
  if (info.link_count == 0) return {};
  char text[160];
  std::string out;
  if (info.touching_count > 0) {
    std::snprintf(text, sizeof text, "linked pieces open by %.2g %% of the box where they touch; ",
                  100 * info.worst_opening / diagonal);
    out = text;
  }
  std::snprintf(text, sizeof text, "gaps of links: %.2g %% of the box at 95 of 100 links, %.2g %% at worst",
                100 * info.percentile_95 / diagonal, 100 * info.worst / diagonal);
  out += text;
  if (info.contact_count > 0) {
    std::snprintf(text, sizeof text, "; pieces that only touch open by %.2g %% at worst",
                  100 * info.worst_contact / diagonal);
    out += text;
  }
  return out;
}

void WidestGap::take(const std::vector<double>& positions, const std::string& place) {
  const hf_gaps_info info = measure(surface_, positions);
  const double open = info.touching_count > 0 ? info.worst_opening : info.worst;
  if (info.link_count == 0 || open <= worst_) return;
  worst_ = open;
  place_ = place;
  positions_ = positions;
}

std::string WidestGap::sentence(double diagonal) const {
  if (worst_ < 0) return {};
  return "widest " + place_ + ": " + gaps_sentence(surface_, positions_, diagonal);
}

std::string unreached_sentence(hf_surface surface, const std::vector<uint32_t>& reached, const std::string& what,
                               const std::string& fate) {
  uint32_t count = 0;
  if (hf_surface_get_components(surface, 0, nullptr, &count) != HF_OK) return {};
  std::vector<uint32_t> component(count);
  if (hf_surface_get_components(surface, count, component.data(), nullptr) != HF_OK) return {};
  uint32_t components = 0;
  for (const uint32_t c : component) components = c == HF_NO_INDEX ? components : std::max(components, c + 1);
  std::vector<char> has(components, 0);
  for (const uint32_t v : reached) {
    if (component[v] != HF_NO_INDEX) has[component[v]] = 1;
  }
  uint32_t without = 0, isolated = 0, listed = 0, bare = 0;
  std::vector<char> seen(has);
  std::string around;
  for (uint32_t v = 0; v < count; ++v) {
    const uint32_t c = component[v];
    if (c == HF_NO_INDEX) {
      ++isolated;
      continue;
    }
    without += !has[c];
    if (seen[c]) continue;
    seen[c] = 1;
    ++bare;
    constexpr uint32_t most_listed = 5;
    if (listed++ < most_listed) around += (around.empty() ? "" : ", ") + std::to_string(v);
    if (listed == most_listed + 1) around += ", ...";
  }
  if (without + isolated == 0) return {};
  const uint32_t all = without + isolated;
  std::string out = std::to_string(all) + (all == 1 ? " vertex is" : " vertices are") + " reached by no " + what +
                    " and " + fate + ":";
  if (without > 0)
    out += " " + std::to_string(without) + " in " + std::to_string(bare) + (bare == 1 ? " component" : " components") +
           " without one (at " + around + ")";
  if (isolated > 0)
    out += (without > 0 ? std::string(",") : std::string()) + " " + std::to_string(isolated) +
           " without a triangle (left out)";
  return out;
}

std::string light_sentence(hf_surface surface, const std::vector<uint32_t>& vertices, const std::string& name) {
  uint32_t count = 0;
  if (hf_surface_get_pieces(surface, 0, nullptr, nullptr, &count) != HF_OK) return {};
  std::vector<int32_t> light(count);
  if (hf_surface_get_pieces(surface, count, nullptr, light.data(), nullptr) != HF_OK) return {};
  size_t on = 0;
  for (const uint32_t v : vertices) on += light[v] != 0;
  if (2 * on <= vertices.size()) return {};
  return "handle \"" + name + "\" lies on a light piece: it moves that piece and hardly pulls the rest";
}

}  // namespace samples
