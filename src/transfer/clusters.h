// Corresponding clusters of two surfaces with the same harmonic coordinates U (pair_fields.h).
//
// Default: a cluster is a kernel exp(-|U(v) - c|^2 / 2 s^2) around a centre c in the space of all fields; centres are a
// farthest-point sample of the target's rows. The same centre on source and target is the correspondence of iso-levels
// of Xu et al. 2009, Section 6, in all fields at once. Paper: a cluster is a level band of one field, a hat function of
// u_h times u_h^4, the same function on both surfaces.
//
// Target: each vertex keeps its four largest weights, brought to zero where a fifth would take over, multiples of 2^-24
// that sum to exactly 1. Source: a kernel per cluster with the width at least the distance of the 6th nearest vertex
// (coarse meshes), cut at 2.5 widths, and a broad one three times as wide that steadies the first. Cost: O(n C H) once
// per change of pairs.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/span.h"
#include "engine/core.h"

namespace hf_inner {

constexpr std::int32_t blend_count = 4;  // clusters per target vertex

struct ClusterOptions {
  bool paper_bands = false;
  std::int32_t cluster_count = 0;  // 0 = 80, or eight bands per field
  double kernel_width = 0.04;
};

// What the rotation of a cluster is fitted to: M = sum_ij w_ij (q_i - q_j)(p_i - p_j)' over edges, or
// M = sum_i w_i (q_i - q')(p_i - p')' over vertices about their centroid (the paper's shape matching). Edges see only
// how the surface turns, not how its parts shift against each other: 10 to 20 % nearer to the truth on the animals
// measured. Both are linear in q, so a kernel is kept as M = sum_v q_v g_v', one constant g_v per vertex:
//     g_v = sum_j w_vj (p_v - p_j),     g_v = w_v (p_v - p'),      sum_v g_v = 0
// a third as many terms as edges, and no rest position is read. Compressed rows; scaled so that the trace of M at rest
// is 1 (g = 0 for a cluster without extent).
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
  Vector<std::int32_t> support;  // source vertices within reach of the base width: few of them make a cluster uncertain
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
