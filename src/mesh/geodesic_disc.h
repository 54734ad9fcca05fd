// Finds the vertices within a geodesic distance of a point of the surface.
//
// The method is fast marching with circular fronts (Kimmel and Sethian 1998; Novotni and Klein 2002). Two vertices with
// known distances give the place of the source in the plane of their triangle. The distance of the third vertex is the
// straight line from there if that line crosses the edge between the two. Otherwise it is the path along an edge. The
// result is exact on surfaces that unfold to a plane, if no hole blocks a straight line. Elsewhere the error falls with
// the square of the edge length. Cost: O(d log d) for d vertices in the disc, independent of the mesh size.
#pragma once
#include <cstdint>

#include "mesh/topology.h"

namespace hf_inner::mesh {

struct DiscVertex {
  std::int32_t vertex;
  double distance;
  bool rim;  // the vertex has a neighbour outside the disc
};

// Returns the vertices within `radius` of a point, sorted by distance. `radius` is in the unit of mesh.positions. The
// point is sum_k weight[k] vertex[k] in one triangle; unused corners are -1. A vertex also counts as inside if it lies
// beyond the radius by a small share of its mean edge length. So a site on the disc has the same effect on coarse and
// fine meshes.
Vector<DiscVertex> geodesic_disc(const Mesh& mesh, const Topology& topology, const std::int32_t vertex[3],
                                 const double weight[3], double radius, Memory& memory);

}  // namespace hf_inner::mesh
