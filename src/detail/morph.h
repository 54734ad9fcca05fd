// The surface between a region and its base: x = p + weight (base - p) inside, p elsewhere.
//
// Its normals are unit vectors along the sum of the cross products of the triangles around a vertex.
#pragma once
#include "detail/region.h"

namespace hf_inner {

// p + weight (base - p), with the bits of p at 0 and those of the base at 1.
inline Vec3 morphed(Vec3 p, Vec3 base, double weight) noexcept {
  if (weight == 0) return p;
  if (weight == 1) return base;
  return p + weight * (base - p);
}

// Positions by local number, scaled: inside morphed, the rim as it is.
Vector<Vec3> morphed_positions(const RegionSurface& surface, const RegionState& state, double weight, Memory& memory);

// Area of the triangles with a corner inside, of the scaled mesh.
double morphed_area(const RegionSurface& surface, const RegionState& state, double weight, Memory& memory);

// Sums of cross products by local number, of all triangles around, for any scaled positions by local number.
Vector<Vec3> local_normal_sums(const RegionState& state, Span<const Vec3> positions, Memory& memory);

// Unit vector; (0, 0, 1) where triangles cancel out or have no area.
Vec3 unit_normal(Vec3 sum) noexcept;

}  // namespace hf_inner
