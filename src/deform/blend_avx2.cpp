// The loop of blend.cpp with a column of the blended transform in each register. The sums have the order of the plain
// loop and nothing is contracted, so the bits are the same. Built with -mavx2, chosen at run time; includes no header
// whose inline functions could leak into other files.
#include "deform/blend_rows.h"

#include <immintrin.h>

namespace hf {

void blend_rows_avx2(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
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
      __m256d w = _mm256_cvtps_pd(_mm_broadcast_ss(weight + begin));
      __m256d c0 = _mm256_mul_pd(w, _mm256_load_pd(a)), c1 = _mm256_mul_pd(w, _mm256_load_pd(a + 4)),
              c2 = _mm256_mul_pd(w, _mm256_load_pd(a + 8)), c3 = _mm256_mul_pd(w, _mm256_load_pd(a + 12));
      for (std::int32_t k = begin + 1; k < end; ++k) {
        a = columns + 16 * static_cast<std::size_t>(cluster[k]);
        w = _mm256_cvtps_pd(_mm_broadcast_ss(weight + k));
        c0 = _mm256_add_pd(c0, _mm256_mul_pd(w, _mm256_load_pd(a)));
        c1 = _mm256_add_pd(c1, _mm256_mul_pd(w, _mm256_load_pd(a + 4)));
        c2 = _mm256_add_pd(c2, _mm256_mul_pd(w, _mm256_load_pd(a + 8)));
        c3 = _mm256_add_pd(c3, _mm256_mul_pd(w, _mm256_load_pd(a + 12)));
      }
      x = _mm256_mul_pd(c0, _mm256_broadcast_sd(p));
      x = _mm256_add_pd(x, _mm256_mul_pd(c1, _mm256_broadcast_sd(p + 1)));
      x = _mm256_add_pd(x, _mm256_mul_pd(c2, _mm256_broadcast_sd(p + 2)));
      x = _mm256_add_pd(x, c3);
    } else {
      x = _mm256_set_pd(0, p[2], p[1], p[0]);
    }
    x = _mm256_add_pd(offset, _mm256_mul_pd(scale, x));
    _mm_storeu_pd(out, _mm256_castpd256_pd128(x));
    _mm_store_sd(out + 2, _mm256_extractf128_pd(x, 1));
  }
}

}  // namespace hf
