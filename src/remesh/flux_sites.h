// Where the flow of a quad mesh starts and ends, and its amounts: the sites of a Neumann problem.
//
// Every site carries an even number of lines, least_lines or more. A vertex gets the circumference of the geodesic
// circle around it (circle_radius) over the edge length, a border its length over the edge length.
// Sites are partitioned into sources and sinks so that both sides carry about the same and neighbours differ. The
// partition minimises
//     |sum+ - sum-| / sum + neighbour_cost * mean over pairs of one sign of exp(-d_ij / mean d).
// All partitions of up to most_tried_at_once sites are tried; of more sites, exchanges while the cost falls.
// Then both sides are scaled to one even total (largest remainders, in steps of two). A component with too few sites
// gets further ones, each farthest from those it has.
//
// The field solves K u = b, b = +lines at sinks, -lines at sources: u rises from sources to sinks.
// Cost: one Dijkstra over the edges per site, one factorisation.
#pragma once
#include "base/jobs.h"
#include "base/progress.h"
#include "factor/factor.h"
#include "remesh/flux_surface.h"

namespace hf_inner {

struct FluxSite {
  std::int32_t vertex;  // of the surface
  double lines;         // > 0: a sink, < 0: a source
};

// given: sites with their lines (0: chosen here; otherwise of both signs in each component). automatic: given sites are
// proposals. Those near borders are left out, and components with handles get at least four. Apexes are always sites.
// Throws HF_ERROR_INVALID_ARGUMENT when given lines cannot balance, HF_ERROR_TOO_LARGE beyond most_sites sites and
// borders.
Vector<FluxSite> choose_flux_sites(const FluxSurface& surface, Span<const FluxSite> given, bool automatic,
                                   double edge_length, Memory& memory);

// The factor of the flux problem, and fields from it.
class FluxSolver {
 public:
  // Orders and factorises. Throws as Factor::make.
  FluxSolver(const FluxSurface& surface, Memory& memory, JobRunner& jobs);
  // u by vertex of the surface, up to a constant per component. Refined (flux_solves), because lines need a flow that
  // balances at every vertex.
  Vector<double> solve(Span<const FluxSite> sites) const;

 private:
  const FluxSurface* surface_;
  Memory* memory_;
  JobRunner* jobs_;
  std::shared_ptr<const Factor> factor_;
};

// Multiplies the lines of all sites of a component and balances them again (even numbers, at least 4 each).
void scale_lines(const FluxSurface& surface, std::int32_t component, double factor, Vector<FluxSite>& sites);

// Solves, and raises the lines of borders that the flow of other sites crosses until every apex is an extremum.
// If that fails, sources and sinks are held at two levels (border_flux.h).
Vector<double> solve_with_borders(const FluxSurface& surface, const FluxSolver& solver, Vector<FluxSite>& sites);

}  // namespace hf_inner
