// Draws a relaxed quad mesh out to the places of the surface it misses: tips, crests, thin ends.
//
// The distance of every surface vertex to the quads (two triangles each) comes from a tree of boxes. Vertices farther
// than `tolerance`, the farthest first and none within an edge length of another, take the nearest free corner of the
// nearest face to themselves; it is pinned there and the rest relaxed again. A move that would turn a corner over is
// not made. Cost: O(n log faces) a round.
#pragma once
#include "remesh/nearest.h"
#include "remesh/relax.h"

namespace hf {

// How far a quad mesh and the surface are from each other, sampled: surface vertices to the quads; face centres and
// edge middles of the quads to the surface.
class QuadDistance {
 public:
  QuadDistance(const FluxSurface& surface, Memory& memory);
  double largest(const QuadMesh& mesh) const;

 private:
  const FluxSurface* surface_;
  Memory* memory_;
  Table<std::int32_t> corners_;  // of the surface's real triangles
  NearestTriangle tree_;
};

struct CaptureOptions {
  double edge_length = 0.02, tolerance = 0.006;  // inner units
  std::int32_t rounds = 5, relax_rounds = 8;
};

// Returns how many vertices were drawn out.
std::int32_t capture_features(const FluxSurface& surface, QuadMesh& mesh, const CaptureOptions& options,
                              Memory& memory);

}  // namespace hf
