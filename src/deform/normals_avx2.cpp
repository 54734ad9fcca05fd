// The loop over triangles of normals.cpp with the three components in one register. Products, differences and sums are
// the same, so the bits are too. The build uses -mavx2, and the program chooses the loop at run time. The file includes
// no header with inline functions, because their AVX2 code could be linked into other files.
#include "deform/normals_avx2.h"

#include <immintrin.h>

#include "base/compiler.h"

namespace hf_inner::deform {

namespace {

template <class Inside>
HF_ALWAYS_INLINE void add_normals(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                                  Inside&& inside) noexcept {
  const double* positions = rows.positions;
  float* sums = rows.sums;
  const __m256d unit = _mm256_set1_pd(rows.unit);
  const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);  // the mask does not read beyond the end of the array
  const std::int32_t* end = corners + 3 * static_cast<std::size_t>(count);
  for (const std::int32_t* corner = corners; corner < end; corner += 3) {
    const std::size_t i = static_cast<std::uint32_t>(corner[0]), j = static_cast<std::uint32_t>(corner[1]),
                      k = static_cast<std::uint32_t>(corner[2]);
    const __m256d p = _mm256_maskload_pd(positions + 3 * i, three);
    const __m256d a = _mm256_mul_pd(unit, _mm256_sub_pd(_mm256_maskload_pd(positions + 3 * j, three), p)),
                  b = _mm256_mul_pd(unit, _mm256_sub_pd(_mm256_maskload_pd(positions + 3 * k, three), p));
    // c is the cross product a x b. Its components have the order z x y until the end.
    constexpr int next = 0xC9;  // shuffles x y z to y z x
    const __m256d c = _mm256_sub_pd(_mm256_mul_pd(a, _mm256_permute4x64_pd(b, next)),
                                    _mm256_mul_pd(_mm256_permute4x64_pd(a, next), b));
    const __m128 turned = _mm256_cvtpd_ps(c);
    const __m128 n = _mm_shuffle_ps(turned, turned, next);
    const auto add = [&](std::size_t v) {
      float* sum = sums + 4 * v;
      _mm_store_ps(sum, _mm_add_ps(_mm_load_ps(sum), n));
    };
    if (inside(corner[0])) add(i);
    if (inside(corner[1])) add(j);
    if (inside(corner[2])) add(k);
  }
}

}  // namespace

void add_inner_normals_avx2(const NormalRows& rows, const std::int32_t* corners, std::int32_t count) noexcept {
  add_normals(rows, corners, count, [](std::int32_t) { return true; });
}

void add_border_normals_avx2(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                             std::int32_t first, std::int32_t last) noexcept {
  add_normals(rows, corners, count, [=](std::int32_t v) { return v >= first && v < last; });
}

}  // namespace hf_inner::deform
