// Transfers the detail of one region to another in local frames (coating).
//
//     c_s = F_s' (p_s - base_s)         detail of the source's vertices; 0 on its rim
//     x_t = base_t + weight scale F_t c(disc_t)
//
// p is a position, base the same vertex on the smooth base surface. F is a frame of the base surface. Its first axis is
// the projected direction in which the first disc coordinate grows. Its third axis is the normal, its second the cross
// product of the other two. Both regions are mapped to the unit disc. A target vertex interpolates c in the source
// triangle that contains its disc point. A vertex whose base triangles have almost no area (least_normal) gets the
// frame of the whole region.
#pragma once
#include "detail/disc_map.h"

namespace hf_inner::detail {

struct CarryOptions {
  // Boundary vertices that match, in pairs; empty: the states' `first`.
  Span<const std::int32_t> source_pins, target_pins;
  double scale = 0;  // 0: derived from the areas of the two base surfaces
};

struct CarriedDetail {
  std::shared_ptr<const RegionSurface> surface;  // of the target; must outlive `state` and `offset`
  std::shared_ptr<const RegionState> state;
  Vector<Vec3> offset;  // detail of the vertices state->shape->inside at weight 1
  // The position of the i-th of these vertices. Has exactly the bits of the base at weight 0.
  Vec3 position(std::size_t i, double weight) const noexcept {
    return weight == 0 ? state->base[i] : state->base[i] + weight * offset[i];
  }
};

CarriedDetail carry_detail(const Region& source, const Region& target, const CarryOptions& options, Memory& memory);

}  // namespace hf_inner::detail
