// Reads the line of a knife: its points and its options.
#pragma once
#include "hf/surface.h"
#include "mesh/cut_line.h"

namespace hf_inner::mesh {

// Returns the options with the defaults filled in. Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
// HF_ERROR_INVALID_DESC.
CutOptions read_cut_options(const hf_cut_desc& desc);

// Returns the points of the line. Throws as hf_surface_trace_cut documents.
Vector<CurvePoint> read_cut_points(const hf_cut_desc& desc, const Mesh& mesh, const Topology& topology, Memory& memory);

}  // namespace hf_inner::mesh
