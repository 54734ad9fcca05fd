// Turns clusters towards the places where their neighbours went.
//
// An anchored foot may stand where the source's rotations alone would not put it. Translations alone then shift the
// clusters of the leg against each other, like beads on a string. So each cluster is matched to its overlaps,
//     R_c = argmax tr(R' (M_c / s_c + b R_c0)),   M_c = sum_d k_cd (y_cd - y_c)(x_cd - x_c)',
//     k_cd = sum_v a_v W_vc W_vd.
// x_cd is the rest centroid of the overlap of c and d, y_cd the mean of where both put it, s_c the rest spread. R_c0 is
// the rotation that came from the source: it decides the twist, and b how far a cluster may turn.
//
// Translations are solved again afterwards. This is the shape matching of Xu et al. 2009, Section 5.2, started at the
// transferred rotations. Clusters of handles keep theirs. A rigid motion is unchanged. Cost: O(overlaps) per round.
// Allocates nothing.
#pragma once
#include <cstdint>

#include "base/span.h"
#include "deform/rotation.h"
#include "transfer/clusters.h"

namespace hf_inner {

class Refit {
 public:
  explicit Refit(Memory& memory)
      : start_(&memory), other_(&memory), weight_(&memory), point_(&memory), spread_(&memory), centroid_(&memory) {}
  void prepare(const Mesh& target, Span<const double> area, const Clusters& clusters, Memory& memory);

  // One round of rotations. given: those from the source. rotations: the present ones, replaced. matrices: the present
  // ones as matrices.
  void turn(const Quaternion* given, const Vec3* shifts, Quaternion* rotations, const Mat3* matrices) const noexcept;

 private:
  std::int32_t count_ = 0;
  // overlaps of each cluster, also with itself
  Vector<std::int32_t> start_, other_;
  Vector<double> weight_;
  Vector<Vec3> point_;
  Vector<double> spread_;  // 0: the cluster keeps its rotation
  Vector<Vec3> centroid_;
};

}  // namespace hf_inner
