// Bends a leg until its foot is where it shall be.
#pragma once
#include "retarget/rig.h"

namespace hf_inner::retarget {

// places: where each segment begins, and the ankle; all moved by `shift` first. knee: the side to which a leg of two
// segments bends. bends: the turn of each segment in the world. A goal out of reach is met as far as the leg reaches;
// a leg that was straight may stay so.
void bend_leg(const Vector<Vec3>& places, Vec3 shift, Vec3 goal, Vec3 knee, Vector<Turn>& bends);

// Turns the joints of each segment, or takes its turn back.
void turn_segments(const Segments& limb, const Vector<Turn>& bends, bool back, Stance& stance) noexcept;

}  // namespace hf_inner::retarget
