// Writes the result: chains from roles, lengths, rest frames, how sure it is.
#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "skeleton/body.h"

namespace hf_inner::skeleton {

const char* role_name(Role role) noexcept {
  static constexpr const char* names[] = {"other", "spine", "neck",   "head", "jaw",     "shoulder",
                                          "arm",   "hand",  "finger", "leg",  "foot",    "toe",
                                          "tail",  "wing",  "ear",    "eye",  "antenna", "fin"};
  return names[static_cast<std::size_t>(role)];
}

namespace {

Index chain_of(const Character& out, Index joint) { return joint < 0 ? -1 : out.joint_chains[at(joint)]; }

// A joint continues its carrier's chain if it has the same role and side, and is the longest such child.
bool goes_on(const Body& body, Index joint) {
  const Index p = body.carriers[at(joint)];
  if (p < 0) return false;
  const auto same = [&](Index j) {
    return body.roles[at(j)] == body.roles[at(p)] && body.sides[at(j)] == body.sides[at(p)];
  };
  const auto length = [&](Index j) { return norm(body.pivots[at(j)] - body.pivots[at(p)]) + body.reaches[at(j)]; };
  if (!same(joint)) return false;
  for (const Index other : body.children_of(p)) {
    if (other != joint && same(other) &&
        (length(other) > length(joint) || (length(other) == length(joint) && other < joint)))
      return false;
  }
  return true;
}

void make_chains(const Body& body, Character& out) {
  out.joint_chains.assign(at(body.count), -1);
  Vector<Index> longest(&body.memory);
  for (const Index j : body.tree) {
    if (goes_on(body, j)) {
      out.joint_chains[at(j)] = chain_of(out, body.carriers[at(j)]);
      ++out.chains[at(out.joint_chains[at(j)])].count;
      continue;
    }
    Chain chain;
    chain.role = body.roles[at(j)];
    chain.side = body.sides[at(j)];
    chain.count = 1;
    chain.parent = chain_of(out, body.carriers[at(j)]);
    out.joint_chains[at(j)] = static_cast<Index>(out.chains.size());
    out.chains.push_back(chain);
  }
  std::uint32_t first = 0;
  Vector<std::uint32_t> next(&body.memory);
  for (Chain& chain : out.chains) {
    chain.first = first;
    first += chain.count;
    next.push_back(chain.first);
  }
  out.chain_joints.resize(first);
  for (const Index j : body.tree) out.chain_joints[next[at(chain_of(out, j))]++] = static_cast<std::uint32_t>(j);
}

void number_chains(const Body& body, Character& out) {
  Vector<std::size_t> order(&body.memory);
  for (std::size_t c = 0; c < out.chains.size(); ++c) order.push_back(c);
  const auto place = [&](std::size_t c) {
    const bool leg =
        out.chains[c].role == Role::leg || out.chains[c].role == Role::shoulder || out.chains[c].role == Role::foot;
    return leg ? -dot(body.pivots[at(static_cast<Index>(out.chain_joints[out.chains[c].first]))], body.forward) : 0.0;
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double p = place(a), q = place(b);
    return p != q ? p < q : a < b;
  });
  std::uint32_t counts[role_count][3] = {};
  for (const std::size_t c : order)
    out.chains[c].number =
        counts[static_cast<std::size_t>(out.chains[c].role)][static_cast<std::size_t>(out.chains[c].side)]++;
}

// Returns the place where a leg without a foot ends: the point of its sole nearest to the point under the hip. The
// middle of a body is over its ankles; the middle of a boot lies toward the toes.
Vec3 ankle_of_sole(const Body& body, Index joint, Vec3 hip) {
  const double low = body.lowest_below(joint, body.up);
  double back = 1e300, front = -1e300, left = -1e300, right = 1e300;
  for (const std::uint32_t v : body.owned_by(joint)) {
    const Vec3 p = body.points[v];
    if (dot(p, body.up) - low > 0.5 * standing * body.height) continue;
    back = std::min(back, dot(p, body.forward));
    front = std::max(front, dot(p, body.forward));
    left = std::max(left, dot(p, body.left));
    right = std::min(right, dot(p, body.left));
  }
  if (!(front >= back)) return body.pivots[at(joint)];
  const double ahead = std::clamp(dot(hip, body.forward), back, front);
  return low * body.up + ahead * body.forward + 0.5 * (left + right) * cross(body.up, body.forward);
}

// Along the joints, then along the chain that continues from the tip.
void measure_chains(const Body& body, Character& out) {
  for (std::size_t c = 0; c < out.chains.size(); ++c) {
    Chain& chain = out.chains[c];
    const auto pivot = [&](std::uint32_t k) { return body.pivots[out.chain_joints[chain.first + k]]; };
    for (std::uint32_t k = 1; k < chain.count; ++k) chain.length += norm(pivot(k) - pivot(k - 1));
    const Index tip = static_cast<Index>(out.chain_joints[chain.first + chain.count - 1]);
    double on = 0;
    for (const Index child : body.children_of(tip)) {
      const Role role = body.roles[at(child)];
      const bool next = static_cast<std::int32_t>(role) == static_cast<std::int32_t>(chain.role) + 1;
      if (next && body.sides[at(child)] == chain.side && on == 0)
        on = norm(body.pivots[at(child)] - pivot(chain.count - 1));
    }
    if (on == 0 && body.children_of(tip).empty())
      on = chain.role == Role::leg ? norm(ankle_of_sole(body, tip, pivot(0)) - body.pivots[at(tip)])
                                   : body.reaches[at(tip)];
    chain.length = body.scale * (chain.length + on);
    chain.low =
        body.scale * (body.lowest_below(static_cast<Index>(out.chain_joints[chain.first]), body.up) - body.ground);
  }
}

const Chain* find_chain(const Character& out, Role role, Side side, bool last) {
  const Chain* found = nullptr;
  for (const Chain& chain : out.chains) {
    if (chain.role != role || chain.side != side) continue;
    if (!found || (last ? chain.number > found->number : chain.number < found->number)) found = &chain;
  }
  return found;
}

// Means over both sides.
void measure_limbs(const Body& body, Character& out) {
  double legs = 0, hips = 0, leg_count = 0, arms = 0, arm_count = 0, foot = 1e300;
  for (const Side side : {Side::left, Side::right}) {
    if (const Chain* leg = find_chain(out, Role::leg, side, true)) {
      const Index hip = static_cast<Index>(out.chain_joints[leg->first]);
      const Index end = static_cast<Index>(out.chain_joints[leg->first + leg->count - 1]);
      double sole = 0;
      for (const Index child : body.children_of(end)) {
        if (body.roles[at(child)] != Role::foot) continue;
        sole = std::max(0.0, body.height_of(body.pivots[at(child)]));
        if (body.points.empty()) sole = std::min(sole, body.reaches[at(child)]);  // in a leap no foot is on the ground
      }
      foot = std::min(foot, sole);
      legs += leg->length;
      hips += body.scale * body.height_of(body.pivots[at(hip)]);
      leg_count += 1;
    }
    if (const Chain* arm = find_chain(out, Role::arm, side, false)) {
      arms += arm->length;
      arm_count += 1;
    }
  }
  if (leg_count > 0) {
    out.leg_length = legs / leg_count + body.scale * foot;  // a stride lifts the other foot
    out.hip_height = hips / leg_count;
  }
  if (arm_count > 0) out.arm_length = arms / arm_count;
}

// Whether the longest leg has at least a quarter of the length of the longest other limb; the first pair of wings does
// not count. A spider that lies flat stretches its legs aside, and the limbs that stand are short.
bool has_legs(const Character& out) {
  double legs = 0, longest = 0;
  for (const Chain& chain : out.chains) {
    if (chain.role == Role::leg && chain.side == Side::left) legs = std::max(legs, chain.length);
    const bool limb = chain.role == Role::arm || (chain.role == Role::wing && chain.number > 0);
    if (limb) longest = std::max(longest, chain.length);
  }
  return legs > 0 && 4 * legs >= longest;
}

// Names and shape that agree make it sure, names of sides alone less so; a body without head or without legs and fins
// is not understood.
double role_confidence(const Body& body, const Character& out) {
  double sure = body.named ? 0.95 : body.sides_named ? 0.75 : 0.6;
  const bool swims =
      std::any_of(out.chains.begin(), out.chains.end(), [](const Chain& c) { return c.role == Role::fin; });
  if (!has_legs(out) && !swims) sure -= 0.2;
  if (body.head < 0) sure -= 0.2;
  if (!body.sides_named && (body.mirror_margin < unsure || body.mirror_score < 0)) sure = std::min(sure, 0.4);
  return std::min(sure, body.tree.size() < 3 ? 0.1 : 1.0);
}

}  // namespace

