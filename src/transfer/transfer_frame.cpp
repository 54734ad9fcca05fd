// Computes one frame of a transfer (transfer.h): the goals of the regions, the motion of the clusters, and the blend.
#include <cmath>
#include <cstring>

#include "base/compiler.h"
#include "base/elementary.h"
#include "base/error.h"
#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner::transfer {
namespace {

// Tells how rigid a frame of the source is, from 0 to 1.
double rigid_share(const WholeMotion& whole) noexcept {
  const double ratio = whole.residual / rigid_residual;
  return 1 / (1 + ratio * ratio);
}
double turned_share(const deform::Quaternion& turn) noexcept {
  return smooth_step(turn_low, turn_high, deform::angle_between(turn, deform::Quaternion()));
}

// The angle by which a turn tips an upright direction. Turns about the vertical do not count.
double tilt(const deform::Quaternion& turn, Vec3 up) noexcept {
  return arc_cosine(std::clamp(dot(up, deform::rotate(turn, up)), -1.0, 1.0));
}

// Tells how far the body, or a foot, has fallen over, from 0 to 1.
double fallen_share(const deform::Quaternion& turn, Vec3 up) noexcept {
  return smooth_step(fall_low, fall_high, tilt(turn, up));
}

// Returns the part of the rotation q that turns about the axis, and how certain that part is: it has no meaning for a
// half turn about another axis.
struct Twist {
  deform::Quaternion turn;
  double certain;
};
Twist about(const deform::Quaternion& q, Vec3 axis) noexcept {
  const double along = dot(deform::to_vec3(q.vec()), axis);
  return {deform::normalised({along * axis, q.w()}), smooth_step(twist_low, twist_high, along * along + q.w() * q.w())};
}

HF_VECTOR(Four, double, 4);

// The vertices of a blend: joints and weights, blend_count for each, and rest places.
struct BlendInput {
  const BlendColumns* columns;
  const std::int32_t* joint;
  const float* weight;
  const Vec3* rest;
};

HF_FOUR_LANES
void blend_vertices(const BlendInput& in, std::size_t first, std::size_t last, Vec3* out) noexcept {
  for (std::size_t v = first; v < last; ++v) {
    const Vec3 x = in.rest[v];
    Four sum = {0, 0, 0, 0};
    for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
      const double w = static_cast<double>(in.weight[i]);
      if (w <= 0) break;
      const BlendColumns& c = in.columns[in.joint[i]];
      Four along_x, along_y, along_z, shift;
      std::memcpy(&along_x, c.m[0], sizeof along_x);
      std::memcpy(&along_y, c.m[1], sizeof along_y);
      std::memcpy(&along_z, c.m[2], sizeof along_z);
      std::memcpy(&shift, c.m[3], sizeof shift);
      sum += w * (along_x * x.x + along_y * x.y + along_z * x.z + shift);
    }
    out[v] = {sum[0], sum[1], sum[2]};
  }
}

}  // namespace

