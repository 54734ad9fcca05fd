// The compiler's extensions that the library uses, each with a plain alternative that gives the same bits. No other
// file of src names a builtin, an attribute or a vector type of a compiler.
//
// HF_PLAIN_COMPILER chooses the alternatives where the extensions exist too: a test builds with it. Kernels that are
// compiled for one instruction set include this file. So its functions have internal linkage, and no function compiled
// for one instruction set is linked into another.
#pragma once
#include <cstdint>
#include <cstring>

#if (defined(__GNUC__) || defined(__clang__)) && !defined(HF_PLAIN_COMPILER)
#define HF_GNU_EXTENSIONS 1
#else
#define HF_GNU_EXTENSIONS 0
#endif
#if defined(_MSC_VER)
#include <intrin.h>
#endif

// Asks for the cache line at an address: HF_PREFETCH into the nearest cache, HF_PREFETCH_FAR into the second-level
// cache.
#if HF_GNU_EXTENSIONS
#define HF_PREFETCH(address) __builtin_prefetch(address)
#define HF_PREFETCH_FAR(address) __builtin_prefetch(address, 0, 2)
#elif defined(_MSC_VER) && defined(_M_X64)
#define HF_PREFETCH(address) _mm_prefetch(reinterpret_cast<const char*>(address), _MM_HINT_T0)
#define HF_PREFETCH_FAR(address) _mm_prefetch(reinterpret_cast<const char*>(address), _MM_HINT_T1)
#else
#define HF_PREFETCH(address) static_cast<void>(address)
#define HF_PREFETCH_FAR(address) static_cast<void>(address)
#endif

// Marks a function whose argument `format` is a format of printf for the arguments from `first` on. The numbers count
// from 1. MinGW's own printf knows other formats than GNU's, which its C++ library uses.
#if HF_GNU_EXTENSIONS && defined(__MINGW32__) && !defined(__clang__)
#define HF_LIKE_PRINTF(format_at, first) __attribute__((format(gnu_printf, format_at, first)))
#elif HF_GNU_EXTENSIONS
#define HF_LIKE_PRINTF(format_at, first) __attribute__((format(printf, format_at, first)))
#else
#define HF_LIKE_PRINTF(format_at, first)
#endif

// Inlines a function wherever it is called.
#if HF_GNU_EXTENSIONS
#define HF_ALWAYS_INLINE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define HF_ALWAYS_INLINE __forceinline
#else
#define HF_ALWAYS_INLINE inline
#endif

// Unrolls the loop behind it.
#if defined(__clang__)
#define HF_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define HF_UNROLL _Pragma("GCC unroll 16")
#else
#define HF_UNROLL
#endif

// 1 under AddressSanitizer or ThreadSanitizer.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define HF_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HF_SANITIZED 1
#endif
#endif
#ifndef HF_SANITIZED
#define HF_SANITIZED 0
#endif

// Also compiles a function for AVX2. The program picks the version when it starts. The loops work on four adjacent
// numbers and use no fused multiply-adds, so the result has the bits of the plain build. The choice needs glibc's
// dynamic linker. It runs before sanitizers can, so sanitizer builds leave it out.
#if HF_GNU_EXTENSIONS && defined(__GLIBC__) && defined(__x86_64__) && !defined(__clang__) && !HF_SANITIZED
#define HF_FOUR_LANES __attribute__((target_clones("avx2", "default")))
#else
#define HF_FOUR_LANES
#endif

// Whether this processor has an instruction set of x86, by the compiler's name for it: HF_PROCESSOR_HAS("avx2").
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__)) && !defined(_MSC_VER)
#define HF_PROCESSOR_HAS(name) __builtin_cpu_supports(name)
#elif defined(_M_X64)
namespace {
// Reads CPUID, and from XCR0 whether the operating system saves the registers.
inline bool processor_has(const char* name) noexcept {
  int first[4], seventh[4];
  __cpuidex(first, 1, 0);
  __cpuidex(seventh, 7, 0);
  const bool saved = (first[2] >> 27 & 1) != 0;
  const unsigned long long kept = saved ? _xgetbv(0) : 0;
  const bool wide = (kept & 0x6) == 0x6, widest = (kept & 0xe6) == 0xe6;
  if (std::strcmp(name, "fma") == 0) return wide && (first[2] >> 12 & 1) != 0;
  if (std::strcmp(name, "avx2") == 0) return wide && (seventh[1] >> 5 & 1) != 0;
  if (std::strcmp(name, "avx512f") == 0) return widest && (seventh[1] >> 16 & 1) != 0;
  if (std::strcmp(name, "avx512dq") == 0) return widest && (seventh[1] >> 17 & 1) != 0;
  if (std::strcmp(name, "avx512vl") == 0) return widest && (seventh[1] >> 31 & 1) != 0;
  return false;
}
}  // namespace
#define HF_PROCESSOR_HAS(name) processor_has(name)
#else
#define HF_PROCESSOR_HAS(name) false
#endif

