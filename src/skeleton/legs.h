// Legs, as forward and roles both need them.
#pragma once
#include "skeleton/body.h"

namespace hf_inner::skeleton {

// Limbs that stand, else those with the name of legs.
Vector<const Limb*> standing_limbs(const Body& body);
// Whether a limb begins with a bone from the middle of the body: such bones of both sides start in one place.
bool leads_out(const Body& body, const Limb& limb);
// Whether a limb of a body on two legs begins with a bone of the hips: thigh, shin and foot follow it.
bool has_hip_bone(const Body& body, const Limb& limb);
// The place of the thigh in the paths of a leg.
std::size_t thigh_of(const Body& body, const Limb& limb);
// Returns the place of the ankle in the path of a leg; 0: none. The ankle is the last joint below half the hip that is
// clear of the ground, else the first joint there. thigh: the place of the thigh.
std::size_t ankle_of(const Body& body, const Vector<Index>& path, std::size_t thigh);

}  // namespace hf_inner::skeleton
