// Orders unknowns by nested dissection (George 1973). Minimum vertex separators come from a multilevel hierarchy
// (Hendrickson & Rothberg 1998; Ashcraft & Liu 1998), with geometry as the first guess.
//
// A part with more than `direct_size` vertices is coarsened until it is small enough, and bisected there. One vertex of
// the coarser graph is a star: a vertex together with its neighbours, if none of them belongs to another star. The
// separator is then carried back level by level. On each level it is widened by its neighbours, then by theirs, to a
// band, and replaced by the minimum separator in that band. Parts with at most `leaf_size` vertices are ordered by
// exact minimum degree, together with their neighbours outside. There is no recursion: parts wait on a list. A part
// that cannot be split (cliques, hubs) is ordered by approximate minimum degree. The order is the same for any number
// of threads. Cost: O(|A| log n) for n unknowns and |A| entries, plus the flows. It is a few times faster than METIS on
// surface meshes.
#pragma once
#include <cstdint>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "factor/matrix.h"

namespace hf_inner::factor {

void order_by_dissection(const SymmetricMatrix& matrix, Coordinates coordinates, Memory& memory, JobRunner& jobs,
                         Buffer<std::int32_t>& order);

}  // namespace hf_inner::factor
