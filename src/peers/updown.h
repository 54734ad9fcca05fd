// The engine updown: the method of Xu, Zhang, Cohen-Or and Xiong 2009, Section 3, without changes. The factor updates
// follow Davis and Hager 2005.
//
//     (K + R R') u = R R' s,   R = [sqrt(alpha_i) w_i]
//
// Site i has the weights w_i, the penalty alpha_i and the value s_i. To add and remove sites, a multi-rank update and
// downdate change a sparse LDL' factor (cholmod_updown). A back substitution then gives the field u. A hard site is a
// penalty of 1e8 mean diagonals of K, so the field meets its value to about 1e-8 of the value range.
//
// cholmod_updown neither checks its input nor reports a failed pivot. So a component without a site is pinned on its
// diagonal, updates run before downdates, and the mean is subtracted from the values. Many edits make the factor drift.
// A solve then takes one refinement step with the true matrix, which removes the drift. If an update fails, the engine
// factorises again from the sites. Its memory comes from CHOLMOD, not from the solver's allocator.
//
// The engine exists only in builds with HF_WITH_GPL, because CHOLMOD's Modify module is GPL-2.0+. In others
// gpl_absent.cpp refuses it.
#pragma once
#include <memory>

#include "solve/site_solver.h"

namespace hf_inner::peers {

// Throws HF_ERROR_UNSUPPORTED in builds without HF_WITH_GPL. Callers ask before they make a factor for the engine.
void require_updown();

// Throws what require_updown throws.
std::shared_ptr<solve::SiteSolver> make_updown_solver(std::shared_ptr<const surface::Core> core, double penalty);

}  // namespace hf_inner::peers
