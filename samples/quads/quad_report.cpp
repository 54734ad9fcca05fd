#include "quads/quad_report.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

void percentiles(std::vector<double>& values, double (&out)[3]) {
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const double share[3] = {0.05, 0.5, 0.95};
  for (int k = 0; k < 3; ++k) out[k] = values[static_cast<size_t>(share[k] * static_cast<double>(values.size() - 1))];
}

}  // namespace

QuadReport measure_quads(const SurfaceMesh& mesh, double edge_length) {
  QuadReport report;
  report.vertices = static_cast<uint32_t>(mesh.positions.size());
  report.faces = static_cast<uint32_t>(mesh.face_sizes.size());
  std::vector<uint64_t> directed;  // tail and head
  std::vector<uint32_t> valence(mesh.positions.size(), 0);
  std::vector<double> lengths, aspects, angles;
  size_t first = 0;
  for (const uint32_t size : mesh.face_sizes) {
    const uint32_t* c = &mesh.face_vertices[first];
    double low = INFINITY, high = 0;
    glm::dvec3 normal(0);
    for (uint32_t k = 0; k < size; ++k) normal += cross(mesh.positions[c[k]], mesh.positions[c[(k + 1) % size]]);
    for (uint32_t k = 0; k < size; ++k) {
      const uint32_t a = c[k], b = c[(k + 1) % size], before = c[(k + size - 1) % size];
      ++valence[a];
      for (uint32_t j = 0; j < k; ++j) report.no_repeated_corner &= c[j] != a;
      directed.push_back(uint64_t{a} << 32 | b);
      const glm::dvec3 x = mesh.positions[b] - mesh.positions[a], y = mesh.positions[before] - mesh.positions[a];
      const double length = glm::length(x), other = glm::length(y);
      report.turned_over += dot(cross(x, y), normal) <= 0;
      low = std::min(low, length);
      high = std::max(high, length);
      if (size == 4 && length > 0 && other > 0) {
        const double cosine = std::min(std::max(dot(x, y) / (length * other), -1.0), 1.0);
        angles.push_back(std::fabs(std::acos(cosine) * 180 / std::acos(-1.0) - 90));
      }
    }
    if (size == 4) {
      ++report.quads;
      aspects.push_back(low > 0 ? high / low : INFINITY);
    }
    first += size;
  }
  std::sort(directed.begin(), directed.end());
  report.each_directed_edge_once = std::adjacent_find(directed.begin(), directed.end()) == directed.end();
  directed.erase(std::unique(directed.begin(), directed.end()), directed.end());
  std::vector<bool> border(valence.size(), false);
  for (const uint64_t edge : directed) {
    const auto a = static_cast<uint32_t>(edge >> 32), b = static_cast<uint32_t>(edge);
    const bool both = std::binary_search(directed.begin(), directed.end(), uint64_t{b} << 32 | a);
    if (!both) border[a] = border[b] = true;
    if (!both || a < b) lengths.push_back(glm::distance(mesh.positions[a], mesh.positions[b]) / edge_length);
  }
  report.edges = static_cast<uint32_t>(lengths.size());
  report.euler_characteristic =
      static_cast<int>(report.vertices) - static_cast<int>(report.edges) + static_cast<int>(report.faces);
  for (size_t v = 0; v < valence.size(); ++v) {
    ++report.valences[valence[v]];
    report.irregular += valence[v] != (border[v] ? 2u : 4u);
  }
  percentiles(lengths, report.edge);
  percentiles(aspects, report.aspect);
  percentiles(angles, report.angle);
  return report;
}

std::string to_text(const std::map<uint32_t, uint32_t>& histogram) {
  std::string text;
  for (const auto& [key, count] : histogram)
    text += (text.empty() ? "" : ", ") + std::to_string(key) + ": " + std::to_string(count);
  return text;
}

}  // namespace samples
