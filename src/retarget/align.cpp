// Brings the rests of two limbs together.
#include <algorithm>
#include <cmath>

#include "retarget/match.h"

namespace hf_inner::retarget {

std::size_t bone_count(const Segments& chain) noexcept { return chain.count() - (chain.tip.joint >= 0 ? 0 : 1); }

Vec3 segment_place(const Rig& rig, const Segments& chain, std::size_t k) noexcept {
  return k < chain.count() ? rig.rest.place[at(chain.first(k))] : rig.tip_place(chain.tip, rig.rest);
}

namespace {

Vec3 across_line(Vec3 v, Vec3 line) noexcept { return v - dot(v, line) * line; }

// Turns about the line of both chains until they bend the same way. A chain that is nearly straight has no way.
Turn bend_turn(Vec3 line, Vec3 bend, Vec3 wanted, double length) noexcept {
  const Vec3 a = across_line(bend, line), b = across_line(wanted, line);
  const double seen = std::min(norm(a), norm(b)) / length;
  const double weight = std::min(1.0, std::max(0.0, (seen - bend_unseen) / (bend_seen - bend_unseen)));
  if (!(weight > 0)) return {};
  return turn_about(line, weight * arc_tangent(dot(line, cross(a, b)), dot(a, b)));
}

// Where the knee of a leg bends: to where its foot points, across the line from hip to ankle. 0: not known.
Vec3 hinge_side(const Rig& rig, const Segments& chain, Vec3 line) noexcept {
  Vec3 foot = rig.forward;
  for (const RigLeg& leg : rig.legs) {
    if (leg.segments.joints[0] == chain.joints[0] && leg.toe >= 0)
      foot = rig.level(rig.rest.place[at(leg.toe)] - rig.rest.place[at(leg.foot)]);
  }
  const Vec3 side = across_line(unit_vector(foot), line);
  return norm(side) > hinge_seen ? unit_vector(side) : Vec3{};
}

// A knee that stands aside of its hinge's plane is the build of a body, not its pose: thighs of stout bodies run
// outward to legs that are apart. So the target keeps its own distance from that plane.
Vec3 wanted_knee(const Retargeter& r, const ChainPair& pair, Turn turn, Vec3 whole) noexcept {
  const Vec3 by = segment_place(r.source, pair.source, 1) - segment_place(r.source, pair.source, 0);
  const Vec3 knee = r.across * by;
  const Vec3 own = segment_place(r.target, pair.target, 1) - segment_place(r.target, pair.target, 0);
  const Vec3 length = segment_place(r.target, pair.target, 2) - segment_place(r.target, pair.target, 0);
  const Vec3 line = unit_vector(whole), own_line = unit_vector(length);
  const Vec3 side = r.across * hinge_side(r.source, pair.source, inverse(r.across) * line);
  const Vec3 own_side = turn * hinge_side(r.target, pair.target, own_line);
  if (!(norm(side) > 0) || !(norm(own_side) > 0) || !(norm(length) > 0)) return knee;
  const Vec3 aside = cross(line, side);
  const double kept = dot(turn * own, cross(line, own_side)) * norm(whole) / norm(length);
  return knee + (kept - dot(knee, aside)) * aside;
}

}  // namespace

void align_chain(const Retargeter& r, ChainPair& pair, Aligning how, Turn before) {
  pair.align.assign(pair.target.count(), before);
  const std::size_t ns = bone_count(pair.source), nt = bone_count(pair.target);
  if (how == Aligning::none || ns == 0 || nt == 0) return;
  const bool equal = pair.source.count() == pair.target.count();
  const std::size_t bones = std::min(ns, nt);
  const auto wanted = [&](std::size_t k) { return r.across * segment_place(r.source, pair.source, k); };
  const auto own = [&](std::size_t k) { return segment_place(r.target, pair.target, k); };
  const Vec3 whole = wanted(equal ? bones : ns) - wanted(0);
  Turn turn = shortest_turn(before * (own(equal ? bones : nt) - own(0)), whole) * before;
  Vec3 first = wanted(1) - wanted(0);  // of the bones of the source
  if (how != Aligning::line && equal && bones > 1 && norm(whole) > 0) {
    if (pair.role == skeleton::Role::leg && bones == 2) first = wanted_knee(r, pair, turn, whole);
    const Vec3 line = unit_vector(whole);
    const double length = norm(own(bones) - own(0));
    turn = bend_turn(line, turn * (own(1) - own(0)), (length / norm(whole)) * first, length) * turn;
  }
  for (std::size_t k = 0; k < pair.target.count(); ++k) {
    if (how == Aligning::segments && equal && k < bones) {
      const Vec3 bone = k == 0 ? first : k == 1 ? wanted(2) - wanted(0) - first : wanted(k + 1) - wanted(k);
      turn = shortest_turn(turn * (own(k + 1) - own(k)), bone) * turn;
    }
    pair.align[k] = turn;
  }
}

}  // namespace hf_inner::retarget
