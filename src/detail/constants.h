// All chosen numbers of this folder, grouped by the file that uses them.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::detail {

// --- region.cpp ---

// For a region with more than one in this many vertices, the solve passes over the whole factor. This changes the time,
// never the result. On tori of 18,000 and 42,500 vertices, the sweep of the region takes half the time of the whole at
// a sixteenth, 0.6 to 0.7 of it at an eighth and at a quarter, and up to 2.7 times it at a half.
constexpr std::size_t whole_sweep_share = 4;

// --- curve_crossing.cpp, curve_sides.cpp ---

// A curve that passes a vertex more often than this is refused. It bounds the pairs of passes that are compared. A rim
// drawn by hand passes a vertex twice at most.
constexpr std::int32_t most_visits = 8;

// --- curve_sides.cpp ---

// Where a curve crosses itself, at most this many pairs of lines are compared to name the place. It bounds the time of
// a refusal; past it the error names a point beside the crossing. Lines drawn by hand share a triangle with few others.
constexpr std::size_t most_compared = std::size_t{1} << 20;

// --- disc_map.cpp ---

// Edge weights of the map to the disc are at least this share of their median: only positive weights give a map without
// folds. The field's clamped operator has the same share. A larger one distorts the map, a smaller one crowds its
// points. Half and double move a shell of an armadillo on a bunny by 2e-6 and 4e-6 of the box, 0.1 by 5e-4.
constexpr double disc_least_weight = 1e-3;
// Triangles in a leaf of the tree that finds the triangle of a disc point. It trades tests of boxes for tests of
// triangles; no result depends on it.
constexpr std::int32_t disc_leaf = 8;
// Depth of the stack of that tree's search: 2^31 triangles halved to leaves make 28 levels, and each level leaves one
// box to visit.
constexpr std::int32_t disc_stack = 32;

// --- carried_detail.cpp ---

// A direction projected to a tangent plane must keep this share of its length; below it rounding would decide it. It is
// far above rounding (1e-16). With half, double, 0 and 0.5, a shell of an armadillo on a bunny has the same bits.
constexpr double least_direction = 1e-9;
// The sum of the normals around a vertex must have this share of the largest length in the region. Otherwise detail is
// carried in the whole region's frame. It is far above rounding. With half, double, 0 and 0.03, a shell of an armadillo
// on a bunny has the same bits. At 0.3 it changes.
constexpr double least_normal = 1e-12;
// The frame of a unit normal starts from the x axis, or from y if the normal's x coordinate is larger than this. Any
// value from 0.58 to 1 works.
constexpr double upright_cosine = 0.9;

}  // namespace hf_inner::detail
