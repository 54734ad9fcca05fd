// Finds hard sites whose conditions depend linearly on the conditions of other sites.
//
// A hard site demands w'u = s with its barycentric weights w. Linear dependence occurs with four points in a triangle,
// three points on a line in a triangle, or a point on an edge whose two end vertices are sites. The dense system shows
// dependence only by a pivot of rounding size. But independent points at a small distance d also have small pivots, of
// size d^2, and so have hard sites beside stiff soft ones. The weights w themselves distinguish these cases, down to
// distances of 1e-5 of a triangle. The set of sites decides, not their order.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"
#include "solve/site_solver.h"

namespace hf_inner::solve {

// A pivot of the dense system below this share of its diagonal entry makes its site a suspect: it may depend on others.
// Crowded points at a distance d have a share of about d^2, and dependent points less than 1e-11. A larger number costs
// time, because more crowded points are examined. Half and double change no bit on eight shapes with needles, loose
// pieces and a long ribbon.
constexpr double suspect_share = 1e-6;

struct HardSite {
  const Site* site = nullptr;
  std::int32_t slot = -1;
  bool suspect = false;  // has a small pivot, so its group of sites is examined
};

// Returns the slot of a site whose weights depend linearly on the weights of the others, or -1.
// sites: all hard sites of one component; their order decides which site is reported, but not whether one is. The
// function orthogonalises one group of sites with common vertices at a time, in O(sites^2 vertices) of the group.
std::int32_t dependent_site(Span<const HardSite> sites, Memory& memory);

}  // namespace hf_inner::solve
