// The engines by name, for tests that compare them. Without HF_WITH_GPL the engine updown throws HF_ERROR_UNSUPPORTED.
#pragma once
#include <memory>
#include <vector>

#include "peers/refactor.h"
#include "peers/updown.h"
#include "solve/site_solver.h"

namespace hf_test {

enum class EngineKind { green, updown, refactor };

inline std::shared_ptr<hf_inner::solve::SiteSolver> make_engine(EngineKind kind,
                                                                std::shared_ptr<const hf_inner::surface::Core> core) {
  if (kind == EngineKind::updown) return hf_inner::peers::make_updown_solver(std::move(core), 1e8);
  if (kind == EngineKind::refactor) return hf_inner::make_owner_in<hf_inner::peers::RefactorSolver>(core->memory, core);
  return hf_inner::solve::SiteSolver::make(std::move(core));
}

// The engines of this build.
inline std::vector<EngineKind> engines() {
#ifdef HF_WITH_GPL
  return {EngineKind::green, EngineKind::refactor, EngineKind::updown};
#else
  return {EngineKind::green, EngineKind::refactor};
#endif
}

}  // namespace hf_test
