// The dense part of engine green for one component: S = Y'Y + D of its sites and the Cholesky factor L L' = S, both as packed lower
// rows, edited site by site.
//
// Append a row: one forward substitution, O(k^2). Remove a row r: S loses row and column; the rows of L below r get a rank-one
// update with the column that is left over, L33 L33' + l l', by plane rotations (positive, hence stable), O((k - r)^2). Many
// removals at once: factorised again from S, O(k^3 / 3), whichever is cheaper.
// A block is copied before it is edited, so a failure leaves the old one in place.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"

namespace hf {

class DenseBlock {
 public:
  explicit DenseBlock(Memory& memory) : memory_(&memory), slots_(&memory), s_(&memory), l_(&memory), ones_(&memory) {}
  DenseBlock(const DenseBlock& other);

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(slots_.size()); }
  Span<const std::int32_t> slots() const noexcept { return slots_; }

  // Removes the rows whose slots are in `slots` (all present).
  void remove(Span<const std::int32_t> slots);
  // Appends a site: row[j] = S(new, j) for the present sites j, row[count] = S(new, new) with its compliance. factorise() must follow.
  void append(std::int32_t slot, const double* row);
  // Brings L up to date. Returns -1, or the row whose pivot is lost: that site depends linearly on the ones before it.
  std::int32_t factorise();

  // In place: x <- S^-1 x, x[i * channels + c].
  void solve(double* x, std::int32_t channels) const noexcept;
  // S^-1 1, and its sum.
  Span<const double> ones() const noexcept { return ones_; }
  double ones_sum() const noexcept { return ones_sum_; }
  double bytes() const noexcept { return 8.0 * static_cast<double>(s_.size() + l_.size()); }

 private:
  static std::size_t row(std::int32_t i) noexcept { return static_cast<std::size_t>(i) * (static_cast<std::size_t>(i) + 1) / 2; }
  void update_without(std::int32_t r);                   // rank-one update of L for the removal of row r
  void keep_rows(Span<const std::int32_t> rows);        // compacts both triangles to these rows, ascending

  Memory* memory_;
  Vector<std::int32_t> slots_;
  Vector<double> s_, l_;   // packed lower rows
  std::int32_t valid_ = 0; // leading rows of l_ that are up to date
  Vector<double> ones_;
  double ones_sum_ = 0;
};

}  // namespace hf
