#include "factor/leaf_order.h"

#include <algorithm>

#include "base/compiler.h"

namespace hf_inner::factor {
namespace {

// Counts the set bits of a word; the plain instruction set has no instruction for it.
inline std::int32_t count_bits(std::uint64_t x) noexcept {
  x -= (x >> 1) & 0x5555555555555555ull;
  x = (x & 0x3333333333333333ull) + ((x >> 2) & 0x3333333333333333ull);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0full;
  return static_cast<std::int32_t>((x * 0x0101010101010101ull) >> 56);
}

}  // namespace

void LeafOrder::reset(std::int32_t inner, std::int32_t halo) {
  inner_ = inner;
  words_ = (inner + halo + 63) / 64;
  rows_.assign(static_cast<std::size_t>(inner + halo) * static_cast<std::size_t>(words_), 0);
  degree_.resize(static_cast<std::size_t>(inner));
  left_.resize(static_cast<std::size_t>(inner));
}

void LeafOrder::run(std::int32_t* out) {
  const auto row = [&](std::int32_t v) {
    return rows_.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(words_);
  };
  const auto count = [&](std::int32_t v) {
    std::int32_t bits = 0;
    for (std::int32_t w = 0; w < words_; ++w) bits += count_bits(row(v)[w]);
    return bits;
  };
  for (std::int32_t v = 0; v < inner_; ++v) {
    degree_[v] = count(v);
    left_[v] = v;
  }
  std::int32_t remaining = inner_;
  for (std::int32_t k = 0; k < inner_; ++k) {
    std::int32_t at = 0;
    for (std::int32_t i = 1; i < remaining; ++i) {
      if (degree_[left_[i]] < degree_[left_[at]]) at = i;
    }
    const std::int32_t v = left_[at];
    left_.erase(left_.begin() + at);
    left_.push_back(0);
    --remaining;
    out[k] = v;
    // The neighbours of the eliminated vertex become a clique.
    const std::uint64_t* own = row(v);
    for (std::int32_t w = 0; w < words_; ++w) {
      for (std::uint64_t bits = own[w]; bits != 0; bits &= bits - 1) {
        const std::int32_t u = 64 * w + trailing_zeros(bits);
        std::uint64_t* target = row(u);
        if (u >= inner_) break;  // neighbour lists of halo vertices (those eliminated later) are never read
        std::int32_t total = 0;
        for (std::int32_t x = 0; x < words_; ++x) {
          std::uint64_t merged = target[x] | own[x];
          if (x == v >> 6) merged &= ~(std::uint64_t{1} << (v & 63));
          if (x == u >> 6) merged &= ~(std::uint64_t{1} << (u & 63));
          target[x] = merged;
          total += count_bits(merged);
        }
        degree_[u] = total;
      }
    }
  }
}

}  // namespace hf_inner::factor
