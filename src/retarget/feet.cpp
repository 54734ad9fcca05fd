// Goals of the feet: where soles go over the ground, how far the hips sink so that feet reach, and how legs bend.
#include <algorithm>
#include <cmath>

#include "retarget/legs_bend.h"
#include "retarget/retargeter.h"
#include "retarget/sole.h"

namespace hf_inner::retarget {
namespace {

double smooth_step(double low, double high, double x) noexcept {
  const double t = std::min(1.0, std::max(0.0, (x - low) / (high - low)));
  return t * t * (3 - 2 * t);
}

// A sole that dips into the ground stays on it. One that goes as deep as a free one is high was put there: it sinks.
double held_height(double height) noexcept {
  return height < 0 ? height * smooth_step(standing_height, free_height, -height) : height;
}

// How much a sole stands: it is low, and it is slow against the ground.
double stands(const Retargeter& r, const FootPair& foot, double seconds) noexcept {
  const double low = 1 - smooth_step(standing_height, free_height, foot.height);
  if (!foot.known || !(seconds > 0) || !r.options.lock_feet) return low;
  const double* g = r.options.ground_velocity;
  const Vec3 ground = r.source.level({g[0], g[1], g[2]});
  const double speed =
      slowest_step(r.source, foot.source_was, foot.source_now, seconds * ground, low_share * r.source.leg_length) /
      (seconds * r.source.leg_length);
  const double of_ground = norm(ground) / r.source.leg_length;
  return low * (1 - smooth_step(std::max(standing_speed, standing_share * of_ground),
                                std::max(free_speed, free_share * of_ground), speed));
}

// The ankle over the ground, before heights: where its turns put it, or for legs that are not aligned where the foot
// of the source is from its hip.
Vec3 turned_ankle(const Retargeter& r, const FootPair& foot) {
  if (foot.aligned) return foot.places.back();
  const RigLeg& by = r.source.legs[at(foot.source)];
  const Vec3 v = r.source.tip_place(by.segments.tip, r.from) - r.from.place[at(by.segments.joints[0])];
  const Turn body = r.to.turn[at(r.target.mover)] * inverse(r.target.rest.turn[at(r.target.mover)]);
  return foot.places[0] + r.height_scale * (r.across * v) + r.target.level(body * foot.stance);
}

// A foot that its leg lifts far above the sole of the source has left the ground, even while the source drags its toes.
// Stretching the leg down to the ground would undo the step.
double follows_down(const Retargeter& r, FootPair& foot) {
  const RigLeg& leg = r.target.legs[at(foot.target)];
  read_sole(leg, r.to, foot.target_now);
  const double ankle = dot(turned_ankle(r, foot) - r.target.tip_place(leg.segments.tip, r.to), r.target.up);
  const double own = ankle + lowest(r.target, foot.target_now) - r.target.ground;
  const double lift = own - r.height_scale * r.source.leg_length * foot.height;
  return 1 - smooth_step(0, free_lift, lift / leg.length);
}

// Reads where the leg is before it is bent, and how the sole of the source moves.
void read_foot(const Retargeter& r, FootPair& foot, double seconds) {
  const RigLeg &by = r.source.legs[at(foot.source)], &leg = r.target.legs[at(foot.target)];
  read_sole(by, r.from, foot.source_now);
  foot.height = held_height((lowest(r.source, foot.source_now) - r.source.ground) / r.source.leg_length);
  if (foot.known)
    foot.step = sole_step(r.source, foot.source_was, foot.source_now, sole_softness * r.source.leg_length);
  const std::size_t n = leg.segments.count();
  for (std::size_t k = 0; k < n; ++k) foot.places[k] = r.to.place[at(leg.segments.first(k))];
  foot.places[n] = r.target.tip_place(leg.segments.tip, r.to);
  const double stand = stands(r, foot, seconds) * (r.options.foot_path ? 1 : follows_down(r, foot));
  const bool at_once = !foot.known || !r.options.lock_feet;
  foot.standing += (stand - foot.standing) * (at_once ? 1 : 1 - exponential(-seconds / standing_time));
  const std::size_t thigh = at(leg.segments.joints[0]);
  foot.knee_now = r.to.turn[thigh] * (inverse(r.target.rest.turn[thigh]) * foot.knee);
}

// How high an ankle comes under its hip. The leg folds no shorter than its turns or a share of its length.
double highest_ankle(const Retargeter& r, const FootPair& foot, Vec3 turned) noexcept {
  const Vec3 hip = foot.places[0], d = turned - hip;
  const double least = std::min(norm(d), least_fold * r.target.legs[at(foot.target)].length);
  const double aside = norm(r.target.level(d)), under = -dot(d, r.target.up);
  if (!(under > 0) || !(aside < least)) return 1e300;
  return dot(hip, r.target.up) - std::sqrt(least * least - aside * aside);
}

// Sets the goal of the ankle. A standing sole is as high as the sole of the source. A sole in the air is not lower; on
// the scaled path it is no higher either, as long as the sole of the source is near the ground.
void aim_foot(const Retargeter& r, FootPair& foot, bool first, double seconds) {
  const Rig& rig = r.target;
  const RigLeg& leg = rig.legs[at(foot.target)];
  const Vec3 now = r.target.tip_place(leg.segments.tip, r.to);
  read_sole(leg, r.to, foot.target_now);
  const double below = lowest(rig, foot.target_now) - dot(now, rig.up);  // of the sole from the ankle
  Vec3 goal = turned_ankle(r, foot);
  const double own = dot(goal, rig.up);
  const double near = 1 - smooth_step(near_height, far_height, foot.height);
  const double sole = rig.ground + r.height_scale * r.source.leg_length * foot.height - below;
  const double free = own + near * (r.options.foot_path ? sole - own : std::max(0.0, sole - own));
  const double height = foot.standing * sole + (1 - foot.standing) * free;
  const double clear = std::max(height, std::min(sole, rig.ground - below));
  goal = rig.level(goal) + std::min(clear, highest_ankle(r, foot, goal)) * rig.up;
  if (r.options.lock_feet && first) {
    for (Vec3& p : foot.target_now) p = p - now + goal;
    if (foot.known && seconds > 0) {
      const Vec3 own_step = sole_step(rig, foot.target_was, foot.target_now, sole_softness * leg.length);
      const Vec3 by_step = r.scale * (r.across * foot.step), slip = own_step - by_step;
      foot.walked += foot.standing * dot(own_step, by_step);
      foot.walked_by += foot.standing * dot(by_step, by_step);
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
  foot.goal = goal;
}

// A leg that its turns stretch further may stay so.
double reach_of(const Retargeter& r, const FootPair& foot) noexcept {
  return std::max(soft_reach * r.target.legs[at(foot.target)].length, norm(foot.places.back() - foot.places[0]));
}

// How far the hips sink so that a standing foot reaches its goal. The offset is left out: it bends the path of the
// foot, not the body.
double missing_height(const Retargeter& r, const FootPair& foot) noexcept {
  const double reach = reach_of(r, foot);
  const Vec3 d = foot.places[0] - foot.goal;
  const double aside = std::min(norm(r.target.level(d)), 0.9 * reach);
  return foot.standing * std::max(0.0, dot(d, r.target.up) - std::sqrt(reach * reach - aside * aside));
}

// Adds the offset to the goal, as far as the leg reaches.
void add_offset(const Retargeter& r, FootPair& foot, double drop) noexcept {
  const Vec3 a = foot.goal - foot.places[0] + drop * r.target.up, b = foot.offset;
  const double reach = reach_of(r, foot), left = reach * reach - dot(a, a), bb = dot(b, b), ab = dot(a, b);
  if (bb > 0 && bb + 2 * ab > left) {
    const double share = left > 0 ? (std::sqrt(ab * ab + bb * left) - ab) / bb : 0;
    foot.offset = std::min(1.0, share) * b;
  }
  foot.goal = foot.goal + foot.offset;
}

}  // namespace

void Retargeter::meet_goals(double seconds) {
  if (feet.empty()) return;
  double walked = 0, walked_by = 0;
  for (FootPair& foot : feet) read_foot(*this, foot, seconds);
  const Vec3 turned_mover = mover_place;
  for (int round = 0; round < foot_rounds; ++round) {
    double drop = 0, length = 0;
    for (FootPair& foot : feet) {
      aim_foot(*this, foot, round == 0, seconds);
      drop = std::max(drop, missing_height(*this, foot));
      if (round == 0) walked += foot.walked;
      if (round == 0) walked_by += foot.walked_by;
      length = std::max(length, target.legs[at(foot.target)].length);
    }
    drop = std::min(drop, most_drop * length);
    report_.deepest_drop = std::max(report_.deepest_drop, drop);
    mover_place = turned_mover - drop * target.up;
    for (FootPair& foot : feet) {
      const Segments& segments = target.legs[at(foot.target)].segments;
      add_offset(*this, foot, drop);
      if (round > 0) turn_segments(segments, foot.bends, true, to);
      bend_leg(foot.places, -drop * target.up, foot.goal, foot.knee_now, foot.bends);
      turn_segments(segments, foot.bends, false, to);
    }
    target.place(wanted, mover_place, to);
  }
  if (walked_by > 0) report_.stride = walked / walked_by;
}

void Retargeter::measure_hover() {
  double by = 1e300, own = 1e300;
  for (const RigLeg& leg : source.legs) {
    points.resize(leg.sole.size());
    read_sole(leg, from, points);
    if (!leg.sole.empty()) by = std::min(by, lowest(source, points) - source.ground);
  }
  for (const RigLeg& leg : target.legs) {
    points.resize(leg.sole.size());
    read_sole(leg, to, points);
    if (!leg.sole.empty()) own = std::min(own, lowest(target, points) - target.ground);
  }
  if (!(own < 1e300) || !(target.leg_length > 0) || by > standing_height * source.leg_length) return;
  hover_sum += std::max(0.0, own - height_scale * std::max(0.0, by)) / target.leg_length;
  hover_frames += 1;
  report_.hover = hover_sum / hover_frames;
}

}  // namespace hf_inner::retarget
