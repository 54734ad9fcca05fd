#include "base/elementary.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace hf_inner {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

// A number and its rest, which is less than half a unit in its last place.
struct Pair {
  double high, low;
};

// a + b, exactly. (Knuth, The Art of Computer Programming, volume 2, 4.2.2)
inline Pair sum(double a, double b) noexcept {
  const double s = a + b, b_part = s - a;
  return {s, (a - (s - b_part)) + (b - b_part)};
}

// a b, exactly while nothing overflows or underflows. (Dekker 1971)
inline Pair product(double a, double b) noexcept {
  constexpr double halves = 134217729;  // 2^27 + 1: cuts a number into two of at most 26 bits
  const double ca = halves * a, cb = halves * b;
  const double ah = ca - (ca - a), al = a - ah, bh = cb - (cb - b), bl = b - bh, p = a * b;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

// (n.high + n.low) / (d.high + d.low), to twice the digits of a double.
inline Pair quotient(Pair n, Pair d) noexcept {
  const double q = n.high / d.high;
  const Pair back = product(q, d.high);
  return {q, ((((n.high - back.high) - back.low) + n.low) - q * d.low) / d.high};
}

// pi / 2 in four parts. The first three have 32 bits, so that their products with a count of up to 21 bits are exact.
constexpr double half_pi[4] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
// Larger angles would take more than 21 bits of quarter turns.
constexpr double largest_angle = 1e6;

// An angle in [-pi / 4, pi / 4] and the number of quarter turns taken off.
struct Reduced {
  Pair angle;
  int quarter;
};
Reduced reduce(double angle) noexcept {
  if (std::fabs(angle) > largest_angle) angle = std::fmod(angle, 4 * (half_pi[0] + half_pi[1]));
  const double turns = std::floor(angle * two_over_pi + 0.5);
  Pair r = sum(angle - turns * half_pi[0], -turns * half_pi[1]);
  const Pair third = sum(r.high, -turns * half_pi[2]);
  r = sum(third.high, (third.low + r.low) - turns * half_pi[3]);
  return {r, static_cast<int>(static_cast<std::int64_t>(turns) & 3)};
}

// The series of Taylor. On [-pi / 4, pi / 4] the first term left out is below 1e-19 of the result.
double sine_of(Pair r) noexcept {
  const double x = r.high, z = x * x;
  double p = z * (1.0 / 355687428096000);
  p = z * (-1.0 / 1307674368000 + p);
  p = z * (1.0 / 6227020800 + p);
  p = z * (-1.0 / 39916800 + p);
  p = z * (1.0 / 362880 + p);
  p = z * (-1.0 / 5040 + p);
  p = z * (1.0 / 120 + p);
  p = z * (-1.0 / 6 + p);
  return x + (r.low * (1 - 0.5 * z) + x * p);
}
double cosine_of(Pair r) noexcept {
  const double x = r.high, z = x * x, half = 0.5 * z;
  double p = z * (-1.0 / 6402373705728000 + z * (1.0 / 2432902008176640000));
  p = z * (1.0 / 20922789888000 + p);
  p = z * (-1.0 / 87178291200 + p);
  p = z * (1.0 / 479001600 + p);
  p = z * (-1.0 / 3628800 + p);
  p = z * (1.0 / 40320 + p);
  p = z * (-1.0 / 720 + p);
  p = z * (1.0 / 24 + p);
  const double first = 1 - half;
  return first + (((1 - first) - half) + (z * p - x * r.low));
}

// atan(i / 16) with its rest, for i from 0 to 16.
constexpr Pair angles[17] = {
    {0, 0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};
constexpr Pair pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// atan(t) for t in [0, 1]: the angle of the next sixteenth c, and atan((t - c) / (1 + t c), by Taylor's series.
Pair angle_of(Pair t) noexcept {
  const int i = static_cast<int>(16 * t.high + 0.5);
  const double c = i / 16.0;
  Pair r = t;
  if (i > 0) {
    const Pair denominator = sum(1, t.high * c);
    r = quotient(sum(t.high - c, t.low), {denominator.high, denominator.low + (product(t.high, c).low + t.low * c)});
  }
  const double x = r.high, z = x * x;
  double p = z * (1.0 / 13);
  p = z * (-1.0 / 11 + p);
  p = z * (1.0 / 9 + p);
  p = z * (-1.0 / 7 + p);
  p = z * (1.0 / 5 + p);
  p = z * (-1.0 / 3 + p);
  const Pair whole = sum(angles[i].high, x);
  return sum(whole.high, whole.low + (angles[i].low + (r.low + x * p)));
}

Pair difference(Pair a, Pair b) noexcept {
  const Pair high = sum(a.high, -b.high);
  return {high.high, high.low + (a.low - b.low)};
}

// ln 2 in two parts. The first has 33 bits, so that its products with exponents are exact.
constexpr double ln2[2] = {0x1.62e42fefp-1, 0x1.473de6af278edp-34};
constexpr double one_over_ln2 = 0x1.71547652b82fep+0;

}  // namespace

double sine(double angle) noexcept {
  if (!std::isfinite(angle)) return nan;
  if (std::fabs(angle) < 0x1p-27) return angle;
  const Reduced r = reduce(angle);
  const double value = r.quarter % 2 ? cosine_of(r.angle) : sine_of(r.angle);
  return r.quarter >= 2 ? -value : value;
}

double cosine(double angle) noexcept {
  if (!std::isfinite(angle)) return nan;
  const Reduced r = reduce(angle);
  const double value = r.quarter % 2 ? sine_of(r.angle) : cosine_of(r.angle);
  return r.quarter == 1 || r.quarter == 2 ? -value : value;
}

double arc_tangent(double y, double x) noexcept {
  if (std::isnan(x) || std::isnan(y)) return nan;
  double a = std::fabs(x), b = std::fabs(y);
  if (std::isinf(a) || std::isinf(b)) {
    a = std::isinf(a) ? 1 : 0;
    b = std::isinf(b) ? 1 : 0;
  }
  const bool steep = b > a;
  double large = steep ? b : a, small = steep ? a : b;
  Pair angle = {0, 0};
  if (small > 0) {
    // Products of numbers of this size neither overflow nor underflow, unless the quotient is tiny.
    if (large > 0x1p+500 || large < 0x1p-400) {
      const int exponent = -std::ilogb(large);
      large = std::ldexp(large, exponent);
      small = std::ldexp(small, exponent);
    }
    const double ratio = small / large;
    if (ratio < 0x1p-60) {
      if (!steep && !std::signbit(x)) return std::copysign(ratio > 0x1p-1000 ? ratio : std::fabs(y) / std::fabs(x), y);
      angle = {ratio, 0};
    } else {
      angle = angle_of(quotient({small, 0}, {large, 0}));
    }
  }
  if (steep) angle = difference({0.5 * pi.high, 0.5 * pi.low}, angle);
  if (std::signbit(x)) angle = difference(pi, angle);
  return std::copysign(angle.high + angle.low, y);
}

double arc_cosine(double x) noexcept {
  if (!(x >= -1 && x <= 1)) return nan;
  const double c = std::fabs(x);
  if (c == 1) return x > 0 ? 0 : pi.high;
  // The sine of the angle, sqrt((1 - c) (1 + c)), with its rest.
  const Pair below = sum(1, -c), above = sum(1, c), square = product(below.high, above.high);
  const double s = std::sqrt(square.high);
  const Pair back = product(s, s);
  const double rest =
      ((square.high - back.high) - back.low) + (square.low + below.high * above.low + below.low * above.high);
  const Pair root = {s, rest / (2 * s)};
  Pair angle = s < c ? angle_of(quotient(root, {c, 0}))
                     : difference({0.5 * pi.high, 0.5 * pi.low}, angle_of(quotient({c, 0}, root)));
  if (x < 0) angle = difference(pi, angle);
  return angle.high + angle.low;
}

double exponential(double x) noexcept {
  if (std::isnan(x)) return nan;
  if (x > 710) return infinity;
  if (x < -746) return 0;
  const double count = std::floor(x * one_over_ln2 + 0.5);
  const Pair r = sum(x - count * ln2[0], -count * ln2[1]);
  const double t = r.high;
  double p = t * (1.0 / 6227020800);
  p = t * (1.0 / 479001600 + p);
  p = t * (1.0 / 39916800 + p);
  p = t * (1.0 / 3628800 + p);
  p = t * (1.0 / 362880 + p);
  p = t * (1.0 / 40320 + p);
  p = t * (1.0 / 5040 + p);
  p = t * (1.0 / 720 + p);
  p = t * (1.0 / 120 + p);
  p = t * (1.0 / 24 + p);
  p = t * (1.0 / 6 + p);
  p = t * t * (0.5 + p);
  const Pair first = sum(1, t);
  return std::ldexp(first.high + (first.low + (p + r.low * (1 + t))), static_cast<int>(count));
}

double logarithm(double x) noexcept {
  if (std::isnan(x) || x < 0) return nan;
  if (x == 0) return -infinity;
  if (std::isinf(x)) return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  // ln m = 2 (s + s^3 / 3 + s^5 / 5 + ...) with s = (m - 1) / (m + 1). s is below 0.172
  const double f = m - 1;
  const Pair s = quotient({f, 0}, sum(2, f));
  const double z = s.high * s.high;
  double p = z * (2.0 / 23);
  p = z * (2.0 / 21 + p);
  p = z * (2.0 / 19 + p);
  p = z * (2.0 / 17 + p);
  p = z * (2.0 / 15 + p);
  p = z * (2.0 / 13 + p);
  p = z * (2.0 / 11 + p);
  p = z * (2.0 / 9 + p);
  p = z * (2.0 / 7 + p);
  p = z * (2.0 / 5 + p);
  p = z * (2.0 / 3 + p);
  const Pair whole = sum(exponent * ln2[0], 2 * s.high);
  return whole.high + (whole.low + (exponent * ln2[1] + (2 * s.low + s.high * p)));
}

}  // namespace hf_inner
