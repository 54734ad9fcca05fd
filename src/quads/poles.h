// Makes guides that hold poles: irregular vertices of quads at places that the caller chooses.
//
// A singularity of the crosses cannot be named, but it can be forced. The guides lie on a ring around the place, and
// their directions make a quarter turn along it. So the crosses inside have an index of 1/4 (three quads meet) or -1/4
// (five quads meet), whatever they are outside. Cost: O(n) per pole to find its place, then its neighbourhood.
#pragma once
#include "quads/field_quads.h"

namespace hf_inner::quads {

// Appends the guides of the poles. radius: of the rings, inner units; an edge of the quads is a good one. A ring is a
// triangle wide at least. Throws HF_ERROR_INVALID_ARGUMENT (index = pole) where the surface has no normal.
void add_pole_guides(const surface::Core& core, Span<const QuadPole> poles, double radius, Vector<QuadGuide>& out);

// Moves irregular vertices to their poles: for each irregular vertex the nearest free vertex of as many quads, if one
// is within pole_reach edges. It stays there when the mesh is evened out. Vertices around it move along. Returns how
// many moved.
std::int32_t hold_poles(const remesh::FluxSurface& surface, Span<const QuadPole> poles, double edge_length,
                        remesh::QuadMesh& mesh, Memory& memory);

}  // namespace hf_inner::quads
