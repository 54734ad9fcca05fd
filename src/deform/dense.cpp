#include "deform/dense.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

constexpr double pivot_floor = 1e-10;  // of the diagonal

// Products of row a with the four rows b0 .. b3 in a fixed order of summation.
void dot_four(const double* a, const double* b0, const double* b1, const double* b2, const double* b3,
              std::int32_t count, double (&out)[4]) noexcept {
  double s[4][2] = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
  std::int32_t k = 0;
  for (; k + 2 <= count; k += 2) {
    for (int u = 0; u < 2; ++u) {
      const double x = a[k + u];
      s[0][u] += x * b0[k + u], s[1][u] += x * b1[k + u], s[2][u] += x * b2[k + u], s[3][u] += x * b3[k + u];
    }
  }
  if (k < count) s[0][0] += a[k] * b0[k], s[1][0] += a[k] * b1[k], s[2][0] += a[k] * b2[k], s[3][0] += a[k] * b3[k];
  for (int r = 0; r < 4; ++r) out[r] = s[r][0] + s[r][1];
}

}  // namespace

void DenseFactor::factorise(Buffer<double>&& lower, std::int32_t size, Memory& memory) {
  inverse_pivot_.allocate(memory, static_cast<std::size_t>(size));
  std::fill(inverse_pivot_.begin(), inverse_pivot_.end(), 0.0);
  lower_ = std::move(lower);
  size_ = size, dropped_ = 0;
  const std::size_t stride = static_cast<std::size_t>(size);
  for (std::int32_t i = 0; i < size; ++i) {
    double* row = lower_.data() + stride * static_cast<std::size_t>(i);
    const double diagonal = row[i];
    double square = 0;
    for (std::int32_t j = 0; j < i; j += 4) {
      // four columns at once as far as their common part goes, then the small triangle between them
      const std::int32_t columns = std::min(4, i - j);
      const double* other[4];
      for (int c = 0; c < 4; ++c)
        other[c] = lower_.data() + stride * static_cast<std::size_t>(j + std::min(c, columns - 1));
      double sums[4];
      dot_four(row, other[0], other[1], other[2], other[3], j, sums);
      for (int c = 0; c < columns; ++c) {
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
      // rows below get zeros in this column through inverse_pivot_ = 0
      ++dropped_;
      std::fill(row, row + i, 0.0);
    }
  }
}

void DenseFactor::solve(double* x) const noexcept {
  const std::size_t stride = static_cast<std::size_t>(size_);
  for (std::int32_t i = 0; i < size_; ++i) {
    const double* row = lower_.data() + stride * static_cast<std::size_t>(i);
    double even[4] = {0, 0, 0, 0}, odd[4] = {0, 0, 0, 0};
    std::int32_t j = 0;
    for (; j + 2 <= i; j += 2) {
      const double a = row[j], b = row[j + 1];
      const double *xa = x + 4 * j, *xb = xa + 4;
      for (int k = 0; k < 4; ++k) even[k] += a * xa[k], odd[k] += b * xb[k];
    }
    if (j < i) {
      for (int k = 0; k < 4; ++k) even[k] += row[j] * x[4 * j + k];
    }
    double* xi = x + 4 * i;
    for (int k = 0; k < 4; ++k) xi[k] = (xi[k] - (even[k] + odd[k])) * inverse_pivot_[i];
  }
  for (std::int32_t i = size_ - 1; i >= 0; --i) {
    const double* row = lower_.data() + stride * static_cast<std::size_t>(i);
    double* xi = x + 4 * i;
    double y[4];
    for (int k = 0; k < 4; ++k) xi[k] *= inverse_pivot_[i], y[k] = xi[k];
    for (std::int32_t j = 0; j < i; ++j) {
      const double a = row[j];
      double* xj = x + 4 * j;
      for (int k = 0; k < 4; ++k) xj[k] -= a * y[k];
    }
  }
}

}  // namespace hf
