// Kernels for narrow supernodes, which have at most 16 columns. Most supernodes of a factor are narrow, and a sweep
// over them waits for latency, not for memory.
//
// They are stored inverted. A supernode's columns consist of a triangle L and the rows B below. Instead of them, the
// factor stores X = L^-1 and W = B L^-1. Both sweeps are then products, without a chain from column to column.
//     backward  z <- X' z - W' y     (y: the rows below)
//     forward   y <- y - W z, then z <- X z
// The inverse of at most 16 columns of a Cholesky factor is as accurate as the substitution it replaces (Higham 2002,
// chapter 8). Computing it costs nc (nc + 1) / 2 products per row for nc columns, a few percent of the factorisation.
//
// Order of sums: with one right-hand side, the own rows and then the rows below go to four chains in turn (two chains
// above 8 columns). With several right-hand sides they form one chain.
#include <cstddef>
#include <cstdint>

namespace {

constexpr int most_narrow = hf_inner::factor::narrow_columns;

// Returns entry (i, j) of a front's triangle, which is stored in tiles of 8 rows.
inline double& triangle_entry(double* panel, std::int64_t stride, std::int32_t i, std::int32_t j) noexcept {
  return panel[(i >> 3) * stride + 8 * j + (i & 7)];
}

// Replaces a narrow front's triangle L, whose diagonal is already inverted, by X = L^-1.
void invert_triangle(const FrontView& front) {
  const std::int64_t stride = 8 * static_cast<std::int64_t>(front.columns);
  const auto at = [&](std::int32_t i, std::int32_t j) -> double& { return triangle_entry(front.panel, stride, i, j); };
  for (std::int32_t j = 0; j < front.columns; ++j) {
    for (std::int32_t i = j + 1; i < front.columns; ++i) {
      double sum = 0;
      for (std::int32_t k = j; k < i; ++k) sum = multiply_add_scalar(at(i, k), at(k, j), sum);
      at(i, j) = -(sum * at(i, i));
    }
  }
}

// Multiplies vector-rows (as many rows as a vector has numbers) of `Width` columns by the triangle X: w_j = sum over i
// >= j of b_i X_ij.
template <int Width>
void multiply_rows_fixed(double* panel, std::int64_t stride, std::int32_t v, std::int32_t v_end) noexcept {
  for (; v < v_end; ++v) {
    double* row = vector_row(panel, v, stride);
    D::Type b[Width];
    HF_UNROLL
    for (int j = 0; j < Width; ++j) b[j] = D::load(row + 8 * j);
    HF_UNROLL
    for (int j = 0; j < Width; ++j) {
      D::Type sum = D::multiply(b[j], D::all(triangle_entry(panel, stride, j, j)));
      HF_UNROLL
      for (int i = j + 1; i < Width; ++i) sum = D::multiply_add(b[i], D::all(triangle_entry(panel, stride, i, j)), sum);
      D::store(row + 8 * j, sum);
    }
  }
}

void multiply_inverse(const FrontView& front, std::int32_t tile_begin, std::int32_t tile_end) {
  const std::int64_t stride = 8 * static_cast<std::int64_t>(front.columns);
  with_columns<most_narrow>(front.columns, [&](auto columns) {
    multiply_rows_fixed<decltype(columns)::value>(front.panel, stride, tile_begin * tile_vectors,
                                                  tile_end * tile_vectors);
  });
}

// Backward sweep of a narrow supernode for up to 4 right-hand sides; its columns lie along the vector lanes.
template <class T, int N, int C>
inline void backward_narrow_columns(const T* triangle, const std::int32_t* rows, std::int32_t row_count, T* z,
                                    std::int32_t first) noexcept {
  using S = typename Narrow<T, N>::Set;
  constexpr int vectors = (N + S::width - 1) / S::width, chains = C > 1 ? 1 : N > 8 ? 2 : 4;
  typename S::Type part[chains][C][vectors];
  HF_UNROLL
  for (int h = 0; h < chains; ++h) {
    HF_UNROLL
    for (int c = 0; c < C; ++c) {
      HF_UNROLL
      for (int v = 0; v < vectors; ++v) part[h][c][v] = S::zero();
    }
  }
  T* own = z + static_cast<std::int64_t>(first) * C;
  const T* row = triangle;
  HF_UNROLL
  for (int j = 0; j < N; row += ++j) {
    HF_UNROLL
    for (int v = 0; v < vectors; ++v) {
      const int left = j + 1 - v * S::width;
      if (left <= 0) continue;
      const typename S::Type entry =
          left >= S::width ? S::load(row + v * S::width) : S::load_part(row + v * S::width, left);
      HF_UNROLL
      for (int c = 0; c < C; ++c)
        part[j % chains][c][v] = S::multiply_add(entry, S::all(own[j * C + c]), part[j % chains][c][v]);
    }
  }
  const auto add = [&](int h, const T* x, const T* b) {
    HF_UNROLL
    for (int v = 0; v < vectors; ++v) {
      const typename S::Type entry = S::load(b + v * S::width);
      HF_UNROLL
      for (int c = 0; c < C; ++c) part[h][c][v] = S::subtract_product(entry, S::all(x[c]), part[h][c][v]);
    }
  };
  std::int32_t r = 0;
  for (; r + chains <= row_count; r += chains, row += chains * N) {
    HF_UNROLL
    for (int h = 0; h < chains; ++h) add(h, z + static_cast<std::int64_t>(rows[r + h]) * C, row + h * N);
  }
  HF_UNROLL
  for (int h = 0; h < chains - 1; ++h, row += N) {
    if (r + h >= row_count) break;
    add(h, z + static_cast<std::int64_t>(rows[r + h]) * C, row);
  }
  HF_UNROLL
  for (int v = 0; v < vectors; ++v) {
    const int count = N - v * S::width < S::width ? N - v * S::width : S::width;
    if (C == 1) {
      typename S::Type total = S::add(part[0][0][v], part[1 % chains][0][v]);
      if (chains == 4) total = S::add(total, S::add(part[2 % chains][0][v], part[3 % chains][0][v]));
      S::store_first(own + v * S::width, total, count);
      continue;
    }
    alignas(64) T lane[C][S::width];
    HF_UNROLL
    for (int c = 0; c < C; ++c) S::store(lane[c], part[0][c][v]);
    HF_UNROLL
    for (int j = 0; j < count; ++j) {
      HF_UNROLL
      for (int c = 0; c < C; ++c) own[(v * S::width + j) * C + c] = lane[c][j];
    }
  }
}

// Backward sweep of a narrow supernode for one vector of right-hand sides along the lanes, with columns [begin, begin +
// N) in registers. Earlier columns are already finished, later ones are not.
template <class T, int N>
inline void backward_narrow_lanes(const T* triangle, std::int32_t columns, std::int32_t begin, const std::int32_t* rows,
                                  std::int32_t row_count, T* z, std::int32_t first, std::int32_t channels,
                                  int count) noexcept {
  using S = Simd<T>;
  typename S::Type sum[N];
  HF_UNROLL
  for (int j = 0; j < N; ++j) sum[j] = S::zero();
  T* own = z + static_cast<std::int64_t>(first) * channels;
  const T* row = triangle + begin * (begin + 1) / 2 + begin;
  HF_UNROLL
  for (int i = 0; i < N; row += begin + ++i) {
    const typename S::Type x = load_lanes<T>(own + static_cast<std::int64_t>(begin + i) * channels, count);
    HF_UNROLL
    for (int j = 0; j <= i; ++j) sum[j] = S::multiply_add(S::all(row[j]), x, sum[j]);
  }
  for (std::int32_t i = begin + N; i < columns; row += ++i) {
    const typename S::Type x = load_lanes<T>(own + static_cast<std::int64_t>(i) * channels, count);
    HF_UNROLL
    for (int j = 0; j < N; ++j) sum[j] = S::multiply_add(S::all(row[j]), x, sum[j]);
  }
  const T* below = triangle + columns * (columns + 1) / 2 + begin;
  for (std::int32_t r = 0; r < row_count; ++r, below += columns) {
    const typename S::Type x = load_lanes<T>(z + static_cast<std::int64_t>(rows[r]) * channels, count);
    HF_UNROLL
    for (int j = 0; j < N; ++j) sum[j] = S::subtract_product(S::all(below[j]), x, sum[j]);
  }
  HF_UNROLL
  for (int j = 0; j < N; ++j) store_lanes<T>(own + static_cast<std::int64_t>(begin + j) * channels, sum[j], count);
}

template <class T>
void backward_narrow_vector(const T* triangle, std::int32_t columns, const std::int32_t* rows, std::int32_t row_count,
                            T* z, std::int32_t first, std::int32_t channels, int count) noexcept {
  // Columns whose sums stay in registers: 16 of 32 or 8 of 16. On a torus of 62,500 vertices 8 and 40 channels take as
  // long with 8 as with 16 (AVX-512), within 1 %.
  constexpr int most = gemm_columns == 8 ? most_narrow : 8;
  std::int32_t begin = 0;
  const auto run = [&](auto size) {
    constexpr int n = decltype(size)::value;
    backward_narrow_lanes<T, n>(triangle, columns, begin, rows, row_count, z, first, channels, count);
    begin += n;
  };
  while (begin + most < columns) run(Constant<most>{});
  with_columns<most>(columns - begin, run);
}

template <class T>
void backward_narrow_any(const T* triangle, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                         T* z, std::int32_t first, std::int32_t channels) noexcept {
  if (channels == 1) {
    return with_columns<most_narrow>(columns, [&](auto size) {
      backward_narrow_columns<T, decltype(size)::value, 1>(triangle, rows, row_count, z, first);
    });
  }
  if (channels > narrow_channels) {
    for (std::int32_t c = 0; c < channels; c += Simd<T>::width) {
      const int count = channels - c < Simd<T>::width ? channels - c : Simd<T>::width;
      backward_narrow_vector<T>(triangle, columns, rows, row_count, z + c, first, channels, count);
    }
    return;
  }
  if constexpr (narrow_channels > 1) {
    with_columns<most_narrow>(columns, [&](auto size) {
      constexpr int n = decltype(size)::value;
      switch (channels) {
        case 2:
          return backward_narrow_columns<T, n, 2>(triangle, rows, row_count, z, first);
        case 3:
          return backward_narrow_columns<T, n, 3>(triangle, rows, row_count, z, first);
        default:
          return backward_narrow_columns<T, n, 4>(triangle, rows, row_count, z, first);
      }
    });
  }
}

void backward_narrow(const double* triangle, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                     double* z, std::int32_t first, std::int32_t channels) {
  backward_narrow_any<double>(triangle, rows, row_count, columns, z, first, channels);
}
void backward_narrow_f32(const float* triangle, const std::int32_t* rows, std::int32_t row_count, std::int32_t columns,
                         float* z, std::int32_t first, std::int32_t channels) {
  backward_narrow_any<float>(triangle, rows, row_count, columns, z, first, channels);
}

// Computes z <- X z for the inverted triangle X, from the last row to the first.
template <class T>
inline void forward_narrow(const T* triangle, std::int32_t columns, T* z, std::int32_t channels) noexcept {
  using S = Simd<T>;
  const T* row = triangle + columns * (columns + 1) / 2;
  for (std::int32_t j = columns - 1; j >= 0; --j) {
    row -= j + 1;
    if (channels == 1) {
      T sum = 0;
      for (std::int32_t i = 0; i <= j; ++i) sum = multiply_add_scalar(row[i], z[i], sum);
      z[j] = sum;
      continue;
    }
    for (std::int32_t c = 0; c < channels; c += S::width) {
      const int count = channels - c < S::width ? channels - c : S::width;
      typename S::Type sum = S::zero();
      for (std::int32_t i = 0; i <= j; ++i)
        sum = S::multiply_add(S::all(row[i]), load_lanes<T>(z + i * channels + c, count), sum);
      store_lanes<T>(z + j * channels + c, sum, count);
    }
  }
}

// Does the same as forward_narrow on a block of elimination paths, with the sites along the lanes. lanes: 1 or a
// multiple of 8.
inline void path_narrow(const double* triangle, std::int32_t columns, double* x, std::int32_t lanes) noexcept {
  forward_narrow<double>(triangle, columns, x, lanes);
}

}  // namespace
