// Reads the options of quad meshes and the counts and seeds of flow lines.
#pragma once
#include "hf/quads.h"
#include "remesh/quads.h"

namespace hf_inner {

// Returns the edge length in box diagonals. Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE.
double read_edge_length(const Mesh& mesh, float given);
// Returns the rounds of relaxation. Throws HF_ERROR_INVALID_ARGUMENT.
std::int32_t read_relax_count(std::uint32_t given);

// Checks the options that every kind of quads has. Throws HF_ERROR_INVALID_ARGUMENT or HF_ERROR_NON_FINITE.
void check_quad_options(const hf_quads_desc& desc);

// check_quad_options has passed. The kind is uniform or pure. sites: receives the sites of the caller; the options
// refer to it. Throws as hf_quads_create says.
QuadOptions read_quad_options(std::shared_ptr<const Core> core, const hf_quads_desc& desc, Vector<FluxSite>& sites);

// Checks the counts and returns the seeds as inner vertices; empty: lines start at the minima. Throws
// HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_RANGE (index = entry).
Vector<std::int32_t> read_seeds(const Mesh& mesh, const hf_flow_lines& lines, Memory& memory);

}  // namespace hf_inner
