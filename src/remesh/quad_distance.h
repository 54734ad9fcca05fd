// Measures the distance between a quad mesh and its surface, and finds where it is large.
//
// The distance is sampled both ways. Vertices of the surface are measured to the quads (as fans of triangles from their
// first corners). Points on these triangles, `spacing` apart, are measured to the surface. Large surfaces are sampled
// at some of their vertices (most_samples), small ones also at points in their larger triangles (most_spread). The
// samples follow the order of a tree of boxes, so the last triangle found is mostly near enough for the next sample. A
// sample then costs O(1), and O(log n) where the distance exceeds the tolerance. The work is split into jobs of fixed
// size, so the result does not depend on the number of threads.
#pragma once
#include <unordered_set>

#include "base/jobs.h"
#include "base/progress.h"
#include "mesh/nearest_triangle.h"
#include "remesh/quad_mesh.h"

namespace hf_inner::remesh {

struct QuadMiss {
  static constexpr std::int32_t of_surface = -1, of_quads = -2;
  double distance;
  Vec3 point;
  std::int32_t vertex;  // sampled vertex of the surface, or of_surface or of_quads (a point inside a triangle)
  std::int32_t face;    // face of the quad mesh: the nearest one, or the sampled one
};

// Faces (quads) known to lie within one tolerance of the surface, as hashes of their corners' positions. Faces that a
// fitting step did not move are not measured again. If two faces have the same hash, which is very unlikely, the second
// is only measured together with the whole mesh.
struct NearFaces {
  explicit NearFaces(Memory& memory) : keys(&memory) {}
  static std::uint64_t key(const QuadMesh& mesh, std::int32_t f) noexcept;
  bool has(const QuadMesh& mesh, std::int32_t f) const { return keys.count(key(mesh, f)) != 0; }
  std::pmr::unordered_set<std::uint64_t> keys;
};

class QuadDistance {
 public:
  // spacing: distance between the points on triangles, in inner units.
  QuadDistance(const FluxSurface& surface, double spacing, Memory& memory, JobRunner* jobs = nullptr);
  // Rotates the corners of every quad, because most programs draw quads as fans from the first corner. The reflex
  // corner comes first. Without one, an end of the diagonal nearer to the surface comes first. known: NULL, or faces
  // that stay unchanged.
  void turn_quads(QuadMesh& mesh, const NearFaces* known = nullptr) const;
  // Returns the largest distance. out_misses: NULL, or receives the places farther than `tolerance`, the farthest
  // first; without a miss the function then returns `tolerance`. Parameter known: NULL, or faces found near at this
  // tolerance; they are left out, and faces found near are added.
  double measure(const QuadMesh& mesh, double tolerance, Vector<QuadMiss>* out_misses,
                 NearFaces* known = nullptr) const;

  // Returns the point of the surface nearest to p.
  SurfacePoint nearest(Vec3 p) const noexcept;

 private:
  struct Sample {
    Vec3 point;
    std::int32_t vertex, face;  // as in QuadMiss; only samples of the quads have face and hint.
    std::int32_t hint;          // a triangle of the surface near the sample.
  };
  void sample_surface();
  Table<Sample> sample_quads(const QuadMesh& mesh, const Table<std::int32_t>& corners, const Table<std::int32_t>& faces,
                             const NearFaces* known) const;

  const FluxSurface* surface_;
  double spacing_;
  Memory* memory_;
  JobRunner* jobs_;
  Table<std::int32_t> corners_;  // corners of the surface's triangles
  mesh::NearestTriangle tree_;
  Table<Sample> samples_;  // points of the surface, in the order of the search tree
};

}  // namespace hf_inner::remesh
