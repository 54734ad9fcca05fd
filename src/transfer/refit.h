// Clusters turn to where their neighbours went.
//
// An anchored foot may stand elsewhere than the source's rotations alone would put it; translations alone would then
// shift the clusters of the leg against each other, and the leg looks like a string of beads. So each cluster is
// matched to the places where it overlaps its neighbours,
//     R_c = argmax tr(R' (M_c / s_c + b R_c0)),   M_c = sum_d k_cd (y_cd - y_c)(x_cd - x_c)',   k_cd = sum_v a_v W_vc
//     W_vd,
// x_cd the rest centroid of the overlap of c and d, y_cd the mean of where c and d put it, s_c the rest spread, R_c0
// the rotation that came from the source (which decides the twist, and b = 0.18 how far a cluster may turn), after
// which the translations are solved again: the shape matching of overlapping clusters of Xu et al. 2009, Section 5.2,
// started at the transferred rotations. Handle clusters keep theirs. A rigid motion stays as it is. Cost: O(overlaps)
// per round. Allocates nothing.
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

  // One round. given: rotations from the source; rotations, matrices: present ones, overwritten.
  void turn(const Quaternion* given, const Vec3* shifts, Quaternion* rotations, const Mat3* matrices) const noexcept;

 private:
  std::int32_t count_ = 0;
  // overlaps of each cluster, itself included (its pivot, with the vertices it shares with nobody)
  Vector<std::int32_t> start_, other_;
  Vector<double> weight_;
  Vector<Vec3> point_;
  Vector<double> spread_;  // 0: the cluster keeps its rotation
  Vector<Vec3> centroid_;
};

}  // namespace hf_inner
