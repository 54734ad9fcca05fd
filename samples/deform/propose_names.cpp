#include "deform/propose_names.h"

#include <algorithm>

namespace samples {

RegionOwners::RegionOwners(const PosableMesh& mesh) : mesh_(mesh), skin_(&mesh.model, mesh.flat) {
  if (!skin_.joints.empty()) body_ = know_body(mesh.model, mesh.flat);
}

int RegionOwners::owner(const glm::dvec3& point, double radius) const {
  if (skin_.joints.empty()) return -1;
  const size_t width = skin_.joints.size() / mesh_.flat.positions.size();
  std::vector<double> moved(mesh_.model.nodes.size(), 0.0);
  for (size_t v = 0; v < mesh_.flat.positions.size(); ++v) {
    if (glm::distance(mesh_.flat.positions[v], point) > radius) continue;
    for (size_t k = v * width; k < (v + 1) * width; ++k)
      moved[skin_.joints[k]] += static_cast<double>(skin_.weights[k]);
  }
  const auto most = std::max_element(moved.begin(), moved.end());
  return most == moved.end() || *most <= 0 ? -1 : static_cast<int>(most - moved.begin());
}

std::string RegionOwners::name(int node) const {
  return node < 0 ? std::string() : mesh_.model.nodes[static_cast<size_t>(node)].name;
}

bool RegionOwners::hangs_free(int node) const {
  if (!body_.knows_parts()) return false;
  for (; node >= 0; node = mesh_.model.nodes[static_cast<size_t>(node)].parent) {
    switch (body_.nodes[static_cast<size_t>(node)].part) {
      case BodyPart::other:
        continue;
      case BodyPart::trunk:
      case BodyPart::leg:
        return false;
      default:
        return true;
    }
  }
  return false;
}

}  // namespace samples
