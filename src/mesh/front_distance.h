// Computes geodesic distances fast, within about 1 % (docs/geodesics.md).
//
// The method is fast marching with circular fronts (Kimmel and Sethian 1998; Novotni and Klein 2002) on the intrinsic
// Delaunay triangulation (intrinsic.h), whose triangles have no sharp angle between long edges. Two vertices with known
// distances from one source give its place in the plane of their triangle, and so the distance of the third. Where the
// two are nearest to different sources, the distance of each from the other's source is guessed along straight lines. A
// vertex is visited again where a shorter path comes later. Cost: O(n log n), without a factor.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

class FrontDistance {
 public:
  // Makes the triangulation. The mesh lives as long as the object.
  FrontDistance(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs = nullptr);

  // Writes the distance from the nearest of the sources, in the unit of mesh.positions, infinite where none reaches. It
  // is never below the straight line to the nearest source. Reports progress and can be cancelled.
  void distance(Span<const std::int32_t> sources, double* out) const;

 private:
  // A triangle at a vertex, with the other corners a and b.
  struct Corner {
    double to_a, to_b, across;  // lengths of its edges
    std::int32_t a, b;
  };
  class Fronts;
  const Mesh* mesh_;
  Memory* memory_;
  Vector<std::int32_t> start_;  // the corners of vertex v: corner_[start_[v]] to corner_[start_[v + 1] - 1]
  Vector<Corner> corner_;
};

}  // namespace hf_inner::mesh
