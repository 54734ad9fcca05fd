// Points of the skin that stand for soles and for parts of the body.
#include <algorithm>
#include <cmath>

#include "retarget/rig.h"

namespace hf_inner::retarget {
namespace {

// Directions spread evenly over the sphere: a spiral whose steps turn by the golden angle.
Vec3 spread_direction(std::size_t k, std::size_t count) noexcept {
  const double golden = 2.399963229728653;
  const double y = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(count);
  const double r = std::sqrt(std::max(0.0, 1 - y * y)), angle = golden * static_cast<double>(k);
  return {r * cosine(angle), y, r * sine(angle)};
}

Vec3 vertex(const skeleton::CharacterInput& in, std::size_t v) noexcept {
  return {in.positions[3 * v], in.positions[3 * v + 1], in.positions[3 * v + 2]};
}

// The heaviest joints of a vertex, heaviest first.
SkinPoint influences_of(const skeleton::CharacterInput& in, std::size_t v) noexcept {
  SkinPoint p;
  const auto add = [&](Index joint, double weight) {
    if (!(weight > 0) || !std::isfinite(weight)) return;
    for (std::size_t k = 0; k < SkinPoint::most; ++k) {
      if (!(weight > p.weights[k])) continue;
      std::swap(weight, p.weights[k]);
      std::swap(joint, p.joints[k]);
    }
  };
  if (in.influence_starts) {
    for (std::uint32_t k = in.influence_starts[v]; k < in.influence_starts[v + 1]; ++k)
      add(static_cast<Index>(in.influence_joints[k]), in.influence_weights ? in.influence_weights[k] : 1.0);
  }
  if (p.joints[0] < 0 && in.vertex_joints && in.vertex_joints[v] >= 0) add(in.vertex_joints[v], 1);
  return p;
}

// Fastens a place to the joints of a point at rest.
void fasten(SkinPoint& p, Vec3 place, const Stance& rest) noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < SkinPoint::most && p.joints[k] >= 0; ++k) {
    const Linear& m = rest.linear[at(p.joints[k])];
    const double size = norm(m.x) * norm(m.y) * norm(m.z);
    if (!(std::fabs(determinant(m)) > 1e-9 * size)) p.weights[k] = 0;  // a flat joint moves no vertex
    if (p.weights[k] > 0) p.local[k] = solve(m, place - rest.place[at(p.joints[k])]);
    sum += p.weights[k];
  }
  for (double& w : p.weights) w = sum > 0 ? w / sum : 0;
  if (!(sum > 0)) p.joints[0] = -1;
}

template <class Takes>
Vector<SkinPoint> outermost(const skeleton::CharacterInput& in, const Stance& rest, std::size_t directions, Vec3 up,
                            bool below, Takes takes, Memory& memory) {
  Vector<std::uint32_t> taken(&memory), best(directions, HF_NO_INDEX, &memory);
  Vector<double> reach(directions, -1e300, &memory);
  Vector<Vec3> spread(&memory);
  for (std::size_t k = 0; k < directions; ++k) {
    const Vec3 d = spread_direction(k, directions);
    spread.push_back(below && dot(d, up) > 0 ? d - (2 * dot(d, up)) * up : d);
  }
  for (std::uint32_t v = 0; in.positions && v < in.vertex_count; ++v) {
    const Vec3 p = vertex(in, v);
    const SkinPoint joints = influences_of(in, v);
    if (joints.joints[0] < 0 || !std::isfinite(p.x + p.y + p.z) || !takes(joints.joints[0], p)) continue;
    for (std::size_t k = 0; k < directions; ++k) {
      if (dot(spread[k], p) > reach[k]) {
        reach[k] = dot(spread[k], p);
        best[k] = v;
      }
    }
  }
  std::sort(best.begin(), best.end());
  best.erase(std::unique(best.begin(), best.end()), best.end());
  Vector<SkinPoint> out(&memory);
  for (const std::uint32_t v : best) {
    if (v == HF_NO_INDEX) continue;
    SkinPoint p = influences_of(in, v);
    fasten(p, vertex(in, v), rest);
    if (p.joints[0] >= 0) out.push_back(p);
  }
  return out;
}

// How high a joint of the feet rests over the sole: as on the lower foot, for a stride lifts the other one. In a leap
// both are in the air, and the length of the foot bounds it.
double over_sole(const Rig& rig, const Stance& rest, Index RigLeg::*joint) noexcept {
  double height = 1e300;
  for (const RigLeg& leg : rig.legs) {
    if (leg.*joint < 0) continue;
    height = std::min(height, rig.height_of(rest.place[at(leg.*joint)]));
    if (leg.toe >= 0) height = std::min(height, norm(rest.place[at(leg.toe)] - rest.place[at(leg.foot)]));
  }
  return height;
}

