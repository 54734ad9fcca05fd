// See openings.h.
#include "transfer/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

Border::Border(const surface::Core& core, Memory& memory)
    : positions_(core.mesh.positions.data()),
      edges_(&memory),
      middle_(&memory),
      outward_(core.mesh.positions.size(), Vec3(), &memory),
      vertices_(&memory),
      start_(&memory),
      list_(&memory) {
  const mesh::Topology& topology = core.topology();
  const Vec3* p = positions_;
  for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
    const std::int32_t from = topology.edge_triangle_start[at(e)];
    if (topology.edge_triangle_start[at(e) + 1] - from != 1) continue;
    const std::int32_t *c = core.mesh.triangle(topology.triangle(from)), a = topology.first(e), b = topology.second(e);
    const std::int32_t third = c[0] != a && c[0] != b ? c[0] : c[1] != a && c[1] != b ? c[1] : c[2];
    const Vec3 along = unit_vector(p[b] - p[a]), inward = p[third] - p[a];
    const Vec3 outward = unit_vector(dot(along, inward) * along - inward);
    edges_.push_back({a, b, outward});
    outward_[at(a)] = outward_[at(a)] + outward;
    outward_[at(b)] = outward_[at(b)] + outward;
    half_ = std::max(half_, 0.5 * norm(p[b] - p[a]));
  }
  const auto middle = [&](const Edge& edge) { return 0.5 * (p[edge.first].x + p[edge.second].x); };
  std::sort(edges_.begin(), edges_.end(), [&](const Edge& a, const Edge& b) {
    const double x = middle(a), y = middle(b);
    return x != y ? x < y : a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  for (const Edge& edge : edges_) {
    middle_.push_back(middle(edge));
    vertices_.push_back(edge.first);
    vertices_.push_back(edge.second);
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  const auto entry = [&](std::int32_t v) {
    return static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
  };
  start_.assign(vertices_.size() + 1, 0);
  list_.assign(2 * edges_.size(), 0);
  for (const Edge& edge : edges_) {
    ++start_[entry(edge.first) + 1];
    ++start_[entry(edge.second) + 1];
  }
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  Vector<std::int32_t> next(start_, &memory);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    for (const std::int32_t v : {edges_[e].first, edges_[e].second})
      list_[at(next[entry(v)]++)] = static_cast<std::int32_t>(e);
  }
}

Vec3 Border::mix(const Place& place, const Vec3* by_vertex) const noexcept {
  const Edge& edge = edges_[at(place.edge)];
  // At a vertex, its own numbers to the last bit.
  if (!(place.share > 0)) return by_vertex[edge.first];
  if (!(place.share < 1)) return by_vertex[edge.second];
  return (1 - place.share) * by_vertex[edge.first] + place.share * by_vertex[edge.second];
}

Border::Place Border::facing(Vec3 place, Vec3 outward, double reach) const noexcept {
  Place out;
  double smallest = std::numeric_limits<double>::infinity(), square = 0;
  bool faces = false;
  const double low = place.x - reach - half_, high = place.x + reach + half_;
  const auto from = static_cast<std::size_t>(std::lower_bound(middle_.begin(), middle_.end(), low) - middle_.begin());
  for (std::size_t e = from; e < edges_.size() && middle_[e] <= high; ++e) {
    if (dot(edges_[e].outward, outward) > -facing_cosine) continue;
    const Vec3 a = positions_[edges_[e].first] - place, b = positions_[edges_[e].second] - positions_[edges_[e].first];
    const auto try_share = [&](double share) {
      const Vec3 d = a + share * b;
      const double size = dot(d, d), along = dot(d, outward);
      if (!(size > least_gap * least_gap && along > 0 && size < smallest * along)) return;
      smallest = size / along;
      square = size;
      out.edge = static_cast<std::int32_t>(e);
      out.share = share;
      faces = along >= facing_cosine * std::sqrt(size) && -dot(d, edges_[e].outward) >= facing_cosine * std::sqrt(size);
    };
    // (A + 2 B t + C t^2) / (D + E t) is least at an end or where its derivative is zero.
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), d = dot(a, outward), along = dot(b, outward);
    try_share(0);
    try_share(1);
    const double p = bb * along, q = bb * d, r = 2 * ab * d - along * aa, root = q * q - p * r;
    if (!(root > 0)) continue;
    // Both roots without cancellation; p may be zero.
    const double sum = -(q + std::copysign(std::sqrt(root), q));
    for (const double share : {p != 0 ? sum / p : -1.0, sum != 0 ? r / sum : -1.0})
      if (share > 0 && share < 1) try_share(share);
  }
  if (!faces || square > reach * reach) out.edge = -1;
  return out;
}

}  // namespace hf_inner::transfer
