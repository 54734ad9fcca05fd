// Engine updown: the paper's method, kept whole (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3; Davis and Hager 2005
// for the update).
//
//     (K + R R') u = R R' s,   R = [sqrt(alpha_i) w_i]
//
// Sites come and go by multi-rank update and downdate of a sparse LDL' factor (cholmod_updown); the field follows by
// back substitution. A hard site is a penalty of 1e8 mean diagonals, so it holds to about 1e-8 of the value range.
// cholmod_updown neither checks its input nor reports a failed pivot. So every component without a site is pinned on
// its diagonal, updates go before downdates, and values are centred. After many edits the solve takes one refinement
// step with the true matrix, which removes the drift. If an update fails, the factor is recomputed from the sites. The
// memory of this engine is CHOLMOD's own, not the solver's allocator.
//
// Only in builds with HF_WITH_GPL: CHOLMOD's Modify module is GPL-2.0+.
#pragma once
#include <memory>

#include "engine/site_solver.h"

namespace hf_inner {

// Throws HF_ERROR_UNSUPPORTED in builds without HF_WITH_GPL.
std::shared_ptr<SiteSolver> make_updown_solver(std::shared_ptr<const Core> core, double penalty);

}  // namespace hf_inner
