// Sorting and partitioning in the memory of the library: the order of std::stable_sort, and no other memory.
#include "base/stable_sort.h"

#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <random>
#include <vector>

namespace {

struct Item {
  int key, place;
  bool operator==(const Item& other) const { return key == other.key && place == other.place; }
};
const auto by_key = [](const Item& a, const Item& b) { return a.key < b.key; };

std::vector<Item> draw(std::size_t count, int keys, std::mt19937& random) {
  std::vector<Item> items;
  for (std::size_t i = 0; i < count; ++i) items.push_back({static_cast<int>(random()) % keys, static_cast<int>(i)});
  return items;
}

TEST(StableSort, keeps_the_order_of_equal_items) {
  std::mt19937 random(5);
  hf_inner::Memory memory;
  for (const std::size_t count : {0u, 1u, 2u, 17u, 1000u, 20000u}) {
    for (const int keys : {1, 2, 10, 1000000}) {
      std::vector<Item> right = draw(count, keys, random);
      hf_inner::Vector<Item> items(right.begin(), right.end(), &memory);
      std::stable_sort(right.begin(), right.end(), by_key);
      hf_inner::stable_sort(items, by_key, memory);
      EXPECT_TRUE(std::equal(right.begin(), right.end(), items.begin(), items.end())) << count << " " << keys;
    }
  }
  EXPECT_EQ(memory.live_bytes(), 0u);
}

TEST(StableSort, partitions_keep_both_orders) {
  std::mt19937 random(6);
  hf_inner::Memory memory;
  for (const std::size_t count : {0u, 1u, 2u, 17u, 1000u}) {
    for (const int keys : {1, 2, 5}) {
      std::vector<Item> right = draw(count, keys, random);
      hf_inner::Vector<Item> items(right.begin(), right.end(), &memory);
      const auto test = [](const Item& item) { return item.key == 0; };
      const auto middle = std::stable_partition(right.begin(), right.end(), test);
      EXPECT_EQ(hf_inner::stable_partition(items, test, memory), static_cast<std::size_t>(middle - right.begin()));
      EXPECT_TRUE(std::equal(right.begin(), right.end(), items.begin(), items.end())) << count << " " << keys;
    }
  }
}

TEST(StableSort, items_that_only_move_are_moved) {
  hf_inner::Memory memory;
  hf_inner::Vector<std::unique_ptr<int>> items(&memory);
  for (const int value : {3, 1, 2, 1}) items.push_back(std::make_unique<int>(value));
  const int* first_of_ones = items[1].get();
  hf_inner::stable_sort(
      items, [](const auto& a, const auto& b) { return *a < *b; }, memory);
  EXPECT_EQ(items[0].get(), first_of_ones);
  EXPECT_EQ(*items[3], 3);
  EXPECT_EQ(hf_inner::stable_partition(
                items, [](const auto& item) { return *item > 1; }, memory),
            2u);
  EXPECT_EQ(*items[0] + *items[1] + *items[2] + *items[3], 7);
}

// Bytes that the host sees, all of them: the limit refuses them too.
TEST(StableSort, takes_its_memory_from_the_library) {
  hf_inner::Memory memory;
  hf_inner::Vector<Item> items(1024, Item{1, 2}, &memory);  // sizes that are not rounded
  const auto before = memory.peak_bytes();
  hf_inner::stable_sort(items, by_key, memory);
  EXPECT_EQ(memory.peak_bytes(), before + 1024 * (sizeof(std::uint32_t) + sizeof(Item)));
  EXPECT_EQ(memory.live_bytes(), before);
  hf_inner::Memory small({}, 100);
  std::vector<Item> host(1000, Item{1, 2});
  EXPECT_THROW(hf_inner::stable_sort(host.data(), host.size(), by_key, small), std::bad_alloc);
}

}  // namespace
