// Nested dissection (George 1973) with minimum vertex separators found on a multilevel hierarchy (Hendrickson &
// Rothberg 1998; Ashcraft & Liu 1998) and geometry as the first guess.
//
// A part of more than `direct_size` vertices is coarsened by stars (a free vertex with free neighbours takes its ring)
// down to it and bisected there. The separator is carried back level by level: widened by rings, and replaced by the
// minimum separator in that band. Parts of at most `leaf_size` are ordered by exact minimum degree with their halo. No
// recursion: parts wait on a list. A part that cannot be split (cliques, hubs) is ordered by approximate minimum
// degree. Same order for any number of threads. Cost: O(|A| log n) plus the flows; a few times faster than METIS on
// surface meshes.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "factor/matrix.h"

namespace hf_inner {

void order_by_dissection(const SymmetricMatrix& matrix, Coordinates coordinates, Memory& memory, JobRunner& jobs,
                         Buffer<std::int32_t>& order);

}  // namespace hf_inner
