#include "deform/dense.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/compiler.h"
#include "deform/constants.h"
#include "deform/dense_panels.h"

namespace hf_inner {
namespace {

// Computes the products of row a with the four rows b0 .. b3, in a fixed order of summation.
void dot_four(const double* a, const double* b0, const double* b1, const double* b2, const double* b3,
              std::int32_t count, double (&out)[4]) noexcept {
  double s[4][2] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
  std::int32_t k = 0;
  for (; k + 2 <= count; k += 2) {
    for (int u = 0; u < 2; ++u) {
      const double x = a[k + u];
      s[0][u] += x * b0[k + u];
      s[1][u] += x * b1[k + u];
      s[2][u] += x * b2[k + u];
      s[3][u] += x * b3[k + u];
    }
  }
  if (k < count) {
    s[0][0] += a[k] * b0[k];
    s[1][0] += a[k] * b1[k];
    s[2][0] += a[k] * b2[k];
    s[3][0] += a[k] * b3[k];
  }
  for (int r = 0; r < 4; ++r) out[r] = s[r][0] + s[r][1];
}

// Copies L to the panels that the loops read.
void pack(const double* lower, std::size_t size, double* rows, double* columns) noexcept {
  constexpr std::size_t wide = DensePanels::wide;
  const std::size_t panels = DensePanels::count(size);
  std::fill(rows, rows + DensePanels::rows_at(panels), 0.0);
  std::fill(columns, columns + DensePanels::rows_at(panels), 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    double* const row = rows + DensePanels::rows_at(i / wide) + i % wide;
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t p = j / wide;
      row[wide * j] = lower[size * i + j];
      columns[DensePanels::columns_at(p, panels) + wide * (i - wide * p) + j % wide] = lower[size * i + j];
    }
  }
}

HF_VECTOR(Lanes, double, 4);  // compiled to two halves without AVX

#include "deform/dense_loops.inl"

}  // namespace

void DenseFactor::factorise(Buffer<double>&& matrix, std::int32_t size, Memory& memory) {
  const std::size_t stride = static_cast<std::size_t>(size);
  Buffer<double> pivots(memory, stride), rows(memory, DensePanels::rows_at(DensePanels::count(stride))),
      columns(memory, rows.size());
  Buffer<double> lower = std::move(matrix);
  inverse_pivot_ = std::move(pivots);
  std::fill(inverse_pivot_.begin(), inverse_pivot_.end(), 0.0);
  size_ = size;
  dropped_ = 0;
  for (std::int32_t i = 0; i < size; ++i) {
    double* row = lower.data() + stride * static_cast<std::size_t>(i);
    const double diagonal = row[i];
    double square = 0;
    for (std::int32_t j = 0; j < i; j += 4) {
      // Four columns are computed at once up to their common part, then the small triangle between them.
      const std::int32_t count = std::min(4, i - j);
      const double* other[4];
      for (int c = 0; c < 4; ++c)
        other[c] = lower.data() + stride * static_cast<std::size_t>(j + std::min(c, count - 1));
      double sums[4];
      dot_four(row, other[0], other[1], other[2], other[3], j, sums);
      for (int c = 0; c < count; ++c) {
        double sum = sums[c];
        for (int k = 0; k < c; ++k) sum += row[j + k] * other[c][j + k];
        row[j + c] = (row[j + c] - sum) * inverse_pivot_[j + c];
        square += row[j + c] * row[j + c];
      }
    }
    const double pivot = diagonal - square;
    if (pivot > pivot_floor * diagonal && pivot > 0) {
      inverse_pivot_[i] = 1.0 / std::sqrt(pivot);
    } else {
      // inverse_pivot_ is 0 here, so all later rows get a 0 in this column.
      ++dropped_;
      std::fill(row, row + i, 0.0);
    }
  }
  pack(lower.data(), stride, rows.data(), columns.data());
  rows_ = std::move(rows);
  columns_ = std::move(columns);
}

void solve_dense(const DensePanels& factor, int sides, double* x) noexcept {
  if (sides == 3) return solve_panels<Lanes, 1, 3>(factor, x);
  solve_panels<Lanes, 1, 4>(factor, x);
}

void DenseFactor::solve_sides(int sides, double* x) const noexcept {
  DenseLoop loop = &solve_dense;
#ifdef HF_DEFORM_AVX2
  if (HF_PROCESSOR_HAS("avx2")) loop = &solve_dense_avx2;
#endif
#ifdef HF_DEFORM_AVX512
  if (HF_PROCESSOR_HAS("avx512f")) loop = &solve_dense_avx512;
#endif
  loop({static_cast<std::size_t>(size_), rows_.data(), columns_.data(), inverse_pivot_.data()}, sides, x);
}

}  // namespace hf_inner
