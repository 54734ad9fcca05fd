// Turns parts of the target less that reach farther than their source's.
//
// Rotations go over, so a part that is k times as long moves k times as far. A robot holds a sword of half a body's
// length; its hand follows a hoof that flips by 90 degrees in two frames. A cow's tail follows a deer's short one. So a
// cluster follows a k-th part of the turn. The factor k is a ratio above 1, target over source. It is the spread of the
// cluster's vertices, or the way to the end of its limb, whichever is more:
//     R'_c = R'_b f(R_b^-1 R_c).
// R are the rotations of the source's clusters, R' the rotations of the target's clusters. The cluster b is the cluster
// before c on the shortest way from the middle of the target; the way goes over clusters that overlap. So an ear keeps
// to its head. f keeps the axis of a turn and changes its angle a. With w = 1/k:
//     w >= 1/2: a - (1 - w) sin a,     w < 1/2: w (4/3 sin a - 1/6 sin 2a).
// Small angles become w a. Half a turn to the left is half a turn to the right, so pi becomes pi or 0: no turn makes a
// part jump. Where k <= 1 rotations stay, to the last bit if they stay on the whole way; so on a body that plays its
// own motion. Feet and the trunk stay too: they stand on the ground, and carry the rest.
//
// A dial (long_follow) takes the angle from that to the whole one. Between them, w < 1/2 cannot keep half a turn from
// jumping: pi goes to 0 at one end and to pi at the other.
//
// A frame reads no vertex, depends on no other frame and allocates nothing.
#pragma once
#include "deform/rotation.h"
#include "transfer/clusters.h"
#include "transfer/overlaps.h"

namespace hf_inner::transfer {

// A ratio of lengths, 1 up to `from` and itself from `to` on: clusters of bodies that are alike lie a little elsewhere.
double counted_ratio(double ratio, double from, double to) noexcept;

class Levers {
 public:
  explicit Levers(Memory& memory)
      : order_(&memory), before_(&memory), follow_(&memory), own_(&memory), bent_(&memory) {}

  // from, to: of the clusters on the source and on the target. limb: by cluster, from 0 to 1, how far it belongs to a
  // limb that can turn less, at least `outer`. Its own width counts as far as `outer` says; beyond that only where it
  // clearly differs. scale: lengths of the target over lengths of the source. centre: of the target. Without this call
  // nothing turns. ends: by cluster, the length from its centroid to the end of its limb on the target, over that on
  // the source.
  void prepare(const Overlaps& from, const Overlaps& to, Span<const double> limb, Span<const double> outer,
               Span<const double> ends, double scale, Vec3 centre, Memory& memory);

  // Changes the rotations of the source's clusters. body: the rotation of the whole source, for clusters that overlap
  // no other. whole: 0, or how far turns are made in full; 1 changes no bit.
  void turn(const deform::Quaternion& body, double whole, deform::Quaternion* rotations) noexcept;

  double follow(std::size_t cluster) const noexcept { return follow_[cluster]; }  // w

 private:
  Vector<std::int32_t> order_;   // clusters, each after the one before it
  Vector<std::int32_t> before_;  // -1: none
  Vector<double> follow_;
  Vector<deform::Quaternion> own_;  // the rotations as they came
  Vector<std::uint8_t> bent_;       // 1 where they changed
};

}  // namespace hf_inner::transfer
