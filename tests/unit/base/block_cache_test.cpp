// Freed blocks that a Memory keeps for the next call: what it keeps, how much, and when the host gets it back.
#include "base/block_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/compiler.h"
#include "base/memory.h"

namespace {

using hf_inner::BlockCache;
using hf_inner::Memory;

// A host that knows its blocks. Its allocate refuses beyond `most` bytes, or throws.
struct Host {
  std::map<void*, std::pair<std::size_t, std::size_t>> blocks;  // bytes, alignment
  std::size_t bytes = 0, most = SIZE_MAX, calls = 0, wrong = 0;
  bool throws = false;

  hf_allocator hooks() { return {allocate, release, this}; }
  static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
    Host& host = *static_cast<Host*>(user);
    ++host.calls;
    if (host.throws) throw std::runtime_error("a fault of the host");
    if (host.bytes + bytes > host.most) return nullptr;
    void* const block = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    host.blocks[block] = {bytes, alignment};
    host.bytes += bytes;
    return block;
  }
  static void release(void* user, void* block, std::size_t bytes, std::size_t alignment) {
    Host& host = *static_cast<Host*>(user);
    const auto found = host.blocks.find(block);
    if (found == host.blocks.end() || found->second != std::pair(bytes, alignment)) {
      ++host.wrong;
      return;
    }
    host.bytes -= bytes;
    host.blocks.erase(found);
    std::free(block);
  }
};

class KeptBlocks : public ::testing::Test {
 protected:
  void SetUp() override {
    if (HF_SANITIZED) GTEST_SKIP() << "under a sanitizer no block is kept";
  }
  void TearDown() override {
    EXPECT_EQ(host.bytes, 0u);
    EXPECT_EQ(host.wrong, 0u);
  }
  // Allocates and frees one block.
  static void use(Memory& memory, std::size_t bytes, std::size_t alignment = 8) {
    memory.deallocate(memory.allocate(bytes, alignment), bytes, alignment);
  }
  Host host;
};

TEST(BlockCacheSizes, rounding_wastes_an_eighth_at_most_and_stays_where_it_is) {
  std::size_t before = 0;
  for (std::size_t bytes = 0; bytes < (1u << 17); ++bytes) {
    const std::size_t rounded = BlockCache::rounded(bytes);
    EXPECT_GE(rounded, bytes);
    EXPECT_LE(rounded, bytes < 128 ? bytes / 16 * 16 + 16 : bytes + bytes / 8);
    EXPECT_EQ(BlockCache::rounded(rounded), rounded);
    EXPECT_GE(rounded, before);
    before = rounded;
  }
  EXPECT_EQ(BlockCache::rounded(SIZE_MAX), SIZE_MAX);
}

TEST_F(KeptBlocks, serve_the_next_allocation_of_their_size_and_alignment) {
  Memory memory(host.hooks());
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{100}, std::size_t{5000}, std::size_t{100000}}) {
    for (const std::size_t alignment : {std::size_t{8}, std::size_t{64}}) {
      use(memory, bytes, alignment);
      host.calls = 0;
      use(memory, bytes, alignment);
      EXPECT_EQ(host.calls, 0u) << bytes;
      void* const one = memory.allocate(bytes, alignment);
      void* const two = memory.allocate(bytes, alignment);  // the first block is taken
      EXPECT_EQ(host.calls, 1u) << bytes;
      EXPECT_NE(one, two);
      memory.deallocate(one, bytes, alignment);
      memory.deallocate(two, bytes, alignment);
    }
  }
  const std::size_t large[] = {70000, 80000, 90000};
  void* blocks[3];
  for (int round = 0; round < 2; ++round) {
    host.calls = 0;
    for (int k = 0; k < 3; ++k) blocks[k] = memory.allocate(large[k], 64);
    for (int k = 0; k < 3; ++k) memory.deallocate(blocks[k], large[k], 64);
  }
  EXPECT_EQ(host.calls, 0u);
  use(memory, 1000, 4096);  // an alignment of its own is not kept
  host.calls = 0;
  use(memory, 1000, 4096);
  EXPECT_EQ(host.calls, 1u);
}

