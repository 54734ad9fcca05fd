// Keeps the target above the ground: the regions that stand or touch, and the rest of the surface.
//
// The ground is the height of the lowest point of the rest shape. A target may sink as deep as its source, scaled.
// Regions are held while the translations are solved (hold_regions). Three rules lift the rest of the surface:
// - A lying source touches the ground with clusters that are far above it at rest. The same clusters of the target
//   should touch: lie_down moves the goals of the anchored regions along up by the mean difference of their heights.
// - A body that has fallen over but does not lie yet is raised as a whole by the depth it sinks.
// - In each cluster that still sinks, the deepest vertex is held at the allowed height, and the clusters turn to follow
//   it. If that vertex moves with the region of a pair, the region is raised instead. A frame in which no part lies or
//   sinks only costs one pass over the heights.
#include <cmath>

#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner {
// Constrains (holds) the regions that stand, touch or would sink, and those that the caller places. share: how far the
// frame is a rigid motion, or the body has fallen over. At share 1 only the caller's constraints remain.
void Transfer::hold_regions(Prepared& p, double share) const {
  const Vec3 source_up = up_of(source_axes_), up = up_of(target_axes_);
  const bool by_itself = options_.mode == HF_TRANSFER_FIELDS && share < 1;
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
    if (at_height + hold.share * (wanted - at_height) < allowed) wanted = allowed, hold.share = 1 - share;
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

void Transfer::find_sunk(Prepared& p, Vec3 up, double allowed) const noexcept {
  std::fill(p.deepest.begin(), p.deepest.end(), Prepared::Sunk());
  const std::size_t rows = p.given_hold.size();
  for (std::size_t v = 0; v < p.blended.size(); ++v) {
    const double depth = allowed - dot(up, p.blended[v]);
    if (!(depth > least_depth)) continue;
    const std::int32_t row = p.rides[v];
    if (row >= 0 && p.given_hold[at(row)].share > 0) continue;  // the caller has placed this region
    Prepared::Sunk& sunk = p.deepest[row >= 0 ? at(row) : rows + at(p.clusters.joint[v * blend_count])];
    if (depth > sunk.depth) sunk.depth = depth, sunk.vertex = static_cast<std::int32_t>(v);
  }
}

// Raises the constraint (hold) of each region that sinks into the ground, or adds one. Constrains the deepest vertex of
// each sunk cluster too. Returns false if no part sinks.
bool Transfer::hold_sunk(Prepared& p, Vec3 up, double share, std::size_t& held) const noexcept {
  const std::size_t rows = p.given_hold.size();
  bool any = false;
  const auto raise = [&](std::size_t row, double depth) {
    any = true;
    Hold fresh;
    fresh.row = row, fresh.share = sunk_hold * share, fresh.vertical = true;
    fresh.goal = p.translations.place(row, p.matrices.data(), p.shifts.data()) + (depth - p.lift) * up;
    for (Hold& hold : p.holds) {
      if (hold.row != row) continue;
      if (hold.share < weak_hold * sunk_hold * share)
        hold = fresh;  // the old constraint is too weak to raise
      else
        hold.goal = hold.goal + depth / hold.share * up;
      return;
    }
    p.holds.push_back(fresh);
  };
  for (std::size_t row = 0; row < rows; ++row)
    if (p.deepest[row].vertex >= 0) raise(row, p.deepest[row].depth);
  // One vertex of each sunk cluster is held, the deepest first, up to vertex_rows vertices.
  while (true) {
    Prepared::Sunk* deepest = nullptr;
    for (std::size_t c = rows; c < p.deepest.size(); ++c)
      if (p.deepest[c].vertex >= 0 && (!deepest || p.deepest[c].depth > deepest->depth)) deepest = &p.deepest[c];
    if (!deepest) return any;
    const std::int32_t vertex = deepest->vertex;
    deepest->vertex = -1;
    std::size_t slot = 0;
    const auto cluster_of = [&](std::int32_t v) { return p.clusters.joint[at(v) * blend_count]; };
    while (slot < held && cluster_of(p.held_vertices[slot]) != cluster_of(vertex)) ++slot;
    if (slot == vertex_rows) continue;
    if (slot == held) {
      p.held_vertices[held++] = vertex;
      p.translations.set_vertex_rows(slot, {&p.held_vertices[slot], 1}, *target_core_, p.clusters);
    }
    raise(p.translations.vertex_row(slot), deepest->depth);
  }
}

// Lifts all parts that would sink below the ground. share: 0 for a rigid motion of the whole source, which is copied
// unchanged, up to 1. fallen: how far the body has tilted over without lying on the ground, from 0 to 1.
void Transfer::keep_above_ground(Prepared& p, Vec3 centroid, double share, double fallen) const {
  if (!(share > least_share)) return;
  const Vec3 up = up_of(target_axes_);
  double low = no_height;
  for (const Vec3& point : p.blended) low = std::min(low, dot(point, up));
  const double allowed = p.target_ground + p.scale * std::min(0.0, p.source_low - p.source_ground);
  if (!(allowed - low > least_depth)) return;
  p.lift = share * fallen * (allowed - low);
  const auto move = [&] {
    for (Vec3& shift : p.shifts) shift = shift + p.lift * up;
    blend(p);
  };
  if (p.lift > 0) move();
  std::size_t held = 0;
  for (std::int32_t round = 0; round < sunk_rounds; ++round) {
    find_sunk(p, up, allowed);
    if (!hold_sunk(p, up, share, held)) return;
    for (const bool again : {true, false}) {
      settle(p, centroid);
      p.translations.hold({p.holds.data(), p.holds.size()}, up, p.matrices.data(), p.shifts.data());
      if (!again || round >= turning_rounds) break;
      turn_clusters(p);
    }
    move();
  }
}

}  // namespace hf_inner
