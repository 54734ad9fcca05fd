// Hard points that say the same of the surface. A hard site asks w'u = s, w its barycentric weights; asked for are rows
// w that depend linearly on others: four points of a triangle, three on a line of it, a point on an edge with both
// ends. The dense system W G W' shows that only by a pivot of rounding size, and crowded but independent points
// (distance d) have pivots of d^2; the rows themselves tell the two apart to 1e-9 of a triangle.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"
#include "engine/site_solver.h"

namespace hf_inner {

struct HardSite {
  const Site* site = nullptr;
  std::int32_t slot = -1;
  bool suspect = false;  // has a small pivot: only its group is looked at
};

// The slot of the first site whose row depends on those before it, or -1. sites: all hard sites of one component; order
// decides who is named. Orthogonalises the rows of one group of sites with common vertices at a time: O(sites^2
// vertices) of the group.
std::int32_t dependent_site(Span<const HardSite> sites, Memory& memory);

}  // namespace hf_inner
