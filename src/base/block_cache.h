// Freed blocks of a Memory, kept for the next allocation of the same size.
//
// A drag frees and allocates the same blocks in every frame. With the cache it asks the host for none. Small sizes are
// rounded up to classes, so that blocks of nearly equal sizes serve each other. Large blocks match by their exact size:
// they are vectors over all vertices.
//
// Thread safety: any thread. No thread waits for another one to allocate: take and put find nothing while another
// thread is inside.
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
  // How many bytes may be kept while `live` bytes are in use.
  static std::uint64_t room(std::uint64_t live) noexcept {
    return live / share > least_room ? live / share : least_room;
  }

  // Returns a kept block, or null. bytes and alignment: as rounded() and aligned() give them.
  void* take(std::size_t bytes, std::size_t alignment) noexcept;
  // Keeps a block. full: there is no room beside the kept ones. refused: it alone is larger than `most`, its alignment is
  // unusual, or another thread is inside.
  enum class Answer { kept, full, refused };
  Answer put(void* block, std::size_t bytes, std::size_t alignment, std::uint64_t most) noexcept;
  std::uint64_t bytes() const noexcept { return bytes_.load(std::memory_order_relaxed); }
  // Calls give(block, bytes, alignment) for each kept block, and keeps none. The lock is free meanwhile: give may call
  // the host. Returns true if there were some.
  template <class Give>
  bool empty(Give&& give) noexcept {
    if (bytes() == 0) return false;
    const Blocks all = take_all();
    for (std::size_t k = 0; k < all.large_count; ++k) give(all.large[k].block, all.large[k].bytes, all.large[k].alignment);
    for (std::size_t k = 0; k < 2 * classes; ++k) {
      for (Free* block = all.small[k / classes][k % classes]; block;) {
        Free* const next = block->next;
        give(block, size_of_class(k % classes), k / classes ? line : least_alignment);
        block = next;
      }
    }
    return true;
  }

 private:
  struct Free {
    Free* next;
  };
  struct Large {
    void* block;
    std::size_t bytes, alignment;
  };
  // The share of the bytes in use that is kept. A drag of one site uses some vectors over all vertices, and a factor is
  // as large as a hundred of them.
  static constexpr std::uint64_t share = 32;
  // Bytes that are kept on small surfaces: the dense rows of some dozen sites.
  static constexpr std::uint64_t least_room = std::uint64_t{1} << 18;
  static constexpr std::size_t least_alignment = 16, line = 64;  // bytes; every block has one of the two, or is not kept
  static constexpr std::size_t classes = 80;                     // up to 64 KiB, see block_cache.cpp
  static constexpr std::size_t most_large = 16;                  // a drag uses a handful
  struct Blocks {
    Free* small[2][classes];  // by alignment
    Large large[most_large];
    std::size_t large_count;
  };
  static std::size_t class_of(std::size_t bytes) noexcept;
  static std::size_t size_of_class(std::size_t number) noexcept;
  Blocks take_all() noexcept;

  std::mutex mutex_;
  Blocks blocks_{};
  std::atomic<std::uint64_t> bytes_{0};
};

}  // namespace hf_inner
