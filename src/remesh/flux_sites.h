// Chooses where the flow of a quad mesh starts and ends, and how much flows: the sites of a Neumann problem.
//
// Every site carries an even number of lines, at least least_lines. A vertex gets the circumference of the geodesic
// circle around it (circle_radius) over the edge length. A border gets its length over the edge length. Sites are
// partitioned into sources and sinks, so that both sides carry about the same number of lines and neighbours differ.
// The partition minimises
//     |sum+ - sum-| / sum + neighbour_cost * mean over pairs on one side of exp(-d_ij / mean d).
// sum+ and sum- are the lines of sinks and sources, and d_ij is the distance of sites i and j. Up to most_tried_at_once
// sites, all partitions are tried. With more sites, sites are exchanged while the cost falls. Then both sides are
// scaled to one even total (largest remainders, in steps of two). A component with too few sites gets additional ones,
// each farthest from the existing ones.
//
// The field solves K u = b with b = +lines at sinks and -lines at sources, so u rises from sources to sinks. Cost: one
// Dijkstra search over the edges per site, and one factorisation.
#pragma once
#include "base/jobs.h"
#include "base/progress.h"
#include "factor/factor.h"
#include "remesh/flux_surface.h"

namespace hf_inner {

struct FluxSite {
  std::int32_t vertex;  // vertex of the FluxSurface
  double lines;         // flow lines that end (> 0, a sink) or start (< 0, a source) here
};

// Chooses the sites of all components. given: sites with their numbers of flow lines. A number of 0 is chosen here,
// otherwise each component needs both signs. automatic: given sites are only proposals. Those near borders are skipped,
// and components with handles get at least four sites. Apexes, the vertices that close borders, are always sites.
// Throws HF_ERROR_INVALID_ARGUMENT when given numbers cannot balance, and HF_ERROR_TOO_LARGE beyond most_sites sites
// and borders.
Vector<FluxSite> choose_flux_sites(const FluxSurface& surface, Span<const FluxSite> given, bool automatic,
                                   double edge_length, Memory& memory);

// Factors the matrix of the flux problem, and solves fields from it.
class FluxSolver {
 public:
  // Orders and factorises the matrix of the flow field. Throws the errors of Factor::make.
  FluxSolver(const FluxSurface& surface, Memory& memory, JobRunner& jobs);
  // Returns the flow field by vertex of the surface, up to a constant per component. flux_solves steps of iterative
  // refinement make the flow balance at every vertex, as lines need it.
  Vector<double> solve(Span<const FluxSite> sites) const;

 private:
  const FluxSurface* surface_;
  Memory* memory_;
  JobRunner* jobs_;
  std::shared_ptr<const Factor> factor_;
};

// Multiplies the numbers of flow lines of all sites of a component and balances them again (even, at least 4 each).
void scale_lines(const FluxSurface& surface, std::int32_t component, double factor, Vector<FluxSite>& sites);

// Solves the flow field. If flow of other sites crosses a border, it raises the border's own flow. It stops when the
// field is extremal at every apex (vertex that closes a border). If that fails, sources and sinks get fixed values
// (border_flux.h).
Vector<double> solve_with_borders(const FluxSurface& surface, const FluxSolver& solver, Vector<FluxSite>& sites);

}  // namespace hf_inner
