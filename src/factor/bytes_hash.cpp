#include "factor/bytes_hash.h"

#include "base/compiler.h"

namespace hf_inner::factor {
namespace {

// The hash runs this many independent chains of multiplications; with one, each multiplication would wait for the last.
// A change of this number would change the saved format.
constexpr int chains = 8;
// The hash asks for memory this many bytes ahead. Otherwise its chains of multiplications would wait for memory.
// Half and twice the value take the same time within the noise of 10 %.
constexpr int bytes_ahead = 4096;

}  // namespace

std::uint64_t hash_piece(const std::uint8_t* bytes, std::uint64_t length) noexcept {
  std::uint64_t chain[chains] = {1, 2, 3, 4, 5, 6, 7, 8};
  std::uint64_t k = 0;
  for (; k + 8 * chains <= length; k += 8 * chains) {
    HF_PREFETCH(bytes + k + bytes_ahead);
    std::uint64_t word[chains];
    std::memcpy(word, bytes + k, sizeof word);
    for (int c = 0; c < chains; ++c) chain[c] = hash_step(chain[c], word[c]);
  }
  for (int c = 0; k < length; k += 8, ++c) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + k, static_cast<std::size_t>(std::min<std::uint64_t>(8, length - k)));
    chain[c] = hash_step(chain[c], word);
  }
  std::uint64_t state = length;
  for (const std::uint64_t c : chain) state = hash_step(state, c);
  return state;
}

}  // namespace hf_inner::factor
