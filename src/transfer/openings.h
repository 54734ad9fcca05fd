// Finds places of a surface's border that face each other across a narrow opening, such as the lids of an eye.
//
// A border edge has an outward direction: in the plane of its triangle, at right angles to the edge, away from the
// surface. Let a ball grow that touches the border at p from outside. The place that faces p is the first that the ball
// meets. It has the least |d|^2 / (d . o) over the places p + d of edges with an opposite outward direction, within an
// angle; o is the outward direction at p. So both ends are the feet of one place of the medial axis of the opening. It
// counts if d lies in the outward direction of both, within an angle.
#pragma once
#include <cstdint>

#include "surface/core.h"

namespace hf_inner::transfer {

class Border {
 public:
  // A place on a border edge: (1 - share) of its first vertex and share of its second. edge < 0: none.
  struct Place {
    std::int32_t edge = -1;
    double share = 0;
  };

  Border(const surface::Core& core, Memory& memory);
  std::size_t edge_count() const noexcept { return edges_.size(); }
  std::int32_t first(std::int32_t edge) const noexcept { return edges_[static_cast<std::size_t>(edge)].first; }
  std::int32_t second(std::int32_t edge) const noexcept { return edges_[static_cast<std::size_t>(edge)].second; }
  // The vertices of the border, ascending.
  Span<const std::int32_t> vertices() const noexcept { return {vertices_.data(), vertices_.size()}; }
  // The border edges at entry i of vertices().
  Span<const std::int32_t> edges_at(std::size_t i) const noexcept {
    const auto from = static_cast<std::size_t>(start_[i]), to = static_cast<std::size_t>(start_[i + 1]);
    return {list_.data() + from, to - from};
  }
  // Mixes numbers by vertex at a place.
  Vec3 mix(const Place& place, const Vec3* by_vertex) const noexcept;
  Vec3 outward(const Place& place) const noexcept { return unit_vector(mix(place, outward_.data())); }
  Vec3 outward(std::int32_t vertex) const noexcept { return unit_vector(outward_[static_cast<std::size_t>(vertex)]); }
  // Returns the place that faces this one, within the reach; edge < 0 where none does.
  Place facing(Vec3 place, Vec3 outward, double reach) const noexcept;

 private:
  struct Edge {
    std::int32_t first, second;
    Vec3 outward;
  };
  const Vec3* positions_;
  Vector<Edge> edges_;     // ascending in the x of their middles
  Vector<double> middle_;  // that x
  Vector<Vec3> outward_;   // by vertex of the surface; zero inside
  Vector<std::int32_t> vertices_, start_, list_;
  double half_ = 0;  // the longest half edge
};

}  // namespace hf_inner::transfer
