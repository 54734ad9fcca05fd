// Places of posed regions: x y z of every vertex, one after the other.
#ifndef HF_SAMPLES_TRANSFER_POSED_REGION_H
#define HF_SAMPLES_TRANSFER_POSED_REGION_H

#include <algorithm>
#include <limits>
#include <vector>

#include "gltf/flat_mesh.h"
#include "gltf/regions.h"

namespace samples {

using namespace hf_gltf;

// The region with one of each set of copies at a place, as the library counts.
inline Region without_copies(const Region& region, const FlatMesh& mesh) {
  Region out;
  std::vector<char> taken(mesh.welded_count, 0);
  for (const uint32_t v : region.vertices)
    if (!taken[mesh.welded[v]]) taken[mesh.welded[v]] = 1, out.vertices.push_back(v);
  return out;
}

inline glm::dvec3 centre_of(const Region& region, const std::vector<double>& xyz) {
  glm::dvec3 sum(0);
  for (const uint32_t v : region.vertices) sum += glm::dvec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]);
  return sum / static_cast<double>(region.vertices.size());
}

inline double lowest_of(const Region& region, const std::vector<double>& xyz, const glm::dvec3& up) {
  double low = std::numeric_limits<double>::infinity();
  for (const uint32_t v : region.vertices)
    low = std::min(low, glm::dot(up, glm::dvec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2])));
  return low;
}

// sinking: empty, or 1 for vertices that do not count.
inline double lowest_of(const std::vector<double>& xyz, const glm::dvec3& up,
                        const std::vector<uint8_t>& sinking = {}) {
  double low = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < xyz.size(); i += 3)
    if (sinking.empty() || !sinking[i / 3])
      low = std::min(low, glm::dot(up, glm::dvec3(xyz[i], xyz[i + 1], xyz[i + 2])));
  return low;
}

}  // namespace samples

#endif
