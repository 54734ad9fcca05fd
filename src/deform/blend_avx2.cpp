// The loop of blend.cpp on four lanes: the rows of a blended transform lie in one register each. The sums have the
// order of the plain loop and nothing is contracted, so the bits are the same. Built with -mavx2, chosen at run time;
// includes no header whose inline functions could leak into other files.
#include "deform/blend_avx2.h"

#include <immintrin.h>

namespace hf {

void blend_rows_avx2(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
  const __m256d offset = _mm256_set_pd(0, rows.offset[2], rows.offset[1], rows.offset[0]),
                scale = _mm256_set1_pd(rows.scale);
  for (std::int32_t v = first; v < last; ++v) {
    const double* p = rows.rest + 3 * static_cast<std::size_t>(v);
    const std::int32_t begin = rows.start[v], end = rows.start[v + 1];
    __m256d x = _mm256_set_pd(0, p[2], p[1], p[0]);
    if (begin < end) {
      const double* a = rows.transforms + 12 * static_cast<std::size_t>(rows.cluster[begin]);
      __m256d r0 = _mm256_loadu_pd(a), r1 = _mm256_loadu_pd(a + 4), r2 = _mm256_loadu_pd(a + 8);
      if (end - begin > 1) {
        const __m256d w = _mm256_broadcast_sd(rows.weight + begin);
        r0 = _mm256_mul_pd(w, r0), r1 = _mm256_mul_pd(w, r1), r2 = _mm256_mul_pd(w, r2);
        for (std::int32_t k = begin + 1; k < end; ++k) {
          const double* b = rows.transforms + 12 * static_cast<std::size_t>(rows.cluster[k]);
          const __m256d u = _mm256_broadcast_sd(rows.weight + k);
          r0 = _mm256_add_pd(r0, _mm256_mul_pd(u, _mm256_loadu_pd(b)));
          r1 = _mm256_add_pd(r1, _mm256_mul_pd(u, _mm256_loadu_pd(b + 4)));
          r2 = _mm256_add_pd(r2, _mm256_mul_pd(u, _mm256_loadu_pd(b + 8)));
        }
      }
      const __m256d point = _mm256_set_pd(1, p[2], p[1], p[0]);
      r0 = _mm256_mul_pd(r0, point), r1 = _mm256_mul_pd(r1, point), r2 = _mm256_mul_pd(r2, point);
      // columns of the three rows: ((c0 + c1) + c2) + c3
      const __m256d zero = _mm256_setzero_pd();
      const __m256d a01 = _mm256_unpacklo_pd(r0, r1), b01 = _mm256_unpackhi_pd(r0, r1),
                    a23 = _mm256_unpacklo_pd(r2, zero), b23 = _mm256_unpackhi_pd(r2, zero);
      const __m256d c0 = _mm256_permute2f128_pd(a01, a23, 0x20), c1 = _mm256_permute2f128_pd(b01, b23, 0x20),
                    c2 = _mm256_permute2f128_pd(a01, a23, 0x31), c3 = _mm256_permute2f128_pd(b01, b23, 0x31);
      x = _mm256_add_pd(_mm256_add_pd(_mm256_add_pd(c0, c1), c2), c3);
    }
    x = _mm256_add_pd(offset, _mm256_mul_pd(scale, x));
    double* out = rows.positions + 3 * static_cast<std::size_t>(v);
    _mm_storeu_pd(out, _mm256_castpd256_pd128(x));
    _mm_store_sd(out + 2, _mm256_extractf128_pd(x, 1));
  }
}

}  // namespace hf
