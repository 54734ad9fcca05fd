// Size classes: multiples of 16 up to 128, then eight steps between two powers of two, so that a rounded block wastes at
// most an eighth.
#include "base/block_cache.h"

#include <new>

namespace hf_inner {
namespace {

constexpr std::size_t steps = 8, least_step = 16;
constexpr std::size_t most_rounded = std::size_t{1} << 16;
// The share of the bytes in use that is kept. A drag of one site uses some vectors over all vertices. The factor is as
// large as a hundred of them.
constexpr std::uint64_t share = 32;
constexpr std::uint64_t least_room = std::uint64_t{1} << 18;  // for small surfaces

// The octave of a size: sizes of octave o are multiples of least_step << o, up to (steps * least_step) << (o + 1).
std::size_t octave_of(std::size_t bytes) noexcept {
  std::size_t octave = 0;
  while (bytes > (2 * steps * least_step) << octave) ++octave;
  return octave;
}

// Under a sanitizer freed blocks go to the host at once, so that it sees who uses them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool keeps_blocks = false;
#else
constexpr bool keeps_blocks = true;
#endif

}  // namespace

std::size_t BlockCache::rounded(std::size_t bytes) noexcept {
  if (bytes > most_rounded) return bytes;
  const std::size_t step = least_step << octave_of(bytes);
  return bytes == 0 ? step : (bytes + step - 1) / step * step;
}

std::size_t BlockCache::class_of(std::size_t bytes) noexcept {
  const std::size_t octave = octave_of(bytes);
  return steps * octave + bytes / (least_step << octave) - 1;
}

std::size_t BlockCache::size_of_class(std::size_t number) noexcept {
  if (number < 2 * steps) return least_step * (number + 1);
  const std::size_t octave = number / steps - 1;
  return (least_step << octave) * (number - steps * octave + 1);
}

void* BlockCache::take(std::size_t bytes, std::size_t alignment) noexcept {
  if (bytes_.load(std::memory_order_relaxed) < bytes) return nullptr;
  const std::lock_guard<std::mutex> lock(mutex_);
  void* found = nullptr;
  if (bytes > most_rounded) {
    for (std::size_t k = 0; k < large_count_ && !found; ++k) {
      if (large_[k].bytes != bytes || large_[k].alignment != alignment) continue;
      found = large_[k].block;
      large_[k] = large_[--large_count_];
    }
  } else if (alignment == least_alignment || alignment == line) {
    Free*& first = small_[alignment == line][class_of(bytes)];
    found = first;
    if (first) first = first->next;
  }
  if (found) bytes_.fetch_sub(bytes, std::memory_order_relaxed);
  return found;
}

bool BlockCache::put(void* block, std::size_t bytes, std::size_t alignment, std::uint64_t live, bool& full) noexcept {
  const std::uint64_t room = live / share > least_room ? live / share : least_room;
  if (!keeps_blocks || bytes > room || (alignment != least_alignment && alignment != line)) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  full = bytes_.load(std::memory_order_relaxed) + bytes > room || (bytes > most_rounded && large_count_ == most_large);
  if (full) return false;
  if (bytes > most_rounded) {
    large_[large_count_++] = {block, bytes, alignment};
  } else {
    Free*& first = small_[alignment == line][class_of(bytes)];
    first = new (block) Free{first};
  }
  bytes_.fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

void* BlockCache::take_any(std::size_t& bytes, std::size_t& alignment) noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  void* found = nullptr;
  if (large_count_ > 0) {
    const Large& last = large_[--large_count_];
    found = last.block;
    bytes = last.bytes;
    alignment = last.alignment;
  }
  for (std::size_t k = 0; k < 2 * classes && !found; ++k) {
    Free*& first = small_[k / classes][k % classes];
    if (!first) continue;
    found = first;
    first = first->next;
    bytes = size_of_class(k % classes);
    alignment = k / classes ? line : least_alignment;
  }
  if (found) bytes_.fetch_sub(bytes, std::memory_order_relaxed);
  return found;
}

}  // namespace hf_inner
