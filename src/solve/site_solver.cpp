#include "solve/site_solver.h"

#include "base/error.h"
#include "solve/green.h"
#include "solve/mixed_solver.h"

namespace hf_inner::solve {

void SiteSolver::rebase(JobRunner&) {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "this baseline keeps its sites in the factor; there is nothing to rebase");
}

void SiteSolver::respond(const double*, const double*, std::int32_t, double*, double*) const {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "loads need the engine green");
}

std::shared_ptr<SiteSolver> SiteSolver::make(std::shared_ptr<const surface::Core> core) {
  const std::shared_ptr<Memory> memory = core->memory;
  if (core->root) return make_owner_in<MixedSolver>(memory, std::move(core));
  return make_owner_in<GreenSolver>(memory, std::move(core));
}

}  // namespace hf_inner::solve
