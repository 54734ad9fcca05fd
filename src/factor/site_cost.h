// Predicts what an edit costs on two routes: grow the dense system, or eliminate the sites and factorise again.
//
// The prediction uses the size of the factor and fixed rates, so the choice is the same on every machine and in every
// run. The dense route adds d new rows to k present rows. It costs 2 d P flops for the paths and 2 d (k + d / 2) C
// flops for the products of paths. The Cholesky factor costs ((k + d)^3 - k^3) / 3 flops. P is the mean number of
// entries of a path and C its mean number of rows. A rebase costs the flops of the factorisation and one more sweep.
// All results are in nanoseconds.
#pragma once
#include "factor/factor.h"

namespace hf_inner::factor {

struct SiteCost {
  // Flops per nanosecond on one thread, measured with AVX-512 on a Xeon of 2 GHz. With AVX2 all rates fall by about the
  // same factor. The rates predict the cost of an edit by dense rows or by a new factor; half of a rate doubles the
  // predicted cost of its step. Wrong rates cost time, but no digits.
  static constexpr double path_rate = 45, gram_rate = 40, cholesky_rate = 15, factorisation_rate = 26;
  static constexpr double signed_rate =
      3.7;  // rows of mixed signs (DenseBlock), without fast kernels; 100 to 1,600 rows
  static constexpr double inside_ns = 10e3;    // an unknown of two small factors; 300 to 10,000 unknowns
  static constexpr double product_rate = 9.6;  // of an edited factor's rim, without fast kernels; the same
  static constexpr double sweep_rate = 4;      // limited by memory; four flops per entry

  explicit SiteCost(const FactorStatistics& factor) noexcept : factor_(factor) {}
  double dense_ns(double k, double d) const noexcept {
    return 2 * d * factor_.path_entries / path_rate + 2 * d * (k + d / 2) * factor_.path_rows / gram_rate +
           (cube(k + d) - cube(k)) / 3 / cholesky_rate;
  }
  // Cost of an edited factor of changed rows, on the rim and inside (edited_factor.h): the rim's paths and their
  // products; two sparse factors of the inside with an ordering; three products of all rows with the rim, and its
  // factor, without fast kernels.
  double edit_ns(double rim, double inside) const noexcept {
    const double dense = 3 * (rim + inside) * rim * rim + 2 * cube(rim) / 3;
    return 2 * rim * factor_.path_entries / path_rate + rim * rim * factor_.path_rows / gram_rate + inside_ns * inside +
           dense / product_rate;
  }
  // Cost of factorising again the rows [first, k) of a dense system with signs of both kinds.
  double signed_ns(double first, double k) const noexcept { return (cube(k) - cube(first)) / 3 / signed_rate; }
  // Cost of eliminating hard vertex sites in a new factor (rebase). outside: the number of rows that stay in the dense
  // system.
  double rebase_ns(double outside) const noexcept {
    return factor_.flops / factorisation_rate + 4 * factor_.entries / sweep_rate + dense_ns(0, outside);
  }

 private:
  static double cube(double x) noexcept { return x * x * x; }
  const FactorStatistics& factor_;
};

}  // namespace hf_inner::factor
