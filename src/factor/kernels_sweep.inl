// Kernels for backward sweeps: one supernode with m interleaved right-hand sides. Included after a simd_*.h; see
// kernels_factor.inl.
//
// A column's sum over the rows below is one chain in row order. With one right-hand side and at most 16 columns, two
// chains hide the latency. This rule counts columns of the supernode, not vector lengths or jobs. So all instruction
// sets and all numbers of threads give the same bits. Narrow supernodes are in kernels_narrow.inl.
#include <cstddef>
#include <cstdint>

namespace {

// The figures of this file come from AVX-512, one thread and a torus of 62,500 vertices. Where none is given, half and
// double of a number take as long within the noise of 5 %, with 1 to 40 channels.

// Columns of a supernode that are summed together on the stack, for several right-hand sides: trades passes over the
// rows for stack.
constexpr std::int32_t chunk_columns = 256;
// Columns of a supernode that are summed together on the stack, for one right-hand side. Most supernodes have fewer, so
// a block is read as one stream.
constexpr std::int32_t single_columns = 1024;
// Numbers of the right-hand sides that stay in the second-level cache while groups of columns pass over them: 64 KB of
// doubles. On a torus of 90,000 vertices 40 channels take 18.2 ms, 17.8 with half and 19.3 with double.
constexpr std::int64_t pass_numbers = 8192;
// At least this many rows are summed in one pass, whatever their length: fewer would load and store the sums more
// often.
constexpr std::int64_t least_rows = 16;
// Columns of a supernode's triangle whose values are copied together: 16 KB for eight right-hand sides, inside the
// first-level cache. On a torus of 90,000 vertices 40 channels take 18.2 ms, 22 with half and 25 with double.
constexpr std::int32_t segment = 256;

template <class T>
constexpr int line = 64 / sizeof(T);  // numbers of a cache line

// Returns how many rows stay in the second-level cache while groups of columns pass over them.
inline std::int32_t rows_of_pass(std::int64_t columns) noexcept {
  return static_cast<std::int32_t>(columns * least_rows > pass_numbers ? least_rows : pass_numbers / columns);
}

template <int N>
struct Constant {
  static constexpr int value = N;
};

// Calls body with the number of columns as a compile-time constant. columns: from 1 to Most.
template <int Most, class Body>
inline void with_columns(std::int32_t columns, Body&& body) noexcept {
  if (columns == Most) return body(Constant<Most>{});
  if constexpr (Most > 1) with_columns<Most - 1>(columns, body);
}

// Sums up to NV vectors of columns over all rows, for C right-hand sides: sum[c * chunk_columns + column]. `Chains`
// rows are summed at once. A wide block is read strip by strip, which is not its order in memory. So each row
// prefetches as many numbers as it reads from `ahead`, in order.
template <class T, int C, int NV, int Chains, bool Ahead = false>
inline void sum_in_registers(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                             const T* z, std::int32_t channels, T* sum, const T* ahead = nullptr) noexcept {
  using S = Simd<T>;
  typename S::Type part[Chains][C][NV];
  for (int h = 0; h < Chains; ++h) {
    for (int c = 0; c < C; ++c) {
      for (int v = 0; v < NV; ++v)
        part[h][c][v] = (Chains == 1) ? S::load(sum + c * chunk_columns + v * S::width) : S::zero();
    }
  }
  std::int32_t r = 0;
  for (; r + Chains <= row_count; r += Chains) {
    for (int h = 0; h < Chains; ++h) {
      const T* x = z + static_cast<std::int64_t>(rows[r + h]) * channels;
      if (Ahead) {
        for (int v = 0; v < NV; ++v) HF_PREFETCH_FAR(ahead + v * S::width);
        ahead += NV * S::width;
      }
      typename S::Type entry[NV];
      for (int v = 0; v < NV; ++v) entry[v] = S::load(block + v * S::width);
      for (int c = 0; c < C; ++c) {
        const typename S::Type factor = S::all(x[c]);
        for (int v = 0; v < NV; ++v) part[h][c][v] = S::multiply_add(entry[v], factor, part[h][c][v]);
      }
      block += stride;
    }
  }
  for (int h = 0; h < Chains - 1; ++h) {
    if (r + h >= row_count) break;
    const T* x = z + static_cast<std::int64_t>(rows[r + h]) * channels;
    for (int c = 0; c < C; ++c) {
      for (int v = 0; v < NV; ++v)
        part[h][c][v] = S::multiply_add(S::load(block + v * S::width), S::all(x[c]), part[h][c][v]);
    }
    block += stride;
  }
  for (int c = 0; c < C; ++c) {
    for (int v = 0; v < NV; ++v) {
      typename S::Type total = part[0][c][v];
      if (Chains == 2) total = S::add(total, part[Chains - 1][c][v]);
      S::store(sum + c * chunk_columns + v * S::width, total);
    }
  }
}

// For one right-hand side, the sums of up to this many vectors of columns stay in registers. The block is then read as
// one stream, row after row, which the processor's own prefetch follows best. 16 of the 32 registers of AVX-512, 12 of
// 16 elsewhere; the rest holds entries and right-hand sides.
constexpr int register_vectors = gemm_columns == 8 ? 16 : 12;

template <class T, int NV = register_vectors>
inline void sum_row_by_row(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                           int vectors, const T* z, T* sum) noexcept {
  if (vectors == NV) return sum_in_registers<T, 1, NV, 1>(block, stride, rows, row_count, z, 1, sum);
  if constexpr (NV > 1) sum_row_by_row<T, NV - 1>(block, stride, rows, row_count, vectors, z, sum);
}

// Sums more columns than fit in registers; the sums stay in the first-level cache. Two or more rows at a time would
// load and store the sums less often. But they read several streams, with 16 instead of 30 GB/s where it was measured.
template <class T>
inline void sum_streaming(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                          std::int32_t width, const T* z, T* sum) noexcept {
  using S = Simd<T>;
  const int vectors = (width + S::width - 1) / S::width;
  if (vectors <= register_vectors) return sum_row_by_row<T>(block, stride, rows, row_count, vectors, z, sum);
  for (std::int32_t r = 0; r < row_count; ++r, block += stride) {
    const typename S::Type x = S::all(z[rows[r]]);
    for (std::int32_t j = 0; j < width; j += S::width)
      S::store(sum + j, S::multiply_add(S::load(block + j), x, S::load(sum + j)));
  }
}

template <class T, int C>
inline void sum_channels(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                         std::int32_t width, const T* z, std::int32_t channels, T* sum) noexcept {
  using S = Simd<T>;
  // The sums that stay in registers: about 16 vectors of 32 registers, or 8 of 16. Half takes up to 5 % longer.
  constexpr int most = gemm_columns == 8 ? (C >= 8 ? 2 : 16 / C >= 8 ? 8 : 16 / C) : (C >= 4 ? (C > 4 ? 1 : 2) : 8 / C);
  const std::int32_t pass = rows_of_pass(stride);
  for (std::int32_t r = 0; r < row_count; r += pass) {
    const std::int32_t count = row_count - r < pass ? row_count - r : pass;
    const T* first = block + r * stride;
    const T* ahead = first + static_cast<std::int64_t>(pass) * stride;
    const auto strip = [&](auto vectors, std::int32_t j) {
      constexpr int n = decltype(vectors)::value;
      sum_in_registers<T, C, n, 1, true>(first + j, stride, rows + r, count, z, channels, sum + j,
                                         ahead + static_cast<std::int64_t>(j) * count);
      return j + n * S::width;
    };
    std::int32_t j = 0;
    while (j + (most - 1) * S::width < width) j = strip(Constant<most>{}, j);
    if (most > 1 && j < width) {
      with_columns<(most > 1 ? most - 1 : 1)>((width - j + S::width - 1) / S::width,
                                              [&](auto vectors) { strip(vectors, j); });
    }
  }
}

// Sums the products of a supernode's rows below with C right-hand sides that start at z: sum[c][j] for column j.
template <class T, int C>
inline void sum_rows(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                     std::int32_t width, const T* z, std::int32_t channels, T* sum) noexcept {
  using S = Simd<T>;
  if (C == 1) {
    if (stride <= 16) {
      // Vectors of columns summed together, so that each row is read once. Two of AVX2 hold as many numbers as one of
      // AVX-512. Double takes as long within 2 %; half of one does not exist.
      constexpr int vectors = S::width <= 4 ? 2 : 1;
      for (std::int32_t j = 0; j < width; j += vectors * S::width) {
        sum_in_registers<T, 1, vectors, 2>(block + j, stride, rows, row_count, z, channels, sum + j);
      }
      return;
    }
    if (channels == 1) return sum_streaming<T>(block, stride, rows, row_count, width, z, sum);
  }
  sum_channels<T, C>(block, stride, rows, row_count, width, z, channels, sum);
}

// Multiplies `width` columns of a supernode's rows below by z for all channels (right-hand sides), and subtracts the
// sums from z.
template <class T, int C>
inline void subtract_sums(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                          std::int32_t width, T* z, T* target, std::int32_t channels) noexcept {
  alignas(64) T sum[(C == 1 ? single_columns : C * chunk_columns) + 64];
  // Supernodes of up to 16 columns with one right-hand side write their sums without reading them first.
  const std::int32_t padded = C == 1 && stride <= 16 ? 0 : (width + 63) & ~63;
  for (int c = 0; c < C; ++c) {
    for (std::int32_t j = 0; j < padded; ++j) sum[c * chunk_columns + j] = 0;
  }
  sum_rows<T, C>(block, stride, rows, row_count, width, z, channels, sum);
  for (int c = 0; c < C; ++c) {
    for (std::int32_t j = 0; j < width; ++j)
      target[static_cast<std::int64_t>(j) * channels + c] -= sum[c * chunk_columns + j];
  }
}

template <class T>
inline typename Simd<T>::Type load_lanes(const T* p, int count) noexcept {
  return count == Simd<T>::width ? Simd<T>::load(p) : Simd<T>::load_part(p, count);
}
template <class T>
inline void store_lanes(T* p, typename Simd<T>::Type v, int count) noexcept {
  if (count == Simd<T>::width)
    Simd<T>::store(p, v);
  else
    Simd<T>::store_part(p, v, count);
}

// Sums N columns of a supernode for one vector of channels (right-hand sides): target[j] -= the products of column j
// with the rows of z. Each entry of the factor fills a whole vector. The block is read in strips of N columns, which is
// not its order in memory. So each row prefetches as many numbers as it reads from `ahead`, in order.
template <class T, int N>
inline void subtract_lanes(const T* block, std::int64_t stride, const std::int32_t* rows, std::int32_t row_count,
                           const T* z, T* target, std::int32_t channels, int count, const T* ahead) noexcept {
  using S = Simd<T>;
  typename S::Type sum[N];
  HF_UNROLL
  for (int j = 0; j < N; ++j) sum[j] = S::zero();
  for (std::int32_t r = 0; r < row_count; ++r, block += stride) {
    const typename S::Type x = load_lanes<T>(z + static_cast<std::int64_t>(rows[r]) * channels, count);
    for (int k = 0; k < N; k += line<T>) HF_PREFETCH_FAR(ahead + k);
    ahead += N;
    HF_UNROLL
    for (int j = 0; j < N; ++j) sum[j] = S::multiply_add(S::all(block[j]), x, sum[j]);
  }
  HF_UNROLL
  for (int j = 0; j < N; ++j) {
    T* out = target + static_cast<std::int64_t>(j) * channels;
    store_lanes<T>(out, S::subtract_product(S::all(T{1}), sum[j], load_lanes<T>(out, count)), count);
  }
}

// Sums a supernode's rows for many channels (right-hand sides), which lie along the lanes. Rows are taken in passes
// that stay in the cache while the groups of columns pass over them.
template <class T>
void backward_rows_lanes(const T* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                         std::int32_t width, T* z, T* target, std::int32_t channels) noexcept {
  // Columns whose sums stay in registers: half of the 32, or of the 16, that the processor has. More would spill, fewer
  // read the right-hand sides more often. With 8 of 32, 40 channels take 15.3 ms instead of 12.8 on a torus of 62,500
  // vertices.
  constexpr int group = gemm_columns == 8 ? 16 : 8;
  const std::int32_t pass = rows_of_pass(columns);
  for (std::int32_t r = 0; r < row_count; r += pass) {
    const std::int32_t left = row_count - r < pass ? row_count - r : pass;
    const T* first = below + static_cast<std::int64_t>(r) * columns;
    const std::int64_t ahead = static_cast<std::int64_t>(pass) * columns;
    for (std::int32_t c = 0; c < channels; c += Simd<T>::width) {
      const int count = channels - c < Simd<T>::width ? channels - c : Simd<T>::width;
      std::int32_t j = 0;
      const auto run = [&](auto size) {
        constexpr int n = decltype(size)::value;
        subtract_lanes<T, n>(first + j, columns, rows + r, left, z + c,
                             target + static_cast<std::int64_t>(j) * channels + c, channels, count,
                             first + ahead + static_cast<std::int64_t>(j) * left);
        j += n;
      };
      while (j + group <= width) run(Constant<group>{});
      if (j < width) with_columns<group - 1>(width - j, run);
    }
  }
}

template <class T>
void backward_rows_any(const T* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                       std::int32_t begin, std::int32_t end, T* z, std::int32_t first, std::int32_t channels) {
  if (channels > 4) {
    return backward_rows_lanes<T>(below + begin, rows, row_count, columns, end - begin, z,
                                  z + static_cast<std::int64_t>(first + begin) * channels, channels);
  }
  const std::int32_t chunk = channels == 1 ? single_columns : chunk_columns;
  for (std::int32_t j = begin; j < end; j += chunk) {
    const std::int32_t width = end - j < chunk ? end - j : chunk;
    T* target = z + static_cast<std::int64_t>(first + j) * channels;
    switch (channels) {
      case 1:
        subtract_sums<T, 1>(below + j, columns, rows, row_count, width, z, target, 1);
        break;
      case 2:
        subtract_sums<T, 2>(below + j, columns, rows, row_count, width, z, target, 2);
        break;
      case 3:
        subtract_sums<T, 3>(below + j, columns, rows, row_count, width, z, target, 3);
        break;
      default:
        subtract_sums<T, 4>(below + j, columns, rows, row_count, width, z, target, 4);
        break;
    }
  }
}

// Solves a supernode's packed triangle for one right-hand side. It reads the triangle from its last number to its first
// as one stream. For each row j it computes x_j = x_j inv_j, then x_i -= L[j][i] x_j for i < j, the nearest i first,
// because the next row waits for it. The present columns are in a copy: a single number stored among them could not be
// forwarded to the vector load after it.
template <class T>
void backward_triangle_single(const T* triangle, std::int32_t columns, T* z) noexcept {
  using S = Simd<T>;
  alignas(64) T x[single_columns + 64];
  std::int32_t begin = (columns - 1) / single_columns * single_columns;
  for (std::int32_t end = columns; end > 0; end = begin, begin -= single_columns) {
    for (std::int32_t j = begin; j < end; ++j) x[j - begin] = z[j];
    for (std::int32_t j = end - 1; j >= begin; --j) {
      const T* row = triangle + static_cast<std::int64_t>(j) * (j + 1) / 2;
      const T value = x[j - begin] * row[j];
      z[j] = value;
      const typename S::Type factor = S::all(value);
      T* near = x - begin;
      std::int32_t i = begin + (j - begin - 1 + S::width) / S::width * S::width;
      while ((i -= S::width) >= begin)
        S::store(near + i, S::subtract_product(S::load(row + i), factor, S::load(near + i)));
      for (; i >= 0; i -= S::width) S::store(z + i, S::subtract_product(S::load(row + i), factor, S::load(z + i)));
    }
  }
}

// Subtracts the contribution of at most 8 rows of the packed triangle, whose solution is in `x`. Columns [left, right)
// lie in a copy of whole vectors. The nearest column comes first.
template <class T, class S>
inline void subtract_solved(const T* const* row, const typename S::Type* x, std::int32_t left, std::int32_t right,
                            T* copy) noexcept {
  for (std::int32_t i = right - 1; i >= left; --i) {
    T* at = copy + (i - left) * S::width;
    typename S::Type target = S::load(at);
    HF_UNROLL
    for (std::int32_t k = 7; k >= 0; --k) target = S::subtract_product(S::all(row[k][i]), x[k], target);
    S::store(at, target);
  }
}

// Solves a supernode's triangle for several right-hand sides along the lanes, one segment of columns at a time in a
// copy. Without the copy, partial vectors stored next to each other could not be forwarded to the loads after them.
// Each target is loaded and stored once for 8 rows.
template <class T, class S>
inline void backward_triangle_lanes(const T* triangle, std::int32_t columns, T* z, std::int32_t channels,
                                    int count) noexcept {
  // Rows whose solutions stay in registers while each target is loaded and stored once. subtract_solved() has this
  // number too. With 4 and 16 all channels take as long within 3 %.
  constexpr std::int32_t block = 8;
  alignas(64) T copy[segment * S::width];
  const auto load = [&](const T* p) { return count == S::width ? S::load(p) : S::load_part(p, count); };
  const std::int64_t step = channels;
  const T* row[block];
  typename S::Type x[block];
  const auto take_rows = [&](std::int32_t from, std::int32_t to) {
    HF_UNROLL
    for (std::int64_t k = 0; k < block; ++k) row[k] = triangle + (from + k) * (from + k + 1) / 2;
    for (std::int32_t k = to - from; k < block; ++k) {
      row[k] = row[0];
      x[k] = S::zero();
    }
  };
  std::int32_t left = (columns - 1) / segment * segment;
  for (std::int32_t right = columns; right > 0; right = left, left -= segment) {
    for (std::int32_t i = left; i < right; ++i) S::store(copy + (i - left) * S::width, load(z + i * step));
    for (std::int32_t to = columns; to > right; to = (to - 1) / block * block) {
      const std::int32_t from = (to - 1) / block * block;
      take_rows(from, to);
      for (std::int32_t k = 0; k < to - from; ++k) x[k] = load(z + (from + k) * step);
      subtract_solved<T, S>(row, x, left, right, copy);
    }
    for (std::int32_t to = right; to > left; to = (to - 1) / block * block) {
      const std::int32_t from = (to - 1) / block * block;
      take_rows(from, to);
      T* own = copy + (from - left) * S::width;
      for (std::int32_t k = 0; k < to - from; ++k) x[k] = S::load(own + k * S::width);
      for (std::int32_t k = to - from - 1; k >= 0; --k) {
        x[k] = S::multiply(x[k], S::all(row[k][from + k]));
        S::store(own + k * S::width, x[k]);
        HF_UNROLL
        for (std::int32_t l = 0; l < k; ++l) x[l] = S::subtract_product(S::all(row[k][from + l]), x[k], x[l]);
      }
      subtract_solved<T, S>(row, x, left, from, copy);
    }
    for (std::int32_t i = left; i < right; ++i) {
      const typename S::Type value = S::load(copy + (i - left) * S::width);
      count == S::width ? S::store(z + i * step, value) : S::store_part(z + i * step, value, count);
    }
  }
}

template <class T>
void backward_triangle_any(const T* triangle, std::int32_t columns, T* z, std::int32_t channels) {
  using S = Simd<T>;
  using Half = typename Narrow<T, 4>::Set;
  if (channels == 1) return backward_triangle_single<T>(triangle, columns, z);
  for (std::int32_t c = 0; c < channels; c += S::width) {
    const int count = channels - c < S::width ? channels - c : S::width;
    if (count <= Half::width) {
      backward_triangle_lanes<T, Half>(triangle, columns, z + c, channels, count);
    } else {
      backward_triangle_lanes<T, S>(triangle, columns, z + c, channels, count);
    }
  }
}

void backward_rows(const double* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                   std::int32_t begin, std::int32_t end, double* z, std::int32_t first, std::int32_t channels) {
  backward_rows_any<double>(below, rows, row_count, columns, begin, end, z, first, channels);
}
void backward_triangle(const double* triangle, std::int32_t columns, double* z, std::int32_t channels) {
  backward_triangle_any<double>(triangle, columns, z, channels);
}
void backward_rows_f32(const float* below, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                       std::int32_t begin, std::int32_t end, float* z, std::int32_t first, std::int32_t channels) {
  backward_rows_any<float>(below, rows, row_count, columns, begin, end, z, first, channels);
}
void backward_triangle_f32(const float* triangle, std::int32_t columns, float* z, std::int32_t channels) {
  backward_triangle_any<float>(triangle, columns, z, channels);
}

}  // namespace
