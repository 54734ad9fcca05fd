// Keeps the target above the ground: the regions that stand or touch, and the rest of the surface.
//
// The ground is the height of the lowest point of the rest shape. A target may sink as deep as its source, scaled.
// Regions are held while the translations are solved (hold_regions). Three rules lift the rest of the surface:
// - A lying source touches the ground with clusters that are far above it at rest. The same clusters of the target
//   should touch: lie_down moves the goals of the anchored regions along up by the mean difference of their heights.
// - A body that has fallen over but does not lie yet is raised as a whole by the depth it sinks.
// - Each cluster that still sinks rises by its depth, and the clusters near it in the space of the fields by a part of
//   it, so that a limb bends up. Thin parts may sink (transfer_sinking.cpp).
// All three come in continuously: no rule switches, and no vertex is chosen. A frame in which no part lies or sinks
// only costs one pass over the heights.
#include <cmath>

#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner {
// Constrains (holds) the regions that stand, touch or would sink, and those that the caller places. share: how far the
// frame is a rigid motion, or the body has fallen over. At share 1 only the caller's constraints remain.
void Transfer::hold_regions(Prepared& p, double share) const {
  const Vec3 source_up = up_of(source_axes_), up = up_of(target_axes_);
  const bool by_itself = has_ground() && share < 1;
  p.holds.clear();
  for (std::size_t row = 0; row < p.given_hold.size(); ++row) {
    if (p.given_hold[row].share > 0) {
      p.holds.push_back(p.given_hold[row]);
      continue;
    }
    if (!by_itself || row == p.anchors.size()) continue;
    const bool anchored = row < p.anchors.size();
    const Prepared::Anchor& pair = anchored ? p.anchors[row] : p.loose[row - p.anchors.size() - 1];
    const double height = lowest(source_.region(pair.number), p.posed.data(), source_up) - p.source_ground;
    Hold hold;
    hold.row = row;
    if (pair.is_foot) {
      hold.goal = p.goals[row], hold.share = (1 - share) * (1 - smooth_step(stands, flies, p.scale * height));
      if (hold.share > 0) p.holds.push_back(hold);
      continue;
    }
    // `low` is the height of the region's lowest vertex over the region's mean, after the blended rotation.
    const Mat3 rotation = p.translations.mean_rotation(row, p.matrices.data());
    double low = no_height;
    for (const std::int32_t v : target_.region(pair.number))
      low = std::min(low, dot(up, rotation * (target_core_->mesh.positions[at(v)] - pair.target_rest)));
    const Vec3 now = p.translations.place(row, p.matrices.data(), p.shifts.data());
    const double at_height = dot(up, now) + low - p.target_ground;
    const double rest =
        lowest(source_.region(pair.number), source_core_->mesh.positions.data(), source_up) - p.source_ground;
    double wanted = at_height;
    if ((pair.flags & HF_PAIR_CONTACT) && rest > 0) {
      hold.share = (1 - share) * (1 - smooth_step(touches, leaves, std::max(height, 0.0) / rest));
      wanted = p.scale * height;
    }
    const double allowed = std::min(0.0, p.scale * height);
    const double depth = allowed - (at_height + hold.share * (wanted - at_height));
    if (depth > 0) {
      // The hold against sinking comes in with the depth. A contact that is held already only changes its goal.
      const double firm = (1 - share) * smooth_step(0, firm_depth, depth);
      wanted = wanted + (hold.share > firm ? firm / hold.share : 1.0) * (allowed - wanted);
      hold.share = std::max(hold.share, firm);
    }
    if (wanted == at_height || !(hold.share > least_hold)) continue;
    hold.goal = now + (wanted - at_height) * up, hold.vertical = true;
    p.holds.push_back(hold);
  }
  p.translations.hold({p.holds.data(), p.holds.size()}, up, p.matrices.data(), p.shifts.data());
}

// Returns how far the source lies, from 0 to 1. Also fills the scaled heights of the source's clusters.
double Transfer::lying_share(Prepared& p) const noexcept {
  const Vec3 up = up_of(source_axes_);
  p.source_low = no_height;
  std::fill(p.source_lows.begin(), p.source_lows.end(), no_height);
  for (std::size_t v = 0; v < p.posed.size(); ++v) {
    const double height = dot(p.posed[v], up);
    p.source_low = std::min(p.source_low, height);
    double& low = p.source_lows[at(p.source_owner[v])];
    low = std::min(low, height);
  }
  double touching = 0;
  for (std::size_t c = 0; c < p.source_lows.size(); ++c) {
    double& low = p.source_lows[c];
    low = p.scale * (low - p.source_ground);
    p.touch[c] = p.rest_lows[c] > flies ? p.clusters.mass[c] * (1 - smooth_step(stands, flies, low)) : 0.0;
    touching += p.touch[c];
  }
  return smooth_step(lies_low, lies_high, touching);
}

