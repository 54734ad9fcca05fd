// Deformation clusters: overlapping level bands of the handles' fields, with weights.
//
// A clamped B-spline basis B_0 .. B_{K+1} cuts the level s(phi) of a handle's field (levels.h). Degree 1 gives the
// paper's linear bands (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.2), degree 2 a surface without visible bands.
// B_{K+1} is the handle itself. B_0 is shared by the other handles as phi_j / (1 - phi). Handles are clusters, and the
// vertices of a handle belong to it alone. Each connected piece of {B_k > 0}, 0 < k <= K, is a cluster of its own.
//
// With two handles in a component one field is enough. With more, field i counts with beta_i = max(0, phi_i -
// field_prune |phi|), which is continuous, and levels are eased towards the handles (levels.h). A component with one
// handle moves with it; one without stays. Cost: O(n) per field. On failure nothing is left behind.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/levels.h"

namespace hf_inner {

struct BandOptions {
  int degree = 2;
  BandSpacing spacing = BandSpacing::equal_length;
  std::int32_t band_count = static_cast<std::int32_t>(default_bands_smooth);  // K wished for; see bands_for
};

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
  // The same by blocks of eight consecutive vertices (list_blocks in blend.h). Entries block_start[b] .. block_start[b +
  // 1] are the clusters of any of them, ascending, with eight weights each; missing ones are 0. A block without entries
  // is read vertex by vertex, as are the vertices after the last whole block.
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
