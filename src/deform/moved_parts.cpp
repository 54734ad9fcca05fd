#include "deform/moved_parts.h"

#include <algorithm>

#include "base/index.h"
#include "deform/constants.h"

namespace hf_inner::deform {
namespace {

// The role whose part a joint of this role belongs to.
skeleton::Role part_role(skeleton::Role role) noexcept {
  switch (role) {
    case skeleton::Role::head:
    case skeleton::Role::jaw:
    case skeleton::Role::eye:
      return skeleton::Role::head;
    case skeleton::Role::hand:
    case skeleton::Role::finger:
      return skeleton::Role::hand;
    case skeleton::Role::foot:
    case skeleton::Role::toe:
      return skeleton::Role::foot;
    default:
      return skeleton::Role::other;
  }
}

// The joints, parents first. Parents form no circle.
Vector<std::uint32_t> parents_first(const Vector<std::int32_t>& parents, Memory& memory) {
  const std::size_t count = parents.size();
  Vector<std::int32_t> first(count, -1, &memory), next(count, -1, &memory);
  Vector<std::uint32_t> order(&memory);
  order.reserve(count);
  for (std::size_t j = count; j-- > 0;) {
    const std::int32_t parent = parents[j];
    if (parent < 0) continue;
    next[j] = first[at(parent)];
    first[at(parent)] = static_cast<std::int32_t>(j);
  }
  for (std::size_t j = 0; j < count; ++j) {
    if (parents[j] < 0) order.push_back(static_cast<std::uint32_t>(j));
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::int32_t child = first[order[k]]; child >= 0; child = next[at(child)])
      order.push_back(static_cast<std::uint32_t>(child));
  }
  return order;
}

}  // namespace

MovedParts::MovedParts(const surface::Core& core, const skeleton::KnownSkeleton& known)
    : core_(core),
      known_(known),
      memory_(*core.memory),
      order_(parents_first(known.parents, memory_)),
      role_(&memory_),
      side_(&memory_),
      chain_(&memory_),
      joint_part_(&memory_),
      part_role_(&memory_),
      part_joint_(&memory_),
      has_foot_(&memory_),
      unmoved_(&memory_),
      vertex_part_(&memory_),
      beside_(&memory_),
      start_(&memory_),
      vertex_(&memory_),
      chest_(&memory_),
      moved_(&memory_) {
  read_roles();
  read_chains();
  take_necks();
  find_unmoved();
  find_vertices();
  find_beside();
  find_chest();
  find_head_base();
}

template <class Visit>
void MovedParts::for_joints(std::int32_t v, Visit&& visit) const {
  const skeleton::CharacterInput& input = known_.input;
  if (input.vertex_count == 0) return;
  const std::size_t given = at(core_.mesh.given_of_inner[at(v)]);
  for (std::uint32_t k = input.influence_starts[given]; k < input.influence_starts[given + 1]; ++k) {
    if (input.influence_weights[k] > 0) visit(input.influence_joints[k], input.influence_weights[k]);
  }
}

bool MovedParts::knows_roles() const noexcept { return known_.character.role_confidence >= sure_roles; }

// A joint without a role takes the role of its parent. But a joint that hangs on the trunk begins a limb of its own, so
// it keeps no role.
void MovedParts::read_roles() {
  const skeleton::Character& character = known_.character;
  role_ = character.roles;
  side_ = character.sides;
  chain_ = character.joint_chains;
  for (const std::uint32_t j : order_) {
    const std::int32_t parent = known_.parents[j];
    if (parent < 0) continue;
    if (chain_[j] < 0) chain_[j] = chain_[at(parent)];
    const skeleton::Role above = role_[at(parent)];
    if (role_[j] != skeleton::Role::other || above == skeleton::Role::spine || above == skeleton::Role::neck ||
        above == skeleton::Role::shoulder)
      continue;
    role_[j] = above;
    side_[j] = side_[at(parent)];
  }
}

