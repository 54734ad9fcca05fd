// Predicts what an edit costs on each route: grow the dense system, or eliminate the sites and factorise.
//
// The figures of the factor and measured rates decide, so the choice is the same on every machine and in every run.
// Dense route for d new rows beside k: paths 2 d P, Gram 2 d (k + d / 2) C, Cholesky ((k + d)^3 - k^3) / 3 flops. P is
// the number of entries of a mean path, C that of its rows. Rebase: the factorisation's flops and one more sweep. Unit:
// nanoseconds.
#pragma once
#include "factor/factor.h"

namespace hf_inner {

struct SiteCost {
  // Flops in a nanosecond on one thread, measured with AVX-512 on a 2 GHz Xeon; AVX2 divides all by about the same
  // factor. Half of one: its route is chosen half as often. Wrong rates cost time, never digits.
  static constexpr double path_rate = 45, gram_rate = 40, cholesky_rate = 15, factorisation_rate = 26;
  static constexpr double signed_rate =
      3.7;                                 // of mixed signs (DenseBlock), which has no front kernels; 100 to 1,600 rows
  static constexpr double sweep_rate = 4;  // bound by memory, as four flops an entry

  explicit SiteCost(const FactorStatistics& factor) noexcept : factor_(factor) {}
  double dense_ns(double k, double d) const noexcept {
    return 2 * d * factor_.path_entries / path_rate + 2 * d * (k + d / 2) * factor_.path_rows / gram_rate +
           (cube(k + d) - cube(k)) / 3 / cholesky_rate;
  }
  // Rows [first, k) of mixed signs factorised again.
  double signed_ns(double first, double k) const noexcept { return (cube(k) - cube(first)) / 3 / signed_rate; }
  // outside: rows that stay outside the elimination.
  double rebase_ns(double outside) const noexcept {
    return factor_.flops / factorisation_rate + 4 * factor_.entries / sweep_rate + dense_ns(0, outside);
  }

 private:
  static double cube(double x) noexcept { return x * x * x; }
  const FactorStatistics& factor_;
};

}  // namespace hf_inner
