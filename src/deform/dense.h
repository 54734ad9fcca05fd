// Factors a dense symmetric positive semi-definite system once, and solves it for three or four right-hand sides many
// times.
//
// The factorisation is a row-oriented Cholesky L L'. If a pivot falls below a fraction of its diagonal, the unknown
// depends on earlier ones. This happens to clusters on a mesh too coarse to separate them. The unknown is set to zero,
// and the result still minimises the same quadratic energy. Factoring costs size^3 / 6 multiply-adds, and a solve
// size^2 per right-hand side. Solving allocates nothing. Every processor gets the same bits.
//
// It is written by hand instead of with Eigen's LLT. At size 480 a solve takes a quarter of the time, in every frame.
// Eigen's LLT also cannot drop dependent unknowns.
#pragma once
#include <cstdint>

#include "base/memory.h"

namespace hf_inner::deform {

class DenseFactor {
 public:
  explicit DenseFactor(Memory&) noexcept {}
  // Factors the matrix: its lower triangle, row by row with leading dimension size. The buffer is used up.
  void factorise(Buffer<double>&& matrix, std::int32_t size, Memory& memory);
  // Solves in place. x[4 * unknown + k] holds right-hand side k < 3; the fourth number stays.
  void solve(double* x) const noexcept { solve_sides(3, x); }
  // The same for four right-hand sides.
  void solve_four(double* x) const noexcept { solve_sides(4, x); }
  std::int32_t size() const noexcept { return size_; }
  std::int32_t dropped() const noexcept { return dropped_; }

 private:
  void solve_sides(int sides, double* x) const noexcept;
  void finish_row(double* lower, std::size_t stride, std::size_t first, std::size_t i, double square) noexcept;

  std::int32_t size_ = 0;
  std::int32_t dropped_ = 0;
  Buffer<double> rows_, columns_;  // DensePanels
  Buffer<double> inverse_pivot_;   // 0 for dropped unknowns
};

}  // namespace hf_inner::deform
