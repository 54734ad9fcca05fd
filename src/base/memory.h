// Memory counts and limits every allocation of a surface and of the objects made on it. It allocates through the host's
// functions or malloc, and counts live and peak bytes. It keeps freed blocks for the next call (block_cache.h), so that
// a drag allocates nothing from the host. Kept blocks are not live. They go back to the host when a call is refused,
// when the host or the limit has no more memory, and when an object is destroyed.
//
// Two containers use it: Vector<T> (std::pmr::vector) for small and growing arrays, and Buffer<T> for large numeric
// arrays (64-byte aligned, not initialised). A failed allocation throws std::bad_alloc and leaves earlier allocations
// intact. A Memory must outlive everything allocated from it, so handles share it by std::shared_ptr. Thread safety:
// any thread may allocate and deallocate if the host's functions allow it; the default functions do.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

#include "base/block_cache.h"
#include "hf/base.h"

namespace hf_inner {

// A byte limit refused an allocation. The numbers are for the message: `needed` counts the bytes in use and the block.
class MemoryLimitReached final : public std::bad_alloc {
 public:
  MemoryLimitReached(std::uint64_t byte_limit, std::uint64_t in_use, std::uint64_t block) noexcept
      : limit(byte_limit), used(in_use), needed(in_use + block) {}
  const char* what() const noexcept override { return "the memory limit is reached"; }
  const std::uint64_t limit, used, needed;  // bytes
};

class Memory final : public std::pmr::memory_resource {
 public:
  Memory() noexcept = default;
  // hooks: the host's allocation functions; both set, or both null for malloc. byte_limit: at most this many bytes are
  // allocated at once; 0 = no limit.
  explicit Memory(const hf_allocator& hooks, std::uint64_t byte_limit = 0) noexcept
      : hooks_(hooks), byte_limit_(byte_limit) {}
  ~Memory() { release_kept(); }

  // The bytes from the host that are in use.
  std::uint64_t live_bytes() const noexcept { return live_.load(std::memory_order_relaxed); }
  // Bytes that may still be allocated before the byte limit refuses.
  std::uint64_t room() const noexcept {
    const std::uint64_t live = live_bytes();
    return byte_limit_ == 0 ? UINT64_MAX : byte_limit_ > live ? byte_limit_ - live : 0;
  }
  std::uint64_t peak_bytes() const noexcept { return peak_.load(std::memory_order_relaxed); }
  std::uint64_t allocation_count() const noexcept { return count_.load(std::memory_order_relaxed); }
  // Gives the kept blocks back to the host. Returns true if there were some.
  bool release_kept() noexcept;

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* pointer, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
  void* ask_host(std::size_t bytes, std::size_t alignment);
  void give_host(void* pointer, std::size_t bytes, std::size_t alignment) noexcept;

  hf_allocator hooks_{};
  std::uint64_t byte_limit_ = 0;
  std::atomic<std::uint64_t> live_{0}, peak_{0}, count_{0};
  BlockCache kept_;
};

// Makes a Memory object whose own block also comes from the hooks. Throws std::bad_alloc.
std::shared_ptr<Memory> make_memory(const hf_allocator& hooks, std::uint64_t byte_limit);

template <class T>
using Vector = std::pmr::vector<T>;

// Does the same as std::make_shared, but takes the block from `memory`. Use it for objects that do not own that Memory;
// see make_owner_in.
template <class T, class... Arguments>
std::shared_ptr<T> make_shared_in(Memory& memory, Arguments&&... arguments) {
  return std::allocate_shared<T>(std::pmr::polymorphic_allocator<T>(&memory), std::forward<Arguments>(arguments)...);
}

// An allocator that keeps its Memory alive. It serves objects that lie in a Memory and also own it, directly or through
// their members. Such an object frees its block after its own destructor, when no other owner of the Memory may be
// left.
template <class T>
struct OwningAllocator {
  using value_type = T;
  explicit OwningAllocator(std::shared_ptr<Memory> owner) noexcept : memory(std::move(owner)) {}
  template <class U>
  OwningAllocator(const OwningAllocator<U>& other) noexcept : memory(other.memory) {}
  T* allocate(std::size_t count) { return static_cast<T*>(memory->allocate(count * sizeof(T), alignof(T))); }
  void deallocate(T* block, std::size_t count) noexcept { memory->deallocate(block, count * sizeof(T), alignof(T)); }
  template <class U>
  bool operator==(const OwningAllocator<U>& other) const noexcept {
    return memory == other.memory;
  }
  template <class U>
  bool operator!=(const OwningAllocator<U>& other) const noexcept {
    return memory != other.memory;
  }
  std::shared_ptr<Memory> memory;
};

// Does the same as std::make_shared, for objects that own the Memory they lie in.
template <class T, class... Arguments>
std::shared_ptr<T> make_owner_in(const std::shared_ptr<Memory>& memory, Arguments&&... arguments) {
  return std::allocate_shared<T>(OwningAllocator<T>(memory), std::forward<Arguments>(arguments)...);
}

// An uninitialised array of trivially copyable T, aligned to 64 bytes. It can be moved but not copied.
template <class T>
class Buffer {
 public:
  static_assert(std::is_trivially_copyable_v<T>);
  Buffer() noexcept = default;
  Buffer(Memory& memory, std::size_t size) { allocate(memory, size); }
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    Buffer moved(std::move(other));
    swap(moved);
    return *this;
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { release(); }

  // Replaces the contents by `size` uninitialised elements. If it throws std::bad_alloc, the old contents remain.
  void allocate(Memory& memory, std::size_t size) {
    if (size > most_bytes / sizeof(T)) throw std::bad_alloc();
    T* fresh = size ? static_cast<T*>(memory.allocate(size * sizeof(T), alignment)) : nullptr;
    release();
    memory_ = &memory;
    data_ = fresh;
    size_ = size;
  }
  // Makes the buffer a read-only view of `size` elements at `data`. The caller keeps these elements alive.
  void borrow(const T* data, std::size_t size) noexcept {
    release();
    memory_ = nullptr;
    data_ = const_cast<T*>(data);
    size_ = size;
  }
  // Makes room for `size` elements. It keeps the present block if that is large enough. The contents are not preserved.
  void reserve_at_least(Memory& memory, std::size_t size) {
    if (size > size_) allocate(memory, size);
  }
  void release() noexcept {
    if (memory_ && data_) memory_->deallocate(data_, size_ * sizeof(T), alignment);
    data_ = nullptr;
    size_ = 0;
  }
  void swap(Buffer& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  T* data() noexcept { return data_; }
  const T* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  T* begin() noexcept { return data_; }
  T* end() noexcept { return data_ + size_; }
  const T* begin() const noexcept { return data_; }
  const T* end() const noexcept { return data_ + size_; }

  // The alignment in bytes is one cache line, which is also the size of the widest vector register.
  static constexpr std::size_t alignment = 64;
  // Largest number of bytes of a buffer. The limit keeps size * sizeof(T) from overflowing.
  static constexpr std::size_t most_bytes = static_cast<std::size_t>(-1) / 16;

 private:
  Memory* memory_ = nullptr;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace hf_inner
