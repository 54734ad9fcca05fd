// The host may run with floating-point traps, flush-to-zero or another rounding mode. Every entry point constructs a
// FloatEnvironment: it saves the host's, sets round-to-nearest, no traps, subnormals on, and restores it at scope end,
// sticky flags included.
#pragma once
#include <cfenv>
#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace hf_inner {

class FloatEnvironment {
 public:
  FloatEnvironment() noexcept {
    std::feholdexcept(&host_);
#if defined(__SSE2__)
    control_ = _mm_getcsr();
    _mm_setcsr(0x1f80u);  // all exceptions masked, round to nearest, neither FTZ nor DAZ
#endif
    std::fesetround(FE_TONEAREST);
  }
  ~FloatEnvironment() {
    std::fesetenv(&host_);
#if defined(__SSE2__)
    // feholdexcept has saved the sticky flags and traps of the host in host_; DAZ is in the control word only
    _mm_setcsr((_mm_getcsr() & ~0x8040u) | (control_ & 0x8040u));
#endif
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  std::fenv_t host_;
#if defined(__SSE2__)
  unsigned control_ = 0;
#endif
};

}  // namespace hf_inner
