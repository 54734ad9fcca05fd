// Finds the local maxima of a field with their persistence: how far a path must go down to reach a higher maximum.
//
// Every vertex belongs to the basin of a peak that some ascending edge path leads to. Edges between two basins are
// taken from the highest to the lowest. Each such edge joins its basins, and the lower peak ends there. This is the
// merge tree of the superlevel sets (Edelsbrunner, Letscher and Zomorodian 2002). The choice of the ascending path does
// not matter: a vertex and its peak are edge-connected above the vertex. Vertex numbers break ties. Cost: O(E) for E
// edges, a sort of the edges between basins, and one pass over the vertices for each doubling of the longest ascending
// path.
#pragma once
#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner::field {

struct Peak {
  std::int32_t vertex;  // inner
  std::int32_t saddle;  // where it meets a higher peak; Mesh::none for the highest of its component
};

// Returns every local maximum, by vertex. field: finite, one value per welded vertex.
Vector<Peak> find_peaks(const mesh::Topology& topology, Span<const double> field, Memory& memory);

}  // namespace hf_inner::field
