// What a ray hits first, and which vertex is nearest to a point.
#pragma once
#include "mesh/mesh.h"

namespace hf_inner {

// Where the surface stands: rows by vertex as given, or, empty, at rest. Both searches pass over the whole surface, on
// the threads of `jobs`; the result does not depend on their number.
struct PickTarget {
  const Mesh& mesh;
  ConstRows posed;
  bool front_only = false;
};

struct RayHit {
  std::uint32_t triangle = HF_NO_INDEX;  // as given
  std::int32_t vertex = Mesh::none;      // its corner nearest to the hit, inner
  double weight[3] = {0, 0, 0};
  Vec3 position;  // in the caller's unit
  double distance = 0;
};

// The first triangle on a ray; triangle HF_NO_INDEX for none. Edges are tested with the same numbers from both sides,
// so no ray slips between two triangles (Woop, Benthin and Wald 2013). direction: not zero. Throws HF_ERROR_NON_FINITE
// (index = given vertex) for a posed position.
RayHit cast_ray(const PickTarget& target, Vec3 origin, Vec3 direction, JobRunner& jobs, Memory& memory);

struct NearestVertex {
  std::int32_t vertex = Mesh::none;  // inner
  double distance = 0;               // in the caller's unit
};

// Throws as cast_ray.
NearestVertex nearest_vertex(const PickTarget& target, Vec3 point, JobRunner& jobs, Memory& memory);

}  // namespace hf_inner
