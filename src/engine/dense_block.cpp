#include "engine/dense_block.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

// Dot product with eight running sums: one fixed order of additions that compilers can still vectorise.
double dot_product(const double* a, const double* b, std::size_t count) noexcept {
  double sum[8] = {0, 0, 0, 0, 0, 0, 0, 0};
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    for (std::size_t k = 0; k < 8; ++k) sum[k] += a[i + k] * b[i + k];
  }
  for (; i < count; ++i) sum[0] += a[i] * b[i];
  return ((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7]));
}

// A pivot this far below its diagonal means linear dependence: independent sites stay above 1e-9 even on bi-harmonic patches.
constexpr double pivot_floor = 1e-13;

}  // namespace

DenseBlock::DenseBlock(const DenseBlock& other)
    : memory_(other.memory_),
      slots_(other.slots_, other.memory_),
      s_(other.s_, other.memory_),
      l_(other.l_, other.memory_),
      valid_(other.valid_),
      ones_(other.ones_, other.memory_),
      ones_sum_(other.ones_sum_) {}

void DenseBlock::update_without(std::int32_t r) {
  // l = what column r leaves over below row r; rotate it into the columns that follow
  Vector<double> left(slots_.size(), 0.0, memory_);
  for (std::int32_t i = r + 1; i < valid_; ++i) left[static_cast<std::size_t>(i)] = l_[row(i) + static_cast<std::size_t>(r)];
  for (std::int32_t j = r + 1; j < valid_; ++j) {
    double& pivot = l_[row(j) + static_cast<std::size_t>(j)];
    const double radius = std::hypot(pivot, left[static_cast<std::size_t>(j)]);
    const double c = radius / pivot, s = left[static_cast<std::size_t>(j)] / pivot;
    pivot = radius;
    for (std::int32_t i = j + 1; i < valid_; ++i) {
      double& lij = l_[row(i) + static_cast<std::size_t>(j)];
      lij = (lij + s * left[static_cast<std::size_t>(i)]) / c;
      left[static_cast<std::size_t>(i)] = c * left[static_cast<std::size_t>(i)] - s * lij;
    }
  }
}

void DenseBlock::keep_rows(Span<const std::int32_t> rows) {
  for (Vector<double>* packed : {&s_, &l_}) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) (*packed)[to++] = (*packed)[row(rows[i]) + static_cast<std::size_t>(rows[j])];
    }
    packed->resize(to);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) slots_[i] = slots_[static_cast<std::size_t>(rows[i])];
  slots_.resize(rows.size());
}

void DenseBlock::remove(Span<const std::int32_t> slots) {
  if (slots.empty()) return;
  Vector<std::int32_t> leaving(slots.begin(), slots.end(), memory_);
  std::sort(leaving.begin(), leaving.end());
  const auto leaves = [&](std::int32_t slot) { return std::binary_search(leaving.begin(), leaving.end(), slot); };
  const double k = count(), d = static_cast<double>(slots.size()), left = k - d;
  Vector<std::int32_t> kept(memory_);
  kept.reserve(slots_.size());
  if (d * 2 * k * k < left * left * left / 3 + 1e4) {
    // from the last row to the first: later rows move least
    for (std::int32_t r = count() - 1; r >= 0; --r) {
      if (!leaves(slots_[static_cast<std::size_t>(r)])) continue;
      if (r < valid_) update_without(r), --valid_;
      kept.clear();
      for (std::int32_t i = 0; i < count(); ++i) {
        if (i != r) kept.push_back(i);
      }
      keep_rows(kept);
    }
    return;
  }
  std::int32_t first = count();
  for (std::int32_t i = 0; i < count(); ++i) {
    if (!leaves(slots_[static_cast<std::size_t>(i)])) {
      kept.push_back(i);
    } else if (first == count()) {
      first = i;
    }
  }
  keep_rows(kept);
  valid_ = std::min(valid_, first);
}

void DenseBlock::append(std::int32_t slot, const double* values) {
  const std::size_t width = static_cast<std::size_t>(count()) + 1;
  s_.insert(s_.end(), values, values + width);
  l_.resize(s_.size(), 0.0);
  slots_.push_back(slot);
}

std::int32_t DenseBlock::factorise() {
  const std::int32_t k = count();
  for (std::int32_t i = valid_; i < k; ++i) {
    const double* s = s_.data() + row(i);
    double* l = l_.data() + row(i);
    for (std::int32_t j = 0; j < i; ++j) {
      const double* lj = l_.data() + row(j);
      l[j] = (s[j] - dot_product(l, lj, static_cast<std::size_t>(j))) / lj[j];
    }
    const double pivot = s[i] - dot_product(l, l, static_cast<std::size_t>(i));
    if (!(pivot > pivot_floor * s[i])) return i;
    l[i] = std::sqrt(pivot);
    valid_ = i + 1;
  }
  ones_.assign(static_cast<std::size_t>(k), 1.0);
  solve(ones_.data(), 1);
  ones_sum_ = 0;
  for (const double x : ones_) ones_sum_ += x;
  return -1;
}

void DenseBlock::solve(double* x, std::int32_t channels) const noexcept {
  const std::int32_t k = count();
  const std::size_t m = static_cast<std::size_t>(channels);
  for (std::int32_t i = 0; i < k; ++i) {
    const double* l = l_.data() + row(i);
    double* xi = x + static_cast<std::size_t>(i) * m;
    for (std::int32_t j = 0; j < i; ++j) {
      for (std::size_t c = 0; c < m; ++c) xi[c] -= l[j] * x[static_cast<std::size_t>(j) * m + c];
    }
    for (std::size_t c = 0; c < m; ++c) xi[c] /= l[i];
  }
  for (std::int32_t i = k - 1; i >= 0; --i) {
    const double* l = l_.data() + row(i);
    double* xi = x + static_cast<std::size_t>(i) * m;
    for (std::size_t c = 0; c < m; ++c) xi[c] /= l[i];
    for (std::int32_t j = 0; j < i; ++j) {
      for (std::size_t c = 0; c < m; ++c) x[static_cast<std::size_t>(j) * m + c] -= l[j] * xi[c];
    }
  }
}

}  // namespace hf
