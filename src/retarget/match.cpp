#include "retarget/match.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::retarget {

void Matcher::follow(Index target, Index a, Index b, double share, Turn align) {
  if (r.wanted[at(target)]) return;
  r.wanted[at(target)] = 1;
  used[at(a)] = used[at(b)] = 1;
  const auto post = [&](Index j) {
    return unit_turn(inverse(r.source.rest.turn[at(j)]) *
                     (inverse(r.across) * (align * r.target.rest.turn[at(target)])));
  };
  r.follows.push_back({target, a, b, share, post(a), post(b)});
}

void Matcher::one_to_one(Index source, Index target) {
  if (source >= 0 && target >= 0) follow(target, source, source, 0, {});
}

namespace {

// The arc length from the first place to the end of each segment, as a share of all. A last segment without a tip
// counts as long as the one before.
void arc_shares(const Rig& rig, const Segments& chain, Vector<double>& shares) {
  const std::size_t bones = bone_count(chain);
  double sum = 0, last = 1;
  for (std::size_t k = 0; k < chain.count(); ++k) {
    if (k < bones) last = norm(segment_place(rig, chain, k + 1) - segment_place(rig, chain, k));
    sum += last;
    shares.push_back(sum);
  }
  for (double& share : shares) share = sum > 0 ? share / sum : 1;
}

// The joints of a segment: positions in Segments::joints.
std::size_t segment_end(const Segments& chain, std::size_t k) {
  return k + 1 < chain.count() ? at(chain.starts[k + 1]) : chain.joints.size();
}

// Returns the places of the joints along a segment, then the place of its end, as shares of its length. If the end of
// the last piece is not known, the piece counts as long as the piece before.
Vector<double> piece_places(const Rig& rig, const Segments& chain, std::size_t k, Memory& memory) {
  const std::size_t first = at(chain.starts[k]), end = segment_end(chain, k), joints = chain.joints.size();
  const auto place = [&](std::size_t i) {
    return i < joints ? rig.rest.place[at(chain.joints[i])] : rig.tip_place(chain.tip, rig.rest);
  };
  Vector<double> places(1, 0.0, &memory);
  double length = 1;
  for (std::size_t i = first; i < end; ++i) {
    if (i + 1 < joints || chain.tip.joint >= 0) length = norm(place(i + 1) - place(i));
    places.push_back(places.back() + length);
  }
  const double whole = places.back();
  for (double& p : places) p = whole > 0 ? p / whole : 0;
  return places;
}

// Makes each piece of a bone follow the piece of the source in which its middle lies. A joint in the place where the
// bone ends, such as a control of the heel, is a piece of no length: nothing follows it.
void follow_pieces(Matcher& m, const ChainPair& pair, std::size_t k) {
  const Vector<double> from = piece_places(m.r.source, pair.source, k, m.memory),
                       to = piece_places(m.r.target, pair.target, k, m.memory);
  const std::size_t sa = at(pair.source.starts[k]), ta = at(pair.target.starts[k]);
  for (std::size_t i = 0; i + 1 < to.size(); ++i) {
    const double middle = 0.5 * (to[i] + to[i + 1]);
    std::size_t piece = 0;
    for (std::size_t p = 1; p + 1 < from.size(); ++p) {
      if (from[p] < from[p + 1] && from[p] <= middle) piece = p;
    }
    const Index by = pair.source.joints[sa + piece];
    m.follow(pair.target.joints[ta + i], by, by, 0, pair.align[k]);
  }
}

// Pairs chains of unequal length. A segment of the target turns as the source does at the same share of arc length,
// between the turns at the ends of its segments. The joint that carries the chain has share 0.
void follow_arcs(Matcher& m, const ChainPair& pair) {
  Vector<double> u(&m.memory), v(&m.memory);
  arc_shares(m.r.source, pair.source, u);
  arc_shares(m.r.target, pair.target, v);
  const auto joint = [&](std::size_t k) { return pair.source.joints[segment_end(pair.source, k) - 1]; };
  for (std::size_t k = 0; k < v.size(); ++k) {
    std::size_t i = 0;
    while (i + 1 < u.size() && u[i] < v[k] - 1e-9) ++i;
    const double low = i > 0 ? u[i - 1] : 0;
    const Index a = i > 0 ? joint(i - 1) : pair.source.before >= 0 ? pair.source.before : joint(0);
    const double share = u[i] > low ? std::min(1.0, std::max(0.0, (v[k] - low) / (u[i] - low))) : 1;
    for (std::size_t q = at(pair.target.starts[k]); q < segment_end(pair.target, k); ++q)
      m.follow(pair.target.joints[q], share > 1 - 1e-9 ? joint(i) : a, joint(i), share, pair.align[k]);
  }
}

// A limb of one bone points where the hand or foot of the source is. The last bone of the source would kick it.
bool follows_line(const ChainPair& pair) {
  return (pair.role == skeleton::Role::arm || pair.role == skeleton::Role::leg) && pair.target.count() == 1 &&
         pair.source.count() > 1 && pair.source.tip.joint >= 0;
}

}  // namespace

