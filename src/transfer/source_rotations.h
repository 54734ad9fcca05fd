// Finds how each cluster of the source has turned in a posed frame.
//
//     M_c = sum_ij w_cij (q_i - q_j)(p_i - p_j)',   R_c = argmax tr(R' (M_c + e R_b))
//
// R_c is the rotation of cluster c, p the rest and q the posed vertices. R_b is found in the same way, from the broad
// kernel and the rotation of the whole body. The sum runs over the edges of the cluster's kernel, or over
// its vertices (clusters.h). This is the rotation of as-rigid-as-possible cells (Sorkine and Alexa 2007), averaged over
// the cluster. R_b, with the small weight e, decides the twist of thin, flat and collinear clusters. A rigid motion q =
// R p + t gives R to every cluster, because M_c = R S with a positive S.
//
// Each cluster costs the size of its kernels and two 4 x 4 eigenproblems. Allocates nothing.
#pragma once
#include "deform/rotation.h"
#include "transfer/clusters.h"

namespace hf_inner::transfer {

// The motion of the whole source: its rotation, its area centroids, and how far the frame is from a rigid motion.
struct WholeMotion {
  deform::Quaternion rotation;
  Vec3 rest_centroid, centroid;
  double residual = 0;  // root mean square of q - (R (p - rest_centroid) + centroid)
};

class SourceRotations {
 public:
  explicit SourceRotations(Memory& memory) : sample_(&memory), sample_weight_(&memory) {}
  void prepare(const mesh::Mesh& mesh, Span<const double> area);

  // posed: inner coordinates of the source.
  WholeMotion whole(const mesh::Mesh& mesh, Span<const double> area, const Vec3* posed) const noexcept;
  void clusters(const Clusters& clusters, const Vec3* posed, const deform::Quaternion& whole, deform::Quaternion* out,
                JobRunner& jobs) const;

 private:
  Vector<std::int32_t> sample_;  // vertices used for the rotation of the whole body
  Vector<double> sample_weight_;
  Vec3 sample_centroid_;
  double sample_spread_ = 0;
};

}  // namespace hf_inner::transfer