// Computes the goals of the anchors, the regions that follow their source. turn: rotation of the whole source in the
// target's frame. When the body turns, the offset between the two rest shapes turns with it. A standing foot stays in
// place while the body turns over it. While the body is upright and the foot is low, the foot's offset therefore turns
// only as far about the vertical as the foot itself. High in the air it turns with the body: a foot that kicks points
// anywhere.
void Transfer::place_anchors(Prepared& p, const WholeMotion& whole, const deform::Quaternion& turn) const {
  const Vec3 source_up = up_of(source_axes_), up = up_of(target_axes_);
  const Twist round = about(turn, up);
  const double rigid = rigid_share(whole), fallen = std::max(rigid, fallen_share(turn, up)),
               yaw = round.certain * turned_share(round.turn);
  const Mat3 carried = power(turn, std::max(fallen, yaw)).toRotationMatrix();
  if (dials_.moves_paths()) {
    const Vec3 travel = p.scale * deform::rotate(axes_, whole.centroid - whole.rest_centroid);
    p.body_rise = (1 - fallen_share(turn, up)) * dials_.hip_height_share * p.hip_height;
    p.body_excess = (dials_.stride - 1) * (travel - dot(up, travel) * up) + p.body_rise * up;
  }
  for (std::size_t k = 0; k < p.anchors.size(); ++k) {
    Prepared::Anchor& anchor = p.anchors[k];
    const Span<const std::int32_t> from = source_.region(anchor.number), to = target_.region(anchor.number);
    const Vec3 path = p.scale * deform::rotate(axes_, region_mean(from, p.posed.data()) - anchor.source_rest);
    const Vec3 offset = anchor.target_rest - p.target_centroid -
                        p.scale * deform::rotate(axes_, anchor.source_rest - whole.rest_centroid);
    Twist own{deform::Quaternion(), 0};
    const auto c = static_cast<std::size_t>(anchor.cluster);
    const deform::Quaternion own_turn = p.given[c] * p.dialled_turn[c].conjugate();
    // A body leans over feet that stand, and falls with those that tip.
    anchor.fallen = fallen_share(turn, up);
    if (anchor.is_foot)
      anchor.fallen *= 1 - (1 - fallen_share(own_turn, up)) * (1 - smooth_step(lean_high, fall_high, tilt(turn, up)));
    const double upright = 1 - std::max(rigid, anchor.fallen);
    const bool steps = anchor.is_foot && upright > 0;
    const double height = p.scale * (lowest(from, p.posed.data(), source_up) - p.source_ground),
                 own_share = upright * (1 - smooth_step(stands, turns_freely, height));
    if (steps) {
      own = about(own_turn, up);
      own.turn = power(own.turn, turned_share(own.turn));
    }
    const auto turned = [&](Vec3 arm) {
      Vec3 out = carried * arm - arm;
      // A share of the turned arm, not of the turn: half a turn to the left is the same as half a turn to the right.
      if (steps) out = (1 - own_share) * out + (own_share * own.certain) * (deform::rotate(own.turn, arm) - arm);
      return out;
    };
    p.goals[k] = anchor.target_rest + path + turned(offset);
    if (dials_.moves_paths()) {
      // The part of the path that the body's turn makes does not count as travel.
      const Vec3 travel = path - turned(p.scale * deform::rotate(axes_, anchor.source_rest - whole.rest_centroid));
      p.excess[k] = (dials_.stride - 1) * (travel - dot(up, travel) * up);
      if (anchor.flags & HF_PAIR_TRUNK) p.excess[k] = p.excess[k] + p.body_rise * up;
    }
    if (!anchor.is_foot || !options_.keep_ground) continue;
    // The target's foot may sink only as deep into the ground as the source's foot.
    const double allowed = p.target_ground + std::min(0.0, height);
    const Mat3 rotation = p.translations.mean_rotation(k, p.matrices.data());
    double low = no_height;
    for (const std::int32_t v : to)
      low = std::min(low, dot(up, rotation * (target_core_->mesh.positions[at(v)] - anchor.target_rest)));
    const double lift = allowed - (dot(up, p.goals[k]) + low);
    if (lift > 0) p.goals[k] = p.goals[k] + (1 - std::max({rigid, anchor.fallen, yaw})) * lift * up;
  }
}

void Transfer::read_holds(Prepared& p, Span<const PairHold> holds) const {
  for (Hold& hold : p.given_hold) hold.share = 0;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const std::uint32_t number = holds[i].pair;
    if (!std::binary_search(numbers_.begin(), numbers_.end(), number))
      fail(HF_ERROR_NOT_FOUND, index, "entry %zu of the holds: the transfer has no pair %u", i, number);
    if (!is_finite(holds[i].place))
      fail(HF_ERROR_NON_FINITE, index, "entry %zu of the holds: the place of pair %u is not finite", i, number);
    if (mesh::is_too_far(target_core_->mesh.to_inner(holds[i].place)))
      fail(HF_ERROR_TOO_LARGE, index, "entry %zu of the holds: the place of pair %u is more than %g box diagonals away",
           i, number, mesh::farthest_pose);
    const auto row_in = [&](const Vector<Prepared::Anchor>& list) {
      std::size_t k = 0;
      while (k < list.size() && list[k].number != number) ++k;
      return k;
    };
    std::size_t row = row_in(p.anchors);
    if (row == p.anchors.size()) row = p.anchors.size() + 1 + row_in(p.loose);
    Hold& hold = p.given_hold[row];
    if (hold.share > 0)
      fail(HF_ERROR_INVALID_ARGUMENT, index, "entry %zu of the holds: pair %u is held already", i, number);
    hold.row = row;
    hold.goal = target_core_->mesh.to_inner(holds[i].place);
    hold.share = 1;
    hold.vertical = false;
  }
}

void Transfer::settle(Prepared& p, Vec3 centroid) const {
  p.translations.solve(p.clusters, p.matrices.data(), {p.goals.data(), p.goals.size()}, centroid,
                       p.cluster_goals.data(), p.slack.forces(), p.shifts.data());
}

void Transfer::turn_clusters(Prepared& p) const {
  p.refit.turn(p.given.data(), p.slack.slides(), p.shifts.data(), p.rotations.data(), p.matrices.data());
  for (std::size_t c = 0; c < p.rotations.size(); ++c) p.matrices[c] = p.rotations[c].toRotationMatrix();
}

void Transfer::blend(Prepared& p) const {
  for (std::size_t c = 0; c < p.columns.size(); ++c) {
    BlendColumns& to = p.columns[c];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) to.m[j][i] = p.matrices[c](i, j);
    to.m[3][0] = p.shifts[c].x;
    to.m[3][1] = p.shifts[c].y;
    to.m[3][2] = p.shifts[c].z;
  }
  const std::size_t n = p.blended.size();
  const BlendInput in = {p.columns.data(), p.clusters.joint.data(), p.clusters.weight.data(),
                         target_core_->mesh.positions.data()};
  target_core_->jobs->for_each(static_cast<std::uint32_t>((n + vertex_block - 1) / vertex_block), [&](std::uint32_t b) {
    const std::size_t first = std::size_t{b} * vertex_block;
    blend_vertices(in, first, std::min(n, first + vertex_block), p.blended.data());
  });
}

