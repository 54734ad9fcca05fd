// Blocks of memory with a head that remembers their size and alignment, for allocators of tests that count and check.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace reliability {

struct BlockHead {
  void* base;
  std::size_t size, alignment;
};

// Ends the program when the C library has no memory.
inline void* take_block(std::size_t size, std::size_t alignment) {
  char* const base = static_cast<char*>(std::malloc(size + alignment + sizeof(BlockHead)));
  if (!base) std::abort();
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(base + sizeof(BlockHead));
  char* const block = base + sizeof(BlockHead) + ((first + alignment - 1) / alignment * alignment - first);
  const BlockHead head = {base, size, alignment};
  std::memcpy(block - sizeof head, &head, sizeof head);
  return block;
}

// Frees the block and returns its head; base is dangling then.
inline BlockHead give_block(void* block) {
  BlockHead head;
  std::memcpy(&head, static_cast<char*>(block) - sizeof head, sizeof head);
  std::free(head.base);
  return head;
}

}  // namespace reliability
