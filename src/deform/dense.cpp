#include "deform/dense.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "deform/constants.h"

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

// Solves L y = x in place (forward substitution), for four right-hand sides side by side.
HF_FOUR_LANES
void solve_lower(const double* lower, const double* inverse_pivot, std::int32_t size, double* x) noexcept {
  for (std::int32_t i = 0; i < size; ++i) {
    const double* row = lower + static_cast<std::size_t>(size) * static_cast<std::size_t>(i);
    double sum[4][4] = {};
    std::int32_t j = 0;
    for (; j + 4 <= i; j += 4) {
      for (int u = 0; u < 4; ++u) {
        for (int k = 0; k < 4; ++k) sum[u][k] += row[j + u] * x[4 * (j + u) + k];
      }
    }
    for (; j < i; ++j) {
      for (int k = 0; k < 4; ++k) sum[0][k] += row[j] * x[4 * j + k];
    }
    double* xi = x + 4 * i;
    for (int k = 0; k < 4; ++k)
      xi[k] = (xi[k] - ((sum[0][k] + sum[1][k]) + (sum[2][k] + sum[3][k]))) * inverse_pivot[i];
  }
}

// Solves L' y = x in place (backward substitution). It takes the rows of L from the last one, two at a time.
HF_FOUR_LANES
void solve_upper(const double* lower, const double* inverse_pivot, std::int32_t size, double* x) noexcept {
  std::int32_t i = size;
  if (i % 2 == 1) {
    --i;
    const double* row = lower + static_cast<std::size_t>(size) * static_cast<std::size_t>(i);
    double y[4];
    for (int k = 0; k < 4; ++k) y[k] = x[4 * i + k] *= inverse_pivot[i];
    for (std::int32_t j = 0; j < i; ++j) {
      for (int k = 0; k < 4; ++k) x[4 * j + k] -= row[j] * y[k];
    }
  }
  while (i > 0) {
    i -= 2;
    const double* first = lower + static_cast<std::size_t>(size) * static_cast<std::size_t>(i);
    const double* second = first + size;
    double y[4], z[4];
    for (int k = 0; k < 4; ++k) {
      z[k] = x[4 * i + 4 + k] *= inverse_pivot[i + 1];
      y[k] = x[4 * i + k] = (x[4 * i + k] - second[i] * z[k]) * inverse_pivot[i];
    }
    for (std::int32_t j = 0; j < i; ++j) {
      for (int k = 0; k < 4; ++k) x[4 * j + k] -= first[j] * y[k] + second[j] * z[k];
    }
  }
}

}  // namespace

void DenseFactor::factorise(Buffer<double>&& lower, std::int32_t size, Memory& memory) {
  inverse_pivot_.allocate(memory, static_cast<std::size_t>(size));
  std::fill(inverse_pivot_.begin(), inverse_pivot_.end(), 0.0);
  lower_ = std::move(lower);
  size_ = size;
  dropped_ = 0;
  const std::size_t stride = static_cast<std::size_t>(size);
  for (std::int32_t i = 0; i < size; ++i) {
    double* row = lower_.data() + stride * static_cast<std::size_t>(i);
    const double diagonal = row[i];
    double square = 0;
    for (std::int32_t j = 0; j < i; j += 4) {
      // Four columns are computed at once up to their common part, then the small triangle between them.
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
      // inverse_pivot_ is 0 here, so all later rows get a 0 in this column.
      ++dropped_;
      std::fill(row, row + i, 0.0);
    }
  }
}

void DenseFactor::solve(double* x) const noexcept {
  solve_lower(lower_.data(), inverse_pivot_.data(), size_, x);
  solve_upper(lower_.data(), inverse_pivot_.data(), size_, x);
}

}  // namespace hf_inner
