// Finds the trunk of a body: the part outside all limbs.
//
// The Poisson field of field/extremities.h falls from a tip to the root of its limb. The limb is the connected part
// around the tip where the field is above a share of this fall. Higher parts of the trunk count more for its middle. So
// the middle is in the chest of a biped, not in its hips, and between the legs of an animal. The middle follows
// translation and scale. Cost: some passes over the mesh.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "field/extremities.h"
#include "surface/core.h"

namespace hf_inner::deform {

struct Trunk {
  bool found = false;
  Vec3 middle;
  double area = 0;
};

// Finds the trunk of the component with the largest area. height: of every vertex. `found` is false where nothing is
// left.
Trunk find_trunk(const surface::Core& core, const field::Extremities& tips, Span<const double> height);

// The same of the vertices that are `inside`, 1 or 0 for every vertex.
Trunk trunk_of(const surface::Core& core, Span<const std::uint8_t> inside, Span<const double> height);

}  // namespace hf_inner::deform
