// Turns a handle's field phi into a level s in [0, 1], and evaluates the B-spline basis over s that makes the bands.
//
// Equal value: s = phi, as in the paper. Equal length: s = int_0^phi dp / g(p), scaled to end at 1, where
//     g(p) = sum_T A |grad phi|^3 / sum_T A |grad phi|^2   over the triangles T that contain the value p.
// A is the area of a triangle. g is the mean gradient weighted by energy. Parts without a handle, where phi is nearly
// constant, therefore do not count. Cost per field: O(min(triangles, triangle_samples)) times the bins that a triangle
// spans. A failed call changes nothing.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/handles.h"
#include "deform/rest.h"

namespace hf_inner {

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

// Computes the levels (field values turned to [0, 1]) of several fields in one pass over the triangles. The fields of
// component c are parts[part_start[c] .. part_start[c + 1]).
Vector<Levels> make_levels(const Core& core, const Rest& rest, const HandleFields& fields,
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
double eased_level(double level, std::int32_t band_count) noexcept;
BandValues band_values(double level, std::int32_t band_count, int degree) noexcept;

}  // namespace hf_inner
