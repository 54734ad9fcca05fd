// The vertices within a geodesic distance of a point of the surface.
//
// Fast marching with circular fronts: two vertices at known distances place the source in the unfolded plane of their
// triangle, and the third vertex is as far as the straight line to it, when that line crosses the edge, else as the way
// along an edge (Kimmel and Sethian 1998 with the unfolded source of Novotni and Klein 2002). Exact for one source on
// surfaces that unfold to a plane without holes in sight; elsewhere of second order. Cost: O(d log d) for d vertices in
// the disc, independent of the mesh.
#pragma once
#include <cstdint>

#include "mesh/topology.h"

namespace hf_inner {

struct DiscVertex {
  std::int32_t vertex;
  double distance;
  bool rim;  // has a neighbour outside the disc
};

// Vertices within `radius` (in inner units) of the point sum_k weight[k] vertex[k] of one triangle (unused corners -1),
// by distance. A vertex counts as inside up to 0.3 of its mean edge beyond the radius: the condition u = s on a set of
// vertices acts as one on a disc that ends about there, so discs of one radius act alike on coarse and fine meshes.
Vector<DiscVertex> geodesic_disc(const Mesh& mesh, const Topology& topology, const std::int32_t vertex[3],
                                 const double weight[3], double radius, Memory& memory);

}  // namespace hf_inner
