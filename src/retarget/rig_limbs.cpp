// Limbs, trunk and what carries all of them.
#include <algorithm>
#include <cmath>

#include "retarget/rig.h"

namespace hf_inner::retarget {

const skeleton::Chain* find_chain(const skeleton::Character& character, skeleton::Role role, skeleton::Side side,
                                  std::uint32_t number) {
  for (const skeleton::Chain& chain : character.chains) {
    if (chain.role == role && chain.side == side && chain.number == number) return &chain;
  }
  return nullptr;
}

namespace {

// Returns the chain that begins at the tip of another, or null.
const skeleton::Chain* next_chain(const skeleton::Character& character, const skeleton::Chain& chain,
                                  skeleton::Role role) {
  const Index index = static_cast<Index>(&chain - character.chains.data());
  for (const skeleton::Chain& next : character.chains) {
    if (next.parent == index && next.role == role && next.side == chain.side) return &next;
  }
  return nullptr;
}

Index first_joint(const skeleton::Character& character, const skeleton::Chain& chain) {
  return static_cast<Index>(character.chain_joints[chain.first]);
}

// A limb ends at the hand or foot. Other chains end in the middle of what hangs on their last joint, and limbs on
// which nothing hangs where their vertices end.
Tip find_tip(const Rig& rig, const skeleton::Character& character, const skeleton::Chain& chain, Index last) {
  const skeleton::Role next = chain.role == skeleton::Role::arm   ? skeleton::Role::hand
                              : chain.role == skeleton::Role::leg ? skeleton::Role::foot
                                                                  : skeleton::Role::other;
  if (next != skeleton::Role::other) {
    if (const skeleton::Chain* end = next_chain(character, chain, next)) return {first_joint(character, *end), {}};
  }
  Vec3 sum;
  double found = 0;
  for (std::size_t j = 0; j < at(rig.count); ++j) {
    if (rig.parents[j] != last || character.kinds[j] == skeleton::JointKind::twist) continue;
    sum = sum + rig.rest.place[j];
    found += 1;
  }
  const Vec3 offset = (1 / std::max(found, 1.0)) * sum - rig.rest.place[at(last)];
  const bool far = found > 0 && norm(offset) > no_length * rig.height;
  if (far) return {last, offset};
  const Vec3 end = rig.ends[at(last)];
  const bool limb = chain.role == skeleton::Role::arm || chain.role == skeleton::Role::leg;
  return limb && norm(end) > no_length * rig.height ? Tip{last, end} : Tip{};
}

// Where a limb bends: at each joint with a clear bend; without one at the joint nearest to the middle.
void cut_limb(const Rig& rig, Segments& limb) {
  const std::size_t n = limb.joints.size();
  const Vec3 end = limb.tip.joint >= 0 ? rig.tip_place(limb.tip, rig.rest) : rig.rest.place[at(limb.joints[n - 1])];
  const auto place = [&](std::size_t k) { return k < n ? rig.rest.place[at(limb.joints[k])] : end; };
  const std::size_t last = limb.tip.joint >= 0 ? n : n - 1;  // the place where the last segment ends
  // Two joints in one place, such as an ankle and the control of its heel, have no bone between them.
  const auto bone = [&](std::size_t k) {
    const Vec3 way = place(k + 1) - place(k);
    return norm(way) > no_length * rig.height ? unit_vector(way) : Vec3{};
  };
  double length = 0;
  for (std::size_t k = 0; k < last; ++k) length += norm(place(k + 1) - place(k));
  std::size_t middle = 0;
  double nearest = 1e300, along = 0;
  for (std::size_t k = 1; k < last; ++k) {
    along += norm(place(k) - place(k - 1));
    const Vec3 a = bone(k - 1), b = bone(k);
    if (norm(a) > 0 && norm(b) > 0 && dot(a, b) < segment_bend) limb.starts.push_back(static_cast<Index>(k));
    if (std::fabs(along - 0.5 * length) < nearest) {
      nearest = std::fabs(along - 0.5 * length);
      middle = k;
    }
  }
  if (limb.starts.size() == 1 && middle > 0) limb.starts.push_back(static_cast<Index>(middle));
}

// The lowest joint that carries both.
Index common_carrier(const Rig& rig, Index a, Index b) {
  for (Index steps = 0; a >= 0 && steps <= rig.count; ++steps) {
    if (rig.is_below(b, a)) return a;
    a = rig.carriers[at(a)] >= 0 ? rig.carriers[at(a)] : rig.parents[at(a)];
  }
  return -1;
}

}  // namespace

Segments cut_chain(const Rig& rig, const skeleton::Character& character, const skeleton::Chain& chain, Memory& memory) {
  Segments out(memory);
  for (std::uint32_t k = 0; k < chain.count; ++k)
    out.joints.push_back(static_cast<Index>(character.chain_joints[chain.first + k]));
  out.before = rig.carriers[at(out.joints[0])];
  out.tip = find_tip(rig, character, chain, out.joints.back());
  if (chain.role == skeleton::Role::leg && out.tip.joint < 0 && out.joints.size() > 2) {  // the last joint is the ankle
    out.tip = {out.joints.back(), {}};
    out.joints.pop_back();
  }
  out.starts.push_back(0);
  if (chain.role == skeleton::Role::arm || chain.role == skeleton::Role::leg) {
    cut_limb(rig, out);
  } else {
    for (std::size_t k = 1; k < out.joints.size(); ++k) out.starts.push_back(static_cast<Index>(k));
  }
  return out;
}

void find_legs(Rig& rig, const skeleton::Character& character, Memory& memory) {
  std::uint32_t most = 0;
  for (const skeleton::Chain& chain : character.chains) {
    if (chain.role == skeleton::Role::leg) most = std::max(most, chain.number + 1);
  }
  for (std::uint32_t number = most; number-- > 0;) {
    for (const skeleton::Side side : {skeleton::Side::left, skeleton::Side::right, skeleton::Side::middle}) {
      const skeleton::Chain* chain = find_chain(character, skeleton::Role::leg, side, number);
      if (!chain) continue;
      RigLeg leg(memory);
      leg.segments = cut_chain(rig, character, *chain, memory);
      if (leg.segments.tip.joint < 0) continue;
      leg.side = side;
      leg.foot = leg.segments.tip.offset.x == 0 && leg.segments.tip.offset.y == 0 && leg.segments.tip.offset.z == 0
                     ? leg.segments.tip.joint
                     : -1;
      const skeleton::Chain* foot = next_chain(character, *chain, skeleton::Role::foot);
      const skeleton::Chain* toe = foot ? next_chain(character, *foot, skeleton::Role::toe) : nullptr;
      if (toe) leg.toe = first_joint(character, *toe);
      for (std::size_t s = 0; s < leg.segments.count(); ++s) {
        const Vec3 a = rig.rest.place[at(leg.segments.first(s))];
        leg.length += norm((s + 1 < leg.segments.count() ? rig.rest.place[at(leg.segments.first(s + 1))]
                                                         : rig.tip_place(leg.segments.tip, rig.rest)) -
                           a);
      }
      rig.legs.push_back(std::move(leg));
    }
  }
}

void find_trunk(Rig& rig, const skeleton::Character& character) {
  const auto visit = [&](skeleton::Role role, auto&& call) {
    for (const skeleton::Chain& chain : character.chains) {
      if (chain.role == role) call(first_joint(character, chain));
    }
  };
  if (const skeleton::Chain* head = find_chain(character, skeleton::Role::head, skeleton::Side::middle, 0))
    rig.head = first_joint(character, *head);
  Index arms = -1;
  for (const skeleton::Role role : {skeleton::Role::arm, skeleton::Role::wing})
    visit(role, [&](Index j) { arms = arms < 0 ? j : common_carrier(rig, arms, j); });
  rig.mover = rig.head >= 0 ? rig.head : arms;
  if (arms >= 0 && rig.mover >= 0) rig.mover = common_carrier(rig, rig.mover, arms);
  visit(skeleton::Role::leg, [&](Index j) { rig.mover = rig.mover < 0 ? j : common_carrier(rig, rig.mover, j); });
  if ((rig.legs.empty() || rig.mover < 0) && !character.chains.empty())
    rig.mover = first_joint(character, character.chains[0]);
  if (rig.mover < 0) rig.mover = rig.order[0];
  // Thighs may hang above the pelvis, as in 3ds Max's Biped. A root at the ground is farther away.
  for (Index p = rig.carriers[at(rig.mover)]; p >= 0 && character.roles[at(p)] == skeleton::Role::spine;
       p = rig.carriers[at(p)]) {
    const double apart = norm(rig.rest.place[at(p)] - rig.rest.place[at(rig.mover)]);
    if (rig.linked[at(rig.mover)] || !(apart > no_length * rig.height) || apart > pelvis_bone * rig.height) break;
    rig.mover = p;
  }
  for (Index j = rig.head >= 0 ? rig.carriers[at(rig.head)] : arms, steps = 0;
       j >= 0 && j != rig.mover && steps <= rig.count; j = rig.carriers[at(j)], ++steps) {
    const Vec3 from_mover = rig.rest.place[at(j)] - rig.rest.place[at(rig.mover)];
    const Vec3 way = rig.rest.place[at(rig.head >= 0 ? rig.head : arms)] - rig.rest.place[at(rig.mover)];
    const bool begins = rig.linked[at(j)] && dot(from_mover, unit_vector(way)) < no_length * rig.height;
    (begins ? rig.second_rows : character.roles[at(j)] == skeleton::Role::neck ? rig.neck : rig.trunk).push_back(j);
  }
  std::reverse(rig.trunk.begin(), rig.trunk.end());
  std::reverse(rig.neck.begin(), rig.neck.end());
  rig.moves.assign(at(rig.count), 0);
  for (const Index j : rig.order) {
    const Index by = rig.linked[at(j)] ? rig.carriers[at(j)] : rig.parents[at(j)];
    rig.moves[at(j)] = j == rig.mover || (by >= 0 && rig.moves[at(by)]);
  }
  double rise = character.trunk;
  if (rig.head >= 0) rise = dot(unit_vector(rig.rest.place[at(rig.head)] - rig.hip_place(rig.rest)), rig.up);
  rig.upright = rig.legs.size() == 2 && rise > 0.6;
}

}  // namespace hf_inner::retarget
