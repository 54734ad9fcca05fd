// Size classes: multiples of 16 up to 128, then eight steps between two powers of two, so that a rounded block wastes at
// most an eighth.
#include "base/block_cache.h"

#include <new>

namespace hf_inner {
namespace {

constexpr std::size_t steps = 8, least_step = 16;
constexpr std::size_t most_rounded = std::size_t{1} << 16;

// The octave of a size: sizes of octave o are multiples of least_step << o, up to (steps * least_step) << (o + 1).
std::size_t octave_of(std::size_t bytes) noexcept {
  std::size_t octave = 0;
  while (bytes > (2 * steps * least_step) << octave) ++octave;
  return octave;
}

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
  if (this->bytes() < bytes) return nullptr;
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock) return nullptr;
  void* found = nullptr;
  if (bytes > most_rounded) {
    for (std::size_t k = 0; k < blocks_.large_count && !found; ++k) {
      const Large kept = blocks_.large[k];
      if (kept.bytes != bytes || kept.alignment != alignment) continue;
      found = kept.block;
      blocks_.large[k] = blocks_.large[--blocks_.large_count];
    }
  } else if (alignment == least_alignment || alignment == line) {
    Free*& first = blocks_.small[alignment == line][class_of(bytes)];
    found = first;
    if (first) first = first->next;
  }
  if (found) bytes_.fetch_sub(bytes, std::memory_order_relaxed);
  return found;
}

BlockCache::Answer BlockCache::put(void* block, std::size_t bytes, std::size_t alignment, std::uint64_t most) noexcept {
  if (bytes > most || (alignment != least_alignment && alignment != line)) return Answer::refused;
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock) return Answer::refused;
  if (this->bytes() > most - bytes) return Answer::full;
  if (bytes > most_rounded) {
    if (blocks_.large_count == most_large) return Answer::full;
    blocks_.large[blocks_.large_count++] = {block, bytes, alignment};
  } else {
    Free*& first = blocks_.small[alignment == line][class_of(bytes)];
    first = new (block) Free{first};
  }
  bytes_.fetch_add(bytes, std::memory_order_relaxed);
  return Answer::kept;
}

BlockCache::Blocks BlockCache::take_all() noexcept {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Blocks all = blocks_;
  blocks_ = Blocks{};
  bytes_.store(0, std::memory_order_relaxed);
  return all;
}

}  // namespace hf_inner
