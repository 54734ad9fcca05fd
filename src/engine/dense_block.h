// The dense part of engine green for one component: the symmetric matrix M of its rows and the factor M = L Sigma L',
// both as packed lower rows, edited row by row. Sigma = diag(+1 or -1): rows of sites are positive; rows of free values
// (see green.h) are negative, which makes M quasi-definite, so that it factors without pivoting in any order (Vanderbei
// 1995).
//
// Append rows: the front kernels of the sparse factor on the rows that are new. Remove a row r while all signs are positive: the rows of L below r
// get a rank-one update with the column that is left over, L33 L33' + l l', by plane rotations, O((k - r)^2). Many
// removals at once, or signs mixed: factorised again from M, O(k^3 / 3). A block is copied before it is edited, so a
// failure leaves the old one in place.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner {

class DenseBlock {
 public:
  explicit DenseBlock(Memory& memory)
      : memory_(&memory), ids_(&memory), sign_(&memory), m_(&memory), l_(&memory), ones_(&memory) {}
  DenseBlock(const DenseBlock& other);

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(ids_.size()); }
  Span<const std::int32_t> ids() const noexcept { return ids_; }
  bool has_negative() const noexcept { return negative_ > 0; }

  // Removes the rows whose ids are in `ids` (all present).
  void remove(Span<const std::int32_t> ids);
  // Appends a row: row[j] = M(new, j) for the present rows j, row[count] = M(new, new). factorise() must follow.
  void append(std::int32_t id, const double* row, bool positive = true);
  // Brings L up to date. Returns -1, or the row whose pivot is lost: that site depends linearly on the ones before it.
  std::int32_t factorise(JobRunner& jobs);

  // In place: x <- M^-1 x, x[i * channels + c].
  void solve(double* x, std::int32_t channels) const noexcept;
  // M^-1 1, and its sum; all signs positive.
  Span<const double> ones() const noexcept { return ones_; }
  double ones_sum() const noexcept { return ones_sum_; }
  // The smallest pivot over its diagonal entry, of a factorised block: crowded points, whose solution loses as many
  // digits, have a small one. O(k).
  double least_pivot() const noexcept;
  // The same of one row.
  double pivot_share(std::int32_t i) const noexcept;
  double bytes() const noexcept { return 8.0 * static_cast<double>(m_.size() + l_.size()); }

 private:
  static std::size_t row(std::int32_t i) noexcept {
    return static_cast<std::size_t>(i) * (static_cast<std::size_t>(i) + 1) / 2;
  }
  std::int32_t factorise_positive(JobRunner& jobs);
  std::int32_t factorise_signed();
  void update_without(std::int32_t r);            // rank-one update of L for the removal of row r
  void keep_rows(Span<const std::int32_t> rows);  // compacts everything to these rows, ascending

  Memory* memory_;
  Vector<std::int32_t> ids_;
  Vector<double> sign_;
  Vector<double> m_, l_;    // packed lower rows; the diagonal of L inverted
  std::int32_t valid_ = 0;  // leading rows of l_ that are up to date
  std::int32_t negative_ = 0;
  Vector<double> ones_;
  double ones_sum_ = 0;
};

}  // namespace hf_inner
