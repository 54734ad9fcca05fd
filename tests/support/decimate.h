// A coarse copy of a closed mesh: the shortest edges are collapsed to their middles, as long as the mesh stays a
// manifold.
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "support/meshes.h"

namespace hf_test {

class Decimator {
 public:
  explicit Decimator(const PlainMesh& mesh) : positions_(mesh.positions), corners_(mesh.triangles) {
    around_.resize(mesh.vertex_count());
    for (std::uint32_t i = 0; i < corners_.size(); ++i) around_[corners_[i]].insert(i / 3);
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      const std::uint32_t a = corners_[i], b = corners_[i - i % 3 + (i + 1) % 3];
      if (a < b) queue_.insert({length(a, b), a, b});
    }
  }
  // Collapses edges until `vertices` are left, or none can go.
  PlainMesh down_to(std::uint32_t vertices) {
    std::uint32_t left = 0;
    for (const auto& t : around_) left += !t.empty();
    while (left > vertices && !queue_.empty()) {
      const Edge edge = *queue_.begin();
      queue_.erase(queue_.begin());
      if (around_[edge.a].empty() || around_[edge.b].empty() || edge.length != length(edge.a, edge.b)) continue;
      left -= collapse(edge.a, edge.b);
    }
    PlainMesh out;
    std::vector<std::uint32_t> number(around_.size(), UINT32_MAX);
    for (std::uint32_t v = 0; v < around_.size(); ++v) {
      if (around_[v].empty()) continue;
      number[v] = out.vertex_count();
      out.positions.insert(out.positions.end(), {positions_[3 * v], positions_[3 * v + 1], positions_[3 * v + 2]});
    }
    for (std::uint32_t t = 0; 3 * t < corners_.size(); ++t) {
      if (!around_[corners_[3 * t]].count(t)) continue;
      for (int k = 0; k < 3; ++k) out.triangles.push_back(number[corners_[3 * t + static_cast<std::uint32_t>(k)]]);
    }
    return out;
  }

 private:
  struct Edge {
    double length;
    std::uint32_t a, b;
    bool operator<(const Edge& o) const {
      return length != o.length ? length < o.length : a != o.a ? a < o.a : b < o.b;
    }
  };
  double length(std::uint32_t a, std::uint32_t b) const {
    double sum = 0;
    for (std::uint32_t k = 0; k < 3; ++k) sum += std::pow(positions_[3 * a + k] - positions_[3 * b + k], 2);
    return sum;
  }
  std::set<std::uint32_t> neighbours(std::uint32_t v) const {
    std::set<std::uint32_t> out;
    for (const std::uint32_t t : around_[v]) {
      for (std::uint32_t k = 0; k < 3; ++k) out.insert(corners_[3 * t + k]);
    }
    out.erase(v);
    return out;
  }
  bool collapse(std::uint32_t a, std::uint32_t b) {
    const std::set<std::uint32_t> of_a = neighbours(a), of_b = neighbours(b);
    std::size_t common = 0;
    for (const std::uint32_t v : of_a) common += of_b.count(v);
    if (!of_a.count(b) || common != 2) return false;
    for (std::uint32_t k = 0; k < 3; ++k) positions_[3 * a + k] = 0.5 * (positions_[3 * a + k] + positions_[3 * b + k]);
    const std::set<std::uint32_t> moved = around_[b];
    for (const std::uint32_t t : moved) {
      const bool gone = around_[a].count(t) > 0;
      for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t& corner = corners_[3 * t + k];
        if (gone) around_[corner].erase(t);
        if (corner == b) corner = a;
      }
      if (!gone) around_[a].insert(t);
    }
    around_[b].clear();
    for (const std::uint32_t v : neighbours(a))
      queue_.insert({length(std::min(a, v), std::max(a, v)), std::min(a, v), std::max(a, v)});
    return true;
  }

  std::vector<double> positions_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::set<std::uint32_t>> around_;  // triangles of every vertex
  std::set<Edge> queue_;
};

}  // namespace hf_test
