#include "deform/proposal_parts.h"

#include <algorithm>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "deform/constants.h"

namespace hf_inner::deform {
namespace {

constexpr std::int32_t nobody = -1;

bool is_hand(skeleton::Role role) noexcept {
  return role == skeleton::Role::arm || role == skeleton::Role::hand || role == skeleton::Role::finger;
}

// Roles of limbs that are dragged at their end.
bool ends_free(skeleton::Role role) noexcept {
  return role == skeleton::Role::tail || role == skeleton::Role::ear || role == skeleton::Role::wing ||
         role == skeleton::Role::antenna || role == skeleton::Role::fin;
}

// The region that a candidate gets where no other is near.
Vector<std::int32_t> region_of(RegionSearch& search, const Candidate& candidate) {
  double radius = candidate.radius;
  for (;;) {
    Vector<std::int32_t> region = search.from(candidate.vertex, candidate.position, radius);
    radius *= radius_growth;
    if (region.size() >= least_region || radius > most_radius) return region;
  }
}

// A candidate for a part on which none was found. Its place is the middle of the part.
Candidate part_candidate(const surface::Core& core, Span<const std::int32_t> vertices) {
  const SharedVector<Vec3>& positions = core.mesh.positions;
  Vec3 sum;
  for (const std::int32_t v : vertices) sum = sum + positions[at(v)];
  Candidate out;
  out.position = (1.0 / static_cast<double>(vertices.size())) * sum;
  out.reason = HandleReason::joint;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t v : vertices) {
    const double d = norm(positions[at(v)] - out.position);
    out.length = std::max(out.length, d);
    if (d >= least) continue;
    least = d;
    out.vertex = v;
  }
  return out;
}

class Chooser {
 public:
  Chooser(RegionSearch& search, const Vector<Candidate>& found, MovedParts* parts)
      : search_(search),
        core_(search.core()),
        mesh_(core_.mesh),
        memory_(*core_.memory),
        found_(found),
        parts_(parts),
        owner_(&memory_) {}

  Proposals run(std::size_t limit) {
    owner_.assign(mesh_.positions.size(), nobody);
    // others make room for whole parts
    for (std::size_t k = 0; k < found_.size(); ++k) {
      if (found_[k].part < 0) continue;
      for (const std::int32_t v : part(found_[k])) owner_[at(v)] = static_cast<std::int32_t>(k);
    }
    Proposals out(&memory_);
    Vector<std::int32_t> number(found_.size(), nobody, &memory_);
    for (std::size_t k = 0; k < found_.size() && out.list.size() < limit; ++k) {
      HandleProposal proposal;
      if (found_[k].part < 0 ? claim(k, proposal) : fit(k, proposal)) {
        number[k] = static_cast<std::int32_t>(out.list.size());
        out.list.push_back(proposal);
      }
      poll();
    }
    out.region.resize(owner_.size());
    for (std::size_t v = 0; v < owner_.size(); ++v) out.region[v] = owner_[v] < 0 ? nobody : number[at(owner_[v])];
    return out;
  }

 private:
  Span<const std::int32_t> part(const Candidate& candidate) const { return parts_->vertices_of(at(candidate.part)); }

  void describe(const Candidate& candidate, Span<const std::int32_t> region, HandleProposal& out) const {
    out.reason = candidate.reason;
    out.pinned = candidate.pinned;
    out.joint = candidate.joint;
    out.vertex = candidate.vertex;
    out.length = mesh_.scale * candidate.length;
    out.following = candidate.pinned ? 1 : tip_following;
    if (!parts_) return;
    const bool whole = candidate.part >= 0;
    const std::uint32_t joint = whole ? parts_->joint_of_part(at(candidate.part)) : parts_->joint_of(region);
    if (joint != no_joint) out.joint = joint;
    const BodyRole own = whole               ? parts_->role_of_part(at(candidate.part))
                         : joint != no_joint ? parts_->main_role_of(region)
                                             : parts_->role_of(out.joint);
    out.role = own.role;
    out.side = own.side;
  }

  // Finds a radius whose region has some vertices and overlaps no other. The region is computed from the numbers that
  // the caller gets, so that handles made of them have the same one.
  bool claim(std::size_t k, HandleProposal& proposal) {
    proposal.position = mesh_.to_given(found_[k].position);
    const Vec3 place = mesh_.to_inner(proposal.position);
    double radius = found_[k].radius;
    bool shrunk = false;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      proposal.radius = mesh_.scale * radius;
      const double own = proposal.radius / mesh_.scale;
      const Vector<std::int32_t> region = search_.near(place, own);
      const bool overlaps =
          std::any_of(region.begin(), region.end(), [&](std::int32_t v) { return owner_[at(v)] >= 0; });
      if (shrunk && is_spike(region, own)) return false;
      if (!overlaps && (shrunk || region.size() >= least_region || radius * radius_growth > most_radius)) {
        for (const std::int32_t v : region) owner_[at(v)] = static_cast<std::int32_t>(k);
        describe(found_[k], region, proposal);
        return true;
      }
      if (overlaps && region.size() == 1) return false;
      if (overlaps) shrunk = true;  // does not grow again
      radius = overlaps ? radius / radius_growth : radius * radius_growth;
    }
    return false;
  }

