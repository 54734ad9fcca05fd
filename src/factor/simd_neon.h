// Vector types of the build for 64-bit ARM. A vector is two registers of NEON, so that the kernels have the shape of
// the AVX2 build: 16 vectors fill the 32 registers. Sums have the order of AVX2 and are fused, so the bits are the
// same.
#pragma once
#include <arm_neon.h>
#include <math.h>

#include <cstdint>

namespace {

// Numbers beyond `count` are not read and come out as zero; they are not written.
template <class Set, class T>
inline typename Set::Type neon_load_part(const T* p, int count) noexcept {
  T numbers[Set::width] = {};
  for (int i = 0; i < Set::width; ++i) {
    if (i < count) numbers[i] = p[i];
  }
  return Set::load(numbers);
}
template <class Set, class T>
inline void neon_store_part(T* p, typename Set::Type v, int count) noexcept {
  T numbers[Set::width];
  Set::store(numbers, v);
  for (int i = 0; i < Set::width; ++i) {
    if (i < count) p[i] = numbers[i];
  }
}

struct Double2 {
  using Type = float64x2_t;
  static constexpr int width = 2;
  static Type zero() noexcept { return vdupq_n_f64(0); }
  static Type all(double x) noexcept { return vdupq_n_f64(x); }
  static Type load(const double* p) noexcept { return vld1q_f64(p); }
  static void store(double* p, Type v) noexcept { vst1q_f64(p, v); }
  static Type load_part(const double* p, int count) noexcept { return neon_load_part<Double2>(p, count); }
  static void store_part(double* p, Type v, int count) noexcept { neon_store_part<Double2>(p, v, count); }
  static void store_first(double* p, Type v, int count) noexcept {
    if (count >= 2) return store(p, v);
    if (count == 1) vst1q_lane_f64(p, v, 0);
  }
  static Type add(Type a, Type b) noexcept { return vaddq_f64(a, b); }
  static Type multiply(Type a, Type b) noexcept { return vmulq_f64(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return vfmaq_f64(c, a, b); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return vfmsq_f64(c, a, b); }
};

struct Float4 {
  using Type = float32x4_t;
  static constexpr int width = 4;
  static Type zero() noexcept { return vdupq_n_f32(0); }
  static Type all(float x) noexcept { return vdupq_n_f32(x); }
  static Type load(const float* p) noexcept { return vld1q_f32(p); }
  static void store(float* p, Type v) noexcept { vst1q_f32(p, v); }
  static Type load_part(const float* p, int count) noexcept { return neon_load_part<Float4>(p, count); }
  static void store_part(float* p, Type v, int count) noexcept { neon_store_part<Float4>(p, v, count); }
  static void store_first(float* p, Type v, int count) noexcept {
    if (count >= 4) return store(p, v);
    float32x2_t rest = vget_low_f32(v);
    if (count & 2) {
      vst1_f32(p, rest);
      rest = vget_high_f32(v);
      p += 2;
    }
    if (count & 1) vst1_lane_f32(p, rest, 0);
  }
  static Type add(Type a, Type b) noexcept { return vaddq_f32(a, b); }
  static Type multiply(Type a, Type b) noexcept { return vmulq_f32(a, b); }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return vfmaq_f32(c, a, b); }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return vfmsq_f32(c, a, b); }
};

// Two registers of one of the sets above.
template <class Half, class T>
struct NeonPair {
  struct Type {
    typename Half::Type low, high;
  };
  static constexpr int half = Half::width, width = 2 * half;
  static Type zero() noexcept { return {Half::zero(), Half::zero()}; }
  static Type all(T x) noexcept {
    const typename Half::Type both = Half::all(x);
    return {both, both};
  }
  static Type load(const T* p) noexcept { return {Half::load(p), Half::load(p + half)}; }
  static void store(T* p, Type v) noexcept {
    Half::store(p, v.low);
    Half::store(p + half, v.high);
  }
  static Type load_part(const T* p, int count) noexcept { return neon_load_part<NeonPair>(p, count); }
  static void store_part(T* p, Type v, int count) noexcept { neon_store_part<NeonPair>(p, v, count); }
  // Stores the first `count` numbers. It is meant for counts that are known at compile time.
  static void store_first(T* p, Type v, int count) noexcept {
    if (count <= half) return Half::store_first(p, v.low, count);
    Half::store(p, v.low);
    Half::store_first(p + half, v.high, count - half);
  }
  static Type add(Type a, Type b) noexcept { return {Half::add(a.low, b.low), Half::add(a.high, b.high)}; }
  static Type multiply(Type a, Type b) noexcept {
    return {Half::multiply(a.low, b.low), Half::multiply(a.high, b.high)};
  }
  static Type multiply_add(Type a, Type b, Type c) noexcept {
    return {Half::multiply_add(a.low, b.low, c.low), Half::multiply_add(a.high, b.high, c.high)};
  }
  static Type subtract_product(Type a, Type b, Type c) noexcept {
    return {Half::subtract_product(a.low, b.low, c.low), Half::subtract_product(a.high, b.high, c.high)};
  }
};
struct Double4 : NeonPair<Double2, double> {};
struct Float8 : NeonPair<Float4, float> {};

