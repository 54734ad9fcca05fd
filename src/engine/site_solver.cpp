#include "engine/site_solver.h"

#include "base/error.h"
#include "engine/green.h"
#include "engine/mixed_solver.h"
#include "engine/refactor.h"
#include "engine/updown.h"

namespace hf_inner {

void SiteSolver::rebase(JobRunner&) {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
       "only engine green keeps its sites outside the factor; there is nothing to rebase");
}

void SiteSolver::respond(const double*, const double*, std::int32_t, double*, double*) const {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX, "loads need the engine green");
}

std::shared_ptr<SiteSolver> SiteSolver::make(EngineKind kind, std::shared_ptr<const Core> core, double penalty) {
  const std::shared_ptr<Memory> memory = core->memory;
  if (core->root) {
    if (kind != EngineKind::green)
      fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
           "a vertex has more than %d neighbours; only HF_ENGINE_GREEN solves bi-harmonic fields there",
           core->formed_valence);
    return make_owner_in<MixedSolver>(memory, std::move(core));
  }
  switch (kind) {
    case EngineKind::updown:
      return make_updown_solver(std::move(core), penalty);
    case EngineKind::refactor:
      return make_owner_in<RefactorSolver>(memory, std::move(core));
    case EngineKind::green:
      break;
  }
  return make_owner_in<GreenSolver>(memory, std::move(core));
}

}  // namespace hf_inner