  // Finds a place and a radius whose region is a piece of the part: in the middle, or where that makes a spike, far
  // from the rim of the part.
  bool fit(std::size_t k, HandleProposal& proposal) {
    const Candidate middle = part_candidate(core_, part(found_[k]));
    const bool inside = owner_[at(vertex_near(core_, middle.position))] == static_cast<std::int32_t>(k);
    // a caller gives the place back in the unit of the mesh
    const auto given_back = [&](Vec3 p) { return mesh_.to_inner(mesh_.to_given(p)); };
    const Vec3 place = given_back(inside ? middle.position : mesh_.positions[at(middle.vertex)]);
    const Vec3 deep = given_back(mesh_.positions[at(deepest(k))]);
    double radius = radius_within(k, place, middle.length), deep_radius = 0;
    if (is_spike(search_.near(place, radius), radius)) deep_radius = radius_within(k, deep, middle.length);
    const bool deeper = deep_radius > radius;
    if (deeper) radius = deep_radius;
    if (!(radius > 0)) return false;  // other layers of the surface are at the same place
    proposal.position = mesh_.to_given(deeper ? deep : place);
    proposal.radius = mesh_.scale * radius;
    describe(found_[k], part(found_[k]), proposal);
    proposal.vertex = vertex_near(core_, mesh_.to_inner(proposal.position));
    return true;
  }

  // The largest radius of some, from `radius` down, whose region is of candidate k alone; 0: none.
  double radius_within(std::size_t k, Vec3 place, double radius) {
    const auto is_own = [&](std::int32_t v) { return owner_[at(v)] == static_cast<std::int32_t>(k); };
    for (int attempt = 0; attempt < most_attempts; ++attempt, radius /= radius_growth) {
      const double given_back = mesh_.scale * radius / mesh_.scale;
      const Vector<std::int32_t> region = search_.near(place, given_back);
      if (std::all_of(region.begin(), region.end(), is_own)) return given_back;
    }
    return 0;
  }

  // The vertex of a part with the most edges between it and the others.
  std::int32_t deepest(std::size_t k) const {
    const mesh::Topology& topology = core_.topology();
    const Span<const std::int32_t> own = part(found_[k]);
    Vector<std::uint8_t> seen(owner_.size(), 0, &memory_);
    Vector<std::int32_t> reached(&memory_);
    const auto for_neighbours = [&](std::int32_t v, auto&& use) {
      for (std::int32_t i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i)
        use(topology.neighbour[at(i)]);
    };
    for (const std::int32_t v : own) {
      bool rim = false;
      for_neighbours(v, [&](std::int32_t u) { rim = rim || owner_[at(u)] != static_cast<std::int32_t>(k); });
      if (!rim) continue;
      seen[at(v)] = 1;
      reached.push_back(v);
    }
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for_neighbours(reached[i], [&](std::int32_t u) {
        if (seen[at(u)] || owner_[at(u)] != static_cast<std::int32_t>(k)) return;
        seen[at(u)] = 1;
        reached.push_back(u);
      });
    }
    return reached.empty() ? own[0] : reached.back();
  }

  RegionSearch& search_;
  const surface::Core& core_;
  const mesh::Mesh& mesh_;
  Memory& memory_;
  const Vector<Candidate>& found_;
  MovedParts* const parts_;
  Vector<std::int32_t> owner_;  // by inner vertex: its candidate, or none
};

}  // namespace

void leave_out_unmoved(RegionSearch& search, const MovedParts& parts, Vector<Candidate>& found) {
  if (!parts.has_unmoved()) return;
  const auto unmoved = [&](const Candidate& candidate) {
    poll();
    return parts.is_unmoved(region_of(search, candidate));
  };
  found.erase(std::remove_if(found.begin(), found.end(), unmoved), found.end());
}

