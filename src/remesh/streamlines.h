// Traces the streamlines of a field as curves for display and guidance. The folder field/ has iso-lines.
//
// Lines follow the flux of clamped cotangent weights (flux_field.h): they never cross, always rise, and end at extrema.
// In a harmonic field of the clamped operator the flux is balanced, and lines are dense where the field is steep. In
// any other field each vertex scales its inflow to its outflow; the other properties hold as well.
//
// A line has one point per edge that it runs along. The point lies on the iso-line through the mean of the edge's two
// values. The line's share of the edge's flux places it between the middles of the two segments of that iso-line.
//
// The surface is prepared once. A trace costs O(n log n) to sort n vertices, and O(degree) per edge that a line runs
// along.
#pragma once
#include "remesh/flux_field.h"
#include "surface/core.h"

namespace hf_inner::remesh {

struct StreamlineSet {
  explicit StreamlineSet(Memory& memory) : point(&memory), value(&memory), start(&memory), from(&memory), to(&memory) {}
  Vector<Vec3> point;  // inner units
  Vector<double> value;
  Vector<std::uint32_t> start;    // by line, and the end of the last line
  Vector<std::int32_t> from, to;  // by line: inner vertices at its lower and upper end
};

class FlowTracer {
 public:
  explicit FlowTracer(std::shared_ptr<const surface::Core> core);
  const surface::Core& core() const noexcept { return *core_; }
  const FluxSurface& surface() const noexcept { return surface_; }

  // Traces line_count lines from the minima, each for the same flux. With seeds it traces one line through every seed
  // vertex instead, along the edge with the largest flux there. u: by inner vertex, finite wherever a line can run.
  // Throws HF_ERROR_TOO_LARGE for 2^32 points or more.
  StreamlineSet trace(Span<const double> u, std::uint32_t line_count, Span<const std::int32_t> seeds) const;

 private:
  void follow(const FluxField& field, FluxPoint p, bool upward, StreamlineSet& out, std::int32_t& end) const;
  Vec3 place(const FluxField& field, FluxPoint p) const noexcept;

  std::shared_ptr<const surface::Core> core_;
  FluxSurface surface_;
  Table<std::int32_t> fan_;  // by inner vertex: its first copy in surface_ (one copy per fan of triangles)
};

}  // namespace hf_inner::remesh
