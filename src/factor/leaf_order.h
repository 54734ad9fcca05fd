// Exact minimum degree on a small graph whose last vertices (the halo: neighbours that are eliminated later) only
// count. Adjacency is kept as bit rows: eliminating a vertex is OR and popcount. Ties go to the lowest vertex. Cost:
// O(n deg n / 64).
#pragma once
#include <cstdint>

#include "base/memory.h"

namespace hf_inner {

class LeafOrder {
 public:
  explicit LeafOrder(Memory& memory) : rows_(&memory), degree_(&memory), left_(&memory) {}
  // Clears the graph: `inner` vertices to order, then `halo` vertices.
  void reset(std::int32_t inner, std::int32_t halo);
  void add_edge(std::int32_t a, std::int32_t b) noexcept {
    rows_[static_cast<std::size_t>(a) * words_ + (b >> 6)] |= std::uint64_t{1} << (b & 63);
    rows_[static_cast<std::size_t>(b) * words_ + (a >> 6)] |= std::uint64_t{1} << (a & 63);
  }
  // out[k] = inner vertex eliminated k-th.
  void run(std::int32_t* out);

 private:
  std::int32_t inner_ = 0, words_ = 0;
  Vector<std::uint64_t> rows_;
  Vector<std::int32_t> degree_, left_;
};

}  // namespace hf_inner
