// Vector types of the AVX2 + FMA build.
#pragma once
#include <immintrin.h>

#include <cstdint>

#include "factor/simd_256.h"

namespace {

template <class T>
struct Simd;

template <>
struct Simd<double> : Double4 {};
template <>
struct Simd<float> : Float8 {};
template <class T, int Columns>
struct Narrow {
  using Set = Simd<T>;
};

// Multiplies a row of N <= 16 numbers by z, padded with zeros to 16, and sums the products to four numbers. One fused
// multiply-add joins lanes 8 apart, then lanes 4 apart are added. Reads up to 15 numbers behind the row.
constexpr bool has_row_products = true;
template <int N>
inline __m256d row_products(const double* row, const double* z) noexcept {
  __m256d low = _mm256_mul_pd(_mm256_loadu_pd(row), _mm256_load_pd(z));
  if (N > 8) low = _mm256_fmadd_pd(_mm256_loadu_pd(row + 8), _mm256_load_pd(z + 8), low);
  if (N <= 4) return low;
  __m256d high = _mm256_mul_pd(_mm256_loadu_pd(row + 4), _mm256_load_pd(z + 4));
  if (N > 8) high = _mm256_fmadd_pd(_mm256_loadu_pd(row + 12), _mm256_load_pd(z + 12), high);
  return _mm256_add_pd(low, high);
}

// 16 registers: 3 x 4 and 2 x 6 sums take 12; three or two hold a vector of rows each, one a factor. Double spills,
// half leaves registers idle.
constexpr int gemm_rows = 3, gemm_columns = 4;  // vectors of rows x columns of a sum
constexpr std::int32_t narrow_channels = 4;     // as in simd_avx512.h
constexpr int lane_vectors = 2, lane_rows = 6;  // the block in the kernels for paths

// Transposes by blocks of 4 x 4: out[r][at + c] = tile[8 c + r] for r < rows and c < columns.
inline void store_transposed(const double* tile, double* const* out, std::int64_t at, std::int32_t rows,
                             std::int32_t columns) noexcept {
  for (std::int32_t r = 0; r < rows; r += 4) {
    for (std::int32_t c = 0; c < columns; c += 4) {
      __m256d in[4], pair[4], row[4];
      for (int k = 0; k < 4; ++k)
        in[k] = c + k < columns ? _mm256_loadu_pd(tile + 8 * (c + k) + r) : _mm256_setzero_pd();
      pair[0] = _mm256_unpacklo_pd(in[0], in[1]);
      pair[1] = _mm256_unpackhi_pd(in[0], in[1]);
      pair[2] = _mm256_unpacklo_pd(in[2], in[3]);
      pair[3] = _mm256_unpackhi_pd(in[2], in[3]);
      row[0] = _mm256_permute2f128_pd(pair[0], pair[2], 0x20);
      row[1] = _mm256_permute2f128_pd(pair[1], pair[3], 0x20);
      row[2] = _mm256_permute2f128_pd(pair[0], pair[2], 0x31);
      row[3] = _mm256_permute2f128_pd(pair[1], pair[3], 0x31);
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
