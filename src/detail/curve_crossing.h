// Refuses closed curves that cross themselves.
//
// On a triangle mesh, two paths along edges can only cross where they share vertices. There they may also touch: run
// together for a while, and part to the sides they came from. The order of the neighbours around the first and the last
// shared vertex tells crossing from touching. Cost: O(m log m) for a curve of m vertices, and the degrees of the
// vertices that it passes more than once.
#pragma once
#include "detail/curve.h"

namespace hf_inner::detail {

// Ways out and straight back along the same edges do not count. Where the triangles around a shared vertex are not one
// fan, sides mean nothing, and the curve is taken to touch. Throws HF_ERROR_INVALID_ARGUMENT when the curve crosses
// itself; index: the point before the crossing.
void require_no_crossing(const surface::Core& core, const ClosedCurve& curve, Memory& memory);

}  // namespace hf_inner::detail