void Matcher::add_pair(ChainPair pair, Aligning how, Turn before) {
  align_chain(r, pair, how, before);
  // The turns of a joint contain the turns of the joints above it in its chain.
  for (const Index joint : pair.source.joints) used[at(joint)] = 1;
  if (pair.source.count() == pair.target.count()) {
    for (std::size_t k = 0; k < pair.target.count(); ++k) follow_pieces(*this, pair, k);
  } else if (follows_line(pair)) {
    const std::size_t first = r.follows.size();
    for (const Index joint : pair.target.joints)
      follow(joint, pair.source.joints[0], pair.source.joints[0], 0, pair.align[0]);
    for (std::size_t k = first; k < r.follows.size(); ++k) r.follows[k].line = static_cast<Index>(r.pairs.size());
  } else {
    follow_arcs(*this, pair);
  }
  pair.compared = how == Aligning::segments && pair.source.count() == pair.target.count() &&
                  std::min(bone_count(pair.source), bone_count(pair.target)) > 0;
  r.pairs.push_back(std::move(pair));
}

void Matcher::add_path(const Vector<Index>& a, const Vector<Index>& b, Index a_before, Index b_before, Index a_end,
                       Index b_end, skeleton::Role role) {
  if (a.empty() || b.empty()) return;
  ChainPair pair(memory);
  pair.role = role;
  const auto fill = [](Segments& out, const Vector<Index>& joints, Index before, Index end) {
    out.joints = joints;
    out.before = before;
    if (end >= 0) out.tip = {end, {}};
    for (std::size_t k = 0; k < joints.size(); ++k) out.starts.push_back(static_cast<Index>(k));
  };
  fill(pair.source, a, a_before, a_end);
  fill(pair.target, b, b_before, b_end);
  add_pair(std::move(pair), Aligning::none, {});
}

// The joints between the trunk and a limb.
void Matcher::add_collars(const Segments& a, const Segments& b) {
  const auto path = [&](const Rig& rig, const skeleton::Character& c, Index j) {
    Vector<Index> out(&memory);
    for (; j >= 0 && c.roles[at(j)] == skeleton::Role::shoulder; j = rig.carriers[at(j)]) out.push_back(j);
    std::reverse(out.begin(), out.end());
    return std::pair(std::move(out), j);
  };
  const auto [from, from_before] = path(r.source, s.character, a.before);
  const auto [to, to_before] = path(r.target, t.character, b.before);
  add_path(from, to, from_before, to_before, a.joints[0], b.joints[0], skeleton::Role::shoulder);
}

namespace {

const skeleton::Chain* next_of(const skeleton::Character& c, const skeleton::Chain& chain, skeleton::Role role) {
  const Index index = static_cast<Index>(&chain - c.chains.data());
  for (const skeleton::Chain& next : c.chains) {
    if (next.parent == index && next.role == role && next.side == chain.side) return &next;
  }
  return nullptr;
}

}  // namespace

// Pairs the chains that continue a limb: hands, feet and toes.
void Matcher::add_next(const skeleton::Chain& a, const skeleton::Chain& b, skeleton::Role role, Turn align) {
  ChainPair pair(memory);
  pair.role = role;
  pair.side = b.side;
  pair.source = cut_chain(r.source, s.character, a, memory);
  pair.target = cut_chain(r.target, t.character, b, memory);
  add_pair(std::move(pair), Aligning::none, align);
}

