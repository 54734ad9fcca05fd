// Which islands move with one bone, as the parts of a robot, eyes and buttons do.
//
// A robot has no island that bends: none holds three bones. There every island takes one bone: the one that it holds,
// or the one whose joint is in its middle. On other surfaces only small islands that hold no bone do. An island without
// a bone of its own takes one from the islands that it touches and from its own smooth weights.
#pragma once
#include "weights/solution.h"

namespace hf_inner {

// By island: the column of the solution whose bone it takes, or -1 where the smooth weights stay.
Vector<Index> rigid_columns(const Solution& solution, const Vector<BoneSegment>& segments);

}  // namespace hf_inner
