// Turns candidates into proposals with disjoint regions. A character says which are pinned and which are whole parts.
//
// A region has the vertices near a place, or a whole head, hand or foot: a dragged head then keeps the shape of its
// skull.
#pragma once
#include "deform/handles.h"
#include "deform/proposal_joints.h"

namespace hf_inner::deform {

// Removes candidates on parts that no joint of the skin moves.
void leave_out_unmoved(RegionSearch& search, const MovedParts& parts, Vector<Candidate>& found);

// Unpins candidates on hands, heads, tails and pieces that hang on them. If legs are known, candidates on the ground
// stay pinned only on legs, and on arms of a body that is not upright. If no candidate would stay pinned, none changes.
void let_free(RegionSearch& search, const MovedParts& parts, Vector<Candidate>& found);

// Gives each head, hand and foot one candidate: the first on it, or a new one. height: of every inner vertex. A foot
// with a vertex at or below `low` is pinned.
void take_parts(RegionSearch& search, MovedParts& parts, Span<const double> height, double low,
                Vector<Candidate>& found);

// Leaves one candidate that is not pinned on each tail, ear, wing, antenna or fin: the nearest to its end.
void leave_one_each(RegionSearch& search, const skeleton::KnownSkeleton& known, MovedParts& parts,
                    Vector<Candidate>& found);

// Chooses at most `limit` proposals, in the order of the candidates. parts: null without a skeleton.
Proposals choose_regions(RegionSearch& search, const Vector<Candidate>& found, MovedParts* parts, std::size_t limit);

}  // namespace hf_inner::deform
