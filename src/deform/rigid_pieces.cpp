#include "deform/rigid_pieces.h"

#include <algorithm>

#include "deform/constants.h"

namespace hf_inner::deform {

RigidPieces::RigidPieces(const surface::Core& core, Span<const std::int32_t> vertices, const mesh::Mesh& rest,
                         Memory& memory)
    : piece_(static_cast<std::size_t>(core.size()), -1, &memory),
      start_(1, 0, &memory),
      vertex_(&memory),
      rest_(&memory),
      weight_(&memory) {
  // the plain geometry has pieces as components, in the same order of vertices
  const mesh::Mesh& plain = core.geometry->unlinked().mesh;
  Vector<std::int32_t> number(static_cast<std::size_t>(plain.component_count()), -1, &memory);
  std::int32_t count = 0;
  for (const std::int32_t v : vertices) {
    std::int32_t& own = number[plain.component[v]];
    if (own < 0) own = count++;
  }
  Vector<std::int32_t> size(static_cast<std::size_t>(count), 0, &memory);
  for (std::int32_t v = 0; v < core.size(); ++v) {
    piece_[v] = number[plain.component[v]];
    if (piece_[v] >= 0) ++size[piece_[v]];
  }
  for (const std::int32_t s : size) {
    start_.push_back(start_.back() + s);
    largest_ = std::max(largest_, static_cast<std::size_t>(s));
  }
  Vector<std::int32_t> next(start_, &memory), place(piece_.size(), -1, &memory);
  vertex_.resize(start_.back());
  for (std::int32_t v = 0; v < core.size(); ++v) {
    if (piece_[v] < 0) continue;
    place[v] = next[piece_[v]]++;
    vertex_[place[v]] = v;
  }
  Vector<double> held(vertex_.size(), 0.0, &memory), held_sum(size.size(), 0.0, &memory),
      area_sum(size.size(), 0.0, &memory);
  const auto hold = [&](std::int32_t v, double weight) {
    if (v == mesh::Mesh::none || piece_[v] < 0) return;
    held[place[v]] += weight;
    held_sum[piece_[v]] += weight;
  };
  if (core.geometry->links) {
    for (const mesh::Link& link : core.geometry->links->links) {
      hold(link.vertex, link.weight);
      for (int c = 0; c < 3; ++c) hold(link.corner[c], link.weight * link.share[c]);
    }
  }
  // every vertex counts a little, also where it has no area
  const auto area = [&](std::int32_t v) { return std::max(core.geometry->areas[v], least_vertex_area); };
  for (const std::int32_t v : vertex_) area_sum[piece_[v]] += area(v);
  for (std::size_t k = 0; k < vertex_.size(); ++k) {
    const std::int32_t v = vertex_[k], own = piece_[v];
    const double share = held_sum[own] > 0 ? rigid_hold_share : 0.0;
    rest_.push_back(rest.to_given(rest.positions[v]));
    weight_.push_back((1 - share) * area(v) / area_sum[own] + (share > 0 ? share * held[k] / held_sum[own] : 0.0));
  }
}

Vec3 RigidPieces::centroid(std::size_t piece) const noexcept {
  Vec3 sum;
  for (std::int32_t k = start_[piece]; k < start_[piece + 1]; ++k) sum = sum + rest_[k];
  return (1.0 / static_cast<double>(start_[piece + 1] - start_[piece])) * sum;
}

void RigidPieces::make_rigid(Vec3* positions, Vec3* scratch, RigidMotion* motions) const noexcept {
  for (std::size_t p = 0; p < count(); ++p) {
    const std::size_t first = static_cast<std::size_t>(start_[p]), size = vertices_of(p).size();
    for (std::size_t k = 0; k < size; ++k) scratch[k] = positions[vertex_[first + k]];
    const RigidMotion motion =
        fit_rigid({rest_.data() + first, size}, {scratch, size}, {weight_.data() + first, size}, Quaternion());
    for (std::size_t k = 0; k < size; ++k) positions[vertex_[first + k]] = apply(motion, rest_[first + k]);
    if (motions) motions[p] = motion;
  }
}

}  // namespace hf_inner::deform
