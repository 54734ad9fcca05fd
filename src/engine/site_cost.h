// Which way to take an edit: grow the dense system, or eliminate the sites and factorise. Predicted from the factor's
// figures with measured rates, so the choice is the same on every machine and in every run.
//
// Dense route for d new rows beside k: paths 2 d P, Gram 2 d (k + d / 2) C, Cholesky ((k + d)^3 - k^3) / 3 flops, P =
// entries and C = rows of a mean path. Rebase: the factorisation's flops and one more sweep. Rates in flops per
// nanosecond on one thread, measured with AVX-512 on a 2 GHz Xeon; on AVX2 all of them fall by about the same factor.
#pragma once
#include "factor/factor.h"

namespace hf_inner {

struct SiteCost {
  explicit SiteCost(const FactorStatistics& factor) noexcept : factor_(factor) {}
  double dense_ns(double k, double d) const noexcept {
    const double all = k + d;
    return 2 * d * factor_.path_entries / 45 + 2 * d * (k + d / 2) * factor_.path_rows / 40 +
           (all * all * all - k * k * k) / 3 / 15;
  }
  // of the rows that stay outside the elimination
  double rebase_ns(double outside) const noexcept {
    return factor_.flops / 26 + 4 * factor_.entries / 4 + dense_ns(0, outside);
  }

 private:
  const FactorStatistics& factor_;
};

}  // namespace hf_inner
