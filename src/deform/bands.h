// Deformation clusters: the level bands of the handles' fields, split by connected component, overlapping, with
// weights.
//
// The level s(phi) of a handle's field is cut by a clamped B-spline basis B_0 .. B_{K+1}, of degree 1 (the paper's
// linear bands, Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.2) or 2 (no banding in the blended surface). B_{K+1} is
// the handle itself, B_0 the other handles, with shares phi_j / (1 - phi): handles are clusters, and the vertices of a
// handle belong to it alone. Each connected piece of {B_k > 0}, 0 < k <= K, is a cluster of its own. With two handles
// in a component one field says all; with more, each field i counts with beta_i = max(0, phi_i - 0.3 |phi|), a prune
// without cracks (measured on a scan with three handles: 2 per cent more energy than with 0.03, half the weights; a
// quarter of them with eight handles on a torus), and the level is eased towards the handles (levels.h): a scan held by
// its feet and pulled by a hand keeps its worst triangle at 0.67 instead of 0.63 and changes dihedral angles by 14
// degrees instead of 26, for 6 per cent more energy; bars and cylinders, held at both ends, gain nothing. A component
// with one handle moves with it, one without stays. Cost: O(n) per field. On failure nothing is left behind.
#pragma once
#include <cstdint>

#include "deform/levels.h"

namespace hf_inner {

struct BandOptions {
  int degree = 2;
  LevelSpacing spacing = LevelSpacing::equal_length;
  std::int32_t band_count = 10;  // K wished for; see bands_for
};

// The dense solve over clusters grows with their cube: bands are made wider, and small pieces dropped, to stay below.
constexpr std::int32_t free_cluster_target = 480;
constexpr std::int32_t free_cluster_limit = 768;

// Bands per field when there are `field_count` fields: never more than wished, at least 2, together about
// free_cluster_target.
std::int32_t bands_for(std::int32_t wished, std::int32_t field_count) noexcept;

// Weights of vertices in clusters, by vertex, clusters ascending. They are multiples of 2^-24 and sum to 1 exactly: six
// bytes an entry hold them, and a motion that all clusters share comes back to rounding. Vertices of components without
// a handle have none. Clusters 0 .. handle_count - 1 are the handles.
struct ClusterWeights {
  explicit ClusterWeights(Memory& memory)
      : start(&memory),
        cluster(&memory),
        weight(&memory),
        block_start(&memory),
        block_cluster(&memory),
        block_weight(&memory),
        elastic_components(&memory),
        shared(&memory) {}
  Vector<std::int32_t> start;
  Vector<std::uint16_t> cluster;
  Vector<float> weight;
  // The same by blocks of eight vertices in a row (list_blocks in blend.h): entries block_start[b] .. block_start[b + 1] are the
  // clusters of any of them, ascending, with eight weights each, zeros filled in. A block without entries is to be read
  // vertex by vertex; the vertices after the last whole block have none.
  Vector<std::int32_t> block_start;
  Vector<std::uint16_t> block_cluster;
  Vector<float> block_weight;
  Vector<std::int32_t> elastic_components;  // those with free clusters, ascending
  Vector<std::uint8_t> shared;              // of elastic_components: more than two handles meet there
  std::int32_t handle_count = 0;
  std::int32_t cluster_count = 0;
  std::int32_t band_count = 0;  // K in use
  std::int32_t unreached_vertex_count = 0;
  std::int32_t free_count() const noexcept { return cluster_count - handle_count; }
};

ClusterWeights make_cluster_weights(const Core& core, const Rest& rest, const Reach& reach, const HandleFields& fields,
                                    const BandOptions& options, Memory& memory);

}  // namespace hf_inner
