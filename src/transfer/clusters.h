// Makes corresponding clusters on two surfaces with the same harmonic coordinates U (pair_fields.h).
//
// By default, a cluster is a kernel exp(-|U(v) - c|^2 / 2 s^2) of width s around a centre c. U(v) and c hold one number
// per field. The centres are a farthest-point sample of the target vertices' U. Source and target share the centres.
// This generalises the corresponding iso-levels of Xu et al. 2009, Section 6, to all fields at once.
// cluster_scheme.h is an interface to other clusters.
//
// Each target vertex keeps its four largest weights. They fall to zero where a fifth would replace one of them. They
// are multiples of 2^-24 that sum to exactly 1. On the source, each cluster has a narrow and a broad kernel. Their
// widths adapt to coarse meshes. The broad kernel decides where the narrow one is uncertain. Each change of the pairs
// costs O(n C H) for n vertices, C clusters and H pairs.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/span.h"
#include "surface/core.h"
#include "transfer/cluster_scheme.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

struct ClusterOptions {
  const ClusterScheme* scheme = nullptr;  // null: kernels around centres
  std::int32_t cluster_count = 0;         // 0: default_cluster_count, or the default of the scheme
  double kernel_width = default_kernel_width;
};

// The moment matrix M from which the rotation of a cluster is computed. p are rest positions, q posed positions, and
// p', q' their means. The sum runs over edges; a scheme can sum
// over vertices:
//     M = sum_ij w_ij (q_i - q_j)(p_i - p_j)',     M = sum_i w_i (q_i - q')(p_i - p')'.
// An edge sum ignores how two parts shift against each other, which improves the results on the animals. Both sums are
// linear in q. A kernel therefore stores one constant vector g_v per vertex, and M = sum_v q_v g_v':
//     g_v = sum_j w_vj (p_v - p_j),     g_v = w_v (p_v - p'),     sum_v g_v = 0.
// This has a third of the terms and reads no rest positions. Rows are compressed and scaled, so that M has trace 1 at
// rest. A cluster without extent has g = 0.
struct SourceKernels {
  explicit SourceKernels(Memory& memory) : start(&memory), vertex(&memory), slope(&memory) {}
  Vector<std::int32_t> start, vertex;
  Vector<Vec3> slope;  // g
};

struct Clusters {
  explicit Clusters(Memory& memory)
      : centre(&memory),
        joint(&memory),
        weight(&memory),
        mass(&memory),
        pivot(&memory),
        support(&memory),
        narrow(memory),
        broad(memory) {}
  std::int32_t count = 0, field_count = 0;
  Vector<double> centre;       // count x field_count
  Vector<std::int32_t> joint;  // blend_count per target vertex, by falling weight
  Vector<float> weight;
  Vector<double> mass;           // per cluster: share of the target's area, summing to 1
  Vector<Vec3> pivot;            // rest centroid on the target, inner coordinates
  Vector<std::int32_t> support;  // source vertices within one kernel width; few make a rotation uncertain
  SourceKernels narrow, broad;
};

// Returns the vertex areas of a mesh, scaled to sum 1. A floor gives every vertex some weight.
Vector<double> area_shares(const mesh::Mesh& mesh, Memory& memory);

Clusters make_clusters(const ClusterOptions& options, std::int32_t field_count, Span<const double> source_field,
                       Span<const double> source_area, const surface::Core& source_core,
                       Span<const double> target_field, Span<const double> target_area, const mesh::Mesh& target_mesh,
                       Memory& memory, JobRunner& jobs);

// The weights of the source's vertices in the same clusters, computed as on the target.
struct SourceWeights {
  explicit SourceWeights(Memory& memory) : joint(&memory), weight(&memory) {}
  Vector<std::int32_t> joint;  // blend_count per source vertex, by falling weight
  Vector<float> weight;
};
SourceWeights weigh_source(const Clusters& clusters, double kernel_width, Span<const double> source_field,
                           Memory& memory, JobRunner& jobs);

// Writes the four (or fewer) largest weights of one vertex, taken from `count` candidates. They are multiples of 2^-24
// with sum exactly 1. The candidates end up sorted.
struct ClusterWeight {
  std::int32_t cluster = 0;
  double weight = 0;
};
void write_weights(ClusterWeight* candidates, std::int32_t count, std::int32_t* joint, float* weight) noexcept;

}  // namespace hf_inner::transfer
