// Makes each vertex's row of cluster weights from the entries (vertex, cluster, weight) of the level bands.
//
// For each vertex it sums the entries of the same cluster, drops small weights, scales the rest to sum 1, and rounds
// them to multiples of 2^-24. Cost: O(entries). Pieces of vertices run on several threads. A failed call changes
// nothing.
#pragma once
#include "deform/bands.h"

namespace hf_inner {

struct ClusterEntry {
  std::int32_t vertex, cluster;
  double weight;
};

// entries: one list of (vertex, cluster, weight) per vertex_piece vertices. Entries of one vertex are summed in their
// order. It fills start, cluster, weight and unreached_vertex_count of `out`.
void write_rows(const Core& core, const Reach& reach, const HandleFields& fields,
                const Vector<Vector<ClusterEntry>>& entries, ClusterWeights& out, Memory& memory);

}  // namespace hf_inner
