// Sorting and partitioning that keep the order of equal items, in the memory of the library. std::stable_sort and
// std::stable_partition use operator new. No host sees that memory and no limit counts it.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/memory.h"

namespace hf_inner {

// Sorts `count` items by `less`.
template <class T, class Less>
void stable_sort(T* items, std::size_t count, Less less, Memory& memory) {
  Vector<std::uint32_t> order(count, &memory);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return less(items[a], items[b]) || (a < b && !less(items[b], items[a]));
  });
  Vector<T> sorted(&memory);
  sorted.reserve(count);
  for (const std::uint32_t k : order) sorted.push_back(std::move(items[k]));
  std::move(sorted.begin(), sorted.end(), items);
}

template <class T, class Less>
void stable_sort(Vector<T>& items, Less less, Memory& memory) {
  stable_sort(items.data(), items.size(), less, memory);
}

// Moves the items that pass `test` to the front and returns their number.
template <class T, class Test>
std::size_t stable_partition(Vector<T>& items, Test test, Memory& memory) {
  Vector<T> rest(&memory);
  std::size_t kept = 0;
  for (T& item : items) {
    if (!test(item))
      rest.push_back(std::move(item));
    else if (T& place = items[kept++]; &place != &item)
      place = std::move(item);
  }
  std::move(rest.begin(), rest.end(), items.begin() + static_cast<std::ptrdiff_t>(kept));
  return kept;
}

}  // namespace hf_inner
