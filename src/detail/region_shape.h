// Lists the parts of a region: its vertices, its rim, the sites of its base surface, and the triangles that move.
// Immutable.
//
//     inside   I, the vertices that the base surface moves.
//     rim      Vertices outside I that have a neighbour in I.
//     sites    The rim. For a bi-harmonic matrix K also every other vertex that K couples with I, which makes two
//     rings.
//              The base is then a clamped plate: it takes position and slope from the surface around it.
//
// The masks cost O(n) for n vertices of the surface. All other work depends only on the size of the region.
#pragma once
#include <cstdint>

#include "surface/core.h"

namespace hf_inner::detail {

struct RegionShape {
  // Describes the region with these vertices. inside: inner vertices in ascending order, each once. Throws
  // HF_ERROR_INVALID_ARGUMENT when a whole component lies inside; index: one of its vertices in the caller's mesh.
  RegionShape(const surface::Core& core, Span<const std::int32_t> inside, Memory& memory);

  std::int32_t local_count() const noexcept { return static_cast<std::int32_t>(inside.size() + rim.size()); }
  // Returns the inner vertex that has this local number.
  std::int32_t vertex(std::int32_t number) const noexcept {
    const std::size_t i = static_cast<std::size_t>(number);
    return i < inside.size() ? inside[i] : rim[i - inside.size()];
  }

  Vector<std::int32_t> inside, rim, sites;  // inner vertices, ascending
  Vector<std::int32_t> local;               // local number by inner vertex: inside first, then rim; -1 elsewhere
  Vector<std::int32_t> triangles;           // those with a corner inside
  Vector<std::int32_t> corners;             // local numbers, 3 per triangle
};

// Returns the region with `rings` more rings of vertices around it. A negative number takes rings away.
Vector<std::int32_t> grown(const surface::Core& core, Span<const std::int32_t> inside, std::int32_t rings,
                           Memory& memory);

}  // namespace hf_inner::detail
