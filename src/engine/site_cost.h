// Which way to take an edit: grow the dense system, or eliminate the sites and factorise. Predicted from the factor's
// figures with measured rates, so the choice is the same on every machine and in every run.
//
// Dense route for d new rows beside k: paths 2 d P, Gram 2 d (k + d / 2) C, Cholesky ((k + d)^3 - k^3) / 3 flops, P =
// entries and C = rows of a mean path. Rebase: the factorisation's flops and one more sweep. Rates in flops per
// nanosecond on one thread, measured on a 2.3 GHz Xeon.
#pragma once
#include <cmath>

#include "factor/factor.h"

namespace hf {

struct SiteCost {
  // factor: its statistics; n: unknowns; groups: path groups there are, for the mean length of a path
  SiteCost(const FactorStatistics& factor, double n, double mean_path_entries, double mean_path_rows) noexcept
      : flops(factor.flops), entries(factor.entries) {
    // before any path is known: a planar separator tree gives about one sixth of the factor in a path of about 5
    // sqrt(n) rows
    path_entries = mean_path_entries > 0 ? mean_path_entries : 0.15 * factor.entries;
    path_rows = mean_path_rows > 0 ? mean_path_rows : 5 * std::sqrt(n);
  }
  double dense_ns(double k, double d) const noexcept {
    const double all = k + d;
    return 2 * d * path_entries / 20 + 2 * d * (k + d / 2) * path_rows / 14 + (all * all * all - k * k * k) / 3 / 3.5;
  }
  // of the rows that stay outside the elimination
  double rebase_ns(double outside) const noexcept { return flops / 26 + 4 * entries / 4 + dense_ns(0, outside); }

  double flops, entries, path_entries, path_rows;
};

}  // namespace hf
