#include "deform/proposals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "deform/constants.h"
#include "deform/handles.h"
#include "deform/proposal_joints.h"
#include "deform/proposal_parts.h"
#include "deform/trunk.h"
#include "field/extremities.h"
#include "field/peaks.h"

namespace hf_inner::deform {
namespace {

double distance(Vec3 a, Vec3 b) noexcept { return norm(a - b); }

class Proposer {
 public:
  Proposer(const surface::Core& core, const ProposalOptions& options)
      : core_(core),
        search_(core),
        mesh_(core.mesh),
        options_(options),
        memory_(*core.memory),
        found_(&memory_),
        height_(&memory_) {}

  Proposals run() {
    constexpr float tips_found = 0.8f;  // reported progress, by the usual share of time
    field::Extremities tips = [&] {
      const ProgressRange range(0.0f, tips_found);
      return field::poisson_extremities(core_, options_.least_length_share);
    }();
    find_feet();
    add_tips(tips);
    add_ends();
    add_trunk(find_trunk(core_, tips, height_));
    Proposals out = options_.skeleton ? follow(*options_.skeleton) : choose_plain();
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
    for (const field::Peak& peak : field::find_peaks(core_.topology(), depth, memory_)) {
      const double low = height_[at(peak.vertex)];
      // a component that stands on the ground, a shoe for example, needs no leg
      const bool whole = peak.saddle == mesh::Mesh::none;
      const double saddle = whole ? top[at(mesh_.component[at(peak.vertex)])] : height_[at(peak.saddle)];
      if (low - ground_ > ground_share * tall_ || saddle - low < (whole ? shoe_share : leg_share) * tall_) continue;
      found_.push_back(foot_at(peak.vertex, saddle - low));
    }
  }

  // The sole is the part that is edge-connected to the minimum and nearly as low. The handle is at the vertex nearest
  // to the middle of the sole. That vertex does not depend on which of many equally low vertices is the minimum.
  Candidate foot_at(Index lowest, double leg) {
    const double level = height_[at(lowest)] + sole_share * tall_;
    Vector<Index> sole(&memory_);
    Vector<std::uint8_t> seen(height_.size(), 0, &memory_);
    sole.push_back(lowest);
    seen[at(lowest)] = 1;
    for (std::size_t i = 0; i < sole.size(); ++i) {
      const Index v = sole[i];
      for (Index k = core_.topology().neighbour_start[at(v)]; k < core_.topology().neighbour_start[at(v) + 1]; ++k) {
        const Index u = core_.topology().neighbour[at(k)];
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

  void add_tips(const field::Extremities& tips) {
    const std::size_t feet = found_.size();
    for (const field::Extremity& tip : tips.points) {
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

  double area_near(Vec3 place, double radius) {
    double area = 0;
    for (const Index v : search_.near(place, radius)) area += core_.areas[at(v)];
    return area;
  }

  // The trunk holds, so that a pulled hand does not take the body along. The region goes around, also where a part
  // inside the body is the nearest.
  void add_trunk(const Trunk& trunk) {
    if (!trunk.found) return;
    Candidate out;
    out.position = trunk.middle;
    out.vertex = vertex_near(core_, out.position);
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

  // Pins the vertices near the middle of the trunk that the spine moves, and the chest of an upright body. If the
  // middle is on a thigh or a neck, it moves to the middle of the vertices that the spine moves. Where a head sits on
  // the chest without a neck, the far part of the trunk is pinned, so that a dragged head draws out the near part.
  void place_trunk(MovedParts& parts) {
    const auto middle = std::find_if(found_.begin(), found_.end(),
                                     [](const Candidate& other) { return other.reason == HandleReason::middle; });
    if (middle == found_.end()) return;
    Vector<std::uint8_t> spine(mesh_.positions.size(), 0, &memory_);
    for (std::size_t v = 0; v < spine.size(); ++v) spine[v] = parts.is_of_spine(static_cast<Index>(v));
    const Vec3* const head = parts.head_on_chest();
    if (head) {
      double far = 0;
      for (std::size_t v = 0; v < spine.size(); ++v) {
        if (spine[v] && parts.is_in_trunk(static_cast<Index>(v)))
          far = std::max(far, distance(mesh_.positions[v], *head));
      }
      for (std::size_t v = 0; v < spine.size(); ++v)
        spine[v] &=
            parts.is_in_trunk(static_cast<Index>(v)) && distance(mesh_.positions[v], *head) > neckless_share * far;
    }
    const auto near_middle = [&] {
      Vector<Index> out(&memory_);
      for (std::size_t v = 0; v < spine.size(); ++v) {
        if (spine[v] && distance(mesh_.positions[v], middle->position) <= middle->radius)
          out.push_back(static_cast<Index>(v));
      }
      return out;
    };
    Vector<Index> held = near_middle();
    const Vector<Index> around = search_.near(middle->position, middle->radius);
    if (parts.main_role_of(around).role != skeleton::Role::spine || held.size() < least_region) {
      const Trunk trunk = trunk_of(core_, spine, height_);
      if (!trunk.found) return;
      middle->position = trunk.middle;
      middle->radius = most_radius;
      held = near_middle();
    }
    if (held.size() < least_region) return;
    for (std::size_t v = 0; v < spine.size(); ++v) {
      if (head ? spine[v] != 0 : parts.is_of_chest(static_cast<Index>(v))) held.push_back(static_cast<Index>(v));
    }
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
    middle->part = parts.add_trunk(held);
  }

  // ---- the list ----

  Proposals choose_plain() {
    if (!options_.parents.empty()) add_joints(core_, joint_list(core_, options_.joints, options_.parents), found_);
    std::sort(found_.begin(), found_.end(), comes_first);
    return choose_regions(search_, found_, nullptr, options_.limit);
  }

  Proposals follow(const skeleton::KnownSkeleton& skeleton) {
    MovedParts parts(core_, skeleton);
    leave_out_unmoved(search_, parts, found_);
    if (parts.knows_roles()) {
      place_trunk(parts);
      let_free(search_, parts, found_);
      take_parts(search_, parts, height_, ground_ + ground_share * tall_, found_);
    }
    add_joints(core_, joint_list(core_, skeleton, parts), found_);
    if (parts.knows_roles()) leave_one_each(search_, skeleton, parts, found_);
    std::sort(found_.begin(), found_.end(), comes_first);
    return choose_regions(search_, found_, &parts, options_.limit);
  }

  const surface::Core& core_;
  RegionSearch search_;
  const mesh::Mesh& mesh_;
  const ProposalOptions& options_;
  Memory& memory_;
  Vector<Candidate> found_;
  Vector<double> height_;
  double ground_ = 0, tall_ = 0;
};

}  // namespace

Proposals propose_handles(const surface::Core& core, const ProposalOptions& options) {
  return Proposer(core, options).run();
}

}  // namespace hf_inner::deform
