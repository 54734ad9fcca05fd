// Gives the library its own floating-point settings during a call. The host may use traps, flush-to-zero or another
// rounding mode. Every entry point constructs a FloatEnvironment. The constructor saves the host's settings and sets
// round-to-nearest, no traps and subnormal numbers. The destructor restores the host's settings and exception flags.
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
    _mm_setcsr(0x1f80u);  // all exceptions masked, round to nearest, denormals kept
#endif
    std::fesetround(FE_TONEAREST);
  }
  ~FloatEnvironment() {
    std::fesetenv(&host_);
#if defined(__SSE2__)
    // fesetenv restored the exception flags and traps of the host. control_ restores flush-to-zero and
    // denormals-are-zero.
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
