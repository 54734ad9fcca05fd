// Fluxes that keep every border of a surface an extremum of the field.
//
// A border is closed by an apex (flux_surface.h), a site with a flux. If that flux is weak, the flux of other sites
// crosses the border: it enters on one side and leaves on the other. Raising that flux raises the flux of its
// neighbours. So sites are held at the ends of the range instead:
//     u = 0 at sources,    u = 1 at sinks.
// By the maximum principle of positive weights every site is then an extremum.
// The fluxes q with these values solve a small dense system over the sites of a component but the first:
//     sum_j q_j (g_j(i) - g_j(0)) = t_i - t_0,    K g_j = e_j - e_0.
// The first site balances the others. The system is positive definite and solved by Cholesky.
//
// Cost: a solve per site, and the cube of their number.
#pragma once
#include "remesh/flux_sites.h"

namespace hf_inner {

// Returns the field and keeps the total of lines of each component. Lines of sites become the even numbers nearest to
// their fluxes, least_lines or more.
Vector<double> solve_between_levels(const FluxSurface& surface, const FluxSolver& solver, Vector<FluxSite>& sites);

}  // namespace hf_inner
