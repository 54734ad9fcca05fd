// Reads the options of quad meshes and the counts and seeds of flow lines.
#pragma once
#include "hf/quads.h"
#include "remesh/quads.h"

namespace hf_inner {

// sites: receives the sites of the caller; the options refer to it. Throws as hf_quads_create says.
QuadOptions read_quad_options(std::shared_ptr<const Core> core, const hf_quads_desc& desc, Vector<FluxSite>& sites);

// Checks the counts and returns the seeds as inner vertices; empty: lines start at the minima. Throws
// HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_RANGE (index = entry).
Vector<std::int32_t> read_seeds(const Mesh& mesh, const hf_flow_lines& lines, Memory& memory);

}  // namespace hf_inner
