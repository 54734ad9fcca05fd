// Vector types of the plain build, with two lanes, which every 64-bit processor has. Products are rounded before they
// are added.
#pragma once
#include <cstdint>
#include <cstring>

#include "base/compiler.h"

namespace {

HF_VECTOR(Vector2, double, 2);
HF_VECTOR(Vector4f, float, 4);

template <class T>
struct Simd;

template <class T, class Lanes, int Width>
struct PlainSimd {
  using Type = Lanes;
  static constexpr int width = Width;
  static Type zero() noexcept { return Type{}; }
  static Type all(T x) noexcept {
    Type v;
    for (int i = 0; i < Width; ++i) v[i] = x;
    return v;
  }
  static Type load(const T* p) noexcept {
    Type v;
    std::memcpy(&v, p, sizeof v);
    return v;
  }
  static void store(T* p, Type v) noexcept { std::memcpy(p, &v, sizeof v); }
  static Type load_part(const T* p, int count) noexcept {
    Type v{};
    for (int i = 0; i < Width; ++i) {
      if (i < count) v[i] = p[i];
    }
    return v;
  }
  static void store_part(T* p, Type v, int count) noexcept {
    for (int i = 0; i < Width; ++i) {
      if (i < count) p[i] = v[i];
    }
  }
  static void store_first(T* p, Type v, int count) noexcept { store_part(p, v, count < Width ? count : Width); }
  static Type add(Type a, Type b) noexcept { return a + b; }
  static Type multiply(Type a, Type b) noexcept { return a * b; }
  static Type multiply_add(Type a, Type b, Type c) noexcept { return a * b + c; }
  static Type subtract_product(Type a, Type b, Type c) noexcept { return c - a * b; }
};

template <>
struct Simd<double> : PlainSimd<double, Vector2, 2> {};
template <>
struct Simd<float> : PlainSimd<float, Vector4f, 4> {};

template <class T, int Columns>
struct Narrow {
  using Set = Simd<T>;
};

constexpr bool has_row_products = false;  // without four lanes, one product follows the other

// There are 16 registers. Sums of 3 x 4 take 12, sums of 2 x 4 take 8. The rest holds rows and factors. Double spills.
constexpr int gemm_rows = 3, gemm_columns = 4;  // vectors of rows x columns of a sum
// In narrow supernodes, only one right-hand side has kernels of its own. With two lanes, more of them lie along the
// lanes as fast, and the code of 16 widths for 2, 3 and 4 would take a tenth of the WebAssembly file.
constexpr std::int32_t narrow_channels = 1;
constexpr int lane_vectors = 2, lane_rows = 4;  // the block in the kernels for paths

inline double multiply_add_scalar(double a, double b, double c) noexcept { return a * b + c; }
inline float multiply_add_scalar(float a, float b, float c) noexcept { return a * b + c; }

// Transposes: out[r][at + c] = tile[8 c + r] for r < rows and c < columns.
inline void store_transposed(const double* tile, double* const* out, std::int64_t at, std::int32_t rows,
                             std::int32_t columns) noexcept {
  for (std::int32_t r = 0; r < rows; ++r) {
    for (std::int32_t c = 0; c < columns; ++c) out[r][at + c] = tile[8 * c + r];
  }
}

}  // namespace
