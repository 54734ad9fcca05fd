// Makes deformation clusters: overlapping level bands of the handles' fields, with weights.
//
// A handle's field phi is turned into a level s(phi) (levels.h). A clamped B-spline basis B_0 .. B_{K+1} over s gives K
// bands. Degree 1 gives the paper's linear bands (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.2). Degree 2 gives a
// surface without visible bands. B_{K+1} is the handle itself. The other handles share B_0, each with the weight phi_j
// / (1 - phi). Handles are clusters, and the vertices of a handle belong to it alone. Each connected piece of {B_k >
// 0}, 0 < k <= K, is a cluster of its own.
//
// With two handles in a component, one field is enough. With more, field i has the share beta_i = max(0, phi_i -
// field_prune |phi|), and bending starts gradually at a handle (eased_level). A component with one handle moves with
// that handle. A component without a handle stays. Cost: O(n) per field. A failed call changes nothing.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/levels.h"

namespace hf_inner::deform {

struct BandOptions {
  int degree = 2;
  BandSpacing spacing = BandSpacing::equal_length;
  // Wished number of level bands per field (K); bands_for gives the real one.
  std::int32_t band_count = static_cast<std::int32_t>(default_pose_bands);
};

// Returns the number of level bands per field: at most `wished`, at least 2. All `field_count` fields together then
// have about free_cluster_target bands.
std::int32_t bands_for(std::int32_t wished, std::int32_t field_count) noexcept;

// The weights of vertices in clusters (handles and pieces of level bands). Each vertex has a row of entries with
// ascending cluster numbers. The weights of a row are multiples of 2^-24 and sum to exactly 1, so a motion that all
// clusters share comes back to rounding. An entry takes six bytes. Vertices of components without a handle have no
// entries. Clusters 0 .. handle_count - 1 are the handles.
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
  // The same weights for blocks of eight consecutive vertices (list_blocks in blend.h). Entries block_start[b] ..
  // block_start[b + 1] list the clusters of block b in ascending order. Each has eight weights, one per vertex, and 0
  // where a vertex does not use it. The blend reads a block without entries vertex by vertex. It does the same with the
  // vertices after the last whole block.
  Vector<std::int32_t> block_start;
  Vector<std::uint16_t> block_cluster;
  Vector<float> block_weight;
  Vector<std::int32_t> elastic_components;  // components with clusters that are no handles, ascending
  Vector<std::uint8_t> shared;              // by elastic component: 1 if more than two handles meet in it
  std::int32_t handle_count = 0;
  std::int32_t cluster_count = 0;
  std::int32_t band_count = 0;  // K, the level bands per field in use
  std::int32_t unreached_vertex_count = 0;
  std::int32_t free_count() const noexcept { return cluster_count - handle_count; }
};

ClusterWeights make_cluster_weights(const surface::Core& core, const Rest& rest, const Reach& reach,
                                    const HandleFields& fields, const BandOptions& options, Memory& memory);

}  // namespace hf_inner::deform
