// Which pieces move with one bone, as the parts of a robot, eyes and buttons do.
//
// A piece that holds three bones bends, and one that holds all bones of a family that any piece holds. A robot is
// made of solid pieces of which hardly any bends, and more than one is large or holds a bone. There every piece gets
// one bone: the bone inside it, or the bone whose joint is in its middle. On creatures only small pieces that hold no
// bone do. A piece without a bone of its own takes one from the pieces that it touches and from its own smooth weights;
// on creatures only where most of both agrees. Other surfaces, such as loose triangles, stay smooth.
#pragma once
#include "weights/solution.h"

namespace hf_inner::weights {

// By piece: the column of the solution whose bone it takes, or -1 where the smooth weights stay.
Vector<Index> rigid_columns(const Solution& solution, const Bones& bones, const Vector<BoneSegment>& segments);

}  // namespace hf_inner::weights
