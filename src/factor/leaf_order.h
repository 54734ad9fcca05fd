// Orders a small graph by exact minimum degree.
//
// The last vertices are the halo: neighbours that are eliminated later. They count in degrees but get no place in the
// order. Adjacency is stored as rows of bits, so eliminating a vertex is OR and popcount. Ties go to the lowest vertex.
// Cost: O(n deg n / 64) for n vertices of mean degree deg.
#pragma once
#include <cstdint>

#include "base/memory.h"

namespace hf_inner::factor {

class LeafOrder {
 public:
  explicit LeafOrder(Memory& memory) : rows_(&memory), degree_(&memory), left_(&memory) {}
  // Clears the graph. It then has `inner` vertices to order, followed by `halo` vertices, which only count as
  // neighbours.
  void reset(std::int32_t inner, std::int32_t halo);
  void add_edge(std::int32_t a, std::int32_t b) noexcept {
    rows_[static_cast<std::size_t>(a) * words_ + (b >> 6)] |= std::uint64_t{1} << (b & 63);
    rows_[static_cast<std::size_t>(b) * words_ + (a >> 6)] |= std::uint64_t{1} << (a & 63);
  }
  // Fills out[k] with the inner vertex that is eliminated k-th.
  void run(std::int32_t* out);

 private:
  std::int32_t inner_ = 0, words_ = 0;
  Vector<std::uint64_t> rows_;
  Vector<std::int32_t> degree_, left_;
};

}  // namespace hf_inner::factor