// A chain joins the part of the chain that it hangs on: a jaw joins a head. Fingers without a hand are one part. A
// single joint without a role on a head, such as a brow, belongs to the head; a row of such joints is hair.
void MovedParts::read_chains() {
  const skeleton::Character& character = known_.character;
  const Vector<skeleton::Chain>& chains = character.chains;
  Vector<std::int32_t> part(chains.size(), -1, &memory_), below(chains.size(), -1, &memory_);
  Vector<std::uint8_t> ends(chains.size(), 1, &memory_);
  for (const skeleton::Chain& chain : chains) {
    if (chain.parent >= 0) ends[at(chain.parent)] = 0;
  }
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const std::int32_t above = chains[c].parent;
    const skeleton::Role role = part_role(chains[c].role);
    const bool digit = chains[c].role == skeleton::Role::finger || chains[c].role == skeleton::Role::toe;
    const std::int32_t part_above = above < 0 ? -1 : digit && part[at(above)] < 0 ? below[at(above)] : part[at(above)];
    const skeleton::Role role_above = part_above < 0 ? skeleton::Role::other : part_role_[at(part_above)];
    const bool brow = role_above == skeleton::Role::head && chains[c].role == skeleton::Role::other &&
                      chains[c].count == 1 && ends[c];
    if (part_above >= 0 && (brow || role == role_above)) {
      part[c] = part_above;
    } else if (role != skeleton::Role::other) {
      part[c] = static_cast<std::int32_t>(part_role_.size());
      part_role_.push_back(role);
      part_joint_.push_back(character.chain_joints[chains[c].first]);
      if (digit && above >= 0) below[at(above)] = part[c];
    }
  }
  joint_part_.assign(known_.parents.size(), -1);
  for (std::size_t j = 0; j < joint_part_.size(); ++j) {
    const std::int32_t carrier = character.carriers[j];
    std::int32_t chain = character.joint_chains[j];
    if (chain < 0 && carrier >= 0) chain = character.joint_chains[at(carrier)];
    if (chain >= 0) joint_part_[j] = part[at(chain)];
  }
}

// A head whose joints have most of no vertex is moved by its neck: an end joint says where the head ends.
void MovedParts::take_necks() {
  Vector<std::uint8_t> moves(order_.size(), 0, &memory_);
  for (std::int32_t v = 0; v < core_.size(); ++v) {
    double most = 0;
    std::uint32_t heaviest = no_joint;
    for_joints(v, [&](std::uint32_t j, double weight) {
      if (weight > most) heaviest = j;
      most = std::max(most, weight);
    });
    if (heaviest != no_joint) moves[heaviest] = 1;
  }
  const skeleton::Character& character = known_.character;
  const auto is_head = [&](std::int32_t part) { return part >= 0 && part_role_[at(part)] == skeleton::Role::head; };
  for (std::size_t j = 0; j < moves.size(); ++j) {
    if (moves[j] && is_head(joint_part_[j])) return;
  }
  for (std::size_t j = 0; j < moves.size(); ++j) {
    if (character.roles[j] != skeleton::Role::head) continue;
    std::int32_t neck = known_.parents[j];
    while (neck >= 0 && !moves[at(neck)]) neck = known_.parents[at(neck)];
    if (neck < 0 || character.roles[at(neck)] != skeleton::Role::neck || is_head(joint_part_[at(neck)])) continue;
    joint_part_[at(neck)] = static_cast<std::int32_t>(part_role_.size());
    part_role_.push_back(skeleton::Role::head);
    part_joint_.push_back(static_cast<std::uint32_t>(neck));
  }
}

// A joint is a control if no skin names it or a joint above it. If controls move more than half of a mesh, they count
// as its joints.
void MovedParts::find_unmoved() {
  const std::size_t size = at(core_.size());
  unmoved_.assign(size, 0);
  if (known_.input.vertex_count == 0) return;
  Vector<std::uint8_t> moves(order_.size(), 1, &memory_);
  for (const std::uint32_t j : order_) {
    const std::int32_t parent = known_.parents[j];
    moves[j] = !known_.input.bound || known_.input.bound[j] || (parent >= 0 && moves[at(parent)]);
  }
  std::size_t count = 0;
  for (std::size_t v = 0; v < size; ++v) {
    bool moved = false;
    for_joints(static_cast<std::int32_t>(v), [&](std::uint32_t j, double) { moved = moved || moves[j]; });
    unmoved_[v] = !moved;
    count += !moved;
  }
  if (2 * count > size) unmoved_.assign(size, 0);
  has_unmoved_ = count > 0 && 2 * count <= size;
}

