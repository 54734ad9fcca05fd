// Vector types of the AVX2 + FMA build.
#pragma once
#include <immintrin.h>

#include <cstdint>

namespace {

template <class T>
struct Simd;

template <>
struct Simd<double> {
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
  static Type add(Type a, Type b) noexcept { return _mm256_add_pd(a, b); }
  static Type multiply(Type a, Type b) noexcept { return _mm256_mul_pd(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return _mm256_fmadd_pd(a, b, c); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return _mm256_fnmadd_pd(a, b, c); }
};

template <>
struct Simd<float> {
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
  static Type add(Type a, Type b) noexcept { return _mm256_add_ps(a, b); }
  static Type multiply(Type a, Type b) noexcept { return _mm256_mul_ps(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return _mm256_fmadd_ps(a, b, c); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return _mm256_fnmadd_ps(a, b, c); }
};

constexpr int gemm_rows = 3, gemm_columns = 4;  // vectors of rows x columns of one accumulator block
constexpr int lane_vectors = 2, lane_rows = 6;

inline double multiply_add_scalar(double a, double b, double c) noexcept {
  return _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c)));
}
inline float multiply_add_scalar(float a, float b, float c) noexcept {
  return _mm_cvtss_f32(_mm_fmadd_ss(_mm_set_ss(a), _mm_set_ss(b), _mm_set_ss(c)));
}

// out[r][at + c] = tile[8 c + r] for r < rows, c < columns: blocks of 4 x 4.
inline void store_transposed(const double* tile, double* const* out, std::int64_t at, std::int32_t rows,
                             std::int32_t columns) noexcept {
  for (std::int32_t r = 0; r < rows; r += 4) {
    for (std::int32_t c = 0; c < columns; c += 4) {
      __m256d in[4], pair[4], row[4];
      for (int k = 0; k < 4; ++k)
        in[k] = c + k < columns ? _mm256_loadu_pd(tile + 8 * (c + k) + r) : _mm256_setzero_pd();
      pair[0] = _mm256_unpacklo_pd(in[0], in[1]), pair[1] = _mm256_unpackhi_pd(in[0], in[1]);
      pair[2] = _mm256_unpacklo_pd(in[2], in[3]), pair[3] = _mm256_unpackhi_pd(in[2], in[3]);
      row[0] = _mm256_permute2f128_pd(pair[0], pair[2], 0x20), row[1] = _mm256_permute2f128_pd(pair[1], pair[3], 0x20);
      row[2] = _mm256_permute2f128_pd(pair[0], pair[2], 0x31), row[3] = _mm256_permute2f128_pd(pair[1], pair[3], 0x31);
      for (int k = 0; k < 4; ++k) {
        if (r + k >= rows) break;
        if (c + 4 <= columns)
          _mm256_storeu_pd(out[r + k] + at + c, row[k]);
        else
          Simd<double>::store_part(out[r + k] + at + c, row[k], columns - c);
      }
    }
  }
}

}  // namespace
