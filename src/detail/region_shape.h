// The parts of a region: its vertices, its rim, the sites of its base surface, and the triangles that move with it.
// Immutable.
//
//     inside   I, the vertices that the base moves.
//     rim      Vertices off I with a neighbour in I.
//     sites    The rim. Fourth-order operators add every vertex off I that K couples with I (two rings). Then
//              K_II u_I = -K_IS p_S is the clamped plate: position and slope come from the surface around.
//
// Cost: O(n) for the masks, the rest by the size of the region.
#pragma once
#include <cstdint>

#include "engine/core.h"

namespace hf_inner {

struct RegionShape {
  // inside: inner vertices, ascending, each once. Throws HF_ERROR_INVALID_ARGUMENT (index = a vertex as given) when a
  // whole component lies inside.
  RegionShape(const Core& core, Span<const std::int32_t> inside, Memory& memory);

  std::int32_t local_count() const noexcept { return static_cast<std::int32_t>(inside.size() + rim.size()); }
  // Inner vertex of a local number.
  std::int32_t vertex(std::int32_t number) const noexcept {
    const std::size_t i = static_cast<std::size_t>(number);
    return i < inside.size() ? inside[i] : rim[i - inside.size()];
  }

  Vector<std::int32_t> inside, rim, sites;  // inner vertices, ascending
  Vector<std::int32_t> local;               // by inner vertex: its number, inside first, then rim; -1 elsewhere
  Vector<std::int32_t> triangles;           // with a corner inside
  Vector<std::int32_t> corners;             // local numbers, 3 per triangle
};

// The region with `rings` rings of vertices more, or fewer if it is below 0.
Vector<std::int32_t> grown(const Core& core, Span<const std::int32_t> inside, std::int32_t rings, Memory& memory);

}  // namespace hf_inner
