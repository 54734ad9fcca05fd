// Computes sqrt(a^2 + b^2) with IEEE operations alone. std::hypot may round either way, depending on the C library, and
// the bits of a field must not depend on it.
#pragma once
#include <algorithm>
#include <cmath>

namespace hf_inner {

// Outside this range, a sum of squares may have lost digits to underflow or may have overflowed.
constexpr double least_square = 1e-280, largest_square = 1e300;

// Returns sqrt(a^2 + b^2), accurate to two units in the last place. No intermediate result overflows or underflows. a
// and b may be infinite but not NaN.
inline double hypotenuse(double a, double b) noexcept {
  const double sum = a * a + b * b;
  if (sum > least_square && sum < largest_square) return std::sqrt(sum);
  const double large = std::max(std::fabs(a), std::fabs(b));
  if (!(large > 0) || std::isinf(large)) return large;
  const double x = a / large, y = b / large;
  return large * std::sqrt(x * x + y * y);
}

}  // namespace hf_inner
