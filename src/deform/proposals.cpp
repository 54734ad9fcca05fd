#include "deform/proposals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "deform/constants.h"
#include "deform/handles.h"
#include "deform/trunk.h"
#include "field/extremities.h"
#include "field/peaks.h"

namespace hf_inner {
namespace {

constexpr std::uint32_t no_joint = 0xffffffffu;

// A place that may become a proposal. All lengths are in the unit of the inner mesh, whose box diagonal is 1.
struct Candidate {
  Index vertex = 0;
  HandleReason reason = HandleReason::tip;
  bool pinned = false;
  bool second = false;  // the end of a component that is nearer to its middle; both ends have one length
  std::uint32_t joint = no_joint;
  Vec3 position;
  double radius = 0, length = 0;
};

double distance(Vec3 a, Vec3 b) noexcept { return norm(a - b); }

class Proposer {
 public:
  Proposer(const Core& core, const ProposalOptions& options)
      : core_(core), mesh_(core.mesh), options_(options), memory_(*core.memory), found_(&memory_), height_(&memory_) {}

  Vector<HandleProposal> run() {
    constexpr float tips_found = 0.8f;  // reported progress, by the usual share of time
    Extremities tips = [&] {
      const ProgressRange range(0.0f, tips_found);
      return poisson_extremities(core_, options_.least_length_share);
    }();
    find_feet();
    add_tips(tips);
    add_ends();
    add_trunk(tips);
    add_joints();
    Vector<HandleProposal> out = choose();
    report(1.0f);
    return out;
  }

 private:
  // ---- feet ----

  void find_feet() {
    height_.resize(at(core_.size()));
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t v = 0; v < height_.size(); ++v) {
      height_[v] = dot(options_.up, mesh_.positions[v]);
      lowest = std::min(lowest, height_[v]);
      highest = std::max(highest, height_[v]);
    }
    ground_ = lowest;
    tall_ = highest - lowest;
    if (tall_ < least_tall) return;
    Vector<double> top(at(mesh_.component_count()), lowest, &memory_);
    Vector<double> depth(height_.size(), &memory_);
    for (std::size_t v = 0; v < height_.size(); ++v) {
      double& highest_of = top[at(mesh_.component[v])];
      highest_of = std::max(highest_of, height_[v]);
      depth[v] = -height_[v];
    }
    for (const Peak& peak : find_peaks(core_.topology, depth, memory_)) {
      const double low = height_[at(peak.vertex)];
      // a component that stands on the ground, a shoe for example, needs no leg
      const bool whole = peak.saddle == Mesh::none;
      const double saddle = whole ? top[at(mesh_.component[at(peak.vertex)])] : height_[at(peak.saddle)];
      if (low - ground_ > ground_share * tall_ || saddle - low < (whole ? shoe_share : leg_share) * tall_) continue;
      found_.push_back(foot_at(peak.vertex, saddle - low));
    }
  }

  // The sole is what is edge-connected to the minimum and nearly as low. Its middle does not depend on which of many
  // equally low vertices is the minimum.
  Candidate foot_at(Index lowest, double leg) {
    const double level = height_[at(lowest)] + sole_share * tall_;
    Vector<Index> sole(&memory_);
    Vector<std::uint8_t> seen(height_.size(), 0, &memory_);
    sole.push_back(lowest);
    seen[at(lowest)] = 1;
    for (std::size_t i = 0; i < sole.size(); ++i) {
      const Index v = sole[i];
      for (Index k = core_.topology.neighbour_start[at(v)]; k < core_.topology.neighbour_start[at(v) + 1]; ++k) {
        const Index u = core_.topology.neighbour[at(k)];
        if (seen[at(u)] || height_[at(u)] > level) continue;
        sole.push_back(u);
        seen[at(u)] = 1;
      }
    }
    std::sort(sole.begin(), sole.end());
    Vec3 sum, plain;
    double area = 0;
    for (const Index v : sole) {
      sum = sum + core_.areas[at(v)] * mesh_.positions[at(v)];
      area += core_.areas[at(v)];
      plain = plain + mesh_.positions[at(v)];
    }
    const Vec3 middle = area > 0 ? (1 / area) * sum : (1 / static_cast<double>(sole.size())) * plain;
    Candidate out;
    out.vertex = nearest_of(sole, middle);
    out.position = mesh_.positions[at(out.vertex)];
    double farthest = 0;
    for (const Index v : sole) farthest = std::max(farthest, distance(mesh_.positions[at(v)], out.position));
    out.reason = HandleReason::foot;
    out.pinned = true;
    out.radius = std::min(std::max(sole_margin * farthest, least_radius), most_sole_radius);
    out.length = leg;
    return out;
  }

  Index nearest_of(Span<const Index> list, Vec3 point) const {
    Index best = list[0];
    double least = std::numeric_limits<double>::infinity();
    for (const Index v : list) {
      const double d = distance(mesh_.positions[at(v)], point);
      if (d < least) {
        least = d;
        best = v;
      }
    }
    return best;
  }

