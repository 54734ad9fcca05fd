// Snaps a relaxed quad mesh to the places of the surface it misses: tips, crests, thin ends.
//
// Each missed vertex of the surface, the farthest first, takes the nearest free corner of its nearest face and pins it.
// Two such vertices are at least an edge length apart. The rest is relaxed again. A move that would turn a corner over
// is left out. Cost: O(n log faces) a round.
#pragma once
#include "remesh/quad_distance.h"
#include "remesh/relax.h"

namespace hf_inner {

struct CaptureOptions {
  double edge_length = 0;  // inner units
};

// Returns how many vertices were snapped.
std::int32_t capture_features(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh,
                              const CaptureOptions& options, Memory& memory);

}  // namespace hf_inner
