#include "base/memory.h"

#include <cstdlib>
#include <exception>

#if defined(__linux__)
#include <sys/mman.h>
#elif defined(_WIN32)
#include <malloc.h>
#endif

#include "base/compiler.h"

namespace hf_inner {
namespace {

// A large page has this size on Linux. Reading a factor of 130 MB through pages of 4 KiB takes several times as long.
constexpr std::size_t huge_page = std::size_t{2} << 20;
// Smallest block that is aligned to large pages. In smaller blocks up to half of a large page would be wasted.
constexpr std::size_t least_huge = 2 * huge_page;

// Under a sanitizer freed blocks go to the host at once, so that it sees who uses them.
constexpr bool keeps_blocks = HF_SANITIZED == 0;

// Aligns large blocks to 2 MiB and asks the kernel for large pages, which make reading a factor several times faster.
void* default_allocate(std::size_t bytes, std::size_t alignment) noexcept {
  const bool large = bytes >= least_huge;
  const std::size_t align = large ? huge_page : (alignment < sizeof(void*) ? sizeof(void*) : alignment);
  if (bytes > SIZE_MAX - align) return nullptr;
  const std::size_t rounded = (bytes + align - 1) / align * align;
#if defined(_WIN32)  // its C library has no aligned_alloc, and frees aligned blocks with a function of their own
  void* pointer = _aligned_malloc(rounded, align);
#else
  void* pointer = std::aligned_alloc(align, rounded);
#endif
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (pointer && large) madvise(pointer, rounded, MADV_HUGEPAGE);
#endif
  return pointer;
}

void default_release(void* pointer) noexcept {
#if defined(_WIN32)
  _aligned_free(pointer);
#else
  std::free(pointer);
#endif
}

// A standard allocator that calls the host's functions directly. It allocates the Memory object itself.
template <class T>
struct HookAllocator {
  using value_type = T;
  explicit HookAllocator(const hf_allocator& given) noexcept : hooks(given) {}
  template <class U>
  HookAllocator(const HookAllocator<U>& other) noexcept : hooks(other.hooks) {}
  T* allocate(std::size_t count) {
    void* block = hooks.allocate ? hooks.allocate(hooks.user, count * sizeof(T), alignof(T))
                                 : ::operator new(count * sizeof(T), std::nothrow);
    if (!block) throw std::bad_alloc();
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t count) noexcept {
    if (hooks.allocate) {
      hooks.release(hooks.user, block, count * sizeof(T), alignof(T));
    } else {
      ::operator delete(block);
    }
  }
  template <class U>
  bool operator==(const HookAllocator<U>& other) const noexcept {
    return hooks.allocate == other.hooks.allocate && hooks.user == other.hooks.user;
  }
  template <class U>
  bool operator!=(const HookAllocator<U>& other) const noexcept {
    return !(*this == other);
  }
  hf_allocator hooks;
};

}  // namespace

std::shared_ptr<Memory> make_memory(const hf_allocator& hooks, std::uint64_t byte_limit) {
  return std::allocate_shared<Memory>(HookAllocator<Memory>(hooks), hooks, byte_limit);
}

// The host's function may throw.
void* Memory::ask_host(std::size_t bytes, std::size_t alignment) {
  return hooks_.allocate ? hooks_.allocate(hooks_.user, bytes, alignment) : default_allocate(bytes, alignment);
}

void Memory::give_host(void* pointer, std::size_t bytes, std::size_t alignment) noexcept {
  if (hooks_.allocate) {
    hooks_.release(hooks_.user, pointer, bytes, alignment);
  } else {
    default_release(pointer);
  }
}

bool Memory::release_kept() noexcept {
  return kept_.empty([&](void* block, std::size_t bytes, std::size_t alignment) { give_host(block, bytes, alignment); });
}

void* Memory::do_allocate(std::size_t asked, std::size_t given_alignment) {
  const std::size_t bytes = BlockCache::rounded(asked), alignment = BlockCache::aligned(given_alignment);
  // Counts the bytes first and subtracts them again if the allocation fails.
  struct Claim {
    std::atomic<std::uint64_t>& live;
    std::uint64_t bytes;
    ~Claim() { live.fetch_sub(bytes, std::memory_order_relaxed); }
  } claim{live_, bytes};
  const std::uint64_t live = live_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  if (byte_limit_ != 0 && live > byte_limit_) throw MemoryLimitReached(byte_limit_, live - bytes, bytes);
  void* pointer = kept_.take(bytes, alignment);
  if (!pointer) {
    if (byte_limit_ != 0 && live + kept_.bytes() > byte_limit_) release_kept();
    pointer = ask_host(bytes, alignment);
    if (!pointer && release_kept()) pointer = ask_host(bytes, alignment);
  }
  if (!pointer) throw std::bad_alloc();
  claim.bytes = 0;
  count_.fetch_add(1, std::memory_order_relaxed);
  std::uint64_t peak = peak_.load(std::memory_order_relaxed);
  while (peak < live && !peak_.compare_exchange_weak(peak, live, std::memory_order_relaxed)) {
  }
  return pointer;
}

void Memory::do_deallocate(void* pointer, std::size_t asked, std::size_t given_alignment) {
  const std::size_t bytes = BlockCache::rounded(asked), alignment = BlockCache::aligned(given_alignment);
  const std::uint64_t live = live_.fetch_sub(bytes, std::memory_order_relaxed) - bytes;
  if (keeps_blocks && std::uncaught_exceptions() == 0) {
    const std::uint64_t most = BlockCache::room(live);
    BlockCache::Answer answer = kept_.put(pointer, bytes, alignment, most);
    // After a long call a full cache holds the sizes of that call, which the next call does not want.
    if (answer == BlockCache::Answer::full) {
      release_kept();
      answer = kept_.put(pointer, bytes, alignment, most);
    }
    if (answer == BlockCache::Answer::kept) return;
  } else {
    release_kept();  // a call is refused
  }
  give_host(pointer, bytes, alignment);
}

}  // namespace hf_inner