  // ---- tips, ends, joints, the middle ----

  void add_tips(const Extremities& tips) {
    const std::size_t feet = found_.size();
    for (const Extremity& tip : tips.points) {
      const Vec3 p = mesh_.positions[at(tip.vertex)];
      const bool low = height_[at(tip.vertex)] - ground_ <= low_tip_share * tall_;
      bool taken = false;
      for (std::size_t f = 0; f < feet && !taken; ++f) {
        taken = low && distance(found_[f].position, p) <= foot_reach;
      }
      if (taken) continue;
      Candidate out;
      out.vertex = tip.vertex;
      out.position = p;
      out.length = tip.length;
      out.radius = std::min(std::max(tip_share * tip.length, least_radius), most_tip_radius);
      found_.push_back(out);
    }
  }

  // A component without a tip or foot: the vertex farthest from its middle, and the vertex farthest from that.
  void add_ends() {
    const std::size_t components = at(mesh_.component_count());
    Vector<std::uint8_t> has(components, 0, &memory_);
    for (const Candidate& candidate : found_) has[at(mesh_.component[at(candidate.vertex)])] = 1;
    Vector<Vec3> from(components, &memory_);
    Vector<double> count(components, 0.0, &memory_);
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      const std::size_t c = at(mesh_.component[v]);
      from[c] = from[c] + mesh_.positions[v];
      count[c] += 1;
    }
    for (std::size_t c = 0; c < components; ++c) from[c] = (1 / count[c]) * from[c];
    Vector<Index> first(components, 0, &memory_), second(components, 0, &memory_);
    farthest(from, first);
    for (std::size_t c = 0; c < components; ++c) from[c] = mesh_.positions[at(first[c])];
    farthest(from, second);
    for (std::size_t c = 0; c < components; ++c) {
      const double size = distance(from[c], mesh_.positions[at(second[c])]);
      if (has[c] || size < least_piece) continue;
      for (const Index v : {first[c], second[c]}) {
        Candidate out;
        out.vertex = v;
        out.position = mesh_.positions[at(v)];
        out.reason = HandleReason::end;
        out.second = v != first[c];
        out.length = size / 2;
        out.radius = std::min(std::max(tip_share * out.length, least_radius), most_tip_radius);
        found_.push_back(out);
      }
    }
  }

