// Reads the counts and seeds of streamlines.
#pragma once
#include "hf/quads.h"
#include "mesh/mesh.h"

namespace hf_inner::remesh {

// Checks the counts and returns the seeds as inner vertices; empty: lines start at the minima. Throws
// HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_RANGE (index = entry).
Vector<std::int32_t> read_seeds(const mesh::Mesh& mesh, const hf_streamlines& lines, Memory& memory);

}  // namespace hf_inner::remesh
