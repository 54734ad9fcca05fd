#include "deform/anderson.h"

#include <algorithm>
#include <cmath>

#include "base/algebra.h"
#include "base/compiler.h"
#include "base/index.h"

namespace hf_inner::deform {
namespace {

// Sixteen sums hide the latency of additions: four vectors of four numbers, or eight of two.
HF_FOUR_LANES
double product(const double* a, const double* b, std::size_t size) noexcept {
  constexpr std::size_t lanes = 16;
  double sum[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) sum[l] += a[i + l] * b[i + l];
  }
  for (; i < size; ++i) sum[0] += a[i] * b[i];
  for (std::size_t half = lanes / 2; half > 0; half /= 2) {
    for (std::size_t l = 0; l < half; ++l) sum[l] += sum[l + half];
  }
  return sum[0];
}

// Computes to -= factor times from.
HF_FOUR_LANES
void subtract(double factor, const double* from, double* to, std::size_t size) noexcept {
  for (std::size_t i = 0; i < size; ++i) to[i] -= factor * from[i];
}

}  // namespace

void Anderson::fit(std::size_t size) {
  store_.assign((2 * anderson_steps + 3) * size, 0.0);
  size_ = size;
  forget();
}

void Anderson::keep_difference(Span<const double> z, Span<const double> f) noexcept {
  double *to_f = df(next_), *to_both = both(next_);
  const double *from_z = last_z(), *from_f = last_f();
  for (std::size_t i = 0; i < size_; ++i) {
    to_f[i] = f[i] - from_f[i];
    to_both[i] = (z[i] - from_z[i]) + to_f[i];
  }
  const std::size_t place = next_;
  count_ = std::min(count_ + 1, anderson_steps);
  next_ = (next_ + 1) % anderson_steps;
  // f is the last residual plus this difference, so dF' f changes by the new row of dF' dF
  for (std::size_t k = 0; k < count_; ++k) {
    gram_[place][k] = gram_[k][place] = product(to_f, df(k), size_);
    right_[k] += gram_[place][k];
  }
  right_[place] = product(to_f, f.data(), size_);
}

void Anderson::step(Span<double> z, Span<const double> f, std::size_t block, double longest) noexcept {
  const double residual = product(f.data(), f.data(), size_);
  if (open_ && residual > anderson_growth * last_residual_) forget();
  if (open_)
    keep_difference(z, f);
  else
    for (std::size_t k = 0; k < count_; ++k) right_[k] = product(df(k), f.data(), size_);
  std::copy(z.begin(), z.end(), last_z());
  std::copy(f.begin(), f.end(), last_f());
  last_residual_ = residual;
  open_ = true;

  // Columns of length 1, so that damping trades directions and not sizes. Steps that are not kept yet have a row of the
  // identity.
  constexpr int most = static_cast<int>(anderson_steps);
  hf_eigen::Matrix<double, most, most> gram = hf_eigen::Matrix<double, most, most>::Identity();
  hf_eigen::Matrix<double, most, 1> right = hf_eigen::Matrix<double, most, 1>::Zero(), scale = right;
  const int count = static_cast<int>(count_);
  for (int k = 0; k < count; ++k) {
    const double square = gram_[at(k)][at(k)];
    scale(k) = square > 0 ? 1 / std::sqrt(square) : 0.0;
    right(k) = scale(k) * right_[at(k)];
  }
  for (int k = 0; k < count; ++k) {
    for (int j = 0; j < count; ++j) gram(j, k) = scale(j) * scale(k) * gram_[at(j)][at(k)];
    gram(k, k) += anderson_damping;
  }
  if (count > 0) right = gram.ldlt().solve(right).eval();
  double* const extra = leap();
  std::fill(extra, extra + size_, 0.0);
  for (int k = 0; k < count; ++k) subtract(right(k) * scale(k), both(at(k)), extra, size_);
  double largest = 0;
  for (std::size_t i = 0; i < size_; i += block) {
    double square = 0;
    for (std::size_t j = i; j < i + block; ++j) square += extra[j] * extra[j];
    largest = std::max(largest, square);
  }
  if (!std::isfinite(largest)) {
    std::fill(extra, extra + size_, 0.0);
    largest = 0;
    forget();
  }
  const double kept = largest > longest * longest ? longest / std::sqrt(largest) : 1.0;
  for (std::size_t i = 0; i < size_; ++i) z[i] += f[i] + kept * extra[i];
}

}  // namespace hf_inner::deform