void let_free(RegionSearch& search, const MovedParts& parts, Vector<Candidate>& found) {
  Vector<std::size_t> freed(search.core().memory.get());
  bool held = false, legs = false;
  const auto is_leg = [](skeleton::Role role) {
    return role == skeleton::Role::leg || role == skeleton::Role::foot || role == skeleton::Role::toe;
  };
  Vector<skeleton::Role> role(found.size(), skeleton::Role::other, search.core().memory.get());
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k].pinned) continue;
    poll();
    role[k] = found[k].part < 0 ? parts.main_role_of(region_of(search, found[k])).role
                                : parts.role_of_part(at(found[k].part)).role;
    legs = legs || (found[k].reason == HandleReason::foot && is_leg(role[k]));
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!found[k].pinned) continue;
    const bool foot = found[k].reason == HandleReason::foot;
    if (parts.hangs_free(role[k], foot) || (foot && legs && !is_leg(role[k]) && !is_hand(role[k]))) {
      freed.push_back(k);
    } else {
      held = true;
    }
  }
  if (!held) return;
  for (const std::size_t k : freed) {
    found[k].pinned = false;
    if (found[k].reason == HandleReason::foot) found[k].reason = HandleReason::tip;
  }
}

void take_parts(RegionSearch& search, MovedParts& parts, Span<const double> height, double low,
                Vector<Candidate>& found) {
  std::sort(found.begin(), found.end(), comes_first);
  Vector<std::uint8_t> taken(parts.part_count(), 0, search.core().memory.get());
  Vector<Candidate> out(search.core().memory.get());
  const auto take = [&](Candidate candidate, std::int32_t part) {
    const Span<const std::int32_t> vertices = parts.vertices_of(at(part));
    candidate.part = part;
    taken[at(part)] = 1;
    const bool is_low =
        std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t v) { return height[at(v)] <= low; });
    if (parts.role_of_part(at(part)).role == skeleton::Role::foot && is_low) {
      candidate.pinned = true;
      candidate.reason = HandleReason::foot;
    }
    out.push_back(candidate);
  };
  for (const Candidate& candidate : found) {
    if (candidate.reason == HandleReason::middle && candidate.part >= 0) taken[at(candidate.part)] = 1;
  }
  for (const Candidate& candidate : found) {
    poll();
    if (candidate.reason == HandleReason::middle) {
      out.push_back(candidate);
      continue;
    }
    const Vector<std::int32_t> region = region_of(search, candidate);
    const std::uint32_t joint = parts.joint_of(region);
    std::int32_t part = parts.part_of(region);
    // what a head moves beside the skull goes along with it
    if (part < 0 && joint != no_joint) part = parts.part_of_joint(joint);
    if (part >= 0 && parts.vertices_of(at(part)).size() >= least_part) {
      if (!taken[at(part)]) take(candidate, part);
      continue;
    }
    out.push_back(candidate);
    if (!parts.has_foot(parts.chain_of(joint)) || candidate.reason != HandleReason::foot) continue;
    out.back().pinned = false;  // a shin above a foot
    out.back().reason = HandleReason::tip;
  }
  for (std::size_t p = 0; p < taken.size(); ++p) {
    const Span<const std::int32_t> vertices = parts.vertices_of(p);
    if (!taken[p] && vertices.size() >= least_part)
      take(part_candidate(search.core(), vertices), static_cast<std::int32_t>(p));
  }
  found = std::move(out);
}

void leave_one_each(RegionSearch& search, const skeleton::KnownSkeleton& known, MovedParts& parts,
                    Vector<Candidate>& found) {
  const skeleton::Character& character = known.character;
  Vector<std::uint32_t> rank(character.kinds.size(), 0, search.core().memory.get());  // of a joint in its chain
  for (const skeleton::Chain& chain : character.chains) {
    for (std::uint32_t k = 0; k < chain.count; ++k) rank[character.chain_joints[chain.first + k]] = k + 1;
  }
  std::sort(found.begin(), found.end(), comes_first);
  Vector<std::size_t> best(character.chains.size(), found.size(), search.core().memory.get());
  Vector<std::uint32_t> farthest(character.chains.size(), 0, search.core().memory.get());
  Vector<std::uint8_t> dropped(found.size(), 0, search.core().memory.get());
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].part >= 0 || found[k].pinned) continue;
    poll();
    const std::uint32_t joint = parts.joint_of(region_of(search, found[k]));
    const std::int32_t c = parts.chain_of(joint);
    if (c < 0 || !ends_free(character.chains[at(c)].role)) continue;
    if (best[at(c)] < found.size()) dropped[rank[joint] > farthest[at(c)] ? best[at(c)] : k] = 1;
    if (best[at(c)] < found.size() && rank[joint] <= farthest[at(c)]) continue;
    best[at(c)] = k;
    farthest[at(c)] = rank[joint];
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!dropped[k]) found[kept++] = found[k];
  }
  found.resize(kept);
}

Proposals choose_regions(RegionSearch& search, const Vector<Candidate>& found, MovedParts* parts, std::size_t limit) {
  return Chooser(search, found, parts).run(limit);
}

}  // namespace hf_inner::deform