void MovedParts::find_vertices() {
  const std::size_t size = at(core_.size()), count = part_role_.size();
  vertex_part_.assign(size, -1);
  Vector<double> area(count, 0.0, &memory_), share(count, 0.0, &memory_);
  double whole = 0;
  for (std::size_t v = 0; v < size; ++v) {
    double all = 0;
    std::int32_t best = -1;
    const auto visit = [&](std::uint32_t j, double weight) {
      all += weight;
      const std::int32_t part = joint_part_[j];
      if (part < 0) return;
      share[at(part)] += weight;
      if (best < 0 || share[at(part)] > share[at(best)]) best = part;
    };
    for_joints(static_cast<std::int32_t>(v), visit);
    if (best >= 0 && share[at(best)] > part_share * all) vertex_part_[v] = best;
    for_joints(static_cast<std::int32_t>(v), [&](std::uint32_t j, double) {
      if (joint_part_[j] >= 0) share[at(joint_part_[j])] = 0;
    });
    whole += core_.areas[v];
    if (vertex_part_[v] >= 0) area[at(vertex_part_[v])] += core_.areas[v];
  }
  for (std::int32_t& part : vertex_part_) {
    if (part >= 0 && area[at(part)] > most_part_share * whole) part = -1;
  }
  start_.assign(count + 1, 0);
  for (const std::int32_t part : vertex_part_) {
    if (part >= 0) ++start_[at(part) + 1];
  }
  for (std::size_t p = 0; p < count; ++p) start_[p + 1] += start_[p];
  Vector<std::int32_t> next(start_, &memory_);
  vertex_.resize(at(start_[count]));
  for (std::size_t v = 0; v < size; ++v) {
    if (vertex_part_[v] >= 0) vertex_[at(next[at(vertex_part_[v])]++)] = static_cast<std::int32_t>(v);
  }
  has_foot_.assign(known_.character.chains.size(), 0);
  for (const skeleton::Chain& chain : known_.character.chains) {
    if (chain.parent < 0) continue;
    const std::int32_t part = joint_part_[known_.character.chain_joints[chain.first]];
    if (part >= 0 && part_role_[at(part)] == skeleton::Role::foot && vertices_of(at(part)).size() >= least_part)
      has_foot_[at(chain.parent)] = 1;
  }
}

void MovedParts::find_beside() {
  const std::size_t size = at(core_.size());
  beside_.assign(size, 0);
  for (std::size_t v = 0; v < size; ++v) beside_[v] = vertex_part_[v] >= 0;
  if (core_.geometry->links) {
    for (const mesh::Link& link : core_.geometry->links->links) {
      std::int32_t ends[4] = {link.vertex, link.corner[0], link.corner[1], link.corner[2]};
      const bool held = std::any_of(ends, ends + 4, [&](std::int32_t v) { return v >= 0 && vertex_part_[at(v)] >= 0; });
      for (const std::int32_t v : ends) {
        if (held && v >= 0) beside_[at(v)] = 1;
      }
    }
  }
  for (int ring = 0; ring < free_rings; ++ring) {
    const Vector<std::uint8_t> inside(beside_, &memory_);
    for (std::size_t v = 0; v < size; ++v) {
      for (Index k = core_.topology().neighbour_start[v]; k < core_.topology().neighbour_start[v + 1]; ++k)
        beside_[v] |= inside[at(core_.topology().neighbour[at(k)])];
    }
  }
}

void MovedParts::find_chest() {
  const skeleton::Character& character = known_.character;
  chest_.assign(known_.parents.size(), 0);
  if (!(character.trunk > upright_trunk)) return;
  for (std::size_t j = 0; j < chest_.size(); ++j) {
    if (character.roles[j] != skeleton::Role::head) continue;
    std::int32_t above = static_cast<std::int32_t>(j);
    while (above >= 0 &&
           (character.roles[at(above)] == skeleton::Role::head || character.roles[at(above)] == skeleton::Role::neck))
      above = character.carriers[at(above)];
    if (above >= 0 && character.roles[at(above)] == skeleton::Role::spine) chest_[at(above)] = 1;
  }
  for (std::size_t j = 0; j < chest_.size(); ++j) {
    const std::int32_t carrier = character.carriers[j];
    if (character.roles[j] == skeleton::Role::shoulder && carrier >= 0 && chest_[at(carrier)] == 1) chest_[j] = 2;
  }
}

void MovedParts::find_head_base() {
  if (!core_.geometry->links) return;
  const mesh::Links& links = *core_.geometry->links;
  const auto in_head = [&](std::int32_t v) {
    return vertex_part_[at(v)] >= 0 && part_role_[at(vertex_part_[at(v)])] == skeleton::Role::head;
  };
  // pieces with vertices in a head and others: their edges draw out
  Vector<std::uint8_t> within(links.light.size(), 0, &memory_);
  for (std::size_t v = 0; v < links.piece.size(); ++v)
    within[at(links.piece[v])] |= in_head(static_cast<std::int32_t>(v)) ? 1 : 2;
  double count = 0;
  bool others = false;
  for (const mesh::Link& link : links.links) {
    const std::int32_t other = *std::max_element(link.corner, link.corner + 3);
    for (const auto& [from, to] : {std::pair(link.vertex, other), std::pair(other, link.vertex)}) {
      if (!in_head(from) || in_head(to) || links.light[at(links.piece[at(to)])]) continue;
      if (within[at(links.piece[at(from)])] == 1 && is_chest(to)) {
        head_base_ = head_base_ + core_.mesh.positions[at(to)];
        ++count;
      } else {
        others = true;
      }
    }
  }
  for (std::size_t v = 0; v < links.piece.size(); ++v)
    others = others || (in_head(static_cast<std::int32_t>(v)) && within[at(links.piece[v])] != 1);
  head_on_chest_ = count > 0 && !others;
  if (head_on_chest_) head_base_ = (1 / count) * head_base_;
}

