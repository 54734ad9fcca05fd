// Where rings stand on the arcs of a flux field (the formula in rings.h).
#pragma once
#include "remesh/rings.h"

namespace hf_inner {

// Fills out.rings and out.ring_start. Throws HF_ERROR_TOO_LARGE beyond a million rings.
void place_rings(const FluxField& field, const ArcGraph& graph, const RingOptions& options, Memory& memory,
                 RingMesh& out);

}  // namespace hf_inner
