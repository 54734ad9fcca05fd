// Shared by the files of this room: complex numbers, and the constants that more than one file uses.
#pragma once
#include <complex>
#include <cstdint>

#include "field/connection.h"

namespace hf_inner::quads {

using Complex = std::complex<double>;
constexpr std::int32_t none = -1;
constexpr double half_turn = 3.141592653589793238462643383279502884;
// A factor nearer to 0, or to a whole number, is rounding: factors are sums of powers of i, or halves of them. A larger
// number would drop true terms, a smaller one would keep rounding. With 1e-12 and 1e-6 none of 15 runs changes.
constexpr double no_factor = 1e-9;

// Returns z at length 1, or `otherwise` for 0.
inline Complex unit_of(Complex z, Complex otherwise) noexcept {
  const double length = field::length_of(z);
  return length > 0 ? z / length : otherwise;
}

}  // namespace hf_inner::quads
