// Goals of the feet: where soles go over the ground, how far the hips sink so that feet reach, and how legs bend.
#include <algorithm>
#include <cmath>

#include "retarget/legs_bend.h"
#include "retarget/retargeter.h"

namespace hf_inner {
namespace {

double smooth_step(double low, double high, double x) noexcept {
  const double t = std::min(1.0, std::max(0.0, (x - low) / (high - low)));
  return t * t * (3 - 2 * t);
}

double lowest(const Rig& rig, const Vector<Vec3>& points) noexcept {
  double low = 1e300;
  for (const Vec3& p : points) low = std::min(low, dot(p, rig.up));
  return low;
}

// How far a sole moved over the ground: its lowest points carry the weight, before and after alike.
Vec3 sole_step(const Rig& rig, const Vector<Vec3>& was, const Vector<Vec3>& now, double softness) noexcept {
  const double low_was = lowest(rig, was), low_now = lowest(rig, now);
  const auto weight = [&](double above) {
    const double w = 1 / (1 + (above / softness) * (above / softness));
    return w * w;
  };
  Vec3 step_was, step_now;
  double sum_was = 0, sum_now = 0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double a = weight(dot(was[k], rig.up) - low_was), b = weight(dot(now[k], rig.up) - low_now);
    step_was = step_was + a * (now[k] - was[k]);
    step_now = step_now + b * (now[k] - was[k]);
    sum_was += a;
    sum_now += b;
  }
  return rig.level((0.5 / sum_was) * step_was + (0.5 / sum_now) * step_now);
}

void read_sole(const RigLeg& leg, const Stance& stance, Vector<Vec3>& points) noexcept {
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = leg.sole[k].at(stance);
}

// Where the leg stands before it is bent, and how high the sole of the source is.
void read_foot(const Retargeter& r, FootPair& foot) {
  const RigLeg &by = r.source.legs[at(foot.source)], &leg = r.target.legs[at(foot.target)];
  read_sole(by, r.from, foot.source_now);
  foot.height = (lowest(r.source, foot.source_now) - r.source.ground) / r.source.leg_length;
  foot.standing = 1 - smooth_step(standing_height, free_height, foot.height);
  const std::size_t n = leg.segments.count();
  for (std::size_t k = 0; k < n; ++k) foot.places[k] = r.to.place[at(leg.segments.first(k))];
  foot.places[n] = r.to.place[at(leg.foot)];
  const std::size_t thigh = at(leg.segments.joints[0]);
  foot.knee_now = r.to.turn[thigh] * (inverse(r.target.rest.turn[thigh]) * foot.knee);
}

// Turns the joints of each segment, or takes its turn back.
void turn_leg(const Segments& leg, const Vector<Turn>& bends, bool back, Stance& stance) noexcept {
  for (std::size_t j = 0, k = 0; j < leg.joints.size(); ++j) {
    while (k + 1 < leg.count() && j >= at(leg.starts[k + 1])) ++k;
    Turn& turn = stance.turn[at(leg.joints[j])];
    turn = unit_turn((back ? inverse(bends[k]) : bends[k]) * turn);
  }
}

// The ankle over the ground, before heights: where its turns put it, or for legs that are not aligned where the foot
// of the source is from its hip.
Vec3 turned_ankle(const Retargeter& r, const FootPair& foot) {
  if (foot.aligned) return foot.places.back();
  const RigLeg& by = r.source.legs[at(foot.source)];
  const Vec3 v = r.from.place[at(by.segments.tip.joint)] - r.from.place[at(by.segments.joints[0])];
  const Turn body = r.to.turn[at(r.target.mover)] * inverse(r.target.rest.turn[at(r.target.mover)]);
  return foot.places[0] + r.height_scale * (r.across * v) + r.target.level(body * foot.stance);
}

// Sets the goal of the ankle. The sole is as high as that of the source where it is near the ground.
void aim_foot(const Retargeter& r, FootPair& foot, bool first, double seconds) {
  const Rig& rig = r.target;
  const RigLeg& leg = rig.legs[at(foot.target)];
  const Vec3 now = r.to.place[at(leg.foot)];
  read_sole(leg, r.to, foot.target_now);
  const double below = lowest(rig, foot.target_now) - dot(now, rig.up);  // of the sole from the ankle
  Vec3 goal = turned_ankle(r, foot);
  const double share = smooth_step(near_height, far_height, foot.height);
  const double sole = rig.ground + r.height_scale * r.source.leg_length * std::max(0.0, foot.height);
  const double height = share * dot(goal, rig.up) + (1 - share) * (sole - below);
  goal = rig.level(goal) + std::max(height, rig.ground - below) * rig.up;
  if (r.options.lock_feet && first && seconds >= 0) {
    for (Vec3& p : foot.target_now) p = p - now + goal;
    if (foot.known && seconds > 0) {
      const Vec3 slip = sole_step(rig, foot.target_was, foot.target_now, sole_softness * leg.length) -
                        r.scale * (r.across * sole_step(r.source, foot.source_was, foot.source_now,
                                                        sole_softness * r.source.leg_length));
      foot.offset = foot.offset - foot.standing * slip;
      foot.offset = exponential(-(1 - foot.standing) * seconds / fade_time) * foot.offset;
      const double far = norm(foot.offset) / (most_offset * leg.length);
      if (far > 1) foot.offset = (1 / far) * foot.offset;
    }
    if (!foot.known || seconds > 0) {
      foot.source_was.swap(foot.source_now);
      foot.target_was.swap(foot.target_now);
      foot.known = true;
    }
  }
  foot.goal = goal + foot.offset;
}

// How far the hips sink so that a standing foot reaches its goal.
double missing_height(const Retargeter& r, const FootPair& foot) {
  const RigLeg& leg = r.target.legs[at(foot.target)];
  const double reach = std::max(soft_reach * leg.length, norm(foot.places.back() - foot.places[0]));
  const Vec3 d = foot.places[0] - foot.goal;
  const double aside = std::min(norm(r.target.level(d)), 0.9 * reach);
  return foot.standing * std::max(0.0, dot(d, r.target.up) - std::sqrt(reach * reach - aside * aside));
}

}  // namespace

void Retargeter::meet_goals(double seconds) {
  if (feet.empty()) return;
  for (FootPair& foot : feet) read_foot(*this, foot);
  const Vec3 turned_mover = mover_place;
  for (int round = 0; round < foot_rounds; ++round) {
    double drop = 0, length = 0;
    for (FootPair& foot : feet) {
      aim_foot(*this, foot, round == 0, seconds);
      drop = std::max(drop, missing_height(*this, foot));
      length = std::max(length, target.legs[at(foot.target)].length);
    }
    drop = std::min(drop, most_drop * length);
    report_.deepest_drop = std::max(report_.deepest_drop, drop);
    mover_place = turned_mover - drop * target.up;
    for (FootPair& foot : feet) {
      const Segments& segments = target.legs[at(foot.target)].segments;
      if (round > 0) turn_leg(segments, foot.bends, true, to);
      bend_leg(foot.places, -drop * target.up, foot.goal, foot.knee_now, foot.bends);
      turn_leg(segments, foot.bends, false, to);
    }
    target.place(wanted, mover_place, to);
  }
}

}  // namespace hf_inner
