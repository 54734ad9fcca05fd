// Kernels for forward sweeps: one supernode with m interleaved right-hand sides. Included after a simd_*.h; see
// kernels_factor.inl. A dot product is summed in 8 (double) or 16 (float) lanes, whatever the vector length.
#include <cstddef>
#include <cstdint>

namespace {

// Returns a dot product. Its partial sums fill 64 bytes on every instruction set, and a fixed tree adds them up.
template <class T>
inline T dot(const T* a, const T* b, std::int32_t count) noexcept {
  using S = Simd<T>;
  constexpr std::int32_t sums = 64 / sizeof(T);
  constexpr int vectors = sums / S::width;
  if (count < sums) {
    T total = 0;
    for (std::int32_t k = 0; k < count; ++k) total = multiply_add_scalar(a[k], b[k], total);
    return total;
  }
  typename S::Type part[vectors];
  for (int p = 0; p < vectors; ++p) part[p] = S::zero();
  std::int32_t k = 0;
  for (; k + sums <= count; k += sums) {
    for (int p = 0; p < vectors; ++p)
      part[p] = S::multiply_add(S::load(a + k + p * S::width), S::load(b + k + p * S::width), part[p]);
  }
  alignas(64) T lane[sums];
  for (int p = 0; p < vectors; ++p) S::store(lane + p * S::width, part[p]);
  for (std::int32_t r = 0; k + r < count; ++r) lane[r] = multiply_add_scalar(a[k + r], b[k + r], lane[r]);
  for (std::int32_t half = sums / 2; half > 0; half /= 2) {
    for (std::int32_t r = 0; r < half; ++r) lane[r] += lane[r + half];
  }
  return lane[0];
}

inline double dot8(const double* a, const double* b, std::int32_t count) noexcept { return dot<double>(a, b, count); }

template <class T>
void forward_triangle_any(const T* triangle, std::int32_t columns, T* z, std::int32_t channels) {
  using S = Simd<T>;
  if (columns <= most_narrow) return forward_narrow<T>(triangle, columns, z, channels);
  const T* row = triangle;
  if (channels == 1) {
    for (std::int32_t j = 0; j < columns; row += ++j) z[j] = (z[j] - dot<T>(row, z, j)) * row[j];
    return;
  }
  for (std::int32_t c = 0; c < channels; c += S::width) {
    const int count = channels - c < S::width ? channels - c : S::width;
    row = triangle;
    for (std::int32_t j = 0; j < columns; row += ++j) {
      // Even and odd columns have a sum of their own, because one chain of sums would wait for each addition.
      typename S::Type even = S::zero(), odd = S::zero();
      const T* x = z + c;
      std::int32_t i = 0;
      for (; i + 2 <= j; i += 2, x += 2 * channels) {
        even = S::multiply_add(S::all(row[i]), load_lanes<T>(x, count), even);
        odd = S::multiply_add(S::all(row[i + 1]), load_lanes<T>(x + channels, count), odd);
      }
      if (i < j) even = S::multiply_add(S::all(row[i]), load_lanes<T>(x, count), even);
      T* own = z + static_cast<std::int64_t>(j) * channels + c;
      const typename S::Type rest = S::subtract_product(S::all(T{1}), S::add(even, odd), load_lanes<T>(own, count));
      store_lanes<T>(own, S::multiply(rest, S::all(row[j])), count);
    }
  }
}

#if defined(HF_ROW_PRODUCTS)
// Multiplies the rows of a narrow supernode (at most 16 columns) by one right-hand side, four rows at a time. The last
// group can write three numbers too many, for which `out` has room.
inline void forward_rows_narrow(const double* below, std::int32_t row_count, std::int32_t columns, const double* z,
                                double* out) noexcept {
  alignas(64) double padded[16] = {};
  for (std::int32_t j = 0; j < columns; ++j) padded[j] = z[j];
  with_columns<most_narrow>(columns, [&](auto size) {
    constexpr int n = decltype(size)::value;
    const double* row = below;
    for (std::int32_t r = 0; r < row_count; r += 4, row += 4 * n) {
      Double4::store(out + r, sums_of_four(row_products<n>(row, padded), row_products<n>(row + n, padded),
                                           row_products<n>(row + 2 * n, padded), row_products<n>(row + 3 * n, padded)));
    }
  });
}
inline void forward_rows_narrow(const float*, std::int32_t, std::int32_t, const float*, float*) noexcept {}
#else
template <class T>
inline void forward_rows_narrow(const T*, std::int32_t, std::int32_t, const T*, T*) noexcept {}
#endif

template <class T>
void forward_rows_any(const T* below, std::int32_t row_count, std::int32_t columns, const T* z, T* out,
                      std::int32_t channels) {
  using S = Simd<T>;
  if (channels == 1 && columns <= most_narrow && has_row_products && sizeof(T) == sizeof(double))
    return forward_rows_narrow(below, row_count, columns, z, out);
  if (channels == 1) {
    for (std::int32_t r = 0; r < row_count; ++r, below += columns) out[r] = dot<T>(below, z, columns);
    return;
  }
  // Takes channels (right-hand sides) in groups of one vector, and four rows at a time. Each entry of the factor fills
  // a whole vector.
  for (std::int32_t c = 0; c < channels; c += S::width) {
    const int count = channels - c < S::width ? channels - c : S::width;
    std::int32_t r = 0;
    for (; r + 4 <= row_count; r += 4) {
      const T* b = below + static_cast<std::int64_t>(r) * columns;
      typename S::Type sum[4] = {S::zero(), S::zero(), S::zero(), S::zero()};
      const T* x = z + c;
      for (std::int32_t j = 0; j < columns; ++j, x += channels) {
        const typename S::Type value = load_lanes<T>(x, count);
        for (int k = 0; k < 4; ++k)
          sum[k] = S::multiply_add(S::all(b[j + static_cast<std::int64_t>(k) * columns]), value, sum[k]);
      }
      for (int k = 0; k < 4; ++k) store_lanes<T>(out + static_cast<std::int64_t>(r + k) * channels + c, sum[k], count);
    }
    for (; r < row_count; ++r) {
      const T* b = below + static_cast<std::int64_t>(r) * columns;
      typename S::Type sum = S::zero();
      for (std::int32_t j = 0; j < columns; ++j)
        sum = S::multiply_add(S::all(b[j]), load_lanes<T>(z + static_cast<std::int64_t>(j) * channels + c, count), sum);
      store_lanes<T>(out + static_cast<std::int64_t>(r) * channels + c, sum, count);
    }
  }
}

void forward_triangle(const double* triangle, std::int32_t columns, double* z, std::int32_t channels) {
  forward_triangle_any<double>(triangle, columns, z, channels);
}
void forward_rows(const double* below, std::int32_t row_count, std::int32_t columns, const double* z, double* out,
                  std::int32_t channels) {
  forward_rows_any<double>(below, row_count, columns, z, out, channels);
}
void forward_triangle_f32(const float* triangle, std::int32_t columns, float* z, std::int32_t channels) {
  forward_triangle_any<float>(triangle, columns, z, channels);
}
void forward_rows_f32(const float* below, std::int32_t row_count, std::int32_t columns, const float* z, float* out,
                      std::int32_t channels) {
  forward_rows_any<float>(below, row_count, columns, z, out, channels);
}

}  // namespace
