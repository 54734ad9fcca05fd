// Places rings of nodes on the level loops of a flux field, evenly spaced (formula in rings.h).
#pragma once
#include "remesh/rings.h"

namespace hf_inner {

// Places the rings of nodes: fills out.rings and out.ring_start. Throws HF_ERROR_TOO_LARGE beyond most_rings.
void place_rings(const FluxField& field, const ArcGraph& graph, const RingOptions& options, Memory& memory,
                 RingMesh& out);

}  // namespace hf_inner
