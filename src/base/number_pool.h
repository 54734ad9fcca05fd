// Hands out the smallest number that is not in use. Sites, handles, pairs and slots get their numbers here.
#pragma once
#include <cstdint>

namespace hf_inner {

class NumberPool {
 public:
  // Returns the smallest number that is not in use, and marks it as taken. in_use(number) is called for rising numbers
  // only.
  template <class InUse>
  std::uint32_t take(InUse&& in_use) {
    while (in_use(next_)) ++next_;
    return next_++;
  }
  void give_back(std::uint32_t number) noexcept {
    if (number < next_) next_ = number;
  }

 private:
  std::uint32_t next_ = 0;  // every smaller number is in use
};

}  // namespace hf_inner