// Without a skin a foot touches the ground below its joints.
void add_bare_sole(const Rig& rig, const Stance& rest, RigLeg& leg) {
  for (Index RigLeg::*joint : {&RigLeg::foot, &RigLeg::toe}) {
    const Index j = leg.*joint;
    if (j < 0) continue;
    SkinPoint p;
    p.joints[0] = j;
    p.weights[0] = 1;
    fasten(p, rest.place[at(j)] - over_sole(rig, rest, joint) * rig.up, rest);
    if (p.joints[0] >= 0) leg.sole.push_back(p);
  }
}

}  // namespace

// Finds the lowest vertices that the foot owns, and that the shin owns below the ankle. A shin without a foot touches
// the ground with its lower half.
void find_soles(Rig& rig, const RetargetSide& side, Memory& memory) {
  const Stance& file_rest = rig.file_rest;
  for (RigLeg& leg : rig.legs) {
    const Vec3 ankle = rig.tip_place(leg.segments.tip, file_rest);
    const Index shin = leg.segments.first(leg.segments.count() - 1);
    const Vec3 top = leg.foot < 0 ? 0.5 * (file_rest.place[at(shin)] + ankle) : ankle;
    const auto takes = [&](Index j, Vec3 p) {
      return (leg.foot >= 0 && rig.is_below(j, leg.foot)) || (rig.is_below(j, shin) && dot(p - top, rig.up) < 0);
    };
    leg.sole = outermost(side.input, file_rest, sole_directions, rig.up, true, takes, memory);
    if (leg.sole.size() < 3) add_bare_sole(rig, file_rest, leg);
    for (const SkinPoint& p : leg.sole)
      leg.sole_length =
          std::max(leg.sole_length, norm(rig.level(p.at(rig.rest) - rig.tip_place(leg.segments.tip, rig.rest))));
  }
}

namespace {

// Calls visit(joint, way) for each vertex: the joint that moves it most, and the way from that joint to the vertex.
template <class Visit>
void each_from_joint(const Rig& rig, const skeleton::CharacterInput& in, Visit visit) {
  for (std::uint32_t v = 0; in.positions && v < in.vertex_count; ++v) {
    const Vec3 p = vertex(in, v);
    const Index j = influences_of(in, v).joints[0];
    if (j >= 0 && std::isfinite(p.x + p.y + p.z)) visit(at(j), p - rig.file_rest.place[at(j)]);
  }
}

// Returns how far forward of each joint its sole begins. The sole is the lowest vertices of the joint. 1e300: no
// vertex.
Vector<double> find_heels(const Rig& rig, const skeleton::CharacterInput& in, Memory& memory) {
  Vector<double> lows(at(rig.count), 1e300, &memory), heels(at(rig.count), 1e300, &memory);
  each_from_joint(rig, in, [&](std::size_t j, Vec3 p) { lows[j] = std::min(lows[j], dot(p, rig.up)); });
  each_from_joint(rig, in, [&](std::size_t j, Vec3 p) {
    if (dot(p, rig.up) <= lows[j] + low_share * rig.leg_length) heels[j] = std::min(heels[j], dot(p, rig.forward));
  });
  return heels;
}

}  // namespace

void find_ends(Rig& rig, const RetargetSide& side, Memory& memory) {
  rig.ends.assign(at(rig.count), {});
  Vector<double> counts(at(rig.count), 0, &memory);
  each_from_joint(rig, side.input, [&](std::size_t j, Vec3 p) {
    rig.ends[j] = rig.ends[j] + p;
    counts[j] += 1;
  });
  for (std::size_t j = 0; j < at(rig.count); ++j) {
    if (counts[j] > 0) rig.ends[j] = (2 / counts[j]) * rig.ends[j];
  }
  // The middle of a body is over its ankles, but the middle of a boot lies toward the toes. A leg without a foot ends
  // at the place of its sole that is nearest to the point under the hip.
  const Vector<double> heels = find_heels(rig, side.input, memory);
  for (const skeleton::Chain& chain : side.character.chains) {
    if (chain.role != skeleton::Role::leg) continue;
    const std::size_t hip = side.character.chain_joints[chain.first],
                      last = side.character.chain_joints[chain.first + chain.count - 1];
    const double ahead = dot(rig.ends[last], rig.forward),
                 under = dot(rig.file_rest.place[hip] - rig.file_rest.place[last], rig.forward);
    const double nearest = std::max(under, heels[last]);
    if (nearest < ahead) rig.ends[last] = rig.ends[last] - (ahead - nearest) * rig.forward;
  }
  for (std::size_t j = 0; j < at(rig.count); ++j)
    rig.ends[j] = rig.rest.turn[j] * inverse(rig.file_rest.turn[j]) * rig.ends[j];
}

Vector<SkinPoint> outer_points(const Rig& rig, const RetargetSide& side, const Vector<std::uint8_t>& part,
                               Memory& memory) {
  return outermost(
      side.input, rig.file_rest, part_directions, {}, false, [&](Index j, Vec3) { return part[at(j)] != 0; }, memory);
}

}  // namespace hf_inner::retarget
