// The loop of blend.cpp with two columns of the blended transform in each register. The sums have the order of the
// plain loop, without fused multiply-adds, so the bits are the same. The build uses -mavx512f, and the program chooses
// the loop at run time. The file includes no header with inline functions, because their AVX-512 code could be linked
// into other files.
#include <immintrin.h>

#include "deform/blend_rows.h"

namespace hf_inner::deform {
namespace {

// Blends a block of eight vertices, one vertex per lane. First it sums the twelve numbers of their transforms, cluster
// by cluster. A cluster that a vertex does not use has weight zero in its lane. The masks are all ones: the intrinsics
// without a mask start from an undefined register, and GCC 12 warns about that.
void blend_block(const BlendRows& rows, std::int32_t block) noexcept {
  const std::int32_t begin = rows.block_start[block], end = rows.block_start[block + 1];
  __m512d sum[12];
  const auto add = [&](std::int32_t k, auto&& join) {
    const double* a = rows.columns + 16 * static_cast<std::size_t>(rows.block_cluster[k]);
    const __m512d w = _mm512_maskz_cvtps_pd(0xFF, _mm256_loadu_ps(rows.block_weight + 8 * static_cast<std::size_t>(k)));
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) join(sum[3 * j + i], _mm512_mul_pd(w, _mm512_set1_pd(a[4 * j + i])));
    }
  };
  add(begin, [](__m512d& to, __m512d part) { to = part; });
  for (std::int32_t k = begin + 1; k < end; ++k)
    add(k, [](__m512d& to, __m512d part) { to = _mm512_add_pd(to, part); });
  const double* p = rows.rest + 24 * static_cast<std::size_t>(block);
  const __m512d p0 = _mm512_loadu_pd(p), p1 = _mm512_loadu_pd(p + 8), p2 = _mm512_loadu_pd(p + 16);
  const auto pick = [&](__m512i from01, __m512i from2) {
    return _mm512_permutex2var_pd(_mm512_permutex2var_pd(p0, from01, p1), from2, p2);
  };
  const __m512d rest[3] = {
      pick(_mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 10, 13)),
      pick(_mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 8, 11, 14)),
      pick(_mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 9, 12, 15))};
  __m512d x[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = _mm512_mul_pd(sum[i], rest[0]);
    x[i] = _mm512_add_pd(x[i], _mm512_mul_pd(sum[3 + i], rest[1]));
    x[i] = _mm512_add_pd(x[i], _mm512_mul_pd(sum[6 + i], rest[2]));
    x[i] = _mm512_add_pd(x[i], sum[9 + i]);
    x[i] = _mm512_add_pd(_mm512_set1_pd(rows.offset[i]), _mm512_mul_pd(_mm512_set1_pd(rows.scale), x[i]));
  }
  const auto mix = [&](__m512i from01, __m512i from2) {
    return _mm512_permutex2var_pd(_mm512_permutex2var_pd(x[0], from01, x[1]), from2, x[2]);
  };
  double* out = rows.positions + 24 * static_cast<std::size_t>(block);
  _mm512_storeu_pd(out, mix(_mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10), _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7)));
  _mm512_storeu_pd(out + 8,
                   mix(_mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5), _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7)));
  _mm512_storeu_pd(out + 16,
                   mix(_mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0), _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15)));
}

inline __m256d lower(__m512d c) noexcept { return _mm512_maskz_extractf64x4_pd(0xFF, c, 0); }
inline __m256d upper(__m512d c) noexcept { return _mm512_maskz_extractf64x4_pd(0xFF, c, 1); }

void blend_vertices(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
  const __m256d offset = _mm256_set_pd(0, rows.offset[2], rows.offset[1], rows.offset[0]),
                scale = _mm256_set1_pd(rows.scale);
  const std::int32_t* start = rows.start;
  const std::uint16_t* cluster = rows.cluster;
  const float* weight = rows.weight;
  const double* columns = rows.columns;
  const double* p = rows.rest + 3 * static_cast<std::size_t>(first);
  double* out = rows.positions + 3 * static_cast<std::size_t>(first);
  for (std::int32_t v = first; v < last; ++v, p += 3, out += 3) {
    const std::int32_t begin = start[v], end = start[v + 1];
    __m256d x;
    if (begin < end) {
      const double* a = columns + 16 * static_cast<std::size_t>(cluster[begin]);
      __m512d w = _mm512_set1_pd(static_cast<double>(weight[begin]));
      __m512d c01 = _mm512_mul_pd(w, _mm512_load_pd(a)), c23 = _mm512_mul_pd(w, _mm512_load_pd(a + 8));
      for (std::int32_t k = begin + 1; k < end; ++k) {
        a = columns + 16 * static_cast<std::size_t>(cluster[k]);
        w = _mm512_set1_pd(static_cast<double>(weight[k]));
        c01 = _mm512_add_pd(c01, _mm512_mul_pd(w, _mm512_load_pd(a)));
        c23 = _mm512_add_pd(c23, _mm512_mul_pd(w, _mm512_load_pd(a + 8)));
      }
      x = _mm256_mul_pd(lower(c01), _mm256_broadcast_sd(p));
      x = _mm256_add_pd(x, _mm256_mul_pd(upper(c01), _mm256_broadcast_sd(p + 1)));
      x = _mm256_add_pd(x, _mm256_mul_pd(lower(c23), _mm256_broadcast_sd(p + 2)));
      x = _mm256_add_pd(x, upper(c23));
    } else {
      x = _mm256_set_pd(0, p[2], p[1], p[0]);
    }
    x = _mm256_add_pd(offset, _mm256_mul_pd(scale, x));
    _mm_storeu_pd(out, _mm256_castpd256_pd128(x));
    _mm_store_sd(out + 2, _mm256_extractf128_pd(x, 1));
  }
}

}  // namespace

void blend_rows_avx512(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
  std::int32_t v = first;
  for (; rows.block_start && v + 8 <= last; v += 8) {
    if (rows.block_start[v / 8] < rows.block_start[v / 8 + 1]) {
      blend_block(rows, v / 8);
    } else {
      blend_vertices(rows, v, v + 8);
    }
  }
  blend_vertices(rows, v, last);
}

}  // namespace hf_inner::deform
