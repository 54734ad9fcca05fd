// Detail of one region set up on another, by local frames (coating).
//
//     c_s = F_s' (p_s - base_s)         on the source's vertices, 0 on its rim
//     x_t = base_t + weight scale F_t c(disc_t)
//
// F = (direction in which the first disc coordinate grows, projected; the normal's cross product with it; the normal)
// of the base. c is interpolated in the triangle of the source's disc that the target's disc point lies in. The frames
// of vertices whose base triangles are a millionth of the largest and less are those of the region as a whole.
#pragma once
#include "detail/disc_map.h"

namespace hf_inner {

struct CarryOptions {
  Span<const std::int32_t> source_pins, target_pins;  // inner vertices in pairs; empty: the states' first points
  double scale = 0;                                   // 0: by the areas of the bases
  Progress* progress = nullptr;
};

struct CarriedDetail {
  std::shared_ptr<const RegionSurface> surface;  // of the target; outlives what follows
  std::shared_ptr<const RegionState> state;
  Vector<Vec3> offset;  // of state->shape->inside, at weight 1
};

CarriedDetail carry_detail(const Region& source, const Region& target, const CarryOptions& options, Memory& memory);

}  // namespace hf_inner
