// Turns a handle's field phi into a level s in [0, 1], and evaluates the B-spline basis over s that makes the bands.
//
// Equal value: s = phi, as in the paper. Equal length: s = int_0^phi dp / g(p), scaled to end at 1, where
//     g(p) = sum_T A |grad phi|^3 / sum_T A |grad phi|^2   over the triangles T that contain the value p.
// A is the area of a triangle. g is the mean gradient weighted by energy. Parts without a handle, where phi is nearly
// constant, therefore do not count. Cost per field: O(min(triangles, triangle_samples)) times the bins that a triangle
// spans. A failed call changes nothing.
#pragma once
#include <algorithm>
#include <cstdint>

#include "deform/constants.h"
#include "deform/handles.h"
#include "deform/rest.h"

namespace hf_inner::deform {

enum class BandSpacing : std::int32_t { equal_value, equal_length };

// One handle's field on one component.
struct FieldPart {
  std::int32_t component, handle;
};

// The level s as a function of phi: piecewise linear, increasing from 0 to 1.
struct Levels {
  static constexpr int bins = level_bins;
  double level[bins + 1];
  double operator()(double phi) const noexcept;
};

inline double Levels::operator()(double phi) const noexcept {
  if (phi >= 1) return 1;
  if (!(phi > 0)) return 0;
  const double x = phi * bins;
  const int b = std::min(static_cast<int>(x), bins - 1);
  return level[b] + (x - b) * (level[b + 1] - level[b]);
}

// Computes the levels (field values turned to [0, 1]) of several fields in one pass over the triangles. The fields of
// component c are parts[part_start[c] .. part_start[c + 1]).
Vector<Levels> make_levels(const surface::Core& core, const Rest& rest, const HandleFields& fields,
                           const Vector<FieldPart>& parts, const Vector<std::int32_t>& part_start, BandSpacing spacing,
                           Memory& memory);

// Values of the clamped uniform B-spline basis B_0 .. B_{K+1} of degree 1 or 2 on [0, 1]. At most degree + 1 of them
// are not zero.
struct BandValues {
  std::int32_t first;  // value[0] belongs to B_first
  double value[3];
};
// Returns the level at which the B-splines are read where more than two handles share a component. With it, bending
// starts gradually at a handle. In the last span at each end the level slows down to half its speed: a distance of d
// spans from the end becomes (d + d^2 (2 - d)) / 2. band_count: number of spans of the basis of degree 2.
inline double eased_level(double level, std::int32_t band_count) noexcept {
  // Spans (knot intervals) of the basis of degree 2.
  const double spans = band_count, x = std::clamp(level, 0.0, 1.0) * spans;
  const auto eased = [](double d) { return 0.5 * (d + d * d * (2 - d)); };
  if (x < 1) return eased(x) / spans;
  return x > spans - 1 ? 1 - eased(spans - x) / spans : level;
}
inline BandValues band_values(double level, std::int32_t band_count, int degree) noexcept {
  // K + 2 B-spline functions of degree p take K + 2 - p spans between knots. The knots are clamped at both ends.
  const std::int32_t spans = band_count + 2 - degree;
  const double x = std::clamp(level, 0.0, 1.0) * spans;
  const std::int32_t span = std::min(static_cast<std::int32_t>(x), spans - 1);
  BandValues b{span, {0, 0, 0}};
  const double u = x - span;
  if (degree == 1) {
    b.value[0] = 1 - u;
    b.value[1] = u;
    return b;
  }
  const double low = span == 0 ? 1.0 : 0.5,
               high = span == spans - 1 ? 1.0 : 0.5;  // 1 over the widths of the neighbouring pairs of spans
  b.value[0] = (1 - u) * (1 - u) * low;
  b.value[2] = u * u * high;
  b.value[1] = 1 - b.value[0] - b.value[2];
  return b;
}

}  // namespace hf_inner::deform
