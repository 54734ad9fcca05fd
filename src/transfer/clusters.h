// Makes corresponding clusters of two surfaces with the same harmonic coordinates U (pair_fields.h).
//
// Default: a cluster is a kernel exp(-|U(v) - c|^2 / 2 s^2) around a centre c in the space of all fields. Centres are a
// farthest-point sample of the target's rows. The same centre on source and target is the correspondence of iso-levels
// of Xu et al. 2009, Section 6, in all fields at once. Paper: a cluster is a level band of one field, a hat function of
// u_h times a power of u_h, the same on both surfaces.
//
// Target: each vertex keeps its four largest weights. They fall to zero where a fifth would take over. They are
// multiples of 2^-24 that sum to exactly 1. Source: each cluster has a narrow and a broad kernel. Their widths adapt to
// coarse meshes; the broad one decides where the narrow one is uncertain. Cost: O(n C H) once per change of pairs.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/span.h"
#include "engine/core.h"
#include "transfer/constants.h"

namespace hf_inner {

struct ClusterOptions {
  bool paper_bands = false;
  std::int32_t cluster_count = 0;  // 0 = default_cluster_count, or default_bands per field
  double kernel_width = default_kernel_width;
};

// The moment that the rotation of a cluster is fitted to. The default sums over edges, the paper over vertices:
//     M = sum_ij w_ij (q_i - q_j)(p_i - p_j)',     M = sum_i w_i (q_i - q')(p_i - p')'.
// Edges are blind to parts that shift against each other, which helps on the animals. Both sums are linear in q.
// A kernel is therefore stored as M = sum_v q_v g_v', with one constant g_v per vertex:
//     g_v = sum_j w_vj (p_v - p_j),     g_v = w_v (p_v - p'),     sum_v g_v = 0.
// That is a third of the terms, and no rest position is read. Rows are compressed and scaled so that M has trace 1 at
// rest; g = 0 for a cluster without extent.
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
  Vector<double> mass;           // share of the target's area, summing to 1
  Vector<Vec3> pivot;            // rest centroid on the target, inner coordinates
  Vector<std::int32_t> support;  // source vertices within the base width; few make a cluster uncertain
  SourceKernels narrow, broad;
};

// Vertex areas of a mesh, normalised to sum 1; floored, so that no vertex is without weight.
Vector<double> area_shares(const Mesh& mesh, Memory& memory);

Clusters make_clusters(const ClusterOptions& options, std::int32_t field_count, Span<const double> source_field,
                       Span<const double> source_area, const Core& source_core, Span<const double> target_field,
                       Span<const double> target_area, const Mesh& target_mesh, Memory& memory, JobRunner& jobs);

// The four (or fewer) weights of one vertex from `count` candidates, as multiples of 2^-24 with sum exactly 1; sorts
// the candidates.
struct Candidate {
  std::int32_t cluster = 0;
  double weight = 0;
};
void write_weights(Candidate* candidates, std::int32_t count, std::int32_t* joint, float* weight) noexcept;

}  // namespace hf_inner
