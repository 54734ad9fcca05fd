// Solves K x = b, where single unknowns of x get given values one after the other. K is positive definite.
//
// K is factorised once. Given values are sites of the constraint system: they add rows to a small dense matrix and do
// not touch the factor. Unknowns that come last in the order of the factor have short elimination paths, so the
// unknowns that get values come last. The function inverse_at() gives the part of the inverse that rounding many
// unknowns needs (grid_map.h).
#pragma once
#include <optional>

#include "solve/constraint_system.h"

namespace hf_inner::quads {

// Where row i begins in a lower triangle that is kept row after row.
inline std::size_t lower_row(std::size_t i) noexcept { return i * (i + 1) / 2; }

class DefiniteSystem {
 public:
  // matrix: K, which must outlive *this. factor: the factor of K.
  DefiniteSystem(const SymmetricMatrix& matrix, std::shared_ptr<const factor::Factor> factor, Memory& memory,
                 JobRunner& jobs);
  DefiniteSystem(const DefiniteSystem&) = delete;
  DefiniteSystem& operator=(const DefiniteSystem&) = delete;

  // Computes K^-1 right. Given values stay.
  void set_right(Span<const double> right);
  // From now on the right-hand side counts `factor` times. Removes all given values. Costs no sweep.
  void set_scale(double factor);
  // Removes all given values and the memory that they took. Call set_scale() before anything else then.
  void forget() noexcept;
  // Gives unknowns their values. Each unknown must be without one.
  void fix(Span<const Index> unknowns, Span<const double> values);
  // Computes some unknowns of x, or all of them.
  void solve_at(Span<const Index> unknowns, double* out) const;
  void solve(double* x) const;

  // Returns the rows and columns of K^-1 at the unknowns, without given values: the lower triangle, row after row.
  Vector<double> inverse_at(Span<const Index> unknowns) const;

  solve::ConstraintCounts counts() const noexcept { return system_->counts(); }
  Index fixed_count() const noexcept { return static_cast<Index>(values_.size()); }

 private:
  void clear();
  Vector<double> missing() const;

  const SymmetricMatrix& matrix_;
  std::shared_ptr<const factor::Factor> factor_;
  Memory& memory_;
  JobRunner& jobs_;
  Index pin_ = -1;  // none: K is definite by itself
  double weight_ = 1;
  solve::PinPaths paths_;
  std::optional<solve::ConstraintSystem> system_;
  Vector<double> plain_;  // K^-1 right
  double scale_ = 1;
  Vector<Index> fixed_;    // by site
  Vector<double> values_;  // by site
};

}  // namespace hf_inner::quads
