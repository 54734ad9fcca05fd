// The most common velocity of low soles in a clip.
#include <algorithm>
#include <cmath>

#include "base/arguments.h"
#include "retarget/rig.h"
#include "retarget/sole.h"

namespace hf_inner::retarget {

void find_ground_velocity(const RetargetSide& side, const double* poses, std::uint32_t count, double seconds,
                          double velocity[3], Memory& memory) {
  require(poses, "poses");
  require(velocity, "velocity");
  check_finite(seconds, "seconds");
  if (!(seconds > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "seconds is not above 0; give the time between frames");
  const Rig rig(side, "source", memory);
  Stance stance(memory);
  stance.resize(at(rig.count));
  Vector<Vec3> was(&memory), now(&memory), found(&memory);
  Vector<Vector<Vec3>> before(&memory);
  for (const RigLeg& leg : rig.legs) before.emplace_back(leg.sole.size());
  for (std::uint32_t f = 0; f < count; ++f) {
    rig.read_pose(poses + std::size_t{10} * f * at(rig.count), stance);
    for (std::size_t k = 0; k < rig.legs.size(); ++k) {
      if (rig.legs[k].sole.empty()) continue;
      was.swap(before[k]);
      now.resize(rig.legs[k].sole.size());
      read_sole(rig.legs[k], stance, now);
      const double low = standing_height * rig.leg_length;
      if (f > 0 && lowest(rig, now) - rig.ground < low && lowest(rig, was) - rig.ground < low)
        found.push_back((1 / (seconds * rig.leg_length)) * sole_step(rig, was, now, sole_softness * rig.leg_length));
      before[k].swap(now);
    }
  }
  Vec3 best;
  std::size_t most = 0;
  // A few hundred velocities are compared with each other; longer clips take every so many.
  const std::size_t stride = 1 + found.size() / 500;
  for (std::size_t i = 0; i < found.size(); i += stride) {
    const double radius = std::max(velocity_radius, velocity_share * norm(found[i]));
    Vec3 sum;
    std::size_t near = 0;
    for (std::size_t k = 0; k < found.size(); k += stride) {
      if (norm(found[k] - found[i]) > radius) continue;
      sum = sum + found[k];
      ++near;
    }
    if (near <= most) continue;
    most = near;
    best = (1 / static_cast<double>(near)) * sum;
  }
  if (norm(best) < least_ground_speed) best = {};
  velocity[0] = best.x * rig.leg_length;
  velocity[1] = best.y * rig.leg_length;
  velocity[2] = best.z * rig.leg_length;
}

}  // namespace hf_inner::retarget
