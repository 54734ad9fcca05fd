// The loop of blend.cpp with two vertices or two numbers of a transform in each register. The sums have the order of
// the plain loop, without fused multiply-adds, so the bits are the same. Every 64-bit ARM processor can run it.
#include <arm_neon.h>

#include "deform/blend_rows.h"

namespace hf_inner::deform {
namespace {

// Blends four vertices, half a block of eight, two vertices in a register. First it sums the twelve numbers of their
// transforms, cluster by cluster: 24 of the 32 registers. A cluster that a vertex does not use has weight zero.
void blend_half(const BlendRows& rows, std::int32_t block, std::size_t half) noexcept {
  const std::int32_t begin = rows.block_start[block], end = rows.block_start[block + 1];
  float64x2_t low[12], high[12];
  const auto add = [&](std::int32_t k, auto&& join) {
    const double* a = rows.columns + 16 * static_cast<std::size_t>(rows.block_cluster[k]);
    const float32x4_t w = vld1q_f32(rows.block_weight + 8 * static_cast<std::size_t>(k) + 4 * half);
    const float64x2_t w0 = vcvt_f64_f32(vget_low_f32(w)), w1 = vcvt_high_f64_f32(w);
    for (int j = 0; j < 4; ++j) {
      const float64x2_t xy = vld1q_f64(a + 4 * j), z = vld1q_f64(a + 4 * j + 2);
      join(low[3 * j], vmulq_laneq_f64(w0, xy, 0));
      join(high[3 * j], vmulq_laneq_f64(w1, xy, 0));
      join(low[3 * j + 1], vmulq_laneq_f64(w0, xy, 1));
      join(high[3 * j + 1], vmulq_laneq_f64(w1, xy, 1));
      join(low[3 * j + 2], vmulq_laneq_f64(w0, z, 0));
      join(high[3 * j + 2], vmulq_laneq_f64(w1, z, 0));
    }
  };
  add(begin, [](float64x2_t& to, float64x2_t part) { to = part; });
  for (std::int32_t k = begin + 1; k < end; ++k)
    add(k, [](float64x2_t& to, float64x2_t part) { to = vaddq_f64(to, part); });
  const std::size_t at = 24 * static_cast<std::size_t>(block) + 12 * half;
  const auto finish = [&](const float64x2_t(&sum)[12], std::size_t first) {
    const float64x2x3_t p = vld3q_f64(rows.rest + at + first);
    float64x2x3_t out;
    for (int i = 0; i < 3; ++i) {
      float64x2_t x = vmulq_f64(sum[i], p.val[0]);
      x = vaddq_f64(x, vmulq_f64(sum[3 + i], p.val[1]));
      x = vaddq_f64(x, vmulq_f64(sum[6 + i], p.val[2]));
      x = vaddq_f64(x, sum[9 + i]);
      out.val[i] = vaddq_f64(vdupq_n_f64(rows.offset[i]), vmulq_n_f64(x, rows.scale));
    }
    vst3q_f64(rows.positions + at + first, out);
  };
  finish(low, 0);
  finish(high, 6);
}

void blend_vertices(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
  const float64x2_t offset = vld1q_f64(rows.offset);
  const double* p = rows.rest + 3 * static_cast<std::size_t>(first);
  double* out = rows.positions + 3 * static_cast<std::size_t>(first);
  for (std::int32_t v = first; v < last; ++v, p += 3, out += 3) {
    const std::int32_t begin = rows.start[v], end = rows.start[v + 1];
    float64x2_t xy = vld1q_f64(p);
    double z = p[2];
    if (begin < end) {
      const auto column = [&](std::int32_t k) { return rows.columns + 16 * static_cast<std::size_t>(rows.cluster[k]); };
      float64x2_t sum[8];
      const double* a = column(begin);
      float64x2_t w = vdupq_n_f64(static_cast<double>(rows.weight[begin]));
      for (int j = 0; j < 8; ++j) sum[j] = vmulq_f64(w, vld1q_f64(a + 2 * j));
      for (std::int32_t k = begin + 1; k < end; ++k) {
        a = column(k);
        w = vdupq_n_f64(static_cast<double>(rows.weight[k]));
        for (int j = 0; j < 8; ++j) sum[j] = vaddq_f64(sum[j], vmulq_f64(w, vld1q_f64(a + 2 * j)));
      }
      float64x2_t low = vmulq_n_f64(sum[0], p[0]), high = vmulq_n_f64(sum[1], p[0]);
      low = vaddq_f64(low, vmulq_n_f64(sum[2], p[1]));
      high = vaddq_f64(high, vmulq_n_f64(sum[3], p[1]));
      low = vaddq_f64(low, vmulq_n_f64(sum[4], p[2]));
      high = vaddq_f64(high, vmulq_n_f64(sum[5], p[2]));
      xy = vaddq_f64(low, sum[6]);
      z = vgetq_lane_f64(vaddq_f64(high, sum[7]), 0);
    }
    vst1q_f64(out, vaddq_f64(offset, vmulq_n_f64(xy, rows.scale)));
    out[2] = rows.offset[2] + rows.scale * z;
  }
}

}  // namespace

void blend_rows_neon(const BlendRows& rows, std::int32_t first, std::int32_t last) noexcept {
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