template <class T>
struct Simd;
template <>
struct Simd<double> : Double4 {};
template <>
struct Simd<float> : Float8 {};

// Vectors for supernodes whose number of columns is known at compile time: one register where that
// is enough.
template <bool One, class T>
struct NarrowSet {
  using Set = Simd<T>;
};
template <>
struct NarrowSet<true, double> {
  using Set = Double2;
};
template <>
struct NarrowSet<true, float> {
  using Set = Float4;
};
template <class T, int Columns>
struct Narrow : NarrowSet<Columns * sizeof(T) <= 16, T> {};

inline double multiply_add_scalar(double a, double b, double c) noexcept { return fma(a, b, c); }
inline float multiply_add_scalar(float a, float b, float c) noexcept { return fmaf(a, b, c); }

// Returns the sums of the four numbers of each of four vectors: (0 + 2) + (1 + 3).
inline Double4::Type sums_of_four(Double4::Type a, Double4::Type b, Double4::Type c, Double4::Type d) noexcept {
  return {vpaddq_f64(vaddq_f64(a.low, a.high), vaddq_f64(b.low, b.high)),
          vpaddq_f64(vaddq_f64(c.low, c.high), vaddq_f64(d.low, d.high))};
}

// Multiplies a row of N <= 16 numbers by z, padded with zeros to 16, and sums the products to four numbers. One fused
// multiply-add joins lanes 8 apart, then lanes 4 apart are added. Reads up to 15 numbers behind the row.
#define HF_ROW_PRODUCTS
constexpr bool has_row_products = true;
template <int N>
inline Double4::Type row_products(const double* row, const double* z) noexcept {
  Double4::Type low = Double4::multiply(Double4::load(row), Double4::load(z));
  if (N > 8) low = Double4::multiply_add(Double4::load(row + 8), Double4::load(z + 8), low);
  if (N <= 4) return low;
  Double4::Type high = Double4::multiply(Double4::load(row + 4), Double4::load(z + 4));
  if (N > 8) high = Double4::multiply_add(Double4::load(row + 12), Double4::load(z + 12), high);
  return Double4::add(low, high);
}

// 16 pairs of registers: 3 x 4 and 2 x 6 sums take 12; three or two hold a vector of rows each, one a factor. Double
// spills, half leaves registers idle.
constexpr int gemm_rows = 3, gemm_columns = 4;  // vectors of rows x columns of a sum
constexpr std::int32_t narrow_channels = 4;     // as in simd_avx512.h
constexpr int lane_vectors = 2, lane_rows = 6;  // the block in the kernels for paths

// Transposes by blocks of 2 x 2: out[r][at + c] = tile[8 c + r] for r < rows and c < columns.
inline void store_transposed(const double* tile, double* const* out, std::int64_t at, std::int32_t rows,
                             std::int32_t columns) noexcept {
  std::int32_t r = 0;
  for (; r + 2 <= rows; r += 2) {
    double *upper = out[r] + at, *lower = out[r + 1] + at;
    std::int32_t c = 0;
    for (; c + 2 <= columns; c += 2) {
      const float64x2_t left = vld1q_f64(tile + 8 * c + r), right = vld1q_f64(tile + 8 * (c + 1) + r);
      vst1q_f64(upper + c, vzip1q_f64(left, right));
      vst1q_f64(lower + c, vzip2q_f64(left, right));
    }
    if (c < columns) {
      upper[c] = tile[8 * c + r];
      lower[c] = tile[8 * c + r + 1];
    }
  }
  if (r < rows) {
    for (std::int32_t c = 0; c < columns; ++c) out[r][at + c] = tile[8 * c + r];
  }
}

}  // namespace
