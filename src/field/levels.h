// Chooses N levels of a field so that the N + 1 strips between them are even.
//
// A(c) is the area where u < c and L(c) the length of the line u = c, both exact for a piecewise linear field.
//   - value: equal steps of u.
//   - area: equal steps of A(c). Every strip covers the same area.
//   - length: equal steps of W(c), the integral of A'(s) / L(s) ds. Every strip has the same mean width: its area over
//     the mean length of its lines. W is the height on a cylinder and the distance from the pole on a sphere, whatever
//     the values in between. So point sites, where equal values crowd, get evenly spaced rings.
//
// The integral is taken over 4096 cells between equal values and quantiles of the vertices. In a cell the integral of L
// is the sum over the triangles of |grad u| times the area in it (coarea formula).
// Cost: O(n log n) for the sort; area and length: about 50 and 2 passes over the triangles.
#pragma once
#include "base/span.h"
#include "mesh/mesh.h"

namespace hf_inner {

enum class LevelSpacing : std::int32_t { value = 0, area = 1, length = 2 };

// out: ascending, strictly inside the range but for areas on which the field is constant. field: NaN = no value.
// Throws HF_ERROR_EMPTY when no triangle has values, HF_ERROR_INVALID_ARGUMENT when the field is constant.
void space_levels(const Mesh& mesh, Span<const double> field, LevelSpacing spacing, Span<double> out, Memory& memory);

}  // namespace hf_inner
