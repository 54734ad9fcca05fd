// Turns the line of a knife into a patch: triangles that go, new vertices and new triangles, parted along the line.
//
// Each triangle that the line touches is divided along it (triangle_division.h). The divided triangles around each
// point of the line are parted (vertex_fan.h); parts get copies of the point. So the line opens where it has triangles
// on both sides, and its ends inside the surface stay closed.
#pragma once
#include "mesh/cut_line.h"
#include "mesh/places.h"

namespace hf_inner::mesh {

// All numbers are the caller's. The arrays fit hf_patch_desc.
struct TracedCut {
  explicit TracedCut(Memory& memory)
      : removed(&memory), vertices(&memory), triangles(&memory), sources(&memory), weights(&memory), rims(&memory) {}
  Vector<std::uint32_t> removed;    // triangles, ascending
  Vector<SurfacePlace> vertices;    // where the new vertices lie; inner corners
  Vector<std::uint32_t> triangles;  // three vertices each
  Vector<std::uint32_t> sources;    // by new triangle: the removed one that it is a part of
  Vector<double> weights;           // by corner of a new triangle: its barycentric coordinates in that one
  Vector<std::uint32_t> rims;       // along the line: the vertices on its left and on its right
};

// points: as in cut_line. Throws what cut_line throws, HF_ERROR_CONFLICT for a line that crosses or touches itself
// (index = the given point before), HF_ERROR_EMPTY if nothing is parted, HF_ERROR_UNSUPPORTED where triangles lie on
// each other (index = triangle).
TracedCut trace_cut(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points,
                    const CutOptions& options, Memory& memory);

}  // namespace hf_inner::mesh
