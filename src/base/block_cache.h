// Freed blocks of a Memory, kept for the next allocation of the same size.
//
// A drag frees and allocates the same blocks in every frame. With the cache it asks the host for none. Small sizes are
// rounded up to classes, so that blocks of nearly equal sizes serve each other. Large blocks match by their exact size:
// they are vectors over all vertices. The kept bytes stay below a share of the bytes in use. A full cache is emptied:
// after a long call it holds the sizes of that call, which the next call does not want.
//
// Thread safety: any thread.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace hf_inner {

class BlockCache {
 public:
  // The size and alignment that a block has for the host.
  static std::size_t rounded(std::size_t bytes) noexcept;
  static std::size_t aligned(std::size_t alignment) noexcept {
    return alignment < least_alignment ? least_alignment : alignment;
  }

  // Returns a kept block, or null. bytes and alignment: as rounded() and aligned() give them.
  void* take(std::size_t bytes, std::size_t alignment) noexcept;
  // Keeps a block, or returns false: it has an unusual alignment, or it alone is larger than the room. live: bytes in
  // use. full: set if the cache must be emptied first.
  bool put(void* block, std::size_t bytes, std::size_t alignment, std::uint64_t live, bool& full) noexcept;
  std::uint64_t bytes() const noexcept { return bytes_.load(std::memory_order_relaxed); }
  // Takes one block after the other out, until it returns null.
  void* take_any(std::size_t& bytes, std::size_t& alignment) noexcept;

 private:
  struct Free {
    Free* next;
  };
  struct Large {
    void* block;
    std::size_t bytes, alignment;
  };
  static constexpr std::size_t least_alignment = 16, line = 64;  // bytes; every block has one of the two, or is not kept
  static constexpr std::size_t classes = 80;                     // up to 64 KiB, see block_cache.cpp
  static constexpr std::size_t most_large = 16;                  // a drag uses a handful
  static std::size_t class_of(std::size_t bytes) noexcept;
  static std::size_t size_of_class(std::size_t number) noexcept;

  std::mutex mutex_;
  Free* small_[2][classes] = {};  // by alignment
  Large large_[most_large] = {};
  std::size_t large_count_ = 0;
  std::atomic<std::uint64_t> bytes_{0};
};

}  // namespace hf_inner
