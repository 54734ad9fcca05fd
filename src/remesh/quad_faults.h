// Faults of quads near a place: corners that face away from the normal of their quad, and quads that run through
// others.
//
// A corner is turned over if it faces away from the sum of the cross products of the quad's corners. A quad is the two
// triangles on both sides of its first diagonal. Two quads cross if an edge of a triangle of one passes through a
// triangle of the other. Quads that share a vertex do not count. Cost: O(faces), and O(k^2) for the k quads near the
// place.
#pragma once
#include "remesh/quad_mesh.h"

namespace hf_inner::remesh {

struct QuadFaults {
  std::int32_t turned = 0;    // corners
  std::int32_t crossing = 0;  // pairs of triangles
};

// Counts the faults of quads with a corner within `radius` of `place`.
QuadFaults faults_near(const QuadMesh& mesh, const Vec3& place, double radius, Memory& memory);

}  // namespace hf_inner::remesh
