// Rounds the weights of a vertex to floats whose sum is exactly 1.
#pragma once
#include <cmath>
#include <cstdint>

namespace hf_inner {

// 2^24, the significand of a float: weights that are multiples of its inverse sum to 1 exactly.
constexpr double weight_units = 16777216.0;

// Shares `total` units out over `count` weights. weight(i) returns weight i, the largest first; `sum` is their sum,
// above 0. Calls take(i, units) for each, the last first. The first weight takes what rounding leaves over.
template <class Weight, class Take>
void split_units(std::int32_t count, double total, double sum, Weight&& weight, Take&& take) {
  double rest = total;
  for (std::int32_t i = count - 1; i >= 0; --i) {
    const double units = i == 0 ? rest : std::floor(total * weight(i) / sum);
    rest -= units;
    take(i, units);
  }
}

}  // namespace hf_inner
