// Soles of feet as a few points of the skin.
#pragma once
#include "retarget/rig.h"

namespace hf_inner::retarget {

void read_sole(const RigLeg& leg, const Stance& stance, Vector<Vec3>& points) noexcept;
// The lowest coordinate along up.
double lowest(const Rig& rig, const Vector<Vec3>& points) noexcept;
// How far a sole moved over the ground: its lowest points carry the weight, before and after alike.
Vec3 sole_step(const Rig& rig, const Vector<Vec3>& was, const Vector<Vec3>& now, double softness) noexcept;
// The least step of a low point against the ground, which moved by `ground`. A foot that turns on its ball stands.
// low: points up to this above the lowest count.
double slowest_step(const Rig& rig, const Vector<Vec3>& was, const Vector<Vec3>& now, Vec3 ground, double low) noexcept;

}  // namespace hf_inner::retarget
