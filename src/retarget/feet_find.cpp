// Pairs the feet and finds what stays of them: stance, the side of the knee, the share of the tilt.
#include <algorithm>
#include <cmath>

#include "retarget/match.h"

namespace hf_inner::retarget {
namespace {

Vec3 hip_to_foot(const Rig& rig, const RigLeg& leg) noexcept {
  return segment_place(rig, leg.segments, leg.segments.count()) - segment_place(rig, leg.segments, 0);
}

// In the axes of the body: x to the left.
Vec3 in_axes(const Rig& rig, Vec3 v) noexcept { return {dot(v, rig.left), dot(v, rig.up), dot(v, rig.forward)}; }

// Returns the offset that the stance of the target adds: level, and mirrored between left and right.
Vec3 stance_of(const Retargeter& r, std::size_t pair) {
  const auto difference = [&](const FootPair& foot) {
    return in_axes(r.target, hip_to_foot(r.target, r.target.legs[at(foot.target)]) -
                                 r.scale * (r.across * hip_to_foot(r.source, r.source.legs[at(foot.source)])));
  };
  const skeleton::Side side = r.target.legs[at(r.feet[pair].target)].side;
  Vec3 sum = difference(r.feet[pair]);
  const std::size_t mate = side == skeleton::Side::left ? pair + 1 : pair - 1;
  if (side != skeleton::Side::middle && mate < r.feet.size() && r.target.legs[at(r.feet[mate].target)].side != side) {
    const Vec3 other = difference(r.feet[mate]);
    sum = 0.5 * (sum + Vec3{-other.x, other.y, other.z});
  }
  return sum.x * r.target.left + sum.z * r.target.forward;
}

// Where the knee points: to the side of its bend at rest, forward where it is straight.
Vec3 knee_side_of(const Rig& rig, const RigLeg& leg, Turn align) noexcept {
  const Vec3 line = unit_vector(hip_to_foot(rig, leg));
  const Vec3 knee = segment_place(rig, leg.segments, 1) - segment_place(rig, leg.segments, 0);
  const Vec3 bend = knee - dot(knee, line) * line;
  return norm(bend) > bend_unseen * leg.length ? unit_vector(bend) : inverse(align) * rig.forward;
}

}  // namespace

// Legs pair from behind, each with a leg of its side. A leg without a foot gets no goal. Its boot tilts with the shin,
// so a knee that bends to lift the toes pushes them deeper. Such a leg lifts the body instead, but on the scaled path.
void Retargeter::find_feet() {
  for (std::size_t t = 0; t < target.legs.size(); ++t) {
    const RigLeg& leg = target.legs[t];
    std::size_t place = 0;
    for (std::size_t k = 0; k < t; ++k) place += target.legs[k].side == leg.side;
    for (std::size_t s = 0; s < source.legs.size(); ++s) {
      const RigLeg& by = source.legs[s];
      if (by.side != leg.side || place-- > 0) continue;
      if ((leg.foot < 0 && !options.foot_path) || leg.sole.empty() || by.sole.empty() ||
          !wanted[at(leg.segments.tip.joint)] || leg.segments.count() < 2 || !(leg.length > 0) || !(by.length > 0))
        break;
      FootPair foot(memory);
      foot.source = static_cast<Index>(s);
      foot.target = static_cast<Index>(t);
      foot.aligned = people && !options.foot_path;
      const ChainPair* pair = nullptr;
      for (const ChainPair& p : pairs) {
        if (p.role == skeleton::Role::leg && p.target.joints[0] == leg.segments.joints[0]) pair = &p;
      }
      if (!pair) break;
      foot.knee = knee_side_of(target, leg, pair->align[0]);
      const double rho = (leg.sole_length / target.leg_length) / (by.sole_length / source.leg_length);
      // A longer foot that tilts alike lifts its heel or digs in its toes by so much more.
      if (std::isfinite(rho) && rho > 1) foot.tilt = 1 / rho;
      for (Index j = 0; j < target.count; ++j) {
        if (leg.foot >= 0 && wanted[at(j)] && target.is_below(j, leg.foot)) foot.below.push_back(j);
      }
      foot.source_now.resize(by.sole.size());
      foot.source_was.resize(by.sole.size());
      foot.target_now.resize(leg.sole.size());
      foot.target_was.resize(leg.sole.size());
      foot.places.resize(leg.segments.count() + 1);
      foot.bends.resize(leg.segments.count());
      feet.push_back(std::move(foot));
      break;
    }
  }
  for (std::size_t k = 0; k < feet.size(); ++k) feet[k].stance = stance_of(*this, k);
}

}  // namespace hf_inner::retarget
