// All chosen numbers of this folder, grouped by the file that uses them.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// --- region.cpp ---

// A region of more than 1 in 8 vertices is solved over the whole factor. This changes the time, never the result.
constexpr std::size_t whole_sweep_share = 8;

// --- disc_map.cpp ---

// Least edge weight, as a share of the median: only positive weights give a map without folds. Same floor as in the
// operator.
constexpr double disc_least_weight = 1e-3;
// Triangles in a leaf of the search tree. It trades tests of boxes for tests of triangles; no result depends on it.
constexpr std::int32_t disc_leaf = 8;
// Depth of the search stack: 2^31 triangles halved to leaves make 28 levels, and each level leaves one box to visit.
constexpr std::int32_t disc_stack = 32;

// --- carried_detail.cpp ---

// Least share of a direction's length that must remain after projection; below it rounding sets the frame. Not
// measured.
constexpr double least_direction = 1e-9;
// Least length of a normal sum as a share of the region's largest; below it the whole region's frame is used. Not
// measured.
constexpr double least_normal = 1e-12;
// A normal with more than this on the x axis starts its frame from y. Any value from 0.58 to 1 leaves one axis usable.
constexpr double upright_cosine = 0.9;

}  // namespace hf_inner
