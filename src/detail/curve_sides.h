// Tells the two sides of a closed curve through triangles (mesh/surface_curve.h), and refuses one that crosses itself.
//
// Each edge that the curve crosses counts +1 or -1 from its first vertex to its second. Summed along edges, these
// numbers say how often the curve runs round each vertex: its winding number. Where the sums depend on the way, the
// curve does not separate the surface. One that does not cross itself has two winding numbers, a whole number and the
// next one; the four sides of a crossing have three. A vertex on the curve is on neither side. Cost: O(n) for n
// vertices and the fans of the vertices that the curve passes. Crossings whose sides hold no vertex are not seen: no
// region depends on them.
#pragma once
#include "detail/curve.h"
#include "mesh/surface_curve.h"

namespace hf_inner::detail {

// Returns the vertices of one side, in ascending order. `seed` is an inner vertex of the wanted side; only
// CurveSide::seed uses it. A single vertex that the curve leaves between itself and the region, with one edge to the
// rest, joins the region. On a surface that is not oriented, the curve may cross itself. Throws
// HF_ERROR_INVALID_ARGUMENT in five cases. The curve crosses itself (index: the point before the crossing). The curve
// passes a vertex whose triangles are not one fan (index: that point). The curve does not separate the surface. The
// curve goes round no vertex. A seed is on the curve or in another component (index: the seed in the caller's numbers).
Vector<std::int32_t> surface_curve_side(const surface::Core& core, Span<const mesh::CurvePoint> points,
                                        const mesh::SurfaceCurve& curve, CurveSide side, std::int32_t seed,
                                        Memory& memory);

}  // namespace hf_inner::detail
