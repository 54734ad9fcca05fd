// Finds hard sites whose conditions depend linearly on those of others.
//
// A hard site demands w'u = s with its barycentric weights w. Rows w depend on others at four points of a triangle, at
// three points on a line of it, and at a point on an edge with both ends. The dense system W G W' shows that only by a
// pivot of rounding size, and independent points at a distance d have pivots of d^2. The rows themselves tell the two
// apart to 1e-9 of a triangle.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"
#include "engine/site_solver.h"

namespace hf_inner {

// A pivot below this share of its diagonal entry makes its site a suspect: crowded points lie at d^2 for a distance d,
// dependent ones below 1e-11. Larger: examines more crowded points, in time only.
constexpr double suspect_share = 1e-6;

struct HardSite {
  const Site* site = nullptr;
  std::int32_t slot = -1;
  bool suspect = false;  // has a small pivot: only groups with one are examined
};

// The slot of the first site whose row depends on those before it, or -1. sites: all hard sites of one component; their
// order decides which one is reported. Orthogonalises the rows of one group of sites with common vertices at a time:
// O(sites^2 vertices) of the group.
std::int32_t dependent_site(Span<const HardSite> sites, Memory& memory);

}  // namespace hf_inner
