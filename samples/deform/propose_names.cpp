#include "deform/propose_names.h"

namespace samples {

RegionOwners::RegionOwners(const PosableMesh& mesh) : mesh_(mesh), skin_(&mesh.model, mesh.flat) {
  if (!skin_.joints.empty()) body_ = know_body(mesh.model, mesh.flat);
}

bool RegionOwners::is_under(int node, int other) const {
  while (node >= 0 && node != other) node = mesh_.model.nodes[static_cast<size_t>(node)].parent;
  return node == other;
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
  // a joint counts with all joints below it
  std::vector<double> below(moved.size(), 0.0);
  double all = 0;
  for (size_t n = 0; n < moved.size(); ++n) {
    all += moved[n];
    for (int at = static_cast<int>(n); moved[n] > 0 && at >= 0; at = mesh_.model.nodes[static_cast<size_t>(at)].parent)
      below[static_cast<size_t>(at)] += moved[n];
  }
  int best = -1;
  for (size_t n = 0; n < below.size(); ++n) {
    const bool under = best >= 0 && is_under(static_cast<int>(n), best);
    if (below[n] > 0.5 * all && (best < 0 || under)) best = static_cast<int>(n);
  }
  return best;
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
