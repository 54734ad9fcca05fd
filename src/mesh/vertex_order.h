// Numbers the vertices of a mesh so that neighbours lie near each other in memory.
//
// Scans and subdivided meshes often list neighbours far apart. Loops over pieces of vertices then reach into other
// pieces all the time. Such a mesh gets its vertices along a Hilbert curve through the box (Skilling 2004, "Programming
// the Hilbert curve"). A mesh that has a good order, or few vertices, keeps its own. Cost: O(n). A failed call changes
// nothing.
#pragma once
#include <cstdint>

#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Returns the position of point p, whose coordinates lie in -0.5 to 0.5, along the curve.
std::uint64_t hilbert_key(Vec3 p) noexcept;

// Says whether an order of `count` vertices is good enough. corners: three vertices per triangle, numbered in that
// order.
bool is_local(Span<const std::int32_t> corners, std::size_t count) noexcept;

// Sorts the vertices 0 .. n - 1 along the curve: entry i is the vertex that comes i-th. jobs: threads to use, or null.
Vector<std::int32_t> curve_order(Span<const Vec3> positions, JobRunner* jobs, Memory& memory);

}  // namespace hf_inner::mesh
