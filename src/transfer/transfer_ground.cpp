// Keeps the target above the ground: the regions that stand or touch, and the rest of the surface.
//
// The ground is the height of the lowest point of the rest shape. Where feet are known it is under the feet: what hangs
// lower may sink (ground_height). A target may sink as deep as its source, scaled.
// Regions that stand or touch are held while the translations are solved (hold_regions). Two rules move the rest:
// - lie_down: a lying source touches the ground with clusters that are far above it at rest. The same clusters of the
//   target should touch. So the goals of the anchored regions move along up, by the mean difference of the heights.
// - raise_sunk: vertices under the ground are raised to it with the least work against the energies. So a limb bends
//   up, and no body is raised for its antlers.
// Both come in continuously: no rule switches, and no vertex is chosen. A frame without a part at or under the ground
// only costs one pass over the heights.
#include <cmath>

#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner::transfer {
// Constrains (holds) the regions that stand or touch, and those that the caller places. share: how far the
// frame is a rigid motion, or the body has fallen over. At share 1 only the caller's constraints remain, and feet that
// have not fallen over themselves.
void Transfer::hold_regions(Prepared& p, double rigid, double share) const {
  const Vec3 source_up = up_of(source_axes_), up = up_of(target_axes_);
  p.holds.clear();
  for (std::size_t row = 0; row < p.given_hold.size(); ++row) {
    if (p.given_hold[row].share > 0) {
      p.holds.push_back(p.given_hold[row]);
      continue;
    }
    if (!has_ground() || row == p.anchors.size()) continue;
    const bool anchored = row < p.anchors.size();
    const Prepared::Anchor& pair = anchored ? p.anchors[row] : p.loose[row - p.anchors.size() - 1];
    const double height = lowest(source_.region(pair.number), p.posed.data(), source_up) - p.source_ground;
    Hold hold;
    hold.row = row;
    if (pair.is_foot) {
      hold.goal = p.goals[row];
      hold.share = rigid + (1 - rigid) * (1 - pair.fallen) * (1 - smooth_step(stands, flies, p.scale * height));
      if (hold.share > 0) p.holds.push_back(hold);
      continue;
    }
    const double rest =
        lowest(source_.region(pair.number), source_core_->mesh.positions.data(), source_up) - p.source_ground;
    if (!(pair.flags & HF_PAIR_CONTACT) || !(rest > 0)) continue;
    hold.share = (1 - share) * (1 - smooth_step(touches, leaves, std::max(height, 0.0) / rest));
    if (!(hold.share > least_hold)) continue;
    // `low` is the height of the region's lowest vertex over the region's mean, after the blended rotation.
    const Mat3 rotation = p.translations.mean_rotation(row, p.matrices.data());
    double low = no_height;
    for (const std::int32_t v : target_.region(pair.number))
      low = std::min(low, dot(up, rotation * (target_core_->mesh.positions[at(v)] - pair.target_rest)));
    const Vec3 now = p.translations.place(row, p.matrices.data(), p.shifts.data());
    hold.goal = now + (p.scale * height + p.target_ground - dot(up, now) - low) * up;
    hold.vertical = true;
    p.holds.push_back(hold);
  }
  p.translations.hold({p.holds.data(), p.holds.size()}, up, p.matrices.data(), p.shifts.data());
  if (dials_.moves_paths()) move_paths(p);
}

