// The vertices within a geodesic distance of a point of the surface.
//
// Fast marching with circular fronts (Kimmel and Sethian 1998, the unfolded source of Novotni and Klein 2002). Two
// vertices at known distances place the source in the unfolded plane of their triangle. The third vertex is as far as
// the straight line to it where that line crosses the edge, else as the path along an edge. Exact for one source on
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
// by distance. A vertex counts as inside up to a share of its mean edge beyond the radius. The condition u = s on
// the vertices then acts alike on coarse and fine meshes.
Vector<DiscVertex> geodesic_disc(const Mesh& mesh, const Topology& topology, const std::int32_t vertex[3],
                                 const double weight[3], double radius, Memory& memory);

}  // namespace hf_inner
