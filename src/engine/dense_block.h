// The dense part of a constraint system for one component.
//
// It keeps the symmetric matrix M of its rows and the factor M = L Sigma L', both as packed lower rows, and edits them
// row by row. Sigma = diag(+1 or -1): rows of sites are positive, rows of free values (constraint_system.h) negative.
// That makes M quasi-definite, so it factors in any order without pivoting (Vanderbei 1995).
//
// Append rows: the front kernels of the sparse factor on the new rows alone. Remove row r while all signs are positive:
// the rows of L below r get a rank-one update L33 L33' + l l' by plane rotations, O((k - r)^2). Many removals at once,
// or mixed signs: factorised again from M, O(k^3 / 3). A block is copied before it is edited, so a failure leaves the
// old one in place.
//
// A border of at most two more unknowns nu takes the pins of the component out of the answer:
//
//     [ M   N ] [ x  ]   [   b    ]
//     [ N'  C ] [ nu ] = [ -total ]        (C - N' M^-1 N) is negative definite
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/jobs.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner {

class DenseBlock {
 public:
  static constexpr std::size_t most_border = 2;
  // corner: C, border x border numbers; null: zeros.
  explicit DenseBlock(Memory& memory, std::size_t border = 0, const double* corner = nullptr);
  DenseBlock(const DenseBlock& other);

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(ids_.size()); }
  Span<const std::int32_t> ids() const noexcept { return ids_; }
  bool has_negative() const noexcept { return negative_ > 0; }

  // Removes the rows whose ids are in `ids` (all present).
  void remove(Span<const std::int32_t> ids);
  // Appends a row: row[j] = M(new, j) for the present rows j, row[count] = M(new, new). border: its row of N; null:
  // ones. factorise() must follow.
  void append(std::int32_t id, const double* row, bool positive = true, const double* border = nullptr);
  // Brings L up to date. Returns -1, or the row whose pivot failed: that site depends linearly on the ones before it.
  std::int32_t factorise(JobRunner& jobs);

  // In place: x <- M^-1 x, x[i * channels + c].
  void solve(double* x, std::int32_t channels) const noexcept;
  // The same with the border; all signs positive. total: one number a channel for a border of one, or null: zeros.
  // Writes nu[p * channels + c].
  void solve_bordered(double* x, std::int32_t channels, const double* total, double* nu) const noexcept;
  std::size_t border() const noexcept { return border_; }
  // The smallest pivot over its diagonal entry, of a factorised block: crowded points, whose solution loses as many
  // digits, have a small one. O(k).
  double least_pivot() const noexcept;
  // The same of one row.
  double pivot_share(std::int32_t i) const noexcept;
  double bytes() const noexcept { return 8.0 * static_cast<double>(m_.size() + l_.size()); }

 private:
  static std::size_t row(std::int32_t i) noexcept { return at(i) * (at(i) + 1) / 2; }
  std::int32_t factorise_positive(JobRunner& jobs);
  std::int32_t factorise_signed();
  void update_without(std::int32_t r);            // rank-one update of L for the removal of row r
  void keep_rows(Span<const std::int32_t> rows);  // compacts everything to these rows, ascending
  void factorise_border();
  template <std::size_t fixed>
  void solve_channels(double* x, std::size_t channels) const noexcept;

  Memory* memory_;
  Vector<std::int32_t> ids_;
  Vector<double> sign_;
  Vector<double> m_, l_;    // packed lower rows; the diagonal of L inverted
  std::int32_t valid_ = 0;  // leading rows of l_ that are up to date
  std::int32_t negative_ = 0;
  std::size_t border_;
  Vector<double> n_;                               // N, row by row
  Vector<double> m_inverse_n_;                     // M^-1 N, likewise
  double corner_[most_border * most_border] = {};  // C
  double schur_[most_border * most_border] = {};   // N' M^-1 N - C
};

}  // namespace hf_inner