TEST_F(KeptBlocks, are_not_live_and_stay_within_their_room) {
  Memory memory(host.hooks());
  void* const base = memory.allocate(40u << 20, 64);
  EXPECT_EQ(BlockCache::room(memory.live_bytes()), (40u << 20) / 32);
  std::vector<void*> blocks;
  for (std::size_t k = 0; k < 3000; ++k) blocks.push_back(memory.allocate(100 + 3 * k, 8));
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    memory.deallocate(blocks[k], 100 + 3 * k, 8);
    EXPECT_LE(host.bytes, memory.live_bytes() + BlockCache::room(memory.live_bytes()));
  }
  EXPECT_EQ(memory.live_bytes(), 40u << 20);
  EXPECT_GT(host.bytes, memory.live_bytes());
  EXPECT_TRUE(memory.release_kept());
  EXPECT_FALSE(memory.release_kept());
  EXPECT_EQ(host.bytes, memory.live_bytes());
  memory.deallocate(base, 40u << 20, 64);
}

TEST_F(KeptBlocks, go_back_before_a_limit_is_exceeded) {
  constexpr std::size_t limit = 1u << 20;
  Memory memory(host.hooks(), limit);
  for (std::size_t k = 0; k < 12; ++k) use(memory, (8u << 10) + 1024 * k);
  EXPECT_GT(host.bytes, 0u);
  void* const all = memory.allocate(limit, 64);  // it fits only without them
  EXPECT_EQ(host.bytes, limit);
  EXPECT_THROW(static_cast<void>(memory.allocate(1, 1)), hf_inner::MemoryLimitReached);
  memory.deallocate(all, limit, 64);
}

TEST_F(KeptBlocks, go_back_when_the_host_has_no_more) {
  Memory memory(host.hooks());
  host.most = 200000;
  for (std::size_t k = 0; k < 4; ++k) use(memory, 30000 + 4000 * k);
  EXPECT_GT(host.bytes, 100000u);
  void* const large = memory.allocate(150000, 64);
  EXPECT_EQ(host.bytes, 150000u);
  EXPECT_THROW(static_cast<void>(memory.allocate(60000, 64)), std::bad_alloc);
  memory.deallocate(large, 150000, 64);
}

TEST_F(KeptBlocks, go_back_when_a_call_is_refused) {
  Memory memory(host.hooks());
  use(memory, 5000);
  EXPECT_GT(host.bytes, 0u);
  try {
    const hf_inner::Vector<int> rows(10, 0, &memory);
    throw std::runtime_error("refused");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(host.bytes, 0u);
}

TEST_F(KeptBlocks, an_exception_of_the_host_reaches_the_call) {
  Memory memory(host.hooks());
  use(memory, 5000);
  host.throws = true;
  EXPECT_THROW(static_cast<void>(memory.allocate(7000, 8)), std::runtime_error);
  use(memory, 5000);  // the host is not asked
  host.throws = false;
  use(memory, 7000);
  EXPECT_EQ(memory.live_bytes(), 0u);
}

// Also under ThreadSanitizer, where Memory itself keeps none.
TEST(BlockCache, gives_a_block_to_one_thread_only) {
  BlockCache cache;
  constexpr std::uint64_t most = 1u << 20;
  const auto run = [&](unsigned char mark) {
    for (std::size_t k = 0; k < 20000; ++k) {
      const std::size_t bytes = BlockCache::rounded(16 + 48 * (k % 40));
      void* block = cache.take(bytes, 64);
      if (!block) block = std::aligned_alloc(64, (bytes + 63) / 64 * 64);
      std::memset(block, mark, bytes);
      for (std::size_t i = 0; i < bytes; ++i) {
        if (static_cast<unsigned char*>(block)[i] != mark) ADD_FAILURE() << "another thread wrote";
      }
      if (k % 1000 == 0) cache.empty([](void* kept, std::size_t, std::size_t) { std::free(kept); });
      if (cache.put(block, bytes, 64, most) != BlockCache::Answer::kept) std::free(block);
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) threads.emplace_back(run, static_cast<unsigned char>(t + 1));
  for (std::thread& thread : threads) thread.join();
  std::uint64_t bytes = 0;
  const std::uint64_t kept = cache.bytes();
  cache.empty([&](void* block, std::size_t size, std::size_t) {
    bytes += size;
    std::free(block);
  });
  EXPECT_EQ(bytes, kept);
  EXPECT_EQ(cache.bytes(), 0u);
}

}  // namespace
