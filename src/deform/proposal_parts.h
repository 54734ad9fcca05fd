// Turns candidates into proposals with disjoint regions, and lets a character say what holds and what is one part.
//
// A region is what is near a place, or a whole head, hand or foot. A dragged head then keeps the shape of its skull.
#pragma once
#include "deform/handles.h"
#include "deform/proposal_joints.h"

namespace hf_inner {

// Takes out candidates on parts that no joint of the skin moves.
void leave_out_unmoved(RegionSearch& search, const MovedParts& parts, Vector<Candidate>& found);

// Candidates on hands, heads and tails, and on what hangs on them, do not hold. Where legs are known, nothing else
// stands on the ground. If nothing else holds, all stay as they are.
void let_free(RegionSearch& search, const MovedParts& parts, Vector<Candidate>& found);

// Gives each head, hand and foot one candidate: the first on it, or a new one. height: of every vertex. A foot below
// `low` holds.
void take_parts(RegionSearch& search, MovedParts& parts, Span<const double> height, double low,
                Vector<Candidate>& found);

// Leaves one candidate on each tail, ear or wing: the one that is nearest to its end.
void leave_one_each(RegionSearch& search, const KnownSkeleton& known, MovedParts& parts, Vector<Candidate>& found);

// Chooses at most `limit` proposals, in the order of the candidates. parts: null without a skeleton.
Proposals choose_regions(RegionSearch& search, const Vector<Candidate>& found, MovedParts* parts, std::size_t limit);

}  // namespace hf_inner
