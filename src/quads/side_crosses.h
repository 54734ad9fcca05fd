// Gives the two sides of a crease crosses of their own, at teeth whose sharp corner turns one side (sharp_corners.h).
//
// A vertex has one cross. On a crease that runs to a sharp corner it would be the mean of the two sides, and wrong on
// both. So every side, from one feature edge of the vertex to the next, has a cross of its own there.
#pragma once
#include "quads/cross_field.h"
#include "quads/sharp_corners.h"

namespace hf_inner::quads {

struct SideCrosses {
  explicit SideCrosses(Memory& memory) : of_corner(memory), turned(&memory), seen(&memory) {}
  // features: by half-edge. hard: of feature_crosses, by ascending vertex; receives a cross for vertices that have
  // sides and no cross yet.
  static SideCrosses find(const remesh::FluxSurface& surface, const field::Connection& connection,
                          const remesh::Table<std::uint8_t>& features, const SharpCorners& corners,
                          Vector<HardCross>& hard, Memory& memory);

  // By half-edge: the cross of its side at its tail, in the frame of the vertex; 0 where the vertex has one cross.
  // Empty if no corner is sharp.
  remesh::Table<std::complex<double>> of_corner;
  Vector<std::int32_t> turned;  // vertices of the mesh that have sides
  Vector<SeenCross> seen;       // by neighbour of these vertices
};

// Sets the wish to 0 within `far` of these vertices, along edges. The wish there is the curvature of the crease, evened
// out. It would turn crosses back along the crease.
void leave_out_near(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const std::int32_t> vertices,
                    double far, Vector<std::complex<double>>& wish);
// Parts the four quarter turns of a round patch. Without a wish, the crosses of the patch cancel out in its middle, and
// the turns gather there: at one vertex, which would get no quad, or within an edge. So where crosses cancel out around
// more than two turns, all hold one direction. Adds these crosses to `hard`; returns whether there are any. wish,
// crosses: by vertex of the mesh. index: of FaceCross.
bool part_turns(const remesh::FluxSurface& surface, const mesh::Topology& topology, const field::Connection& connection,
                Span<const std::complex<double>> wish, Span<const std::complex<double>> crosses,
                const remesh::Table<std::int32_t>& index, Vector<HardCross>& hard, Memory& memory);

}  // namespace hf_inner::quads