void Matcher::add_limb(const skeleton::Chain& a, const skeleton::Chain& b, Aligning how, bool standing) {
  ChainPair pair(memory);
  pair.role = b.role;
  pair.side = b.side;
  pair.source = cut_chain(r.source, s.character, a, memory);
  pair.target = cut_chain(r.target, t.character, b, memory);
  add_collars(pair.source, pair.target);
  add_pair(std::move(pair), r.options.align_rests ? how : Aligning::none, {});
  const Turn last = r.pairs.back().align.back();
  const auto end_of = [](const skeleton::Character& c, const skeleton::Chain& limb) {
    return next_of(c, limb, limb.role == skeleton::Role::arm ? skeleton::Role::hand : skeleton::Role::foot);
  };
  const skeleton::Chain *end_a = end_of(s.character, a), *end_b = end_of(t.character, b);
  if (!end_a || !end_b) {
    if (b.role == skeleton::Role::arm) add_fingers(end_a ? *end_a : a, end_b ? *end_b : b, last);
    return;
  }
  add_next(*end_a, *end_b, end_b->role, b.role == skeleton::Role::arm ? last : Turn{});
  if (b.role == skeleton::Role::arm) add_fingers(*end_a, *end_b, last);
  if (!standing) return;
  const skeleton::Chain *toe_a = next_of(s.character, *end_a, skeleton::Role::toe),
                        *toe_b = next_of(t.character, *end_b, skeleton::Role::toe);
  if (toe_a && toe_b) add_next(*toe_a, *toe_b, skeleton::Role::toe, {});
}

skeleton::Role flapping_partner(const skeleton::Character& source, const skeleton::Character& target,
                                skeleton::Side side, skeleton::Role role) {
  const auto has = [&](const skeleton::Character& c, skeleton::Role r) { return find_chain(c, r, side, 0) != nullptr; };
  if (has(source, role) || role == skeleton::Role::leg) return role;
  // One limb of the source leads no two of the target.
  for (const skeleton::Role by : {skeleton::Role::wing, skeleton::Role::fin})
    if (has(source, by) && !has(target, by))
      return role == skeleton::Role::arm || !has(target, skeleton::Role::arm) ? by : skeleton::Role::other;
  return skeleton::Role::other;
}

// Arms by number. Legs from behind; the front legs of an animal follow arms where there are no more legs. Arms flap as
// wings or fins where the source has no arms, and these as one another. The bend of a fin is no elbow, so such pairs
// are aligned by their lines alone.
void Matcher::add_limbs() {
  const auto count = [](const skeleton::Character& c, skeleton::Role role, skeleton::Side side) {
    std::uint32_t found = 0;
    for (const skeleton::Chain& chain : c.chains) found += chain.role == role && chain.side == side;
    return found;
  };
  for (const skeleton::Side side : {skeleton::Side::left, skeleton::Side::right, skeleton::Side::middle}) {
    const std::uint32_t sa = count(s.character, skeleton::Role::arm, side),
                        ta = count(t.character, skeleton::Role::arm, side);
    const std::uint32_t sl = count(s.character, skeleton::Role::leg, side),
                        tl = count(t.character, skeleton::Role::leg, side);
    const auto add = [&](skeleton::Role a, std::uint32_t i, skeleton::Role b, std::uint32_t k, Aligning how) {
      const skeleton::Chain *from = find_chain(s.character, a, side, i), *to = find_chain(t.character, b, side, k);
      if (from && to) add_limb(*from, *to, how, a == skeleton::Role::leg && b == skeleton::Role::leg);
    };
    for (std::uint32_t k = 0; k < std::min(sl, tl); ++k)
      add(skeleton::Role::leg, sl - 1 - k, skeleton::Role::leg, tl - 1 - k,
          r.people ? Aligning::segments : Aligning::none);
    for (std::uint32_t k = 0; k < std::min(sa, ta); ++k)
      add(skeleton::Role::arm, k, skeleton::Role::arm, k,
          r.source.upright == r.target.upright ? Aligning::segments : Aligning::whole);
    if (ta == 0 && sa > 0 && tl > sl) add(skeleton::Role::arm, 0, skeleton::Role::leg, 0, Aligning::none);
    if (sa == 0 && ta > 0 && sl > tl) add(skeleton::Role::leg, 0, skeleton::Role::arm, 0, Aligning::none);
    for (const skeleton::Role to : {skeleton::Role::arm, skeleton::Role::wing, skeleton::Role::fin}) {
      const skeleton::Role by = flapping_partner(s.character, t.character, side, to);
      if (by != to && by != skeleton::Role::other && !(to == skeleton::Role::arm && sl > tl))
        add(by, 0, to, 0, Aligning::line);
    }
  }
}

