// Snaps a relaxed quad mesh to places of the surface that it misses: tips, crests, thin ends.
//
// A miss is a surface vertex too far from the quads. The farthest comes first. The nearest free corner of its nearest
// face moves to it and is pinned there. Two snapped vertices are at least an edge length apart. The vertices around
// them are relaxed again. A move that would turn a corner over is not made. Cost: O(n log faces) per round for n
// surface vertices.
#pragma once
#include "remesh/quad_distance.h"
#include "remesh/relax.h"

namespace hf_inner {

struct CaptureOptions {
  double edge_length = 0;  // inner units
};

// Snaps vertices of the quad mesh to places of the surface that it misses. Returns how many vertices it snapped.
std::int32_t capture_features(const FluxSurface& surface, const QuadDistance& distance, QuadMesh& mesh,
                              const CaptureOptions& options, Memory& memory);

}  // namespace hf_inner
