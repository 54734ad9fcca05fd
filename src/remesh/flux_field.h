// A harmonic field as an exact discrete flow, in which flux lines run.
//
//     f_ij = w_ij (u_j - u_i)     on every edge from the lower to the higher end
//
// is positive (w > 0) and balanced at every vertex that is no site (K u = 0): a flow on the edges. A point of a flux
// line is an edge and an offset in [0, f] from the edge's left side, seen uphill. At a vertex a planar matching that
// keeps the order takes incoming intervals to outgoing ones. Such lines never cross or merge, rise strictly, come back
// when reversed and end at sites only, on any genus. No geometric intersection is computed.
//
// Incoming intervals are contiguous around a regular vertex, and so are outgoing ones: they are matched in order. At a
// saddle the symmetric planar matching is made once and kept. It takes equal amounts from both sides of every boundary
// between incoming and outgoing intervals until none is left.
//
// Values are compared as pairs (u, vertex), so equal values have an order. Cost: O(n log n) to rank, O(degree) for a
// line to pass a vertex.
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
  // The flux of a half-edge that points uphill.
  double flux(std::int32_t h) const noexcept;
  // Changes of direction around a vertex: 0 at an extremum, 2 at a regular vertex, 2 k + 2 at a saddle of index -k.
  std::int32_t sign_changes(std::int32_t v) const noexcept;
  // (outflow - inflow) / (outflow + inflow): rounding error at a vertex that is no site.
  double imbalance(std::int32_t v) const noexcept;

  // The line beyond the head (before the tail) of its edge; half = -1 where it ends, at an extremum.
  FluxPoint up(FluxPoint p) const;
  FluxPoint down(FluxPoint p) const;

  const FluxSurface& surface() const noexcept { return *surface_; }

 private:
  // A run of flux that enters by one edge and leaves by another.
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
