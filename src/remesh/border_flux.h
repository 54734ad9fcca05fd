// Fluxes that keep every border of a surface an extremum, when no flux of its own does.
//
// A border is closed by an apex (flux_surface.h), a site of some flux. The flux of the other sites runs through a hole
// whose own is weak, in on one side and out on the other, and raising it raises that of its neighbours. Held at the
// ends of the range instead,
//     u = 0 at sources,    u = 1 at sinks,
// every site is an extremum whatever its place, by the maximum principle of positive weights. The fluxes that give
// these values solve the small dense system
//     sum_j q_j (g_j(i) - g_j(0)) = t_i - t_0,    K g_j = e_j - e_0,
// over the sites of a component but the first, which takes what is left: positive definite, by Cholesky.
//
// Cost: a solve per site, and the cube of their number.
#pragma once
#include "remesh/flux_sites.h"

namespace hf_inner {

// The field, with as many lines between sources and sinks of each component as there were. Lines of sites become the
// even numbers nearest to their fluxes, 4 at least.
Vector<double> solve_between_levels(const FluxSurface& surface, const FluxSolver& solver, Vector<FluxSite>& sites);

}  // namespace hf_inner
