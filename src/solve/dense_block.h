// The dense part of a constraint system for one component.
//
// It stores the symmetric matrix M of its rows and the factor M = L Sigma L', both as packed lower rows, and edits both
// row by row. Sigma = diag(+1 or -1). Rows of sites are positive. Rows of free values (constraint_system.h) are
// negative. So M is quasi-definite and can be factorised in any order without pivoting (Vanderbei 1995).
//
// To append rows, the dense kernels of the sparse factor factorise the new rows alone. To remove row r, if all signs
// are positive, the rows of L below r get a rank-one update by plane rotations: L33 L33' + l l'. Here L33 is the part
// of L behind row and column r, and l is column r below row r. This costs O((k - r)^2) for k rows. After many removals
// at once, or with mixed signs, M is factorised again, in O(k^3 / 3). A block is copied before an edit, so a failed
// edit leaves the old block in place.
//
// A border of at most two more unknowns nu removes the effect of the pinned vertices of the component:
//
//     [ M   N ] [ x  ]   [   b    ]
//     [ N'  C ] [ nu ] = [ -total ]        (C - N' M^-1 N) is negative definite
#pragma once
#include <algorithm>
#include <cstdint>

#include "base/index.h"
#include "base/jobs.h"
#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::solve {

class DenseBlock {
 public:
  static constexpr std::size_t most_border = 2;  // border unknowns: as many as a component has pins
  // Makes a block without rows. border: number of border unknowns. corner: the border x border numbers of C; null
  // stands for zeros.
  explicit DenseBlock(Memory& memory, std::size_t border = 0, const double* corner = nullptr);
  DenseBlock(const DenseBlock& other);

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(ids_.size()); }
  Span<const std::int32_t> ids() const noexcept { return ids_; }
  bool has_negative() const noexcept { return negative_ > 0; }

  // Removes the rows with these ids from the dense matrix. All of them must be present.
  void remove(Span<const std::int32_t> ids);
  // Appends a row to the matrix M. The entry row[j] is M(new, j) for the present rows j, and row[count] is M(new, new).
  // The array `border` is the new row of the border N; null stands for ones. Call factorise() afterwards.
  void append(std::int32_t id, const double* row, bool positive = true, const double* border = nullptr);
  // Factorises the rows that the factor L does not have yet. Returns -1, or the row whose pivot failed. The site of
  // that row depends linearly on earlier sites.
  std::int32_t factorise(JobRunner& jobs);

  // Replaces x by M^-1 x, with x[row * channels + c] and M the dense matrix.
  void solve(double* x, std::int32_t channels) const noexcept;
  // Solves with the matrix M and its border N, C. All signs must be positive. total: one number per channel for a
  // border of one; null stands for zeros. Writes nu[p * channels + c].
  void solve_bordered(double* x, std::int32_t channels, const double* total, double* nu) const noexcept;
  std::size_t border() const noexcept { return border_; }
  // Returns the smallest ratio of a pivot to its diagonal entry, for a factorised block. Crowded points have a small
  // ratio. A ratio of 1e-k costs about k digits of the solution. Cost: O(k) for k rows.
  double least_pivot() const noexcept;
  // Returns the ratio of the pivot of row i to its diagonal entry.
  double pivot_share(std::int32_t i) const noexcept;
  double entry(std::int32_t i, std::int32_t j) const noexcept { return m_[row(std::max(i, j)) + at(std::min(i, j))]; }
  double bytes() const noexcept { return 8.0 * static_cast<double>(m_.size() + l_.size()); }

 private:
  static std::size_t row(std::int32_t i) noexcept { return at(i) * (at(i) + 1) / 2; }
  std::int32_t factorise_positive(JobRunner& jobs);
  std::int32_t factorise_signed();
  void update_without(std::int32_t r);            // rank-one update of L for the removal of row r
  void keep_rows(Span<const std::int32_t> rows);  // keeps only these rows of all arrays, ascending
  void factorise_border();
  template <std::size_t fixed>
  void solve_channels(double* x, std::size_t channels) const noexcept;

  Memory* memory_;
  Vector<std::int32_t> ids_;
  Vector<double> sign_;
  Vector<double> m_, l_;    // M and L: packed lower rows; the diagonal of L inverted
  std::int32_t valid_ = 0;  // leading rows of l_ that are up to date
  std::int32_t negative_ = 0;
  std::size_t border_;
  Vector<double> n_;                               // the border N, row by row
  Vector<double> m_inverse_n_;                     // M^-1 N, row by row
  double corner_[most_border * most_border] = {};  // the corner C of the border
  double schur_[most_border * most_border] = {};   // N' M^-1 N - C
};

}  // namespace hf_inner::solve
