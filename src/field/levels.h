// Chooses N levels of a field u so that the N + 1 strips between them are even.
//
// Let A(c) be the area where u < c, and L(c) the length of the line u = c. Both are exact for a piecewise linear field.
// - value: equal steps of u.
// - area: equal steps of A(c). Every strip covers the same area.
// - length: equal steps of W(c), the integral of A'(s) / L(s) ds. Every strip has the same mean width, which is its
//   area over the mean length of its lines. On a cylinder W is the height, and on a sphere the distance from the pole,
//   whatever the values between are. So rings around point sites are evenly spaced, where equal steps of u would crowd
//   them.
//
// The integral W is a sum over up to 4096 cells, whose limits are equal steps of u and quantiles of the triangles. In a
// cell the integral of L is the sum over the triangles of |grad u| times the area in the cell (coarea formula). Cost:
// O(n log n) for the sort. The area kind takes about 50 passes over the triangles, the length kind about 2.
#pragma once
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner::field {

enum class LevelSpacing : std::int32_t { value = 0, area = 1, length = 2 };

// Fills `out` with ascending levels of the field. They lie strictly inside the range, except where the field is
// constant on an area. field: NaN means no value. Throws HF_ERROR_EMPTY when no triangle has values,
// HF_ERROR_INVALID_ARGUMENT when the field is constant.
void space_levels(const mesh::Mesh& mesh, Span<const double> field, LevelSpacing spacing, Span<double> out,
                  Memory& memory);

}  // namespace hf_inner::field
