// Finds the first triangle that a ray hits, and the vertex nearest to a point.
#pragma once
#include "hf/surface.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// The surface to search. `posed` has one row per vertex of the caller; if it is empty, the surface is at rest. Both
// searches pass over the whole surface on the threads of `jobs`. The result does not depend on the number of threads.
struct PickTarget {
  const Mesh& mesh;
  ConstRows posed;
  bool front_only = false;
};

// Returns what a pick searches. Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_INVALID_DESC or HF_ERROR_TOO_SMALL.
PickTarget read_target(const Mesh& mesh, const hf_pick_desc& desc);
// Returns the direction of a ray. Throws HF_ERROR_NULL_POINTER, HF_ERROR_NON_FINITE or HF_ERROR_INVALID_ARGUMENT (0).
Vec3 read_direction(const double* direction);

struct RayHit {
  std::uint32_t triangle = HF_NO_INDEX;                           // or face, of the caller
  std::int32_t corner[3] = {Mesh::none, Mesh::none, Mesh::none};  // inner: what `weight` belongs to
  std::int32_t vertex = Mesh::none;                               // its corner nearest to the hit, inner
  double weight[3] = {0, 0, 0};
  Vec3 position;  // in the caller's unit
  double distance = 0;
};

// Returns the first triangle on a ray, or HF_NO_INDEX if the ray hits none. Both triangles of an edge compute the same
// numbers for it, so no ray slips between them (Woop, Benthin and Wald 2013). direction: not zero. Throws
// HF_ERROR_NON_FINITE (index = vertex of the caller) if a posed position is not finite.
RayHit cast_ray(const PickTarget& target, Vec3 origin, Vec3 direction, JobRunner& jobs, Memory& memory);

struct NearestVertex {
  std::int32_t vertex = Mesh::none;  // inner
  double distance = 0;               // in the caller's unit
};

// Returns the vertex nearest to `point`. Throws as cast_ray does, and HF_ERROR_TOO_LARGE where all vertices are farther
// than farthest_pose (places.h).
NearestVertex nearest_vertex(const PickTarget& target, Vec3 point, JobRunner& jobs, Memory& memory);

}  // namespace hf_inner::mesh
