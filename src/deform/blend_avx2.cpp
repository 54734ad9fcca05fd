// The loop of blend.cpp with one column of the blended transform in each register. The sums have the order of the plain
// loop, without fused multiply-adds, so the bits are the same. The build uses -mavx2, and the program chooses the loop
// at run time. The file includes no header with inline functions, because their AVX2 code could be linked into other
// files.
#include <immintrin.h>

#include "deform/blend_rows.h"

namespace hf_inner::deform {

namespace {

// Blends four vertices, half a block of eight, one vertex per lane. First it sums the twelve numbers of their
// transforms, cluster by cluster. A cluster that a vertex does not use has weight zero in its lane.
void blend_half(const BlendRows& rows, std::int32_t block, std::size_t half) noexcept {
  const std::int32_t begin = rows.block_start[block], end = rows.block_start[block + 1];
  __m256d sum[12];
  const auto add = [&](std::int32_t k, auto&& join) {
    const double* a = rows.columns + 16 * static_cast<std::size_t>(rows.block_cluster[k]);
    const __m256d w = _mm256_cvtps_pd(_mm_loadu_ps(rows.block_weight + 8 * static_cast<std::size_t>(k) + 4 * half));
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) join(sum[3 * j + i], _mm256_mul_pd(w, _mm256_broadcast_sd(a + 4 * j + i)));
    }
  };
  add(begin, [](__m256d& to, __m256d part) { to = part; });
  for (std::int32_t k = begin + 1; k < end; ++k)
    add(k, [](__m256d& to, __m256d part) { to = _mm256_add_pd(to, part); });
  const std::size_t at = 24 * static_cast<std::size_t>(block) + 12 * half;
  const double* p = rows.rest + at;
  double lanes[3][4];
  for (int i = 0; i < 3; ++i) {
    __m256d x = _mm256_mul_pd(sum[i], _mm256_set_pd(p[9], p[6], p[3], p[0]));
    x = _mm256_add_pd(x, _mm256_mul_pd(sum[3 + i], _mm256_set_pd(p[10], p[7], p[4], p[1])));
    x = _mm256_add_pd(x, _mm256_mul_pd(sum[6 + i], _mm256_set_pd(p[11], p[8], p[5], p[2])));
    x = _mm256_add_pd(x, sum[9 + i]);
    x = _mm256_add_pd(_mm256_set1_pd(rows.offset[i]), _mm256_mul_pd(_mm256_set1_pd(rows.scale), x));
    _mm256_storeu_pd(lanes[i], x);
  }
  double* out = rows.positions + at;
  for (int l = 0; l < 4; ++l) {
    for (int i = 0; i < 3; ++i) out[3 * l + i] = lanes[i][l];
  }
}

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

}  // namespace

void blend_rows_avx2(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
  std::int32_t v = first;
  for (; rows.block_start && v + 8 <= last; v += 8) {
    if (rows.block_start[v / 8] < rows.block_start[v / 8 + 1]) {
      blend_half(rows, v / 8, 0);
      blend_half(rows, v / 8, 1);
    } else {
      blend_vertices(rows, v, v + 8);
    }
  }
  blend_vertices(rows, v, last);
}

}  // namespace hf_inner::deform
