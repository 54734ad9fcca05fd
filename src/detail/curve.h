// Closed curves on a surface, and the pieces they cut it into.
//
// A curve is a ring of vertices: its points, joined by shortest paths along edges. Pieces are the edge-connected sets
// of vertices off the curve. A curve separates if it leaves two pieces or more, or if it is a whole border. Cost: O(d
// log d) per path for the d vertices nearer than its end, O(n) for the pieces.
#pragma once
#include <cstdint>

#include "engine/core.h"

namespace hf_inner {

enum class CurveSide : std::int32_t { smaller = 0, larger = 1, seed = 2 };

// The corner that stands for a point on a triangle as given: the one of the largest weight. Throws
// HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT (unusable triangle, weights below 0 or of another sum than 1),
// HF_ERROR_NON_FINITE; index = position.
std::int32_t nearest_corner(const Mesh& mesh, std::uint32_t triangle, const double* barycentrics,
                            std::uint32_t position);

// Throws HF_ERROR_INVALID_ARGUMENT (index = position) for a point in another component than the first.
void require_one_component(const Mesh& mesh, Span<const std::int32_t> points);

// The vertices of the curve, in order, without repeats in a row. points: inner vertices of one component.
Vector<std::int32_t> closed_curve(const Core& core, Span<const std::int32_t> points, Memory& memory);

// The vertices of one side, ascending. seed: with CurveSide::seed, an inner vertex. Throws HF_ERROR_INVALID_ARGUMENT
// when the curve does not separate, or the seed is on it or in another component (index = the seed as given).
Vector<std::int32_t> curve_side(const Core& core, Span<const std::int32_t> curve, CurveSide side, std::int32_t seed,
                                Memory& memory);

}  // namespace hf_inner
