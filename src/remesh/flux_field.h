// A harmonic field as an exact discrete flow: what flux lines run in.
//
//     f_ij = w_ij (u_j - u_i)     on every edge from the lower to the higher end
//
// is positive (w > 0) and balanced at every vertex that is no site (K u = 0): a flow on the edges. A flux line is an
// edge with an offset in [0, f] from its left side, seen uphill; it passes a vertex by a planar, order-keeping matching
// of the intervals that come in to those that leave. Lines so made never cross and never merge, rise strictly, come
// back when reversed and end at sites only, on surfaces of any genus, and no geometric intersection is ever computed.
//
// At a regular vertex incoming and outgoing intervals each stand together around it and are matched in order. At a
// saddle equal amounts are taken from both sides of every boundary between incoming and outgoing intervals at once,
// until nothing is left: the symmetric planar matching, made once and kept.
//
// Values are compared as pairs (u, vertex), so that equal ones are told apart. Cost: O(n log n) to rank, O(degree) for
// a line to pass a vertex.
#pragma once
#include "base/span.h"
#include "remesh/flux_surface.h"

namespace hf_inner {

// A place on a flux line: the half-edge that points uphill, and the offset of the line in its flux.
struct FluxPoint {
  std::int32_t half = -1;
  double offset = 0;
};

class FluxField {
 public:
  // u by vertex of the surface, finite.
  FluxField(const FluxSurface& surface, Span<const double> u, Memory& memory);

  double value(std::int32_t v) const noexcept { return u_[v]; }
  std::int32_t rank(std::int32_t v) const noexcept { return rank_[v]; }
  std::int32_t by_rank(std::int32_t r) const noexcept { return order_[r]; }
  bool rises(std::int32_t h) const noexcept { return rank_[surface_->tail[h]] < rank_[surface_->head(h)]; }
  // Of a half-edge that points uphill.
  double flux(std::int32_t h) const noexcept;
  // Changes of direction around a vertex: 0 at an extremum, 2 at a regular vertex, 2 k + 2 at a saddle of index -k.
  std::int32_t sign_changes(std::int32_t v) const noexcept;
  // Fluxes out less fluxes in, over their sum; of the flow at a vertex that is no site it is rounding.
  double imbalance(std::int32_t v) const noexcept;

  // The line beyond the head (before the tail) of its edge; half = -1 where it ends, at an extremum.
  FluxPoint up(FluxPoint p) const;
  FluxPoint down(FluxPoint p) const;

  const FluxSurface& surface() const noexcept { return *surface_; }

 private:
  // A run of flux that comes in by one edge and leaves by another; scale: out per in.
  struct Match {
    std::int32_t vertex, in, out;
    double in_offset, out_offset, length;  // in the units of the inflow
  };
  void match(std::int32_t v);
  FluxPoint through_saddle(std::int32_t v, FluxPoint p, bool upward) const;

  const FluxSurface* surface_;
  Memory* memory_;
  Table<double> u_;
  Table<std::int32_t> rank_, order_;
  Vector<Match> matches_;            // by vertex
  Table<std::int32_t> match_start_;  // by number of the saddle
  Table<std::int32_t> saddle_of_;    // by vertex, -1 for regular ones; empty when there is none
  Table<double> saddle_scale_;       // out per in
};

}  // namespace hf_inner
