#include <algorithm>

#include "deform/blend.h"
#include "deform/rest.h"

namespace hf_inner {
namespace {

constexpr std::int32_t lanes = 8;

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
  Vector<std::int32_t> begin(blocks + 1, 0, weights.start.get_allocator());
  const auto for_blocks = [&](auto&& loop) {
    jobs.for_each(static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
      const std::int32_t first = static_cast<std::int32_t>(part) * blocks_at_once;
      for (std::int32_t b = first; b < std::min(blocks, first + blocks_at_once); ++b) loop(b);
    });
  };
  for_blocks([&](std::int32_t b) { begin[b + 1] = merge_block(weights, b, [](std::uint16_t, const float*) {}); });
  for (std::int32_t b = 0; b < blocks; ++b) begin[b + 1] += begin[b];
  weights.block_cluster.resize(begin[blocks]);
  weights.block_weight.resize(static_cast<std::size_t>(lanes) * static_cast<std::size_t>(begin[blocks]));
  for_blocks([&](std::int32_t b) {
    std::size_t at = static_cast<std::size_t>(begin[b]);
    if (begin[b] == begin[b + 1]) return;
    merge_block(weights, b, [&](std::uint16_t cluster, const float* row) {
      weights.block_cluster[at] = cluster;
      std::copy_n(row, lanes, weights.block_weight.data() + lanes * at);
      ++at;
    });
  });
  weights.block_start = std::move(begin);
}

}  // namespace hf_inner
