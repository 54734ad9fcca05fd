// Splits the path of a limb: shoulder, arm and hand; leg, foot and toes. Names say which limb, the tree says which
// part.
#pragma once
#include "skeleton/body.h"

namespace hf_inner::skeleton {

void assign_leg(Body& body, const Limb& limb, int side);
void assign_arm(Body& body, const Limb& limb, int side);

}  // namespace hf_inner::skeleton