  void farthest(const Vector<Vec3>& from, Vector<Index>& out) const {
    Vector<double> most(out.size(), -1.0, &memory_);
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      const std::size_t c = at(mesh_.component[v]);
      const double d = distance(mesh_.positions[v], from[c]);
      if (d > most[c]) {
        most[c] = d;
        out[c] = static_cast<Index>(v);
      }
    }
  }

  // End joints name the proposals near them, and the first joint in the trunk names the trunk. Those without one, and
  // joints where the skeleton branches, are proposed.
  // Their place is the joint itself, so that the region goes around the limb.
  void add_joints() {
    const std::size_t count = options_.parents.size();
    if (count == 0) return;
    Vector<std::uint32_t> children(count, 0, &memory_);
    for (const std::uint32_t parent : options_.parents) {
      if (parent != no_joint) ++children[parent];
    }
    for (const std::uint32_t joint : joint_order()) {
      const std::size_t j = at(joint);
      if (children[j] == 1) continue;
      const Vec3 place = joint_place(joint);
      const bool end = children[j] == 0;
      Candidate* near = nullptr;
      double least = end ? joint_reach : least_radius;
      for (Candidate& candidate : found_) {
        const double d = distance(candidate.position, place);
        // joints inside the trunk belong to it
        if (candidate.reason == HandleReason::middle && d <= candidate.radius)
          least = std::max(least, candidate.radius);
        if (d <= least) {
          least = d;
          near = &candidate;
        }
      }
      if (near) {
        if ((end || near->reason == HandleReason::middle) && near->joint == no_joint) near->joint = joint;
        continue;
      }
      add_joint(joint, place);
    }
  }

  Vec3 joint_place(std::uint32_t joint) const {
    const double* p = options_.joints.data() + 3 * at(joint);
    return mesh_.to_inner({p[0], p[1], p[2]});
  }

  // The joints from the roots outwards, of one depth the longest bone first. Of two joints at one place the first is
  // proposed, so the order must not be that of the list.
  Vector<std::uint32_t> joint_order() const {
    const std::size_t count = options_.parents.size();
    Vector<std::uint32_t> order(count, 0, &memory_), depth(count, 0, &memory_), path(&memory_);
    Vector<double> bone(count, 0.0, &memory_);
    for (std::uint32_t j = 0; j < count; ++j) {
      order[j] = j;
      const std::uint32_t parent = options_.parents[j];
      if (parent != no_joint) bone[j] = distance(joint_place(j), joint_place(parent));
      // up to a joint whose depth is known; a circle of parents ends where it began
      path.clear();
      for (std::uint32_t at_joint = j; at_joint != no_joint && depth[at_joint] == 0;
           at_joint = options_.parents[at_joint]) {
        depth[at_joint] = 1;
        path.push_back(at_joint);
      }
      const std::uint32_t above = options_.parents[path.empty() ? j : path.back()];
      std::uint32_t reached = above == no_joint ? 0 : depth[above];
      for (std::size_t k = path.size(); k-- > 0;) depth[path[k]] = ++reached;
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (depth[a] != depth[b]) return depth[a] < depth[b];
      return bone[a] != bone[b] ? bone[a] > bone[b] : a < b;
    });
    return order;
  }

  Index nearest_vertex(Vec3 place) const {
    Index vertex = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      const double d = distance(mesh_.positions[v], place);
      if (d < least) {
        least = d;
        vertex = static_cast<Index>(v);
      }
    }
    return vertex;
  }

  void add_joint(std::uint32_t joint, Vec3 place) {
    const Index vertex = nearest_vertex(place);
    const double depth = distance(mesh_.positions[at(vertex)], place);
    if (depth > joint_reach) return;  // a helper away from the surface
    Candidate out;
    out.vertex = vertex;
    out.position = place;
    out.reason = HandleReason::joint;
    out.joint = joint;
    out.radius = std::max(around_joint * depth, least_radius);
    out.length = depth;
    found_.push_back(out);
  }

  double area_near(Vec3 place, double radius) const {
    double area = 0;
    for (const Index v : region_near(core_, place, radius, memory_)) area += core_.areas[at(v)];
    return area;
  }

  // The trunk holds, so that a pulled hand does not take the body along. The region goes around, also where a part
  // inside the body is the nearest.
  void add_trunk(const Extremities& tips) {
    const Trunk trunk = find_trunk(core_, tips, height_);
    if (!trunk.found) return;
    Candidate out;
    out.position = trunk.middle;
    out.vertex = nearest_vertex(out.position);
    double depth = distance(mesh_.positions[at(out.vertex)], out.position);
    if (depth > most_depth) {
      out.position = mesh_.positions[at(out.vertex)];
      depth = 0;
    }
    out.radius = std::max(around_joint * depth, least_trunk_radius);
    while (out.radius * radius_growth <= most_radius &&
           area_near(out.position, out.radius) < held_trunk_share * trunk.area)
      out.radius *= radius_growth;
    out.reason = HandleReason::middle;
    out.pinned = true;
    found_.push_back(out);
  }

  // ---- the list ----

  Vector<HandleProposal> choose() {
    std::sort(found_.begin(), found_.end(), [](const Candidate& a, const Candidate& b) {
      if (a.pinned != b.pinned) return a.pinned;
      if (a.length != b.length) return a.length > b.length;
      if (a.second != b.second) return b.second;
      if (a.vertex != b.vertex) return a.vertex < b.vertex;
      return a.reason != b.reason ? a.reason < b.reason : a.joint < b.joint;
    });
    Vector<std::uint8_t> owned(mesh_.positions.size(), 0, &memory_);
    Vector<HandleProposal> out(&memory_);
    for (const Candidate& candidate : found_) {
      if (out.size() == options_.limit) break;
      HandleProposal proposal;
      proposal.reason = candidate.reason;
      proposal.pinned = candidate.pinned;
      proposal.joint = candidate.joint;
      proposal.vertex = candidate.vertex;
      proposal.length = mesh_.scale * candidate.length;
      proposal.position = mesh_.to_given(candidate.position);
      if (claim(candidate.radius, owned, proposal)) out.push_back(proposal);
      poll();
    }
    return out;
  }

  // Finds a radius whose region has some vertices and overlaps no other. The region is computed from the numbers that
  // the caller gets, so that handles made of them have the same one.
  bool claim(double radius, Vector<std::uint8_t>& owned, HandleProposal& proposal) const {
    const Vec3 place = mesh_.to_inner(proposal.position);
    bool shrunk = false;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      proposal.radius = mesh_.scale * radius;
      const double own = proposal.radius / mesh_.scale;
      const Vector<Index> region = region_near(core_, place, own, memory_);
      const bool overlaps = std::any_of(region.begin(), region.end(), [&](Index v) { return owned[at(v)] != 0; });
      if (shrunk && is_spike(region, own)) return false;
      if (!overlaps && (shrunk || region.size() >= least_region || radius * radius_growth > most_radius)) {
        for (const Index v : region) owned[at(v)] = 1;
        return true;
      }
      if (overlaps && region.size() == 1) return false;
      if (overlaps) shrunk = true;  // does not grow again
      radius = overlaps ? radius / radius_growth : radius * radius_growth;
    }
    return false;
  }

  const Core& core_;
  const Mesh& mesh_;
  const ProposalOptions& options_;
  Memory& memory_;
  Vector<Candidate> found_;
  Vector<double> height_;
  double ground_ = 0, tall_ = 0;
};

}  // namespace

Vector<HandleProposal> propose_handles(const Core& core, const ProposalOptions& options) {
  return Proposer(core, options).run();
}

}  // namespace hf_inner