void write_character(Body& body, Character& out) {
  out.up = body.up;
  out.forward = body.forward;
  out.left = cross(body.up, body.forward);
  out.up_confidence = body.up_confidence;
  out.forward_confidence = body.forward_confidence;
  out.left_confidence = std::min(body.up_confidence, body.forward_confidence);
  out.kinds = body.kinds;
  out.roles = body.roles;
  out.sides = body.sides;
  out.carriers = body.carriers;
  out.mates = body.mates;
  out.frames = body.frames;
  make_chains(body, out);
  number_chains(body, out);
  measure_chains(body, out);
  measure_limbs(body, out);
  out.height = body.scale * body.height;
  out.ground = dot(body.centre, body.up) + body.scale * body.ground;
  out.middle = body.centre + body.scale * (body.offset * body.left + body.ground * body.up);
  out.role_confidence = role_confidence(body, out);
  out.trunk = body.trunk;
  out.why = body.why;
  out.up_why = body.up_why;
  out.forward_why = body.forward_why;
}

namespace {

// Without the surface.
CharacterInput bare_of(const CharacterInput& input) {
  CharacterInput bare = input;
  bare.bound = nullptr;
  bare.vertex_count = bare.triangle_count = 0;
  bare.influence_starts = nullptr;
  return bare;
}

// Whether the surface may be of a part of the body, as a head in a file of clips: no name in it says leg, and there are
// other joints.
bool lacks_legs(const Body& body) {
  if (body.points.empty() || !body.named) return false;
  std::size_t others = 0;
  for (std::size_t j = 0; j < at(body.count); ++j) {
    if (body.kept[j] && body.names[j].named == NameClass::leg) return false;
    others += !body.kept[j];
  }
  return others >= 4;  // two joints of each leg
}

// Whether the joints alone have named legs on both sides that end far from the surface.
bool has_legs_beyond(const Body& body, const Character& bare) {
  Box box;
  for (const Vec3& p : body.points) box.add(p);
  bool found[3] = {};
  for (const Chain& chain : bare.chains) {
    const Index tip = static_cast<Index>(bare.chain_joints[chain.first + chain.count - 1]);
    if (chain.role == Role::leg && chain.count > 1 && box.distance(body.pivots[at(tip)]) > far_from_surface)
      found[static_cast<std::size_t>(chain.side)] = true;
  }
  return bare.role_confidence > 0.9 && found[static_cast<std::size_t>(Side::left)] &&
         found[static_cast<std::size_t>(Side::right)];
}

}  // namespace

Character know_character(const CharacterInput& input, Memory& memory) {
  Body body(input, memory);
  read_joints(body);
  poll();
  read_vertices(body);
  find_owners(body);
  read_names(body);
  poll();
  if (lacks_legs(body)) {
    Character bare = know_character(bare_of(input), memory);
    if (has_legs_beyond(body, bare)) {
      const char words[] = "The surface is of a part of the body: joints and names alone count.\n";
      bare.partial = true;
      bare.why.insert(bare.why.begin(), words, words + sizeof words - 1);
      return bare;
    }
  }
  find_mirror(body);
  join_pieces(body);
  build_tree(body);
  find_limbs(body);
  find_up(body);
  follow_limbs(body);
  find_head(body);
  find_forward(body);
  assign_roles(body);
  Character out(memory);
  write_character(body, out);
  return out;
}

}  // namespace hf_inner::skeleton
