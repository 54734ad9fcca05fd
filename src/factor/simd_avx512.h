// Vector types of the AVX-512 build.
#pragma once
#include <immintrin.h>

#include <cstdint>

#include "factor/simd_256.h"

namespace {

template <class T>
struct Simd;

template <>
struct Simd<double> {
  using Type = __m512d;
  static constexpr int width = 8;
  static __mmask8 mask(int count) noexcept { return static_cast<__mmask8>(count >= 8 ? 0xff : (1u << count) - 1u); }
  static Type zero() noexcept { return _mm512_setzero_pd(); }
  static Type all(double x) noexcept { return _mm512_set1_pd(x); }
  static Type load(const double* p) noexcept { return _mm512_loadu_pd(p); }
  static void store(double* p, Type v) noexcept { _mm512_storeu_pd(p, v); }
  static Type load_part(const double* p, int count) noexcept { return _mm512_maskz_loadu_pd(mask(count), p); }
  static void store_part(double* p, Type v, int count) noexcept { _mm512_mask_storeu_pd(p, mask(count), v); }
  static void store_first(double* p, Type v, int count) noexcept {
    if (count >= 8) return store(p, v);
    const __m256d low = _mm512_maskz_extractf64x4_pd(0xff, v, 0);
    if (count <= 4) return Double4::store_first(p, low, count);
    Double4::store(p, low);
    Double4::store_first(p + 4, _mm512_maskz_extractf64x4_pd(0xff, v, 1), count - 4);
  }
  static Type add(Type a, Type b) noexcept { return _mm512_add_pd(a, b); }
  static Type multiply(Type a, Type b) noexcept { return _mm512_mul_pd(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return _mm512_fmadd_pd(a, b, c); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return _mm512_fnmadd_pd(a, b, c); }
};

template <>
struct Simd<float> {
  using Type = __m512;
  static constexpr int width = 16;
  static __mmask16 mask(int count) noexcept {
    return static_cast<__mmask16>(count >= 16 ? 0xffff : (1u << count) - 1u);
  }
  static Type zero() noexcept { return _mm512_setzero_ps(); }
  static Type all(float x) noexcept { return _mm512_set1_ps(x); }
  static Type load(const float* p) noexcept { return _mm512_loadu_ps(p); }
  static void store(float* p, Type v) noexcept { _mm512_storeu_ps(p, v); }
  static Type load_part(const float* p, int count) noexcept { return _mm512_maskz_loadu_ps(mask(count), p); }
  static void store_part(float* p, Type v, int count) noexcept { _mm512_mask_storeu_ps(p, mask(count), v); }
  static void store_first(float* p, Type v, int count) noexcept {
    if (count >= 16) return store(p, v);
    const __m256 low = _mm512_maskz_extractf32x8_ps(0xff, v, 0);
    if (count <= 8) return Float8::store_first(p, low, count);
    Float8::store(p, low);
    Float8::store_first(p + 8, _mm512_maskz_extractf32x8_ps(0xff, v, 1), count - 8);
  }
  static Type add(Type a, Type b) noexcept { return _mm512_add_ps(a, b); }
  static Type multiply(Type a, Type b) noexcept { return _mm512_mul_ps(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return _mm512_fmadd_ps(a, b, c); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return _mm512_fnmadd_ps(a, b, c); }
};

// Vectors for supernodes whose number of columns is known at compile time: 256 bits where that is
// enough.
template <bool Half>
struct NarrowDouble {
  using Set = Simd<double>;
};
template <>
struct NarrowDouble<true> {
  using Set = Double4;
};
template <bool Half>
struct NarrowFloat {
  using Set = Simd<float>;
};
template <>
struct NarrowFloat<true> {
  using Set = Float8;
};
template <class T, int Columns>
struct Narrow : NarrowDouble<Columns <= 4> {};
template <int Columns>
struct Narrow<float, Columns> : NarrowFloat<Columns <= 8> {};

// Multiplies a row of N <= 16 numbers by z, padded with zeros to 16, and sums the products to four numbers. One fused
// multiply-add joins lanes 8 apart, then lanes 4 apart are added. Reads up to 15 numbers behind the row.
constexpr bool has_row_products = true;
template <int N>
inline __m256d row_products(const double* row, const double* z) noexcept {
  if (N <= 4) return _mm256_mul_pd(_mm256_loadu_pd(row), _mm256_load_pd(z));
  __m512d all = _mm512_mul_pd(_mm512_loadu_pd(row), _mm512_load_pd(z));
  if (N > 8) all = _mm512_fmadd_pd(_mm512_loadu_pd(row + 8), _mm512_load_pd(z + 8), all);
  return _mm256_add_pd(_mm512_maskz_extractf64x4_pd(0xff, all, 0), _mm512_maskz_extractf64x4_pd(0xff, all, 1));
}

// Sizes of blocks: sums stay in 24 of 32 registers, the rest holds factors. On a torus of 62,500 vertices, 6 rows spill
// and factorise 15 % slower, 2 rows and 4 columns take as long within 1 %.
constexpr int gemm_rows = 3, gemm_columns = 8;  // vectors of rows x columns of a sum
// In narrow supernodes, so many right-hand sides have kernels of their own, whose columns lie along the lanes. With 1,
// fields of two and three channels take 9 and 6 % longer; with 2 none changes by more than the noise of 6 %.
constexpr std::int32_t narrow_channels = 4;
// The same block in the kernels for paths. 16 rows spill: 100 sites take 28 % longer. With 4 rows and with 2 vectors
// they take 3 % longer, the noise.
constexpr int lane_vectors = 3, lane_rows = 8;

// Transposes by one 8 x 8 transpose in registers: out[r][at + c] = tile[8 c + r] for r < rows and c < columns.
inline void store_transposed(const double* tile, double* const* out, std::int64_t at, std::int32_t rows,
                             std::int32_t columns) noexcept {
  __m512d in[8], pair[8], quad[8], row[8];
  for (int k = 0; k < 8; ++k) in[k] = k < columns ? _mm512_loadu_pd(tile + 8 * k) : _mm512_setzero_pd();
  for (int k = 0; k < 8; k += 2) {
    pair[k] = _mm512_maskz_unpacklo_pd(0xff, in[k], in[k + 1]);
    pair[k + 1] = _mm512_maskz_unpackhi_pd(0xff, in[k], in[k + 1]);
  }
  for (int k = 0; k < 8; k += 4) {
    for (int h = 0; h < 2; ++h) {
      quad[k + h] = _mm512_maskz_shuffle_f64x2(0xff, pair[k + h], pair[k + 2 + h], 0x88);
      quad[k + 2 + h] = _mm512_maskz_shuffle_f64x2(0xff, pair[k + h], pair[k + 2 + h], 0xdd);
    }
  }
  for (int h = 0; h < 4; ++h) {
    row[h] = _mm512_maskz_shuffle_f64x2(0xff, quad[h], quad[4 + h], 0x88);
    row[4 + h] = _mm512_maskz_shuffle_f64x2(0xff, quad[h], quad[4 + h], 0xdd);
  }
  const __mmask8 mask = Simd<double>::mask(columns);
  for (int k = 0; k < 8; ++k) {
    if (k >= rows) break;
    _mm512_mask_storeu_pd(out[k] + at, mask, row[k]);
  }
}

}  // namespace
