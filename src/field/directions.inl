// The loop of directions.h. It includes no header with inline functions. The linker could otherwise use a function
// compiled for one instruction set on a processor without it.
#include <cstring>

#include "base/compiler.h"

namespace {

// Eight numbers. The compiler puts them into one register or several.
HF_LOOSE_VECTOR(Eight, double, 8);
HF_LOOSE_VECTOR(EightBits, std::int64_t, 8);
HF_LOOSE_VECTOR(Four, double, 4);
HF_LOOSE_VECTOR(Two, double, 2);

inline void get(const double* from, Eight& x) noexcept { std::memcpy(&x, from, sizeof(x)); }
inline void get(const double* from, double& x) noexcept { x = *from; }

// Adds the eight numbers by halves: 8 to 4, 4 to 2, 2 to 1.
inline double sum_of(const Eight& x) noexcept {
  Four low, high;
  std::memcpy(&low, &x, sizeof(low));
  std::memcpy(&high, reinterpret_cast<const char*>(&x) + sizeof(low), sizeof(high));
  low += high;
  Two first, second;
  std::memcpy(&first, &low, sizeof(first));
  std::memcpy(&second, reinterpret_cast<const char*>(&low) + sizeof(first), sizeof(second));
  first += second;
  return first[0] + first[1];
}
inline double sum_of(double x) noexcept { return x; }

// Adds the directions of one triangle. Number is double or Eight. Bits is the integer type of the same size.
template <class Number, class Bits>
inline void add_lanes(const hf_inner::field::TriangleFrame& frame, const double* u0, const double* u1, const double* u2,
                      const double* weights, double* sums) noexcept {
  constexpr std::int64_t magnitude = 0x7fffffffffffffff, exponent = 0x7ff0000000000000, largest = 0x7fe0000000000000;
  Number a, d1, d2, weight;
  get(u0, a);
  get(u1, d1);
  get(u2, d2);
  get(weights, weight);
  d1 -= a;
  d2 -= a;
  // Scales the differences d1 and d2 of the heat by a power of two, so that |d1| + |d2| is in [1, 2). Far from the
  // source the square of the heat would underflow to zero.
  Bits bits, other;
  Number scale, second;
  std::memcpy(&bits, &d1, sizeof(bits));
  std::memcpy(&other, &d2, sizeof(bits));
  bits &= magnitude;
  other &= magnitude;
  std::memcpy(&scale, &bits, sizeof(bits));
  std::memcpy(&second, &other, sizeof(bits));
  scale += second;
  std::memcpy(&bits, &scale, sizeof(bits));
  bits = largest - (bits & exponent);
  std::memcpy(&scale, &bits, sizeof(bits));
  d1 *= scale;
  d2 *= scale;
  // (x, y) is the gradient of the heat times twice the area. With the normal n it is d1 n x (p0 - p2) + d2 n x (p1 -
  // p0), and n x (x, y) = (-y, x).
  Number x = d1 * frame.py, y = d2 * frame.along - d1 * frame.px;
  // Computes 1 / sqrt(squared) to 1e-10 without a division or a root. Halving the exponent gives a start value with an
  // error of 3 %. Each of three Newton steps takes the relative error e to 3/2 e^2. The term 1e-200 keeps the numbers
  // finite where the heat is constant.
  const Number squared = x * x + y * y + 1e-200, half = 0.5 * squared;
  std::memcpy(&bits, &squared, sizeof(bits));
  bits = 0x5fe6eb50c7b537a9 - (bits >> 1);
  Number root;
  std::memcpy(&root, &bits, sizeof(bits));
  root = root * (1.5 - half * (root * root));
  root = root * (1.5 - half * (root * root));
  root = root * (1.5 - half * (root * root));
  root *= weight;
  x *= root;
  y *= root;
  sums[0] -= sum_of(x);
  sums[1] -= sum_of(y);
}

void add_directions_range(const hf_inner::field::DirectionSums& job, std::int64_t begin, std::int64_t end) noexcept {
  const std::int64_t channels = job.channels;
  for (std::int64_t t = begin; t < end; ++t) {
    const hf_inner::field::TriangleFrame& frame = job.frame[t];
    const double* u0 = job.heat + frame.row[0] * channels;
    const double* u1 = job.heat + frame.row[1] * channels;
    const double* u2 = job.heat + frame.row[2] * channels;
    const double* weight = job.weight + frame.component * channels;
    if (channels == 8) {
      add_lanes<Eight, EightBits>(frame, u0, u1, u2, weight, job.sums + 2 * t);
      continue;
    }
    for (std::int64_t c = 0; c < channels; ++c)
      add_lanes<double, std::int64_t>(frame, u0 + c, u1 + c, u2 + c, weight + c, job.sums + 2 * t);
  }
}

}  // namespace
