// Levels of a field: phi of a handle turned into s in [0, 1], and the B-spline basis over s that makes the bands.
//
// Equal value: s = phi (the paper). Equal length: s = int_0^phi dp / g(p), normalised, with
//     g(p) = sum_T A |grad phi|^3 / sum_T A |grad phi|^2   over the triangles T that level p passes.
// g is the mean gradient weighted by energy, so appendages without a handle, where phi is nearly constant, do not
// count. Cost: O(min(triangles, triangle_samples) bins touched) per field. On failure nothing is left behind.
#pragma once
#include <cstdint>

#include "deform/constants.h"
#include "deform/handles.h"
#include "deform/rest.h"

namespace hf_inner {

enum class BandSpacing : std::int32_t { equal_value, equal_length };

// One field on one component.
struct FieldPart {
  std::int32_t component, handle;
};

// Piecewise linear in phi, increasing from 0 to 1.
struct Levels {
  static constexpr int bins = level_bins;
  double level[bins + 1];
  double operator()(double phi) const noexcept;
};

// The levels of several fields in one pass over the triangles; parts ordered by component.
Vector<Levels> make_levels(const Core& core, const Rest& rest, const HandleFields& fields,
                           const Vector<FieldPart>& parts, BandSpacing spacing, Memory& memory);

// The clamped uniform B-spline basis B_0 .. B_{K+1} of degree 1 or 2 on [0, 1]: at most degree + 1 values are not zero.
struct BandValues {
  std::int32_t first;  // number of the function of value[0]
  double value[3];
};
// The level at which bands are read where more than two handles share a surface, so that bending starts gradually at a
// handle. Over the last span at each end it slows down to half its speed: d spans from an end become (d + d^2 (2 - d))
// /
// 2. band_count: spans of the basis of degree 2.
double eased_level(double level, std::int32_t band_count) noexcept;
BandValues band_values(double level, std::int32_t band_count, int degree) noexcept;

}  // namespace hf_inner
