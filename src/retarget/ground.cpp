// Keeps trunk, neck, tail and hands over the ground. A part may sink as deep as the same part of the source.
#include <algorithm>
#include <cmath>

#include "retarget/legs_bend.h"
#include "retarget/match.h"

namespace hf_inner::retarget {
namespace {

// How deep a part is below its lowest allowed height.
double depth_of(const Retargeter& r, const GroundPart& part, Vec3* deepest) noexcept {
  double own = 1e300, by = 0;
  for (const SkinPoint& p : part.target) {
    const Vec3 place = p.at(r.to);
    if (r.target.height_of(place) >= own) continue;
    own = r.target.height_of(place);
    if (deepest) *deepest = place;
  }
  for (const SkinPoint& p : part.source) by = std::min(by, r.source.height_of(p.at(r.from)));
  return std::max(0.0, r.height_scale * by - own);
}

void add_part(Retargeter& r, const RetargetSide& s, const RetargetSide& t, GroundPart part, Index source_root,
              bool (*takes)(skeleton::Role)) {
  const auto points = [&](const Rig& rig, const RetargetSide& side, Index root) {
    Vector<std::uint8_t> mask(at(rig.count), 0, &r.memory);
    for (Index j = 0; j < rig.count; ++j) mask[at(j)] = takes(side.character.roles[at(j)]) && rig.is_below(j, root);
    return outer_points(rig, side, mask, r.memory);
  };
  part.target = points(r.target, t, part.root);
  if (part.target.empty()) return;
  if (source_root >= 0) part.source = points(r.source, s, source_root);
  for (Index j = 0; j < r.target.count; ++j) {
    if (r.wanted[at(j)] && r.target.is_below(j, part.root)) part.below.push_back(j);
  }
  r.parts.push_back(std::move(part));
}

bool is_trunk(skeleton::Role role) { return role == skeleton::Role::spine || role == skeleton::Role::shoulder; }
bool is_head(skeleton::Role role) {
  return role == skeleton::Role::neck || role == skeleton::Role::head || role == skeleton::Role::jaw ||
         role == skeleton::Role::ear || role == skeleton::Role::eye || role == skeleton::Role::antenna;
}
bool is_tail(skeleton::Role role) { return role == skeleton::Role::tail; }
bool is_leg(skeleton::Role role) {
  return role == skeleton::Role::leg || role == skeleton::Role::foot || role == skeleton::Role::toe;
}
bool is_hand(skeleton::Role role) {
  return role == skeleton::Role::hand || role == skeleton::Role::finger || role == skeleton::Role::arm;
}

// Turns the part about its root until its lowest point is on the ground.
void pitch_up(Retargeter& r, const GroundPart& part) {
  double left = most_pitch;
  for (int round = 0; round < pitch_rounds; ++round) {
    Vec3 deepest;
    const double depth = depth_of(r, part, &deepest);
    const Vec3 root = r.to.place[at(part.root)];
    const Vec3 arm = deepest - root, flat = r.target.level(arm);
    const double length = norm(arm);
    if (!(depth > 0) || !(norm(flat) > 0)) return;
    const double rise = dot(arm, r.target.up), wanted = std::min(rise + depth, length);
    const double angle =
        std::min(left, arc_tangent(wanted, std::sqrt(std::max(0.0, length * length - wanted * wanted))) -
                           arc_tangent(rise, norm(flat)));
    if (!(angle > 0)) return;
    left -= angle;
    const Turn turn = turn_about(unit_vector(cross(flat, r.target.up)), angle);
    for (const Index j : part.below) r.to.turn[at(j)] = unit_turn(turn * r.to.turn[at(j)]);
    r.target.place(r.wanted, r.mover_place, r.to);
  }
}

// Bends an arm so that its hand comes up; the hand keeps its turn.
void bend_up(Retargeter& r, GroundPart& part) {
  const double depth = depth_of(r, part, nullptr);
  if (!(depth > 0)) return;
  const std::size_t n = part.arm.count();
  for (std::size_t k = 0; k < n; ++k) part.places[k] = r.to.place[at(part.arm.first(k))];
  part.places[n] = r.target.tip_place(part.arm.tip, r.to);
  const Vec3 line = unit_vector(part.places[n] - part.places[0]), elbow = part.places[1] - part.places[0];
  const Vec3 out = elbow - dot(elbow, line) * line;
  bend_leg(part.places, {}, part.places[n] + depth * r.target.up,
           norm(out) > 0 ? unit_vector(out) : -1.0 * r.target.forward, part.bends);
  turn_segments(part.arm, part.bends, false, r.to);
  r.target.place(r.wanted, r.mover_place, r.to);
}

}  // namespace

void Retargeter::find_parts(const RetargetSide& s, const RetargetSide& t) {
  // A leg that no goal keeps over the ground, such as a leg of one bone, lifts the body.
  for (const skeleton::Chain& chain : t.character.chains) {
    const Index root = static_cast<Index>(t.character.chain_joints[chain.first]);
    const bool kept = std::any_of(feet.begin(), feet.end(), [&](const FootPair& foot) {
      return target.legs[at(foot.target)].segments.joints[0] == root;
    });
    if (chain.role != skeleton::Role::leg || kept) continue;
    GroundPart leg(memory);
    leg.root = root;
    const skeleton::Chain* by = find_chain(s.character, skeleton::Role::leg, chain.side, chain.number);
    add_part(*this, s, t, std::move(leg), by ? static_cast<Index>(s.character.chain_joints[by->first]) : -1, is_leg);
  }
  GroundPart trunk(memory);
  trunk.root = target.mover;
  add_part(*this, s, t, std::move(trunk), source.mover, is_trunk);
  if (target.head >= 0) {
    const auto top = [](const Rig& rig) { return rig.neck.empty() ? rig.head : rig.neck[0]; };
    GroundPart head(memory);
    head.root = top(target);
    head.way = target.upright ? GroundPart::Way::lift : GroundPart::Way::pitch;
    add_part(*this, s, t, std::move(head), source.head >= 0 ? top(source) : -1, is_head);
  }
  for (const skeleton::Chain& chain : t.character.chains) {
    if (chain.role != skeleton::Role::tail && chain.role != skeleton::Role::arm) continue;
    const skeleton::Chain* by = find_chain(s.character, chain.role, chain.side, chain.number);
    if (!by || !wanted[at(static_cast<Index>(t.character.chain_joints[chain.first]))]) continue;
    GroundPart part(memory);
    part.root = static_cast<Index>(t.character.chain_joints[chain.first]);
    part.way = GroundPart::Way::pitch;
    Index source_root = static_cast<Index>(s.character.chain_joints[by->first]);
    if (chain.role == skeleton::Role::arm) {  // from the wrist on; an arm without a hand from its last joint on
      part.way = GroundPart::Way::bend;
      part.arm = cut_chain(target, t.character, chain, memory);
      part.root = part.arm.tip.joint;
      source_root = cut_chain(source, s.character, *by, memory).tip.joint;
      if (part.arm.count() < 2 || part.root < 0) continue;
      part.places.resize(part.arm.count() + 1);
      part.bends.resize(part.arm.count());
    }
    add_part(*this, s, t, std::move(part), source_root, chain.role == skeleton::Role::tail ? is_tail : is_hand);
  }
}

// A body that lies rises until its trunk is on the ground; an upright one brings its head along.
void Retargeter::lift_trunk() {
  double lift = 0;
  for (const GroundPart& part : parts) {
    if (part.way == GroundPart::Way::lift) lift = std::max(lift, depth_of(*this, part, nullptr));
  }
  if (!(lift > 0)) return;
  mover_place = mover_place + lift * target.up;
  target.place(wanted, mover_place, to);
}

void Retargeter::clear_ground() {
  for (GroundPart& part : parts) {
    if (part.way == GroundPart::Way::pitch) pitch_up(*this, part);
    if (part.way == GroundPart::Way::bend) bend_up(*this, part);
  }
}

}  // namespace hf_inner::retarget
