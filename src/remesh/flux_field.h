// A field as an exact discrete flow, along which flux lines run.
//
//     f_ij = w_ij (u_j - u_i)     on every edge from the lower end i to the higher end j
//
// The flow f is positive, because the weights w are. In a harmonic field it is balanced at every vertex that is no site
// (K u = 0). A point of a flux line is an edge and an offset in [0, f] from the edge's left side, seen uphill. At a
// vertex, a planar matching that keeps the order maps incoming intervals to outgoing ones. Such lines never cross or
// merge, and they rise strictly. Reversed, they run back the same way. They end only at extrema, on any genus. No
// geometric intersection is computed.
//
// Around a regular vertex the incoming intervals are contiguous, and so are the outgoing ones, so they are matched in
// order. At a saddle a symmetric planar matching is made once and kept. From both sides of every boundary between
// incoming and outgoing intervals it takes equal amounts, until none is left.
//
// Values are compared as pairs (u, vertex), so equal values have an order too. Cost: O(n log n) to rank n vertices, and
// O(degree) for a line to pass a vertex.
#pragma once
#include "base/span.h"
#include "remesh/flux_surface.h"

namespace hf_inner::remesh {

// A place on a flux line: the half-edge that points uphill, and the offset of the line within its flux.
struct FluxPoint {
  std::int32_t half = -1;
  double offset = 0;
};

class FluxField {
 public:
  // u: finite values by vertex of the surface.
  FluxField(const FluxSurface& surface, Span<const double> u, Memory& memory);

  double value(std::int32_t v) const noexcept { return u_[v]; }
  bool rises(std::int32_t h) const noexcept { return rank_[surface_->tail[h]] < rank_[surface_->head(h)]; }
  // Returns the flux of a half-edge that points uphill.
  double flux(std::int32_t h) const noexcept;
  // Returns how often edges around a vertex change between rising and falling: 0 at an extremum, 2 at a regular vertex,
  // 2 k + 2 at a saddle of index -k.
  std::int32_t sign_changes(std::int32_t v) const noexcept;

  // Return the next point of the flux line, beyond the head of its edge or before its tail. FluxPoint::half is -1 where
  // the line ends at an extremum.
  FluxPoint up(FluxPoint p) const;
  FluxPoint down(FluxPoint p) const;

  const FluxSurface& surface() const noexcept { return *surface_; }

 private:
  // A piece of flux that enters a vertex by one edge and leaves it by another.
  struct Match {
    std::int32_t vertex, in, out;
    double in_offset, out_offset, length;  // in units of the inflow
  };
  void match(std::int32_t v);
  FluxPoint through_saddle(std::int32_t v, FluxPoint p, bool upward) const;

  const FluxSurface* surface_;
  Memory* memory_;
  Table<double> u_;
  Table<std::int32_t> rank_;         // by vertex: its place in the order of values
  Vector<Match> matches_;            // matches of incoming with outgoing flux, saddle by saddle
  Table<std::int32_t> match_start_;  // by number of the saddle
  Table<std::int32_t> saddle_of_;    // by vertex: number of the saddle, -1 at regular vertices
  Table<double> saddle_scale_;       // by saddle: outflow over inflow
};

}  // namespace hf_inner::remesh
