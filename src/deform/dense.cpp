#include "deform/dense.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/compiler.h"
#include "deform/constants.h"
#include "deform/dense_panels.h"

namespace hf_inner::deform {
namespace {

HF_VECTOR(Lanes, double, 4);  // compiled to two halves without AVX
constexpr std::size_t wide = DensePanels::wide;

// Subtracts from the columns j .. j + 3 of eight rows what the columns before j take off, and scales them to columns of
// L. panel: the eight rows, entry (r, k) at 8 k + r. other: the rows j .. j + 3 of L. A sum takes its terms in two
// parts, by column modulo 2. square: adds the squares of the new entries, by row.
HF_FOUR_LANES
void take_four_columns(double* panel, const double* const (&other)[4], std::size_t j, const double* inverse_pivot,
                       double* square) noexcept {
  for (std::size_t half = 0; half < wide; half += 4) {
    Lanes sum[4][2] = {};
    for (std::size_t k = 0; k + 2 <= j; k += 2) {
      for (std::size_t u = 0; u < 2; ++u) {
        Lanes x;
        std::memcpy(&x, panel + wide * (k + u) + half, sizeof x);
        for (std::size_t c = 0; c < 4; ++c) sum[c][u] += x * other[c][k + u];
      }
    }
    Lanes squares, own[4];
    std::memcpy(&squares, square + half, sizeof squares);
    for (std::size_t c = 0; c < 4; ++c) {
      Lanes all = sum[c][0] + sum[c][1], entry;
      for (std::size_t k = 0; k < c; ++k) all += own[k] * other[c][j + k];
      std::memcpy(&entry, panel + wide * (j + c) + half, sizeof entry);
      own[c] = (entry - all) * inverse_pivot[j + c];
      squares += own[c] * own[c];
      std::memcpy(panel + wide * (j + c) + half, &own[c], sizeof entry);
    }
    std::memcpy(square + half, &squares, sizeof squares);
  }
}

// Copies L to the panels that the loops read.
void pack(const double* lower, std::size_t size, double* rows, double* columns) noexcept {
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

#include "deform/dense_loops.inl"

}  // namespace

// Computes row i of L from column `first` on. square: the sum of the squares before.
void DenseFactor::finish_row(double* lower, std::size_t stride, std::size_t first, std::size_t i,
                             double square) noexcept {
  double* const row = lower + stride * i;
  const double diagonal = row[i];
  for (std::size_t j = first; j < i; ++j) {
    // the columns before the last whole four come in two parts, as in take_four_columns
    const double* const other = lower + stride * j;
    const std::size_t whole = j - j % 4;
    double sums[2] = {0, 0};
    for (std::size_t k = 0; k < whole; k += 2) {
      sums[0] += row[k] * other[k];
      sums[1] += row[k + 1] * other[k + 1];
    }
    double sum = sums[0] + sums[1];
    for (std::size_t k = whole; k < j; ++k) sum += row[k] * other[k];
    row[j] = (row[j] - sum) * inverse_pivot_[j];
    square += row[j] * row[j];
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

void DenseFactor::factorise(Buffer<double>&& matrix, std::int32_t size, Memory& memory) {
  const std::size_t stride = static_cast<std::size_t>(size);
  Buffer<double> pivots(memory, stride), rows(memory, DensePanels::rows_at(DensePanels::count(stride))),
      columns(memory, rows.size()), panel(memory, wide * stride);
  Buffer<double> lower = std::move(matrix);
  inverse_pivot_ = std::move(pivots);
  std::fill(inverse_pivot_.begin(), inverse_pivot_.end(), 0.0);
  size_ = size;
  dropped_ = 0;
  // Eight rows at a time: the columns before them four at a time, then the triangle between them.
  for (std::size_t first = 0; first < stride; first += wide) {
    const std::size_t count = std::min(wide, stride - first);
    double square[wide] = {};
    std::fill(panel.begin(), panel.begin() + wide * first, 0.0);
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t j = 0; j < first; ++j) panel[wide * j + r] = lower[stride * (first + r) + j];
    }
    for (std::size_t j = 0; j < first; j += 4) {
      const double* other[4];
      for (std::size_t c = 0; c < 4; ++c) other[c] = lower.data() + stride * (j + c);
      take_four_columns(panel.data(), other, j, inverse_pivot_.data(), square);
    }
    for (std::size_t r = 0; r < count; ++r) {
      for (std::size_t j = 0; j < first; ++j) lower[stride * (first + r) + j] = panel[wide * j + r];
      finish_row(lower.data(), stride, first, first + r, square[r]);
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

}  // namespace hf_inner::deform
