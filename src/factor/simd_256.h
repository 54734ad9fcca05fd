// Vectors of 256 bits, for the AVX2 build and for the narrow supernodes of the AVX-512 build, and functions that both
// builds share.
#pragma once
#include <immintrin.h>

#include <cstdint>

#define HF_ROW_PRODUCTS  // four sums at a time: row_products of simd_avx2.h and simd_avx512.h

namespace {

struct Double4 {
  using Type = __m256d;
  static constexpr int width = 4;
  static __m256i mask(int count) noexcept {
    return _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_setr_epi64x(0, 1, 2, 3));
  }
  static Type zero() noexcept { return _mm256_setzero_pd(); }
  static Type all(double x) noexcept { return _mm256_set1_pd(x); }
  static Type load(const double* p) noexcept { return _mm256_loadu_pd(p); }
  static void store(double* p, Type v) noexcept { _mm256_storeu_pd(p, v); }
  static Type load_part(const double* p, int count) noexcept { return _mm256_maskload_pd(p, mask(count)); }
  static void store_part(double* p, Type v, int count) noexcept { _mm256_maskstore_pd(p, mask(count), v); }
  // Stores the first `count` numbers of a vector without a mask, so that later loads can take them from the store
  // buffer. It is meant for counts that are known at compile time.
  static void store_first(double* p, Type v, int count) noexcept {
    if (count >= 4) return store(p, v);
    __m128d rest = _mm256_castpd256_pd128(v);
    if (count & 2) {
      _mm_storeu_pd(p, rest);
      rest = _mm256_extractf128_pd(v, 1);
      p += 2;
    }
    if (count & 1) _mm_store_sd(p, rest);
  }
  static Type add(Type a, Type b) noexcept { return _mm256_add_pd(a, b); }
  static Type multiply(Type a, Type b) noexcept { return _mm256_mul_pd(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return _mm256_fmadd_pd(a, b, c); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return _mm256_fnmadd_pd(a, b, c); }
};

struct Float8 {
  using Type = __m256;
  static constexpr int width = 8;
  static __m256i mask(int count) noexcept {
    return _mm256_cmpgt_epi32(_mm256_set1_epi32(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  }
  static Type zero() noexcept { return _mm256_setzero_ps(); }
  static Type all(float x) noexcept { return _mm256_set1_ps(x); }
  static Type load(const float* p) noexcept { return _mm256_loadu_ps(p); }
  static void store(float* p, Type v) noexcept { _mm256_storeu_ps(p, v); }
  static Type load_part(const float* p, int count) noexcept { return _mm256_maskload_ps(p, mask(count)); }
  static void store_part(float* p, Type v, int count) noexcept { _mm256_maskstore_ps(p, mask(count), v); }
  static void store_first(float* p, Type v, int count) noexcept {
    if (count >= 8) return store(p, v);
    __m128 rest = _mm256_castps256_ps128(v);
    if (count & 4) {
      _mm_storeu_ps(p, rest);
      rest = _mm256_extractf128_ps(v, 1);
      p += 4;
    }
    if (count & 2) {
      _mm_storel_pi(reinterpret_cast<__m64*>(p), rest);
      rest = _mm_movehl_ps(rest, rest);
      p += 2;
    }
    if (count & 1) _mm_store_ss(p, rest);
  }
  static Type add(Type a, Type b) noexcept { return _mm256_add_ps(a, b); }
  static Type multiply(Type a, Type b) noexcept { return _mm256_mul_ps(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return _mm256_fmadd_ps(a, b, c); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return _mm256_fnmadd_ps(a, b, c); }
};

inline double multiply_add_scalar(double a, double b, double c) noexcept {
  return _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c)));
}
inline float multiply_add_scalar(float a, float b, float c) noexcept {
  return _mm_cvtss_f32(_mm_fmadd_ss(_mm_set_ss(a), _mm_set_ss(b), _mm_set_ss(c)));
}

// Returns the sums of the four numbers of each of four vectors: (0 + 2) + (1 + 3).
inline __m256d sums_of_four(__m256d a, __m256d b, __m256d c, __m256d d) noexcept {
  const __m256d ab = _mm256_add_pd(_mm256_permute2f128_pd(a, b, 0x20), _mm256_permute2f128_pd(a, b, 0x31));
  const __m256d cd = _mm256_add_pd(_mm256_permute2f128_pd(c, d, 0x20), _mm256_permute2f128_pd(c, d, 0x31));
  return _mm256_permute4x64_pd(_mm256_hadd_pd(ab, cd), 0xd8);
}

}  // namespace
