// Every chosen number of this room, grouped by the file that uses it.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner {

// --- region.cpp ---
// Regions of more than 1 in 8 vertices are solved over the whole factor. The result does not depend on it.
constexpr std::size_t whole_sweep_share = 8;

// --- disc_map.cpp ---
// Floor of weights, in medians: an embedding needs positive ones. The value is that of the clamped operator.
constexpr double disc_least_weight = 1e-3;
// Boxes against triangles to test. The result does not depend on it.
constexpr std::int32_t disc_leaf = 8;
// 2^31 triangles halved to leaves give 28 levels, each with one box waiting.
constexpr std::int32_t disc_stack = 32;

// --- carried_detail.cpp ---
// Length of a projected direction, in lengths before, below which rounding would choose the frame. Not measured.
constexpr double least_direction = 1e-9;
// Normal sum, in the largest, below which a frame is that of the whole region: edges 1e-6 of the others. Not measured.
constexpr double least_normal = 1e-12;
// Normals steeper than this on x start a frame from y: any value from 0.58 to 1 leaves one axis usable.
constexpr double upright_cosine = 0.9;

}  // namespace hf_inner