// Some rigs have two rows of bones along the trunk: one carries the skin, the other arms or head. A bone of the other
// row turns as the nearest bone of the trunk. Joints that lead to legs move with the hips.
void Matcher::add_second_trunk() {
  Vector<Index> trunk(r.target.trunk, &memory);
  trunk.insert(trunk.begin(), r.target.mover);
  Vector<std::uint8_t> to_legs(at(r.target.count), 0, &memory);
  for (const RigLeg& leg : r.target.legs) {
    Index j = leg.segments.joints[0];
    for (Index steps = 0; j >= 0 && steps < r.target.count; ++steps, j = r.target.carriers[at(j)]) to_legs[at(j)] = 1;
  }
  for (const Index j : r.target.order) {
    if (r.wanted[at(j)] || to_legs[at(j)] || t.character.roles[at(j)] != skeleton::Role::spine ||
        t.character.kinds[at(j)] != skeleton::JointKind::body)
      continue;
    const auto distance = [&](Index a) { return norm(r.target.rest.place[at(a)] - r.target.rest.place[at(j)]); };
    const Index by =
        *std::min_element(trunk.begin(), trunk.end(), [&](Index a, Index b) { return distance(a) < distance(b); });
    const auto found =
        std::find_if(r.follows.begin(), r.follows.end(), [&](const Follow& f) { return f.target == by; });
    if (found != r.follows.end()) follow(j, found->a, found->b, found->share, {});
  }
}

// Tails, wings, ears, and the parts of the trunk that lead to legs alone.
void Matcher::add_others() {
  for (const skeleton::Chain& b : t.character.chains) {
    const bool aligned = b.role == skeleton::Role::wing;
    const bool taken = b.role == skeleton::Role::tail || b.role == skeleton::Role::wing ||
                       b.role == skeleton::Role::ear || b.role == skeleton::Role::jaw ||
                       b.role == skeleton::Role::eye || b.role == skeleton::Role::antenna ||
                       b.role == skeleton::Role::fin || b.role == skeleton::Role::spine;
    const skeleton::Chain* a = taken ? find_chain(s.character, b.role, b.side, b.number) : nullptr;
    if (!a) continue;
    ChainPair pair(memory);
    pair.role = b.role;
    pair.side = b.side;
    pair.source = cut_chain(r.source, s.character, *a, memory);
    pair.target = cut_chain(r.target, t.character, b, memory);
    if (b.role == skeleton::Role::spine) {  // the trunk has partners already
      const auto open = [](const Vector<Index>& joints, const Vector<std::uint8_t>& done) {
        return std::none_of(joints.begin(), joints.end(), [&](Index j) { return done[at(j)] != 0; });
      };
      if (!open(pair.target.joints, r.wanted) || !open(pair.source.joints, used)) continue;
    }
    add_pair(std::move(pair), aligned && r.options.align_rests ? Aligning::segments : Aligning::none, {});
  }
}

void Retargeter::match_chains(const RetargetSide& s, const RetargetSide& t) {
  wanted.assign(at(target.count), 0);
  Matcher matcher(*this, s, t, memory);
  matcher.one_to_one(source.mover, target.mover);
  for (const Index joint : source.second_rows) matcher.used[at(joint)] = 1;
  const auto last = [](const Rig& rig) { return rig.trunk.empty() ? rig.mover : rig.trunk.back(); };
  const auto next = [](const Rig& rig) { return rig.neck.empty() ? rig.head : rig.neck[0]; };
  matcher.add_path(source.trunk, target.trunk, source.mover, target.mover, next(source), next(target),
                   skeleton::Role::spine);
  matcher.add_path(source.neck, target.neck, last(source), last(target), source.head, target.head,
                   skeleton::Role::neck);
  if (source.head >= 0 && target.head >= 0 && source.head != source.mover && target.head != target.mover)
    matcher.one_to_one(source.head, target.head);
  matcher.add_limbs();
  matcher.add_second_trunk();
  matcher.add_others();
  report_.matched_joints = static_cast<std::uint32_t>(follows.size());
  const auto list = [&](const skeleton::Character& c, const Vector<std::uint8_t>& done, Vector<std::uint32_t>& out) {
    for (std::uint32_t j = 0; j < c.kinds.size(); ++j) {
      if (c.kinds[j] == skeleton::JointKind::body && !done[j]) out.push_back(j);
    }
  };
  list(s.character, matcher.used, report_.unmatched_source);
  list(t.character, wanted, report_.unmatched_target);
}

}  // namespace hf_inner::retarget
