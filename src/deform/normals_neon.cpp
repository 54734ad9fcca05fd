// The loop over triangles of normals.cpp with two components in one register. Products, differences and sums are the
// same, so the bits are too. Every 64-bit ARM processor can run it.
#include <arm_neon.h>

#include "base/compiler.h"
#include "deform/normals_avx2.h"

namespace hf_inner::deform {

namespace {

template <class Inside>
HF_ALWAYS_INLINE void add_normals(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                                  Inside&& inside) noexcept {
  const double* positions = rows.positions;
  float* sums = rows.sums;
  const double unit = rows.unit;
  const std::int32_t* end = corners + 3 * static_cast<std::size_t>(count);
  for (const std::int32_t* corner = corners; corner < end; corner += 3) {
    const std::size_t i = static_cast<std::uint32_t>(corner[0]), j = static_cast<std::uint32_t>(corner[1]),
                      k = static_cast<std::uint32_t>(corner[2]);
    const double *p = positions + 3 * i, *q = positions + 3 * j, *r = positions + 3 * k;
    const float64x2_t xy = vld1q_f64(p);
    const float64x2_t a = vmulq_n_f64(vsubq_f64(vld1q_f64(q), xy), unit),
                      b = vmulq_n_f64(vsubq_f64(vld1q_f64(r), xy), unit);
    // The third components of both edges share a register.
    const float64x2_t third =
        vmulq_n_f64(vsubq_f64(vcombine_f64(vld1_f64(q + 2), vld1_f64(r + 2)), vdupq_n_f64(p[2])), unit);
    // The cross product is (a1 b2 - a2 b1, a2 b0 - a0 b2, a0 b1 - a1 b0).
    const float64x2_t ab = vmulq_laneq_f64(a, third, 1), ba = vmulq_laneq_f64(b, third, 0);
    const double cx = vgetq_lane_f64(ab, 1) - vgetq_lane_f64(ba, 1), cy = vgetq_lane_f64(ba, 0) - vgetq_lane_f64(ab, 0);
    const float64x2_t cross = vmulq_f64(a, vextq_f64(b, b, 1));
    const double cz = vgetq_lane_f64(cross, 0) - vgetq_lane_f64(cross, 1);
    const float32x4_t n = vcombine_f32(vcvt_f32_f64(vcombine_f64(vdup_n_f64(cx), vdup_n_f64(cy))),
                                       vcvt_f32_f64(vcombine_f64(vdup_n_f64(cz), vdup_n_f64(0))));
    const auto add = [&](std::size_t v) {
      float* sum = sums + 4 * v;
      vst1q_f32(sum, vaddq_f32(vld1q_f32(sum), n));
    };
    if (inside(corner[0])) add(i);
    if (inside(corner[1])) add(j);
    if (inside(corner[2])) add(k);
  }
}

}  // namespace

void add_inner_normals_neon(const NormalRows& rows, const std::int32_t* corners, std::int32_t count) noexcept {
  add_normals(rows, corners, count, [](std::int32_t) { return true; });
}

void add_border_normals_neon(const NormalRows& rows, const std::int32_t* corners, std::int32_t count,
                             std::int32_t first, std::int32_t last) noexcept {
  add_normals(rows, corners, count, [=](std::int32_t v) { return v >= first && v < last; });
}

}  // namespace hf_inner::deform
