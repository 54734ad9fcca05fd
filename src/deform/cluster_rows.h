// Rows of cluster weights from the shares the bands give: per vertex equal clusters joined, small ones dropped, the rest
// scaled to sum 1 and rounded to whole steps of 2^-24. Cost: O(entries), pieces of the vertices at once. On failure
// nothing is left behind.
#pragma once
#include "deform/bands.h"

namespace hf_inner {

struct ClusterEntry {
  std::int32_t vertex, cluster;
  double weight;
};

// entries: one list per piece of the vertices (vertex_piece); those of one vertex are summed in their order. Fills start, cluster, weight and
// unreached_vertex_count of `out`.
void write_rows(const Core& core, const Reach& reach, const HandleFields& fields,
                const Vector<Vector<ClusterEntry>>& entries, ClusterWeights& out, Memory& memory);

}  // namespace hf_inner
