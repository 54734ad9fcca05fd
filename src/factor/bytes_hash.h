// Computes a 64-bit checksum of large byte blocks at the speed of memory. It finds damage and is not cryptographic.
//
// The bytes are cut into pieces of 64 KiB. A piece runs through eight chains, which take the little-endian words in
// turn. A step is state <- (state xor word) p; state <- state xor (state >> 32), where the odd number p is 2^64 /
// golden ratio. Every step is a bijection of the state and of the word, so one changed word always changes its chain,
// its piece and the whole. The pieces' values and the length run through one chain in their order. So the result is the
// same for any number of threads.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/jobs.h"
#include "base/memory.h"

namespace hf_inner::factor {

// The checksum is computed in pieces of this many bytes, one thread's job each. A change of this number would change
// the saved format.
constexpr std::uint64_t hash_piece_bytes = std::uint64_t{1} << 16;

inline std::uint64_t hash_step(std::uint64_t state, std::uint64_t word) noexcept {
  state = (state ^ word) * 0x9E3779B97F4A7C15ull;
  return state ^ (state >> 32);
}

// Computes the checksum of one piece of at most hash_piece_bytes. If the length is no multiple of eight, zeros fill the
// last word.
std::uint64_t hash_piece(const std::uint8_t* bytes, std::uint64_t length) noexcept;

// Computes the checksum of all bytes. also(begin, end) is called for every piece right after it was read, on the thread
// that read it. Allocates eight bytes for each piece.
template <class Also>
std::uint64_t hash_bytes(const std::uint8_t* bytes, std::uint64_t length, Memory& memory, JobRunner& jobs,
                         Also&& also) {
  const std::uint64_t pieces = (length + hash_piece_bytes - 1) / hash_piece_bytes;
  Buffer<std::uint64_t> value(memory, static_cast<std::size_t>(pieces));
  jobs.for_each(static_cast<std::uint32_t>(pieces), [&](std::uint32_t piece) {
    const std::uint64_t begin = piece * hash_piece_bytes, end = std::min(length, begin + hash_piece_bytes);
    value[piece] = hash_piece(bytes + begin, end - begin);
    also(begin, end);
  });
  std::uint64_t state = hash_step(0, length);
  for (const std::uint64_t v : value) state = hash_step(state, v);
  return state;
}

template <class T>
std::uint64_t hash_array(const T* values, std::size_t count, Memory& memory, JobRunner& jobs) {
  return hash_bytes(reinterpret_cast<const std::uint8_t*>(values), count * sizeof(T), memory, jobs,
                    [](std::uint64_t, std::uint64_t) {});
}

}  // namespace hf_inner::factor
