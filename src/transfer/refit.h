// Turns each cluster to match where its neighbours moved.
//
// An anchored foot may stand where the source's rotations alone would not put it. Translations alone then shift the
// clusters of the leg against each other, like beads on a string. So each cluster is fitted to its overlaps:
//     R_c = argmax tr(R' (M_c / s_c + b R_c0)),   M_c = sum_d k_cd (y_cd - y_c)(x_cd - x_c)',
//     k_cd = sum_v a_v W_vc W_vd.
//
//     R_c         the new rotation of cluster c
//     R_c0        its rotation taken from the source, which decides the twist
//     a_v, W_vc   the area of vertex v, and its weight in c
//     x_cd, y_cd  the rest centroid of the overlap of c and d, and the mean of the places that c and d give it
//     x_c, y_c    the same for c alone
//     s_c         the rest spread of c
//     b           keep_rotation: it limits how far a cluster turns
//
// Translations are solved again afterwards. This is the shape matching of Xu et al. 2009, Section 5.2, started at the
// transferred rotations. Clusters of handles keep their rotations, and so do clusters that overlap no other. A rigid
// motion stays unchanged. A round costs O(overlaps) and allocates nothing.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "deform/rotation.h"
#include "transfer/clusters.h"
#include "transfer/slack.h"

namespace hf_inner::transfer {

class Refit {
 public:
  explicit Refit(Memory& memory)
      : start_(&memory),
        other_(&memory),
        pair_(&memory),
        weight_(&memory),
        point_(&memory),
        spread_(&memory),
        centroid_(&memory) {}
  void prepare(const mesh::Mesh& target, Span<const double> area, const Clusters& clusters, Memory& memory);

  // Tells which pair of overlapping clusters has which slide (slack.h).
  void take_pairs(Span<const Slack::Pair> pairs);

  // Runs one round of rotations. given: the rotations taken from the source. slides: one for each pair of take_pairs,
  // or null if it was not called. The array rotations: the present rotations, which it replaces. matrices: the present
  // rotations as matrices. shifts: the present translations.
  void turn(const deform::Quaternion* given, const Vec3* slides, const Vec3* shifts, deform::Quaternion* rotations,
            const Mat3* matrices) const noexcept;

 private:
  std::int32_t count_ = 0;
  // The overlaps (common vertices) of each cluster with others and with itself.
  Vector<std::int32_t> start_, other_;
  Vector<std::int32_t> pair_;  // by overlap: 1 + the slack's pair, negative from its other side; 0: none
  Vector<double> weight_;
  Vector<Vec3> point_;
  Vector<double> spread_;  // rest spread per cluster; 0: it keeps its rotation
  Vector<Vec3> centroid_;
};

}  // namespace hf_inner::transfer
