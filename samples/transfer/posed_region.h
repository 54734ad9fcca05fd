// Places of posed regions: x y z of every vertex, one after the other.
#ifndef HF_SAMPLES_TRANSFER_POSED_REGION_H
#define HF_SAMPLES_TRANSFER_POSED_REGION_H

#include <algorithm>
#include <cmath>
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
    if (!taken[mesh.welded[v]]) {
      taken[mesh.welded[v]] = 1;
      out.vertices.push_back(v);
    }
  return out;
}

inline glm::dvec3 centre_of(const Region& region, const std::vector<double>& xyz) {
  glm::dvec3 sum(0);
  for (const uint32_t v : region.vertices) sum += glm::dvec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]);
  return sum / static_cast<double>(region.vertices.size());
}

// The mean of all vertices that are not loose.
inline glm::dvec3 middle_of(const std::vector<double>& xyz, const std::vector<uint8_t>& loose) {
  glm::dvec3 sum(0);
  size_t count = 0;
  for (size_t v = 0; v < loose.size(); ++v) {
    if (loose[v]) continue;
    sum += glm::dvec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]);
    ++count;
  }
  return sum / static_cast<double>(std::max<size_t>(count, 1));
}

inline double lowest_of(const Region& region, const std::vector<double>& xyz, const glm::dvec3& up) {
  double low = std::numeric_limits<double>::infinity();
  for (const uint32_t v : region.vertices)
    low = std::min(low, glm::dot(up, glm::dvec3(xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2])));
  return low;
}

// The rotation that takes a region best from one pose to another (Horn 1987): as a quaternion it is the eigenvector of
// the largest eigenvalue of a matrix of 4 x 4, found by power iteration.
inline glm::dquat turn_of(const Region& region, const std::vector<double>& rest, const std::vector<double>& posed) {
  constexpr int steps = 60;  // a step halves the error at least where a region turns rigidly
  const glm::dvec3 from = centre_of(region, rest), to = centre_of(region, posed);
  double n[4][4] = {};
  for (const uint32_t v : region.vertices) {
    const glm::dvec3 a = glm::dvec3(rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]) - from,
                     b = glm::dvec3(posed[3 * v], posed[3 * v + 1], posed[3 * v + 2]) - to, c = glm::cross(a, b);
    const double same = glm::dot(a, b);
    n[0][0] += same;
    for (int i = 0; i < 3; ++i) {
      n[0][i + 1] += c[i];
      n[i + 1][0] += c[i];
      n[i + 1][i + 1] -= same;
      for (int j = 0; j < 3; ++j) n[i + 1][j + 1] += a[i] * b[j] + a[j] * b[i];
    }
  }
  double size = 0;
  for (const auto& row : n)
    for (const double x : row) size += x * x;
  if (!(size > 0)) return glm::dquat(1, 0, 0, 0);
  for (int i = 0; i < 4; ++i) n[i][i] += std::sqrt(size);  // so that the largest eigenvalue has the largest size
  double q[4] = {1, 0, 0, 0};
  for (int step = 0; step < steps; ++step) {
    double next[4] = {}, square = 0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) next[i] += n[i][j] * q[j];
      square += next[i] * next[i];
    }
    for (int i = 0; i < 4; ++i) q[i] = next[i] / std::sqrt(square);
  }
  return glm::dquat(q[0], q[1], q[2], q[3]);
}

// left_out: 1 for vertices that do not count, such as loose ones.
inline double lowest_of(const std::vector<double>& xyz, const glm::dvec3& up, const std::vector<uint8_t>& left_out) {
  double low = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < xyz.size(); i += 3)
    if (!left_out[i / 3]) low = std::min(low, glm::dot(up, glm::dvec3(xyz[i], xyz[i + 1], xyz[i + 2])));
  return low;
}

}  // namespace samples

#endif
