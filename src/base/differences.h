// Where two arrays differ.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstring>

namespace hf_inner {

// Calls use(i), ascending, for every i below `count` with a[i] != b[i]. Arrays that are shared are not read. Equal stretches are compared as bytes.
template <class T, class Use>
void for_differences(const T* a, const T* b, std::size_t count, Use&& use) {
  if (a == b) return;
  constexpr std::size_t stretch = 1024;
  for (std::size_t begin = 0; begin < count; begin += stretch) {
    const std::size_t size = std::min(stretch, count - begin);
    if (std::memcmp(a + begin, b + begin, size * sizeof(T)) == 0) continue;
    for (std::size_t i = begin; i < begin + size; ++i)
      if (a[i] != b[i]) use(i);
  }
}

}  // namespace hf_inner
