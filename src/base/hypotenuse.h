// sqrt(a^2 + b^2) of IEEE operations alone: the bits of a field must not depend on the C library, whose hypot may round
// either way.
#pragma once
#include <algorithm>
#include <cmath>

namespace hf_inner {

// Squares outside may have lost digits to underflow, or overflowed in the sum.
constexpr double least_square = 1e-280, largest_square = 1e300;

// Without overflow or underflow on the way, to two units in the last place. a and b are numbers, infinite ones too.
inline double hypotenuse(double a, double b) noexcept {
  const double sum = a * a + b * b;
  if (sum > least_square && sum < largest_square) return std::sqrt(sum);
  const double large = std::max(std::fabs(a), std::fabs(b));
  if (!(large > 0) || std::isinf(large)) return large;
  const double x = a / large, y = b / large;
  return large * std::sqrt(x * x + y * y);
}

}  // namespace hf_inner
