// Identities of triangle meshes for the tests of the generated assets.
#ifndef HF_TESTS_UNIT_SAMPLES_MESH_CHECKS_H
#define HF_TESTS_UNIT_SAMPLES_MESH_CHECKS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mesh_checks {

struct Report {
  uint32_t used_vertices = 0, edges = 0, faces = 0, components = 0, borders = 0;
  bool manifold = true;  // every directed edge once, one fan per vertex
  int euler() const { return int(used_vertices) - int(edges) + int(faces); }
  double mean_min_angle = 0, percentile_1 = 0, smallest_angle = 0;  // degrees
  double volume = 0;                                                // signed, positive when triangles face outwards
};

inline uint32_t find_root(std::vector<uint32_t>& parent, uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

inline Report examine(const std::vector<double>& positions, const std::vector<uint32_t>& triangles) {
  Report report;
  const uint32_t count = uint32_t(positions.size() / 3);
  report.faces = uint32_t(triangles.size() / 3);
  std::vector<std::pair<uint32_t, uint32_t>> directed;
  std::vector<uint32_t> parent(count), corner_parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<bool> used(count, false);
  std::vector<double> angles;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    double p[3][3], smallest = 180;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangles[t + k], b = triangles[t + (k + 1) % 3];
      used[a] = true;
      directed.push_back({a, b});
      parent[find_root(parent, a)] = find_root(parent, b);
      for (size_t i = 0; i < 3; ++i) p[k][i] = positions[3 * size_t(a) + i];
    }
    for (size_t k = 0; k < 3; ++k) {
      double u[3], v[3], uv = 0, uu = 0, vv = 0;
      for (size_t i = 0; i < 3; ++i) {
        u[i] = p[(k + 1) % 3][i] - p[k][i];
        v[i] = p[(k + 2) % 3][i] - p[k][i];
        uv += u[i] * v[i];
        uu += u[i] * u[i];
        vv += v[i] * v[i];
      }
      smallest = std::min(smallest, std::acos(std::clamp(uv / std::sqrt(uu * vv), -1.0, 1.0)) * 57.29577951308232);
    }
    angles.push_back(smallest);
    report.volume +=
        (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) - p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
         p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
        6;
  }
  for (uint32_t v = 0; v < count; ++v) {
    report.used_vertices += used[v];
    report.components += used[v] && find_root(parent, v) == v;
  }
  std::sort(directed.begin(), directed.end());
  report.manifold = std::adjacent_find(directed.begin(), directed.end()) == directed.end();
  for (const auto& [a, b] : directed) {
    const bool paired = std::binary_search(directed.begin(), directed.end(), std::make_pair(b, a));
    report.edges += !paired || a < b;
    report.borders += !paired;
  }
  // one fan per vertex: the link of a vertex, its opposite edges, is connected
  std::vector<std::vector<std::pair<uint32_t, uint32_t>>> link(count);
  for (size_t t = 0; t < triangles.size(); t += 3) {
    for (size_t k = 0; k < 3; ++k)
      link[triangles[t + k]].push_back({triangles[t + (k + 1) % 3], triangles[t + (k + 2) % 3]});
  }
  for (uint32_t v = 0; v < count; ++v) {
    std::map<uint32_t, uint32_t> next;
    for (const auto& [a, b] : link[v]) next[a] = b;
    if (link[v].empty()) continue;
    // walk from a start without predecessor, or anywhere on a closed link
    uint32_t start = link[v][0].first;
    std::set<uint32_t> targets;
    for (const auto& [a, b] : link[v]) targets.insert(b);
    for (const auto& [a, b] : link[v]) {
      if (!targets.count(a)) start = a;
    }
    size_t steps = 0;
    uint32_t at = start;
    while (steps < link[v].size() && next.count(at)) {
      at = next[at];
      ++steps;
      if (at == start) break;
    }
    if (steps != link[v].size()) report.manifold = false;
  }
  std::sort(angles.begin(), angles.end());
  for (double a : angles) report.mean_min_angle += a / double(angles.size());
  report.percentile_1 = angles[angles.size() / 100];
  report.smallest_angle = angles[0];
  return report;
}

// Merges bit-equal positions; returns the welded index per vertex and how many there are.
template <typename Real>
std::vector<uint32_t> weld(const std::vector<Real>& positions, uint32_t& welded_count) {
  std::map<std::array<Real, 3>, uint32_t> known;
  std::vector<uint32_t> result;
  for (size_t v = 0; v < positions.size(); v += 3) {
    const std::array<Real, 3> key{positions[v], positions[v + 1], positions[v + 2]};
    result.push_back(known.emplace(key, uint32_t(known.size())).first->second);
  }
  welded_count = uint32_t(known.size());
  return result;
}

}  // namespace mesh_checks

#endif
