// Transfers the detail of one region to another by local frames (coating).
//
//     c_s = F_s' (p_s - base_s)         on the source's vertices, 0 on its rim
//     x_t = base_t + weight scale F_t c(disc_t)
//
// F is a frame of the base. Its first axis is the direction in which the first disc coordinate grows, projected. The
// third axis is the normal, and the second is its cross product with the first. Coordinates c are interpolated in the
// triangle of the source's disc that contains the target's disc point. Vertices whose base triangles have almost no
// area (least_normal) get the frame of the whole region.
#pragma once
#include "detail/disc_map.h"

namespace hf_inner {

struct CarryOptions {
  Span<const std::int32_t> source_pins, target_pins;  // inner vertices in pairs; empty: the states' first points
  double scale = 0;                                   // 0: from the areas of the bases
};

struct CarriedDetail {
  std::shared_ptr<const RegionSurface> surface;  // of the target; outlives what follows
  std::shared_ptr<const RegionState> state;
  Vector<Vec3> offset;  // of state->shape->inside, at weight 1
};

CarriedDetail carry_detail(const Region& source, const Region& target, const CarryOptions& options, Memory& memory);

}  // namespace hf_inner
