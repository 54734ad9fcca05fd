// Measures wall-clock milliseconds for the statistics.
#pragma once
#include <chrono>

namespace hf_inner {

class Timer {
 public:
  double milliseconds() const noexcept {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace hf_inner
