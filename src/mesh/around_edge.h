// Puts the triangles of an edge in order around it.
#pragma once
#include "base/index.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

// A side of a triangle on an edge of three triangles and more.
struct EdgeSide {
  Index side;                    // its number in the topology
  Index apex;                    // the vertex opposite
  double angle, along, squared;  // of the apex about the edge and along it, and its squared distance from the edge
};

// Fills `sides` with the sides of an edge, sorted by their angle, counter-clockwise for a viewer at whom the edge
// points. The circle begins behind its widest gap. It depends on positions, and on numbers of vertices where positions
// are equal; it does not depend on the order of the triangles. Triangles at one angle lie on one another, and rounding
// must not decide which comes first: that with the lower apex, along the edge in one of its directions.
void sort_around_edge(const Mesh& mesh, const Topology& topology, Index edge, Vector<EdgeSide>& sides);

}  // namespace hf_inner::mesh
