// How far a quad mesh and the surface it was made from are from each other, and where.
//
// Both ways, sampled: vertices of the surface to the quads (fans of triangles from their first corners), and points of
// these triangles, `spacing` apart, to the surface. Cost: O((n + points) log) through trees of boxes. Of large surfaces
// some 60,000 vertices are looked at; of those of up to 30,000 triangles points on the larger triangles, too.
#pragma once
#include "base/progress.h"
#include "remesh/nearest.h"
#include "remesh/quad_mesh.h"

namespace hf {

struct QuadMiss {
  static constexpr std::int32_t of_surface = -1, of_quads = -2;
  double distance;
  Vec3 point;
  std::int32_t vertex;  // of the surface; or what the point is of
  std::int32_t face;    // of the quads: the nearest, or its own
};

class QuadDistance {
 public:
  // spacing: of the points on triangles, inner units.
  QuadDistance(const FluxSurface& surface, double spacing, Memory& memory);
  // Lets every quad begin at its reflex corner, or where the diagonal keeps nearer to the surface: most programs draw
  // quads as fans.
  void turn_quads(QuadMesh& mesh) const;
  // The largest distance found. out_misses: NULL, or the places farther than `tolerance`, the farthest first.
  double measure(const QuadMesh& mesh, double tolerance, Vector<QuadMiss>* out_misses, Progress* progress) const;

 private:
  const FluxSurface* surface_;
  double spacing_;
  Memory* memory_;
  Table<std::int32_t> corners_;  // of the surface's real triangles
  NearestTriangle tree_;
};

}  // namespace hf
