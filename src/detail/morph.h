// Blends a region between the surface and its smooth base surface.
//
// A vertex inside the region moves to x = p + weight (base - p); all others keep their position p. A normal is the unit
// vector along the sum of the cross products of the triangles around a vertex.
#pragma once
#include "detail/region.h"

namespace hf_inner::detail {

// Returns p + weight (base - p). The result has exactly the bits of p at weight 0, and the bits of base at weight 1.
inline Vec3 morphed(Vec3 p, Vec3 base, double weight) noexcept {
  if (weight == 0) return p;
  if (weight == 1) return base;
  return p + weight * (base - p);
}

// Returns scaled positions by local number (RegionShape::local): vertices inside are morphed, vertices around the
// region stay in place.
Vector<Vec3> morphed_positions(const RegionSurface& surface, const RegionState& state, double weight, Memory& memory);

// Returns the area of all triangles with a corner inside the region, measured on the scaled mesh.
double morphed_area(const RegionSurface& surface, const RegionState& state, double weight, Memory& memory);

// Returns, for each local vertex, the sum of the cross products of all triangles around it. `positions` are any scaled
// positions by RegionShape::local.
Vector<Vec3> local_normal_sums(const RegionState& state, Span<const Vec3> positions, Memory& memory);

// Returns the unit vector along a sum of cross products, or (0, 0, 1) if the sum is zero.
Vec3 unit_normal(Vec3 sum) noexcept;

}  // namespace hf_inner::detail
