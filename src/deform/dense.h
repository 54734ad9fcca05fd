// A dense symmetric positive semi-definite system, factored once and solved for three right-hand sides many times.
//
// Row-oriented Cholesky L L'. An unknown whose pivot falls below a fraction of its diagonal depends on the ones before
// it, as clusters do on a mesh too coarse to separate them. It is set to zero, which leaves a minimiser of the same
// quadratic. Cost: size^3 / 6 multiply-adds, size^2 per solve and right-hand side. Solving allocates nothing.
//
// By hand, not Eigen's: a solve takes a quarter of the time of its LLT at size 480, in every frame, and dependent
// unknowns are dropped.
#pragma once
#include <cstdint>

#include "base/memory.h"

namespace hf_inner {

class DenseFactor {
 public:
  explicit DenseFactor(Memory&) noexcept {}
  // Takes the lower triangle, row by row with leading dimension size; it is overwritten by L.
  void factorise(Buffer<double>&& lower, std::int32_t size, Memory& memory);
  // In place on x[4 * unknown + k], k < 3 used, k = 3 carried along.
  void solve(double* x) const noexcept;
  std::int32_t size() const noexcept { return size_; }
  std::int32_t dropped() const noexcept { return dropped_; }

 private:
  std::int32_t size_ = 0;
  std::int32_t dropped_ = 0;
  Buffer<double> lower_;
  Buffer<double> inverse_pivot_;  // 0 for dropped unknowns
};

}  // namespace hf_inner