// A vector of `count` numbers: HF_VECTOR(Name, double, 4) makes the type Name. Arithmetic works on each number, and
// operands can be single numbers. HF_LOOSE_VECTOR makes one that needs no more alignment than its numbers.
#if HF_GNU_EXTENSIONS
#define HF_VECTOR(Name, Number, count) typedef Number Name __attribute__((vector_size(count * sizeof(Number))))
#define HF_LOOSE_VECTOR(Name, Number, count) \
  typedef Number Name __attribute__((vector_size(count * sizeof(Number)), aligned(sizeof(Number)), may_alias))
// The larger numbers of two vectors of one type; the second where they do not compare.
#define HF_LARGER(a, b) ((a) > (b) ? (a) : (b))
#else
namespace {
template <class T, int N>
struct PlainVector {
  T number[N];
  T& operator[](int i) noexcept { return number[i]; }
  const T& operator[](int i) const noexcept { return number[i]; }
};
template <class T>
struct Same {
  using Type = T;
};
#define HF_VECTOR_OPERATOR(sign)                                                                                 \
  template <class T, int N>                                                                                      \
  inline PlainVector<T, N> operator sign(const PlainVector<T, N>& a, const PlainVector<T, N>& b) noexcept {      \
    PlainVector<T, N> result;                                                                                    \
    for (int i = 0; i < N; ++i) result[i] = a[i] sign b[i];                                                      \
    return result;                                                                                               \
  }                                                                                                              \
  template <class T, int N>                                                                                      \
  inline PlainVector<T, N> operator sign(const PlainVector<T, N>& a, const typename Same<T>::Type& b) noexcept { \
    PlainVector<T, N> result;                                                                                    \
    for (int i = 0; i < N; ++i) result[i] = a[i] sign b;                                                         \
    return result;                                                                                               \
  }                                                                                                              \
  template <class T, int N>                                                                                      \
  inline PlainVector<T, N> operator sign(const typename Same<T>::Type& a, const PlainVector<T, N>& b) noexcept { \
    PlainVector<T, N> result;                                                                                    \
    for (int i = 0; i < N; ++i) result[i] = a sign b[i];                                                         \
    return result;                                                                                               \
  }                                                                                                              \
  template <class T, int N, class Other>                                                                         \
  inline PlainVector<T, N>& operator sign## = (PlainVector<T, N> & a, const Other& b) noexcept {                 \
    return a = a sign b;                                                                                         \
  }
HF_VECTOR_OPERATOR(+)
HF_VECTOR_OPERATOR(-)
HF_VECTOR_OPERATOR(*)
HF_VECTOR_OPERATOR(/)
HF_VECTOR_OPERATOR(&)
HF_VECTOR_OPERATOR(>>)
#undef HF_VECTOR_OPERATOR
template <class T, int N>
inline PlainVector<T, N> larger(const PlainVector<T, N>& a, const PlainVector<T, N>& b) noexcept {
  PlainVector<T, N> result;
  for (int i = 0; i < N; ++i) result[i] = a[i] > b[i] ? a[i] : b[i];
  return result;
}
}  // namespace
#define HF_LARGER(a, b) larger(a, b)
#define HF_VECTOR(Name, Number, count) using Name = PlainVector<Number, count>
#define HF_LOOSE_VECTOR(Name, Number, count) using Name = PlainVector<Number, count>
#endif

namespace {

// Returns how many zero bits stand below the lowest one of a number that is not 0.
inline int trailing_zeros(std::uint64_t bits) noexcept {
#if HF_GNU_EXTENSIONS
  return __builtin_ctzll(bits);
#else
  int count = 0;
  for (int half = 32; half > 0; half /= 2) {
    if ((bits & ((std::uint64_t{1} << half) - 1)) == 0) {
      bits >>= half;
      count += half;
    }
  }
  return count;
#endif
}

// Tells the processor that this thread waits in a loop.
inline void pause_in_loop() noexcept {
#if HF_GNU_EXTENSIONS && (defined(__x86_64__) || defined(__i386__))
  __builtin_ia32_pause();
#elif defined(_MSC_VER) && (defined(_M_X64) || defined(_M_IX86))
  _mm_pause();
#elif HF_GNU_EXTENSIONS && defined(__aarch64__)
  __asm__ volatile("yield");
#endif
}

}  // namespace

// The square root, without a function of the standard library that could be linked into another instruction set.
#if HF_GNU_EXTENSIONS
#define HF_SQUARE_ROOT(x) __builtin_sqrt(x)
#else
#include <math.h>
#define HF_SQUARE_ROOT(x) (::sqrt(x))
#endif
