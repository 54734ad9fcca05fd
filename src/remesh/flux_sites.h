// Where the flow of a quad mesh starts and ends, and how much of it: the sites of a Neumann problem.
//
// Every site carries an even number of lines, about the circumference of the geodesic circle of radius 0.1 (of the box
// diagonal) around it over the edge length, at least 4; a border its length over the edge length. Sites are divided into
// sources and sinks so that both sides carry about the same and neighbours differ:
//     |sum+ - sum-| / sum + 1/2 mean over pairs of one sign of exp(-d_ij / mean d)
// is least, by trying all divisions up to 12 sites and by exchange beyond. Then both sides are scaled to one even total
// (largest remainders, in steps of two). A component with too few sites gets points farthest from those it has.
//
// The field solves K u = b, b = +lines at sinks, -lines at sources: u rises from sources to sinks.
// Cost: one Dijkstra over the edges per site, one factorisation.
#pragma once
#include "base/jobs.h"
#include "base/progress.h"
#include "remesh/flux_surface.h"

namespace hf {

struct FluxSite {
  std::int32_t vertex;  // of the surface
  double lines;         // > 0: a sink, < 0: a source
};

// fixed: sites named by the caller (lines 0: chosen here). complete: add points to components that have too few; apexes
// are always sites. Throws HF_ERROR_INVALID_ARGUMENT when given lines cannot balance.
Vector<FluxSite> choose_flux_sites(const FluxSurface& surface, Span<const FluxSite> given, double edge_length,
                                   Memory& memory, Progress* progress);

// u by vertex of the surface, 0 in the mean of a component's sources and sinks only up to a constant.
Vector<double> solve_flux(const FluxSurface& surface, Span<const FluxSite> sites, Memory& memory, JobRunner& jobs);

}  // namespace hf
