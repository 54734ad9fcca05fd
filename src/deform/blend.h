// Computes vertex positions from cluster transforms: x_v = sum_c W_vc A_c (p_v, 1).
//
// W_vc is the weight of vertex v in cluster c, A_c the cluster's transform, p_v the rest position. A vertex without
// weights stays at rest. With two handles it costs about 7 ns per vertex. Allocates nothing. Gives the same bits on
// every machine.
#pragma once
#include "deform/bands.h"
#include "deform/rotation.h"

namespace hf_inner::deform {

// A row-major 3 x 4 transform: x = A (p, 1), in the unit of the scaled mesh.
struct Affine {
  double a[3][4];
};

// Turns a rigid motion x = R p + t into a transform.
Affine to_affine(const RigidMotion& motion) noexcept;

// Lists in `weights` the blocks of eight vertices that share most of their clusters. The work of a block grows with the
// number of different clusters in it; without a block, each vertex pays for its own clusters. Neighbouring vertices
// share clusters in every mesh but a shuffled one. Cost: two passes over the weights. When it throws, `weights` has no
// blocks.
void list_blocks(ClusterWeights& weights, JobRunner& jobs);

// Writes the blended positions, moved to offset + scale x. columns: scratch of column_count() numbers, aligned to 64
// bytes. packed: null, or three floats per vertex that get the same positions.
inline std::size_t column_count(const ClusterWeights& weights) noexcept {
  return 16 * static_cast<std::size_t>(weights.cluster_count);
}
void blend(const mesh::Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, double* columns,
           Vec3 offset, double scale, Vec3* positions, float* packed, JobRunner& jobs);

// Returns the mean of the clusters' rotations at one vertex, by its weights.
Quaternion blended_rotation(const ClusterWeights& weights, const Vector<Quaternion>& by_cluster,
                            std::int32_t v) noexcept;

// Returns the blended position of one vertex, in the unit of the scaled mesh.
Vec3 blend_vertex(const mesh::Mesh& mesh, const ClusterWeights& weights, const Affine* transforms,
                  std::int32_t v) noexcept;

}  // namespace hf_inner::deform
