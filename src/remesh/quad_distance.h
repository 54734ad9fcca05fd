// Measures the distance of a quad mesh and its surface, and finds where it is large.
//
// Both ways, sampled: vertices of the surface to the quads (fans of triangles from their first corners), and points of
// these triangles, `spacing` apart, to the surface. Large surfaces are sampled at some of their vertices
// (most_samples), small ones also at points of their larger triangles (most_spread). Points follow the order of a tree
// of boxes, so the last triangle found is mostly near enough for the next point. That costs O(1) a point, and O(log)
// where the distance exceeds the tolerance. Work is cut into pieces of fixed size for the threads; the result does not
// depend on their number.
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
  std::int32_t vertex;  // of the surface, or of_surface, of_quads
  std::int32_t face;    // of the quads: the nearest, or the one sampled
};

// Faces known to lie within one tolerance of the surface, by a hash of their corners' positions in order: faces that a
// step did not move are not measured again. If two faces have one hash (about one in 10^7 pairs of runs), the second is
// not measured until the whole mesh is.
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
  // Rotates the corners of every quad: its reflex corner comes first, or else an end of the diagonal nearer to the
  // surface, because most programs draw quads as fans.
  // Parameter known: NULL, or faces that stay unchanged.
  void turn_quads(QuadMesh& mesh, const NearFaces* known = nullptr) const;
  // Returns the largest distance. out_misses: NULL, or receives the places farther than `tolerance`, the farthest
  // first; without a miss the function then returns `tolerance`. Parameter known: NULL, or faces found near at this
  // tolerance; they are left out, and faces found near are added.
  double measure(const QuadMesh& mesh, double tolerance, Vector<QuadMiss>* out_misses, NearFaces* known = nullptr) const;

  // The point of the surface nearest to p.
  SurfacePoint nearest(Vec3 p) const noexcept;

 private:
  struct Sample {
    Vec3 point;
    std::int32_t vertex, face;  // As in QuadMiss; face and hint are set for samples of the quads only.
    std::int32_t hint;          // A triangle of the surface near it.
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