// Lowers or raises the goals of regions that follow their source (anchors). Then a cluster of the target's vertices
// touches the ground if the same cluster of the source does.
void Transfer::lie_down(Prepared& p, Vec3 centroid, double lies, double fallen, double share) const {
  const Vec3 up = up_of(target_axes_);
  blend(p);
  std::fill(p.target_lows.begin(), p.target_lows.end(), no_height);
  for (std::size_t v = 0; v < p.blended.size(); ++v) {
    double& low = p.target_lows[at(p.clusters.joint[v * blend_count])];
    low = std::min(low, dot(up, p.blended[v]));
  }
  double sum = 0, mass = 0;
  for (std::size_t c = 0; c < p.target_lows.size(); ++c) {
    if (!(p.touch[c] > 0) || p.target_lows[c] == no_height) continue;
    sum += p.touch[c] * (p.target_lows[c] - p.target_ground - p.source_lows[c]), mass += p.touch[c];
  }
  if (!(mass > 0)) return;
  for (std::size_t k = 0; k < p.anchors.size(); ++k)
    p.goals[k] = p.goals[k] - lies * (p.anchors[k].is_foot ? fallen : 1.0) * (sum / mass) * up;
  settle(p, centroid);
  hold_regions(p, share);
}

// Returns the height by which the whole body must rise so that it only just touches the ground: then the depth under
// the ground, summed over the area, is floating_volume. Newton's steps on a convex function of the height.
double Transfer::floating_height(Prepared& p, Vec3 up, double allowed) const noexcept {
  p.sunk.clear();
  for (std::size_t v = 0; v < p.blended.size(); ++v)
    if (allowed - dot(up, p.blended[v]) > 0) p.sunk.push_back(static_cast<std::int32_t>(v));
  double height = 0;
  for (std::int32_t step = 0; step < floating_steps; ++step) {
    double volume = 0, area = 0;
    for (const std::int32_t v : p.sunk) {
      const double sinks = p.sinks[at(p.clusters.joint[at(v) * blend_count])];
      const double depth = allowed - dot(up, p.blended[at(v)]) - height - sinks;
      if (depth <= 0) continue;
      const double share = target_area_[at(v)];
      volume += share * depth, area += share;
    }
    if (volume <= floating_volume) break;
    height += (volume - floating_volume) / area;
  }
  return height;
}

// Raises the clusters that sink by their depth, and the clusters near them by a part of it. The rise is a maximum of
// depths times constants, so it changes as fast as the depths do and no faster. Returns false if no part sinks.
bool Transfer::raise_sunk(Prepared& p, Vec3 up, double allowed, double share) const {
  const std::size_t count = p.depths.size();
  std::fill(p.depths.begin(), p.depths.end(), 0.0);
  std::fill(p.region_depths.begin(), p.region_depths.end(), 0.0);
  double deepest = 0;
  for (std::size_t v = 0; v < p.blended.size(); ++v) {
    double depth = allowed - dot(up, p.blended[v]);
    if (!(depth > 0)) continue;
    const std::int32_t row = p.rides[v];
    if (row >= 0 && p.given_hold[at(row)].share > 0) continue;  // the caller has placed this region
    const std::size_t cluster = at(p.clusters.joint[v * blend_count]);
    depth = std::max(0.0, depth - p.sinks[cluster]);
    p.depths[cluster] = std::max(p.depths[cluster], depth), deepest = std::max(deepest, depth);
    if (row >= 0) p.region_depths[at(row)] = std::max(p.region_depths[at(row)], depth);
  }
  if (!(deepest > least_depth)) return false;
  std::fill(p.rises.begin(), p.rises.end(), 0.0);
  for (std::size_t d = 0; d < count; ++d) {
    if (!(p.depths[d] > 0)) continue;
    for (std::size_t c = 0; c < count; ++c) p.rises[c] = std::max(p.rises[c], p.falloff[d * count + c] * p.depths[d]);
  }
  for (std::size_t c = 0; c < count; ++c) p.shifts[c] = p.shifts[c] + share * p.rises[c] * up;
  // Regions that do not sink are put back. One that sinks may rise, the more of it the deeper it sinks; a place of the
  // caller's never moves.
  for (Hold& hold : p.holds) {
    if (p.given_hold[hold.row].share > 0) continue;
    hold.share *= 1 - smooth_step(0, firm_depth, p.region_depths[hold.row]);
  }
  p.translations.hold({p.holds.data(), p.holds.size()}, up, p.matrices.data(), p.shifts.data());
  return true;
}

// Lifts all parts that would sink below the ground. share: 0 for a rigid motion of the whole source, which is copied
// unchanged, up to 1. fallen: how far the body has tilted over without lying on the ground, from 0 to 1.
void Transfer::keep_above_ground(Prepared& p, double share, double fallen) const {
  if (!(share > least_share)) return;
  const Vec3 up = up_of(target_axes_);
  const double allowed = p.target_ground + p.scale * std::min(0.0, p.source_low - p.source_ground);
  const double lift = share * fallen * floating_height(p, up, allowed);
  if (lift > 0) {
    for (Vec3& shift : p.shifts) shift = shift + lift * up;
    blend(p);
  }
  for (std::int32_t round = 0; round < sunk_rounds; ++round) {
    if (!raise_sunk(p, up, allowed, share)) return;
    blend(p);
  }
}

}  // namespace hf_inner
