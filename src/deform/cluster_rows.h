// Makes each vertex's row of cluster weights from the level bands at the vertex.
//
// A band has the weight share times B-spline, for the cluster of its patch. The last band belongs to the handle of the
// field. The first band is given to all handles j, each with the weight phi_j / (1 - phi). Small weights are dropped.
// The others are scaled to sum 1, and rounded to multiples of 2^-24. Cost per vertex: the number of its slots and of
// the handles. Pieces of vertices run on several threads. A failed call changes nothing.
#pragma once
#include "deform/band_patches.h"

namespace hf_inner::deform {

// clusters: by piece, the cluster of each of its patches, or -1 for those that were dropped. It fills start, cluster,
// weight and unreached_vertex_count of `out`.
void write_rows(const BandSource& source, const Vector<PieceBands>& pieces,
                const Vector<Span<const std::int32_t>>& clusters, ClusterWeights& out, Memory& memory);

}  // namespace hf_inner::deform
