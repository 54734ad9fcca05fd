// Finds fluxes that keep every border of a surface an extremum of the field.
//
// A border is closed by an apex (flux_surface.h), which is a site with a flux. If that flux is weak, the flux of other
// sites crosses the border: it enters on one side and leaves on the other. Raising the weak flux would also raise the
// flux of its neighbours. So the values of the sites are fixed instead:
//     u = 0 at sources,    u = 1 at sinks.
// By the maximum principle of positive weights every site is then an extremum. A small dense system gives the fluxes
// q_j that belong to these values t_i. Its unknowns are the sites j of a component except the first:
//     sum_j q_j (g_j(i) - g_j(0)) = t_i - t_0,    K g_j = e_j - e_0.
// g_j is the field of one unit of flux from the first site 0 to site j. The first site balances the others. The system
// is positive definite and solved by Cholesky.
//
// Cost: one solve per site, and the cube of the number of sites.
#pragma once
#include "remesh/flux_sites.h"

namespace hf_inner {

// Returns the field that is 0 at sources and 1 at sinks. Each component keeps its total of flow lines. The lines of a
// site become the even number nearest to its flux, but at least least_lines.
Vector<double> solve_between_levels(const FluxSurface& surface, const FluxSolver& solver, Vector<FluxSite>& sites);

}  // namespace hf_inner
