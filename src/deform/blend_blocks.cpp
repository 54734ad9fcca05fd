#include <algorithm>

#include "deform/blend.h"
#include "deform/rest.h"

namespace hf_inner::deform {
namespace {

constexpr std::int32_t lanes = 8;

// Whether eight vertices have the same clusters.
bool same_clusters(const ClusterWeights& weights, const std::int32_t* start) noexcept {
  const std::uint16_t* const first = weights.cluster.data() + start[0];
  const std::int32_t width = start[1] - start[0];
  for (std::int32_t l = 1; l < lanes; ++l) {
    if (start[l + 1] - start[l] != width || !std::equal(first, first + width, first + l * width)) return false;
  }
  return true;
}

// Calls use(cluster, eight weights) for every cluster that moves one of eight vertices (a block), in ascending order.
// Returns the number of clusters. It returns 0 when blending the eight together is no quicker: a vertex has no cluster,
// or they share too few clusters (block_sharing).
template <class Use>
std::int32_t merge_block(const ClusterWeights& weights, std::int32_t block, Use&& use) noexcept {
  constexpr std::int32_t none = 0x10000;
  const std::int32_t* start = weights.start.data() + static_cast<std::size_t>(lanes) * static_cast<std::size_t>(block);
  const std::int32_t limit = (start[lanes] - start[0] + lanes) / block_sharing;
  std::int32_t next[lanes], count = 0;
  for (std::int32_t l = 0; l < lanes; ++l) {
    next[l] = start[l];
    if (start[l] == start[l + 1]) return 0;
  }
  if (same_clusters(weights, start)) {  // most blocks
    const std::int32_t width = start[1] - start[0];
    if (width > limit) return 0;
    for (std::int32_t k = 0; k < width; ++k) {
      float row[lanes];
      for (std::int32_t l = 0; l < lanes; ++l) row[l] = weights.weight[start[l] + k];
      use(weights.cluster[start[0] + k], row);
    }
    return width;
  }
  for (;;) {
    std::int32_t smallest = none;
    for (std::int32_t l = 0; l < lanes; ++l) {
      if (next[l] < start[l + 1]) smallest = std::min<std::int32_t>(smallest, weights.cluster[next[l]]);
    }
    if (smallest == none) return count;
    if (++count > limit) return 0;
    float row[lanes];
    for (std::int32_t l = 0; l < lanes; ++l) {
      const bool has = next[l] < start[l + 1] && weights.cluster[next[l]] == smallest;
      row[l] = has ? weights.weight[next[l]] : 0.0f;
      next[l] += has;
    }
    use(static_cast<std::uint16_t>(smallest), row);
  }
}

}  // namespace

void list_blocks(ClusterWeights& weights, JobRunner& jobs) {
  const std::int32_t blocks = static_cast<std::int32_t>(weights.start.size() - 1) / lanes;
  const std::int32_t parts = (blocks + blocks_at_once - 1) / blocks_at_once;
  const auto allocator = weights.start.get_allocator();
  struct Entry {
    std::uint16_t cluster;
    float weight[lanes];
  };
  Vector<Vector<Entry>> entries(static_cast<std::size_t>(parts), allocator);
  Vector<std::int32_t> begin(blocks + 1, 0, allocator);
  jobs.for_each(static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
    const std::int32_t first = static_cast<std::int32_t>(part) * blocks_at_once;
    Vector<Entry>& own = entries[part];
    own.reserve(static_cast<std::size_t>(lanes * blocks_at_once));
    for (std::int32_t b = first; b < std::min(blocks, first + blocks_at_once); ++b) {
      const std::size_t before = own.size();
      begin[b + 1] = merge_block(weights, b, [&](std::uint16_t cluster, const float* row) {
        own.push_back({cluster, {}});
        std::copy_n(row, lanes, own.back().weight);
      });
      if (begin[b + 1] == 0) own.resize(before);
    }
  });
  for (std::int32_t b = 0; b < blocks; ++b) begin[b + 1] += begin[b];
  weights.block_cluster.resize(begin[blocks]);
  weights.block_weight.resize(static_cast<std::size_t>(lanes) * static_cast<std::size_t>(begin[blocks]));
  jobs.for_each(static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
    std::size_t at = static_cast<std::size_t>(begin[static_cast<std::int32_t>(part) * blocks_at_once]);
    for (const Entry& entry : entries[part]) {
      weights.block_cluster[at] = entry.cluster;
      std::copy_n(entry.weight, lanes, weights.block_weight.data() + lanes * at);
      ++at;
    }
  });
  weights.block_start = std::move(begin);
}

}  // namespace hf_inner::deform
