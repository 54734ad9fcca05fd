// Finds closed curves on a surface, and the pieces into which they cut it.
//
// A curve is a ring of vertices: its points, joined by shortest paths along edges. A piece is an edge-connected set of
// vertices off the curve. A curve separates the surface if it leaves two pieces or more, or if it is a whole border.
// Each path costs O(d log d) for the d vertices nearer than its end. The pieces cost O(n) for n vertices.
#pragma once
#include <cstdint>

#include "surface/core.h"

namespace hf_inner::detail {

enum class CurveSide : std::int32_t { smaller = 0, larger = 1, seed = 2 };

// A closed curve. vertices: in order, without repeats in a row. point_of[i]: the point whose path vertices[i] lies on,
// or that it is.
struct ClosedCurve {
  explicit ClosedCurve(Memory& memory) : vertices(&memory), point_of(&memory) {}
  Vector<std::int32_t> vertices, point_of;
};

// points: inner vertices of one component.
ClosedCurve closed_curve(const surface::Core& core, Span<const std::int32_t> points, Memory& memory);

// Tells whether the curve consists of whole borders of the surface. on: by inner vertex, whether it is on the curve.
bool along_borders(const surface::Core& core, Span<const std::int32_t> curve, Span<const std::uint8_t> on);

// Throws HF_ERROR_INVALID_ARGUMENT if the seed is on the curve or elsewhere: in another component. The index is the
// seed as the caller numbered it.
void check_seed(const surface::Core& core, std::int32_t seed, bool on, bool elsewhere);

// Returns the vertices of one side of the curve in ascending order. `seed` is an inner vertex of the wanted side; only
// CurveSide::seed uses it. Throws HF_ERROR_INVALID_ARGUMENT when the curve does not separate the surface. It throws the
// same when the seed lies on the curve or in another component; the index is then the seed as the caller numbered it.
Vector<std::int32_t> curve_side(const surface::Core& core, Span<const std::int32_t> curve, CurveSide side,
                                std::int32_t seed, Memory& memory);

}  // namespace hf_inner::detail
