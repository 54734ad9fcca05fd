// The dials of a transfer: what an animator turns without a new preparation (hf_transfer_dials).
//
// Paths (stride, hip height): after each solve the body moves by d_0 and the row of each anchor by d_k. These are
// constraints on the same factor (Translations::hold). So each row moves by d_k exactly and the energies rise least:
// d_k = (stride - 1) H travel_k + hip_k up, H takes the part along the ground. The vector travel_k is the scaled path
// of the source's region without the part that the body's turn makes. It is constant while a foot is planted, so the
// foot does not slide. Rotations of clusters follow by the same rounds (refit.h).
//
// Limbs (neck, tail, arms): the field of a limb is the sum of the fields of its pairs. The share w of a cluster in it
// rises from 0 at the root to 1. A positive value of `follow` moves the cluster's rest turn towards D^w, where D takes
// the limb's rest direction to the source's. A negative value moves the cluster's rotation towards the rotation of the
// cluster at the root. Arms turn by w times the angle about the forward axis, at rest.
//
// Long parts: long_follow goes to levers.h.
#include <cmath>

#include "base/arguments.h"
#include "base/index.h"
#include "transfer/constants.h"
#include "transfer/prepared.h"

namespace hf_inner::transfer {
namespace {

void check_dial(double value, double least, double most, const char* name) {
  check_finite(value, name);
  // The ABI gives floats, so the bounds are compared as floats.
  const auto x = static_cast<float>(value);
  if (x < static_cast<float>(least) || x > static_cast<float>(most))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%s is %g; it must be %g to %g", name, value, least, most);
}

// The sum of the fields of some pairs, as a field of its own.
void add_columns(const Buffer<double>& field, std::size_t width, const Vector<std::size_t>& columns,
                 Vector<double>& out) {
  for (std::size_t v = 0; v < out.size(); ++v) {
    out[v] = 0;
    for (const std::size_t h : columns) out[v] += field[v * width + h];
  }
}

}  // namespace

void Transfer::set_dials(const Dials& dials) {
  check_dial(dials.stride, least_stride, most_stride, "stride");
  check_dial(dials.hip_height_share, -most_hip_height, most_hip_height, "hip_height_share");
  check_dial(dials.neck_follow, -most_follow, most_follow, "neck_follow");
  check_dial(dials.tail_follow, -most_follow, most_follow, "tail_follow");
  check_dial(dials.arm_space, -most_arm_space, most_arm_space, "arm_space");
  check_dial(dials.long_follow, 0, most_follow, "long_follow");
  dials_ = dials;
  if (prepared_) turn_dials(*prepared_);
}

void Transfer::prepare_dials(Prepared& p) const {
  Memory& memory = *target_core_->memory;
  const std::size_t width = numbers_.size(), count = at(p.clusters.count);
  const Vec3 up = up_of(target_axes_), right{target_axes_(0, 0), target_axes_(0, 1), target_axes_(0, 2)};
  Vector<std::size_t> columns(&memory);
  const auto share_clusters = [&](Prepared::DialLimb& limb) {
    limb.share.assign(count, 0.0);
    limb.root = -1;
    if (columns.empty()) return;
    double nearest = no_height;
    for (std::size_t c = 0; c < count; ++c) {
      double field = 0;
      for (const std::size_t h : columns) field += p.clusters.centre[c * width + h];
      limb.share[c] = std::clamp((field - root_from) / root_width, 0.0, 1.0);
      if (std::abs(field - root_from) < nearest) {
        nearest = std::abs(field - root_from);
        limb.root = static_cast<std::int32_t>(c);
      }
    }
  };
  for (const bool is_neck : {true, false}) {
    Prepared::DialLimb& limb = is_neck ? p.neck : p.tail;
    columns.clear();
    Vec3 ends[2];
    for (std::size_t h = 0; h < width; ++h) {
      if (!(flags_[numbers_[h]] & (is_neck ? HF_PAIR_NECK : HF_PAIR_TAIL))) continue;
      columns.push_back(h);
      ends[0] = ends[0] + region_mean(source_.region(numbers_[h]), source_core_->mesh.positions.data());
      ends[1] = ends[1] + region_mean(target_.region(numbers_[h]), target_core_->mesh.positions.data());
    }
    share_clusters(limb);
    limb.turn = deform::Quaternion();
    if (columns.empty()) continue;
    Vector<double> source_sum(source_area_.size(), 0.0, &memory), target_sum(target_area_.size(), 0.0, &memory);
    add_columns(p.source_field, width, columns, source_sum);
    add_columns(p.target_field, width, columns, target_sum);
    const RestSide source{&source_core_->mesh, {source_sum.data(), source_sum.size()}, source_area_, source_axes_},
        target{&target_core_->mesh, {target_sum.data(), target_sum.size()}, target_area_, target_axes_};
    const double part = 1.0 / static_cast<double>(columns.size());
    Vec3 from, to;
    if (limb_direction(source, 0, part * ends[0], to, root_window) &&
        limb_direction(target, 0, part * ends[1], from, root_window) && norm(from) >= shortest_limb &&
        norm(to) >= shortest_limb)
      limb.turn = minimal_rotation(from, deform::rotate(axes_, to), right);
  }
  for (int side = 0; side < 2; ++side) {
    const Vec3 outward = (side == 0 ? 1.0 : -1.0) * right;
    columns.clear();
    for (std::size_t h = 0; h < width; ++h) {
      const double place = dot(
          outward, region_mean(target_.region(numbers_[h]), target_core_->mesh.positions.data()) - p.target_centroid);
      if ((flags_[numbers_[h]] & HF_PAIR_ARM) && (place > 0 || (place == 0 && side == 0))) columns.push_back(h);
    }
    share_clusters(p.arms[side]);
    p.arms[side].turn = deform::exponential(cross(-1.0 * up, outward));
  }

  double height = 0, trunks = 0;
  for (const Prepared::Anchor& anchor : p.anchors)
    if (anchor.flags & HF_PAIR_TRUNK) {
      height += dot(up, anchor.target_rest);
      trunks += 1;
    }
  p.hip_height = (trunks > 0 ? height / trunks : dot(up, p.target_centroid)) - p.target_ground;
  p.dialled_turn.assign(count, deform::Quaternion());
  p.stiff.assign(count, 0.0);
}

// Sets the numbers that follow from the dials alone.
void Transfer::turn_dials(Prepared& p) const noexcept {
  for (std::size_t c = 0; c < p.dialled_turn.size(); ++c) {
    p.dialled_turn[c] = p.cluster_turn[c];
    p.stiff[c] = 0;
  }
  if (!dials_.turns_limbs()) return;
  for (const bool is_neck : {true, false}) {
    const Prepared::DialLimb& limb = is_neck ? p.neck : p.tail;
    const double follow = is_neck ? dials_.neck_follow : dials_.tail_follow;
    if (limb.root < 0 || follow == 0) continue;
    for (std::size_t c = 0; c < limb.share.size(); ++c) {
      if (!(limb.share[c] > 0)) continue;
      deform::Quaternion& turn = p.dialled_turn[c];
      if (follow > 0)
        turn = deform::normalised(turn * power(turn.conjugate() * power(limb.turn, limb.share[c]), follow));
      else if (c != at(limb.root))
        p.stiff[c] = -follow * limb.share[c];
    }
  }
  for (const Prepared::DialLimb& limb : p.arms) {
    if (limb.root < 0 || dials_.arm_space == 0) continue;
    for (std::size_t c = 0; c < limb.share.size(); ++c)
      if (limb.share[c] > 0)
        p.dialled_turn[c] = deform::normalised(power(limb.turn, dials_.arm_space * limb.share[c]) * p.dialled_turn[c]);
  }
}

// Clusters of limbs that do not follow take the rotation of their limb's root, by a share.
void Transfer::stiffen(Prepared& p) const noexcept {
  for (std::size_t c = 0; c < p.stiff.size(); ++c) {
    if (!(p.stiff[c] > 0)) continue;
    const deform::Quaternion& root = p.given[at(p.neck.root >= 0 && p.neck.share[c] > 0 ? p.neck.root : p.tail.root)];
    p.given[c] = deform::normalised(root * power(root.conjugate() * p.given[c], 1 - p.stiff[c]));
    p.rotations[c] = p.given[c];
    p.matrices[c] = p.given[c].toRotationMatrix();
  }
}

// Moves the rows of the anchors as the dials say. Held vertices of the caller do not move, and vertices at the ground
// keep their height.
void Transfer::move_paths(Prepared& p) const {
  p.dial_holds.clear();
  bool has_trunk = false;
  const auto add = [&](std::size_t row, Vec3 moved, double share, bool vertical) {
    Hold hold;
    hold.row = row;
    hold.share = share;
    hold.vertical = vertical;
    hold.goal = p.translations.place(row, p.matrices.data(), p.shifts.data()) + moved;
    p.dial_holds.push_back(hold);
  };
  for (std::size_t k = 0; k < p.anchors.size(); ++k) {
    add(k, p.given_hold[k].share > 0 ? Vec3() : p.excess[k], 1, false);
    has_trunk = has_trunk || (p.anchors[k].flags & HF_PAIR_TRUNK);
  }
  if (!has_trunk && !p.anchors.empty()) add(p.anchors.size(), p.body_excess, 1, false);
  for (const Hold& hold : p.holds)
    if (hold.row > p.anchors.size()) add(hold.row, Vec3(), hold.share, hold.vertical);
  for (Vec3& shift : p.shifts) shift = shift + p.body_excess;
  p.translations.hold({p.dial_holds.data(), p.dial_holds.size()}, up_of(target_axes_), p.matrices.data(),
                      p.shifts.data());
}

}  // namespace hf_inner::transfer
