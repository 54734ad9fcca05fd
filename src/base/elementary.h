// Sines, angles, exponentials and logarithms with IEEE operations alone. The functions of C libraries differ in the
// last bit, and the bits of a result must not depend on the system. tests/api/called.txt allows none of them.
//
// Errors are below one unit in the last place (tests/unit/base/elementary_test.cpp). Sums and products that need more
// than a double are kept in two: a number and its rest. No function allocates, throws or changes state.
#pragma once

namespace hf_inner {

// The angle is in radians. Up to 1e6 in size the error is below one unit; a larger angle is first taken modulo the
// double next to 2 pi. NaN where the angle is not finite.
double sine(double angle) noexcept;
double cosine(double angle) noexcept;
// Returns the angle of the vector (x, y) from the x-axis, in [-pi, pi]; signs of zero and infinities as atan2 has them.
double arc_tangent(double y, double x) noexcept;
// Returns the angle in [0, pi] whose cosine is x. NaN outside [-1, 1].
double arc_cosine(double x) noexcept;
double exponential(double x) noexcept;
// Returns the natural logarithm: -infinity of 0, NaN below.
double logarithm(double x) noexcept;

}  // namespace hf_inner
