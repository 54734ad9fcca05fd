// Vertices from cluster transforms: x_v = sum_c W_vc A_c (p_v, 1); vertices without weights stay at rest.
// Cost: about 7 ns per vertex on two handles. Allocates nothing; the same bits on every machine.
#pragma once
#include "deform/bands.h"

namespace hf_inner {

// Row-major 3 x 4: x = A (p, 1), in the mesh's own unit.
struct Affine {
  double a[3][4];
};

// Fills the blocks of `weights` in: those whose vertices share most of their clusters, as eight in a row do in any mesh
// but a shuffled one. The work of a block grows with the clusters of any of its vertices, that of eight vertices with
// the clusters of each. Cost: two passes over the weights. When it throws there are no blocks.
void list_blocks(ClusterWeights& weights, JobRunner& jobs);

// Writes the blended positions, moved to offset + scale x. columns: scratch of column_count() numbers, on 64 bytes. packed: null, or three floats per vertex that get the same positions.
inline std::size_t column_count(const ClusterWeights& weights) noexcept {
  return 16 * static_cast<std::size_t>(weights.cluster_count);
}
void blend(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, double* columns, Vec3 offset,
           double scale, Vec3* positions, float* packed, JobRunner& jobs);

// One vertex, in the mesh's own unit.
Vec3 blend_vertex(const Mesh& mesh, const ClusterWeights& weights, const Affine* transforms, std::int32_t v) noexcept;

}  // namespace hf_inner
