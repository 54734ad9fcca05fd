// Flow lines of a field as curves for display and guidance: the co-gradient family beside the iso-lines of field/.
//
// Lines run in the flux of clamped cotangent weights (flux_field.h): they never cross, rise all the way, and end at
// extrema. Of a harmonic field with the clamped operator the flux is balanced, and lines stand as dense as the field is
// steep; of any other field a vertex hands on what comes in scaled to what goes out, and everything else stays true.
//
// A line gives one point per edge it runs in, at the middle of the edge's values: on the iso-line there, at the line's
// share of the edge between the middles of the iso-line's two segments.
//
// The surface is prepared once; a trace costs the ranks, O(n log n), and O(degree) per edge a line runs in.
#pragma once
#include "engine/core.h"
#include "remesh/flux_field.h"

namespace hf_inner {

struct FlowLineSet {
  explicit FlowLineSet(Memory& memory) : point(&memory), value(&memory), start(&memory), from(&memory), to(&memory) {}
  Vector<Vec3> point;  // inner units
  Vector<double> value;
  Vector<std::uint32_t> start;    // by line, and the end
  Vector<std::int32_t> from, to;  // by line, inner vertices: its lower and upper end
};

class FlowTracer {
 public:
  explicit FlowTracer(std::shared_ptr<const Core> core);
  const Core& core() const noexcept { return *core_; }
  const FluxSurface& surface() const noexcept { return surface_; }

  // line_count lines from the minima, each standing for the same flux; with seeds one line through every seed vertex
  // instead, along the edge of the largest flux. u: by inner vertex, finite where a line can come.
  FlowLineSet trace(Span<const double> u, std::uint32_t line_count, Span<const std::int32_t> seeds) const;

 private:
  void follow(const FluxField& field, FluxPoint p, bool upward, FlowLineSet& out, std::int32_t& end) const;
  Vec3 place(const FluxField& field, FluxPoint p) const noexcept;

  std::shared_ptr<const Core> core_;
  FluxSurface surface_;
  Table<std::int32_t> fan_;  // by inner vertex, its first vertex of the surface
};

}  // namespace hf_inner