// Returns how far the source lies, from 0 to 1. Also fills the scaled heights of the source's clusters.
double Transfer::lying_share(Prepared& p) const noexcept {
  const Vec3 up = up_of(source_axes_);
  p.source_low = no_height;
  std::fill(p.source_lows.begin(), p.source_lows.end(), no_height);
  for (std::size_t v = 0; v < p.posed.size(); ++v) {
    const double height = dot(p.posed[v], up);
    if (!p.source_hangs[v]) p.source_low = std::min(p.source_low, height);
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

// Lowers or raises the goals of the anchors. Then a cluster of the target's vertices touches the ground if the same
// cluster of the source does.
void Transfer::lie_down(Prepared& p, Vec3 centroid, double lies, double rigid, double share) const {
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
    sum += p.touch[c] * (p.target_lows[c] - p.target_ground - p.source_lows[c]);
    mass += p.touch[c];
  }
  if (!(mass > 0)) return;
  for (std::size_t k = 0; k < p.anchors.size(); ++k)
    p.goals[k] = p.goals[k] - lies * (p.anchors[k].is_foot ? p.anchors[k].fallen : 1.0) * (sum / mass) * up;
  settle(p, centroid);
  hold_regions(p, rigid, share);
}

// Raises what sinks so that the energies rise least. The rises z of the clusters minimise
//     1/2 z' A z + sum_k (row_k z)^2 / 2 e_k     so that  W_v z >= needs_v  for every vertex v.
// Rows are the regions that stand or touch: they rise too, but only if they must. The forces of the vertices are never
// negative, and each sweep sets one force after the other to its best value (Hildreth's method). Every step is a
// continuous function of the needs. Returns false if nothing is under the ground.
bool Transfer::raise_sunk(Prepared& p, Vec3 up, double allowed, double share) const {
  const std::size_t count = p.rises.size();
  const double* compliance = p.translations.compliance();
  bool any = false;
  for (std::size_t v = 0; v < p.blended.size(); ++v) {
    const std::int32_t row = p.rides[v];
    const bool free = p.sinks[v] || (row >= 0 && p.given_hold[at(row)].share > 0);
    p.needs[v] = free ? -no_height : allowed - dot(up, p.blended[v]) - least_depth;
    any = any || p.needs[v] > 0;
    double& most = p.block_needs[v / rise_block];
    most = v % rise_block == 0 ? p.needs[v] : std::max(most, p.needs[v]);
  }
  if (!any) return false;
  std::fill(p.rises.begin(), p.rises.end(), 0.0);
  std::fill(p.forces.begin(), p.forces.end(), 0.0);
  std::fill(p.hold_forces.begin(), p.hold_forces.end(), 0.0);
  double lowest_rise = 0;  // no cluster has sunk deeper in any sweep
  const auto rise = [&](double change, const double* column) {
    for (std::size_t c = 0; c < count; ++c) {
      p.rises[c] += change * column[c];
      lowest_rise = std::min(lowest_rise, p.rises[c]);
    }
  };
  for (std::int32_t sweep = 0; sweep < rise_sweeps; ++sweep) {
    for (std::size_t i = 0; i < p.holds.size(); ++i) {
      const Hold& hold = p.holds[i];
      const bool given = p.given_hold[hold.row].share > 0;
      const double soft =
          p.translations.give(hold.row) * (given ? hold_ridge : held_give + (1 - hold.share) / hold.share);
      const double change = -(p.translations.mean(hold.row, p.rises.data()) + soft * p.hold_forces[i]) /
                            (p.translations.give(hold.row) + soft);
      p.hold_forces[i] += change;
      rise(change, p.translations.influence(hold.row));
    }
    for (std::size_t v = 0; v < p.needs.size(); ++v) {
      // Most vertices are too far above the ground to take part, now or in an earlier sweep.
      const double too_little = weight_sum_limit * lowest_rise;
      if (v % rise_block == 0 && p.block_needs[v / rise_block] <= too_little) {
        v += rise_block - 1;
        continue;
      }
      if (p.needs[v] <= too_little) continue;
      const std::int32_t* joint = p.clusters.joint.data() + v * blend_count;
      const float* weight = p.clusters.weight.data() + v * blend_count;
      double miss = p.needs[v];
      for (std::int32_t i = 0; i < blend_count; ++i) miss -= static_cast<double>(weight[i]) * p.rises[at(joint[i])];
      if (!(miss > 0) && !(p.forces[v] > 0)) continue;
      double give = 0;
      for (std::int32_t i = 0; i < blend_count; ++i)
        for (std::int32_t j = 0; j < blend_count; ++j)
          give += static_cast<double>(weight[i]) * static_cast<double>(weight[j]) *
                  compliance[at(joint[i]) * count + at(joint[j])];
      if (!(give > 0)) continue;
      const double change = std::max(-p.forces[v], miss / give);
      p.forces[v] += change;
      for (std::int32_t i = 0; i < blend_count; ++i) {
        if (weight[i] > 0) rise(change * static_cast<double>(weight[i]), compliance + at(joint[i]) * count);
      }
    }
  }
  for (std::size_t c = 0; c < count; ++c) p.shifts[c] = p.shifts[c] + share * p.rises[c] * up;
  // The caller's places are met exactly.
  std::size_t kept = 0;
  for (const Hold& hold : p.holds)
    if (p.given_hold[hold.row].share > 0) p.holds[kept++] = hold;
  p.translations.hold({p.holds.data(), kept}, up, p.matrices.data(), p.shifts.data());
  return true;
}

// Lifts all parts that would sink below the ground. The arguments turn and centroid place the rest pose of the whole
// target. rigid: the share of a rigid motion of the whole source, which is copied unchanged. It moves the target that a
// source at rest gives; limbs that the rest alignment turns must not sink there. So that share has a ground that moves
// with the body.
void Transfer::keep_above_ground(Prepared& p, const deform::Quaternion& turn, Vec3 centroid, double rigid) const {
  const Vec3 up = up_of(target_axes_), own_up = deform::rotate(turn, up);
  const double allowed = p.target_ground + p.scale * std::min(0.0, p.source_low - p.source_ground),
               own = p.target_ground + dot(own_up, centroid) - dot(up, p.target_centroid);
  // Both shares raise the same surface, so it is blended anew only after both.
  bool raised = false;
  if (1 - rigid > least_share) raised = raise_sunk(p, up, allowed, 1 - rigid);
  if (rigid > least_share) raised = raise_sunk(p, own_up, own, rigid) || raised;
  if (raised) blend(p);
}

}  // namespace hf_inner::transfer
