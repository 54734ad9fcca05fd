// Local maxima of a field with their persistence: how far one must go down to reach a higher one.
//
// Every vertex belongs to a peak that some ascent over the edges leads to. Edges between the basins of two peaks, taken
// from the highest down, join them; the lower peak ends there (the merge tree of the superlevel sets; Edelsbrunner,
// Letscher and Zomorodian 2002). The choice of ascent does not matter: a vertex and its peak are edge-connected above
// the vertex. Vertex numbers break ties.
// Cost: O(E), a pass over the vertices for each doubling of the longest way up, and a sort of the edges between basins.
#pragma once
#include "base/span.h"
#include "mesh/topology.h"

namespace hf_inner {

struct Peak {
  std::int32_t vertex;  // inner
  std::int32_t saddle;  // where it meets a higher peak; Mesh::none for the highest of its component
};

// Every local maximum, by vertex. field: finite, one value per inner vertex.
Vector<Peak> find_peaks(const Topology& topology, Span<const double> field, Memory& memory);

}  // namespace hf_inner
