// How far a quad mesh and the surface it was made from are from each other, and where.
//
// Both ways, sampled: vertices of the surface to the quads (fans of triangles from their first corners), and points of
// these triangles, `spacing` apart, to the surface. Of large surfaces some 60,000 vertices are looked at; of those of
// up to 30,000 triangles points on the larger triangles, too. Points are taken in the order of a tree of boxes, so that
// the triangle found last is mostly near enough for the next: O(1) a point but where something is missed, O(log) there.
// Work is cut into fixed pieces over the threads that are granted; the result does not depend on their number.
#pragma once
#include <unordered_set>

#include "base/jobs.h"
#include "base/progress.h"
#include "remesh/nearest.h"
#include "remesh/quad_mesh.h"

namespace hf_inner {

struct QuadMiss {
  static constexpr std::int32_t of_surface = -1, of_quads = -2;
  double distance;
  Vec3 point;
  std::int32_t vertex;  // of the surface; or what the point is of
  std::int32_t face;    // of the quads: the nearest, or its own
};

// Faces known to keep within one tolerance of the surface, by a hash of where their corners are, in their order: what a
// step did not move is not measured again. Two faces of one hash (about one in 10^7 pairs of runs) would be taken for
// one another until the mesh is measured as a whole.
struct NearFaces {
  explicit NearFaces(Memory& memory) : keys(&memory) {}
  static std::uint64_t key(const QuadMesh& mesh, std::int32_t f) noexcept;
  bool has(const QuadMesh& mesh, std::int32_t f) const { return keys.count(key(mesh, f)) != 0; }
  std::pmr::unordered_set<std::uint64_t> keys;
};

class QuadDistance {
 public:
  // spacing: of the points on triangles, inner units.
  QuadDistance(const FluxSurface& surface, double spacing, Memory& memory, JobRunner* jobs = nullptr);
  // Lets every quad begin at its reflex corner, or where the diagonal keeps nearer to the surface: most programs draw
  // quads as fans. known: NULL, or faces that stay as they are.
  void turn_quads(QuadMesh& mesh, const NearFaces* known = nullptr) const;
  // The largest distance found. out_misses: NULL, or the places farther than `tolerance`, the farthest first; then
  // distances below `tolerance` are not told apart, and without a miss it is `tolerance` that is returned. known: NULL,
  // or faces found near at this tolerance, which are left out; what is found near now is added.
  double measure(const QuadMesh& mesh, double tolerance, Vector<QuadMiss>* out_misses, Progress* progress,
                 NearFaces* known = nullptr) const;

  // The point of the surface nearest to p.
  SurfacePoint nearest(Vec3 p) const noexcept;

 private:
  struct Sample {
    Vec3 point;
    std::int32_t vertex, face;  // as in QuadMiss; face and hint of samples of the quads only
    std::int32_t hint;          // a triangle of the surface near it
  };
  void sample_surface();
  Table<Sample> sample_quads(const QuadMesh& mesh, const Table<std::int32_t>& corners, const Table<std::int32_t>& faces,
                             const NearFaces* known) const;

  const FluxSurface* surface_;
  double spacing_;
  Memory* memory_;
  JobRunner* jobs_;
  Table<std::int32_t> corners_;  // of the surface's real triangles
  NearestTriangle tree_;
  Table<Sample> samples_;  // of the surface, in the order of the tree
};

}  // namespace hf_inner