void Transfer::apply(const Vec3* source, Vec3* out, Span<const PairHold> holds) {
  for (std::int32_t v = 0; v < source_core_->size(); ++v) {
    const std::int32_t given = source_core_->mesh.given_of_inner[at(v)];
    if (!is_finite(source[v]))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(given), "vertex %d of the posed source is not finite",
           given);
    if (mesh::is_too_far(source_core_->mesh.to_inner(source[v])))
      fail(HF_ERROR_TOO_LARGE, static_cast<std::uint32_t>(given),
           "vertex %d of the posed source is more than %g box diagonals from the surface at rest", given,
           mesh::farthest_pose);
  }
  Prepared& p = prepare();
  if (options_.mode == HF_TRANSFER_STRETCH && !holds.empty())
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "a transfer of mode HF_TRANSFER_STRETCH takes no holds");
  read_holds(p, holds);
  const mesh::Mesh& from = source_core_->mesh;
  const mesh::Mesh& to = target_core_->mesh;
  for (std::size_t v = 0; v < p.posed.size(); ++v) p.posed[v] = from.to_inner(source[v]);
  const WholeMotion whole = p.source_rotations.whole(from, source_area_, p.posed.data());
  if (options_.mode == HF_TRANSFER_STRETCH) {
    const deform::Quaternion turn = deform::normalised(axes_ * whole.rotation * axes_.conjugate());
    p.gradients.apply({source_core_.get(), target_core_.get(), target_factor_.get(), p.posed.data(), whole, axes_, turn,
                       p.scale, p.target_centroid, target_area_},
                      p.blended.data());
    for (std::size_t v = 0; v < p.blended.size(); ++v) out[v] = to.to_given(p.blended[v]);
    make_rigid(p, out);
    return;
  }
  p.source_rotations.clusters(p.clusters, p.posed.data(), whole.rotation, p.given.data(), *target_core_->jobs);
  if (has_kernels()) {
    p.slack.measure(p.given.data(), p.posed.data(), axes_, *target_core_->jobs);
    p.levers.turn(whole.rotation, dials_.long_follow, p.given.data());
  }

  // Takes the rotations of the source's clusters into the target's axes and rest directions.
  const deform::Quaternion turn = deform::normalised(axes_ * whole.rotation * axes_.conjugate());
  const Vec3 centroid = p.target_centroid + p.scale * deform::rotate(axes_, whole.centroid - whole.rest_centroid);
  for (std::size_t c = 0; c < p.rotations.size(); ++c) {
    p.given[c] = p.rotations[c] = deform::normalised(axes_ * p.given[c] * axes_.conjugate() * p.dialled_turn[c]);
    p.matrices[c] = p.rotations[c].toRotationMatrix();
    p.cluster_goals[c] = centroid + deform::rotate(turn, p.clusters.pivot[c] - p.target_centroid);
  }
  if (dials_.turns_limbs()) stiffen(p);
  place_anchors(p, whole, turn);
  const double rigid = rigid_share(whole), fallen = fallen_share(turn, up_of(target_axes_));
  const double share = std::max(rigid, fallen);
  settle(p, centroid);
  hold_regions(p, rigid, share);
  const bool over_ground = has_ground() && !p.anchors.empty();
  const double lies = over_ground ? (1 - rigid) * lying_share(p) : 0.0;
  if (lies > 0) lie_down(p, centroid, lies, rigid, share);
  // If no region follows its source and no constraint is set, no goal pulls the clusters. Then they need no turn
  // towards their neighbours.
  const std::int32_t rounds = options_.scheme || (p.anchors.empty() && holds.empty()) ? 0 : refit_rounds;
  for (std::int32_t round = 0; round < rounds; ++round) {
    turn_clusters(p);
    settle(p, centroid);
    hold_regions(p, rigid, share);
  }
  if (lies > 0) lie_down(p, centroid, lies, rigid, share);
  blend(p);
  if (over_ground) keep_above_ground(p, turn, centroid, rigid);
  target_core_->jobs->for_each(
      static_cast<std::uint32_t>((p.blended.size() + vertex_block - 1) / vertex_block), [&](std::uint32_t b) {
        const std::size_t last = std::min(p.blended.size(), (std::size_t{b} + 1) * vertex_block);
        for (std::size_t v = std::size_t{b} * vertex_block; v < last; ++v) out[v] = to.to_given(p.blended[v]);
      });
  make_rigid(p, out);
}

}  // namespace hf_inner::transfer
