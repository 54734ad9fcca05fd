// Kernels for elimination paths: blocks of up to 32 sites, with the sites along the vector lanes. Included after a
// simd_*.h; see kernels_factor.inl.
#include <cstddef>
#include <cstdint>

namespace {

// Multiplies R rows of the factor by the path entries x of many sites, which fill L vectors of lanes. target[r][lane]
// += (or -=) sum over k of a[r][k * a_step] * x[k * lanes + lane].
template <int R, int L, bool Add>
inline void lane_block(const double* const* a, std::int64_t a_step, const double* x, std::int64_t lanes,
                       std::int32_t k_count, double* const* target) noexcept {
  D::Type sum[R][L];
  for (int r = 0; r < R; ++r) {
    for (int l = 0; l < L; ++l) sum[r][l] = D::load(target[r] + l * D::width);
  }
  std::int64_t offset = 0;
  for (std::int32_t k = 0; k < k_count; ++k, offset += a_step, x += lanes) {
    D::Type value[L];
    for (int l = 0; l < L; ++l) value[l] = D::load(x + l * D::width);
    for (int r = 0; r < R; ++r) {
      const D::Type factor = D::all(a[r][offset]);
      for (int l = 0; l < L; ++l) {
        sum[r][l] =
            Add ? D::multiply_add(factor, value[l], sum[r][l]) : D::subtract_product(factor, value[l], sum[r][l]);
      }
    }
  }
  for (int r = 0; r < R; ++r) {
    for (int l = 0; l < L; ++l) D::store(target[r] + l * D::width, sum[r][l]);
  }
}

template <int R, bool Add>
inline void lane_rows_block(const double* const* a, std::int64_t a_step, const double* x, std::int64_t lanes,
                            std::int32_t used, std::int32_t k_count, double* const* target) noexcept {
  std::int32_t lane = 0;
  const auto shifted = [&](double** out) {
    for (int r = 0; r < R; ++r) out[r] = target[r] + lane;
  };
  double* part[R];
  while (lane < used) {
    const std::int32_t vectors = (used - lane) / D::width;
    shifted(part);
    if (lane_vectors == 3 && (vectors == 3 || vectors > 4)) {
      lane_block<R, lane_vectors, Add>(a, a_step, x + lane, lanes, k_count, part);
      lane += 3 * D::width;
    } else if (vectors >= 2) {
      lane_block<R, 2, Add>(a, a_step, x + lane, lanes, k_count, part);
      lane += 2 * D::width;
    } else {
      lane_block<R, 1, Add>(a, a_step, x + lane, lanes, k_count, part);
      lane += D::width;
    }
  }
}

// Does the same as lane_rows_block (above) for any number of rows.
template <bool Add>
inline void lane_rows_any(const double* const* a, std::int64_t a_step, const double* x, std::int64_t lanes,
                          std::int32_t used, std::int32_t k_count, double* const* target, std::int32_t count) noexcept {
  std::int32_t r = 0;
  for (; r + lane_rows <= count; r += lane_rows)
    lane_rows_block<lane_rows, Add>(a + r, a_step, x, lanes, used, k_count, target + r);
  for (; r + 2 <= count; r += 2) lane_rows_block<2, Add>(a + r, a_step, x, lanes, used, k_count, target + r);
  for (; r < count; ++r) lane_rows_block<1, Add>(a + r, a_step, x, lanes, used, k_count, target + r);
}

void path_triangle(const double* triangle, std::int32_t columns, double* x, std::int32_t lanes) {
  if (columns <= most_narrow) return path_narrow(triangle, columns, x, lanes);
  if (lanes == 1) {
    const double* row = triangle;
    for (std::int32_t j = 0; j < columns; row += ++j) x[j] = (x[j] - dot8(row, x, j)) * row[j];
    return;
  }
  // Columns solved together: more load the right-hand sides less often and leave a longer triangle for single rows. On
  // a torus of 62,500 vertices 100 sites take 3.4 ms with 8 and 16, and 3.8 ms with 4.
  constexpr std::int32_t step = 8;
  for (std::int32_t begin = 0; begin < columns; begin += step) {
    const std::int32_t count = columns - begin < step ? columns - begin : step;
    const double* a[step];
    double* target[step];
    for (std::int32_t r = 0; r < count; ++r) {
      const std::int64_t at = begin + r;
      a[r] = triangle + at * (at + 1) / 2;
      target[r] = x + at * lanes;
    }
    lane_rows_any<false>(a, 1, x, lanes, lanes, begin, target, count);
    for (std::int32_t j = 0; j < count; ++j) {
      const D::Type inverse = D::all(a[j][begin + j]);
      for (std::int32_t lane = 0; lane < lanes; lane += D::width) {
        D::Type value = D::load(target[j] + lane);
        for (std::int32_t i = 0; i < j; ++i)
          value = D::subtract_product(D::all(a[j][begin + i]), D::load(target[i] + lane), value);
        D::store(target[j] + lane, D::multiply(value, inverse));
      }
    }
  }
}

void path_rows(const double* below, std::int32_t row_count, std::int32_t columns, const double* x, std::int32_t lanes,
               double* base, const std::int64_t* target) {
  if (lanes == 1) {
    for (std::int32_t r = 0; r < row_count; ++r, below += columns) base[target[r]] -= dot8(below, x, columns);
    return;
  }
  // Rows whose places are looked up together, a whole number of blocks. On a torus of 62,500 vertices half and double
  // take as long within 2 %.
  constexpr std::int32_t step = 8 * lane_rows;
  for (std::int32_t begin = 0; begin < row_count; begin += step) {
    const std::int32_t count = row_count - begin < step ? row_count - begin : step;
    const double* a[step];
    double* out[step];
    for (std::int32_t r = 0; r < count; ++r) {
      a[r] = below + static_cast<std::int64_t>(begin + r) * columns;
      out[r] = base + target[begin + r];
    }
    lane_rows_any<false>(a, 1, x, lanes, lanes, columns, out, count);
  }
}

void gram(const double* a, std::int32_t a_lanes, std::int32_t a_count, const double* b, std::int32_t b_lanes,
          std::int32_t b_count, std::int32_t rows, double* out, std::int32_t stride) {
  const double* left[32];
  double* target[32];
  for (std::int32_t i = 0; i < a_count; ++i) {
    left[i] = a + i;
    target[i] = out + static_cast<std::int64_t>(i) * stride;
  }
  if (b_lanes == 1) {
    for (std::int32_t i = 0; i < a_count; ++i) {
      double total = target[i][0];
      for (std::int32_t r = 0; r < rows; ++r)
        total = multiply_add_scalar(left[i][static_cast<std::int64_t>(r) * a_lanes], b[r], total);
      target[i][0] = total;
    }
    return;
  }
  lane_rows_any<true>(left, a_lanes, b, b_lanes, (b_count + 7) & ~7, rows, target, a_count);
}

}  // namespace
