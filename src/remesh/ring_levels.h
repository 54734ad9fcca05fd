// Places rings on the arcs of a flux field by the formula in rings.h.
#pragma once
#include "remesh/rings.h"

namespace hf_inner {

// Fills out.rings and out.ring_start. Throws HF_ERROR_TOO_LARGE beyond most_rings.
void place_rings(const FluxField& field, const ArcGraph& graph, const RingOptions& options, Memory& memory,
                 RingMesh& out);

}  // namespace hf_inner