bool MovedParts::is_in_trunk(std::int32_t vertex) const noexcept {
  double all = 0, own = 0;
  for_joints(vertex, [&](std::uint32_t j, double weight) {
    all += weight;
    if (known_.character.roles[j] == skeleton::Role::spine) own += weight;
  });
  return 2 * own > all;
}

bool MovedParts::is_chest(std::int32_t vertex) const noexcept {
  double all = 0, own = 0;
  for_joints(vertex, [&](std::uint32_t j, double weight) {
    all += weight;
    if (chest_[j]) own += weight;
  });
  return 2 * own > all;
}

std::uint32_t MovedParts::joint_of(Span<const std::int32_t> region) {
  if (known_.input.vertex_count == 0) return no_joint;
  moved_.assign(order_.size(), 0.0);
  double all = 0;
  for (const std::int32_t v : region) {
    for_joints(v, [&](std::uint32_t j, double weight) {
      moved_[j] += weight;
      all += weight;
    });
  }
  for (std::size_t k = order_.size(); k-- > 0;) {
    const std::int32_t parent = known_.parents[order_[k]];
    if (parent >= 0) moved_[at(parent)] += moved_[order_[k]];
  }
  std::uint32_t lowest = no_joint;
  for (const std::uint32_t j : order_) {
    if (moved_[j] > 0.5 * all) lowest = j;
  }
  return lowest;
}

std::int32_t MovedParts::add_trunk(Span<const std::int32_t> vertices) {
  const std::int32_t part = static_cast<std::int32_t>(part_count());
  const std::uint32_t joint = joint_of(vertices);
  part_joint_.push_back(joint == no_joint ? order_.front() : joint);
  part_role_.push_back(skeleton::Role::spine);
  for (const std::int32_t v : vertices) vertex_part_[at(v)] = part;
  vertex_.insert(vertex_.end(), vertices.begin(), vertices.end());
  start_.push_back(static_cast<std::int32_t>(vertex_.size()));
  return part;
}

BodyRole MovedParts::main_role_of(Span<const std::int32_t> region) const noexcept {
  double share[skeleton::role_count][3] = {};
  BodyRole best;
  for (const std::int32_t v : region) {
    for_joints(v, [&](std::uint32_t j, double weight) {
      share[static_cast<std::size_t>(role_[j])][static_cast<std::size_t>(side_[j])] += weight;
    });
  }
  double most = 0;
  for (std::size_t role = 0; role < skeleton::role_count; ++role) {
    for (std::size_t side = 0; side < 3; ++side) {
      if (share[role][side] <= most) continue;
      most = share[role][side];
      best = {static_cast<skeleton::Role>(role), static_cast<skeleton::Side>(side)};
    }
  }
  return best;
}

bool MovedParts::hangs_free(skeleton::Role role, bool stands) const noexcept {
  switch (role) {
    case skeleton::Role::other:
    case skeleton::Role::spine:
    case skeleton::Role::neck:
    case skeleton::Role::shoulder:
    case skeleton::Role::leg:
    case skeleton::Role::foot:
    case skeleton::Role::toe:
      return false;
    case skeleton::Role::arm:
    case skeleton::Role::hand:
    case skeleton::Role::finger:
      return !stands || known_.character.trunk > upright_trunk;
    default:
      return true;
  }
}

bool MovedParts::is_unmoved(Span<const std::int32_t> region) const noexcept {
  const auto count = std::count_if(region.begin(), region.end(), [&](std::int32_t v) { return unmoved_[at(v)] != 0; });
  return 2 * static_cast<std::size_t>(count) > region.size();
}

// The majority vote of Boyer and Moore, and a count of the winner.
std::int32_t MovedParts::part_of(Span<const std::int32_t> region) const {
  std::int32_t part = -1;
  std::size_t lead = 0;
  for (const std::int32_t v : region) {
    if (lead == 0) part = vertex_part_[at(v)];
    lead = vertex_part_[at(v)] == part ? lead + 1 : lead - 1;
  }
  const auto count =
      std::count_if(region.begin(), region.end(), [&](std::int32_t v) { return vertex_part_[at(v)] == part; });
  return 2 * static_cast<std::size_t>(count) > region.size() ? part : -1;
}

}  // namespace hf_inner::deform
