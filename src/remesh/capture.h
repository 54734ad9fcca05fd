// Draws a relaxed quad mesh out to the places of the surface it misses: tips, crests, thin ends.
//
// Vertices of the surface farther than capture_tolerance from the quads, the farthest first and none within an edge
// length of another, take the nearest free corner of the nearest face to themselves; it is pinned there and the rest
// relaxed again. A move that would turn a corner over is not made. Cost: O(n log faces) a round.
#pragma once
#include "remesh/quad_distance.h"
#include "remesh/relax.h"

namespace hf_inner {

struct CaptureOptions {
  double edge_length = 0;  // inner units
  Progress* progress = nullptr;
};

// Returns how many vertices were drawn out.
std::int32_t capture_features(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh,
                              const CaptureOptions& options, Memory& memory);

}  // namespace hf_inner
