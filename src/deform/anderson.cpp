#include "deform/anderson.h"

#include <algorithm>
#include <cmath>

#include "base/algebra.h"
#include "base/compiler.h"
#include "base/index.h"

namespace hf_inner {
namespace {

HF_FOUR_LANES
double product(const double* a, const double* b, std::size_t size) noexcept {
  double sum[4] = {0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 4 <= size; i += 4) {
    for (std::size_t l = 0; l < 4; ++l) sum[l] += a[i + l] * b[i + l];
  }
  for (; i < size; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace

void Anderson::fit(std::size_t size) {
  store_.assign((2 * anderson_steps + 3) * size, 0.0);
  size_ = size;
  forget();
}

void Anderson::keep_difference(Span<const double> z, Span<const double> f) noexcept {
  double *to_z = dz(next_), *to_f = df(next_);
  const double *from_z = last_z(), *from_f = last_f();
  for (std::size_t i = 0; i < size_; ++i) to_z[i] = z[i] - from_z[i], to_f[i] = f[i] - from_f[i];
  const std::size_t place = next_;
  count_ = std::min(count_ + 1, anderson_steps), next_ = (next_ + 1) % anderson_steps;
  for (std::size_t k = 0; k < count_; ++k) gram_[place][k] = gram_[k][place] = product(to_f, df(k), size_);
}

void Anderson::step(Span<double> z, Span<const double> f, std::size_t block, double longest) noexcept {
  const double residual = product(f.data(), f.data(), size_);
  if (open_ && residual > anderson_growth * last_residual_) forget();
  if (open_) keep_difference(z, f);
  std::copy(z.begin(), z.end(), last_z());
  std::copy(f.begin(), f.end(), last_f());
  last_residual_ = residual, open_ = true;

  // Columns of length 1, so that damping trades directions and not sizes. What is not kept yet is a row of the
  // identity.
  constexpr int most = static_cast<int>(anderson_steps);
  hf_eigen::Matrix<double, most, most> gram = hf_eigen::Matrix<double, most, most>::Identity();
  hf_eigen::Matrix<double, most, 1> right = hf_eigen::Matrix<double, most, 1>::Zero(), scale = right;
  const int count = static_cast<int>(count_);
  for (int k = 0; k < count; ++k) {
    const double square = gram_[at(k)][at(k)];
    scale(k) = square > 0 ? 1 / std::sqrt(square) : 0.0;
    right(k) = scale(k) * product(df(at(k)), f.data(), size_);
  }
  for (int k = 0; k < count; ++k) {
    for (int j = 0; j < count; ++j) gram(j, k) = scale(j) * scale(k) * gram_[at(j)][at(k)];
    gram(k, k) += anderson_damping;
  }
  if (count > 0) right = gram.ldlt().solve(right).eval();
  double* const extra = leap();
  std::fill(extra, extra + size_, 0.0);
  for (int k = 0; k < count; ++k) {
    const double share = right(k) * scale(k);
    const double *from_z = dz(at(k)), *from_f = df(at(k));
    for (std::size_t i = 0; i < size_; ++i) extra[i] -= share * (from_z[i] + from_f[i]);
  }
  double largest = 0;
  for (std::size_t i = 0; i < size_; i += block) largest = std::max(largest, product(extra + i, extra + i, block));
  if (!std::isfinite(largest)) std::fill(extra, extra + size_, 0.0), largest = 0, forget();
  const double kept = largest > longest * longest ? longest / std::sqrt(largest) : 1.0;
  for (std::size_t i = 0; i < size_; ++i) z[i] += f[i] + kept * extra[i];
}

}  // namespace hf_inner
