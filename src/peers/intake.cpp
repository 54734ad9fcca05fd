#include "peers/intake.h"

#include "base/error.h"

namespace hf_inner::peers {
namespace {

// Weight of hard sites as penalties, as in Xu et al. 2009. With more than the second number, rounding hides the other
// terms of the equation.
constexpr double default_penalty = 1e8, largest_penalty = 1e10;

}  // namespace

double read_penalty(double given) {
  if (given != 0 && !(given > 0 && given <= largest_penalty))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "penalty is %g; it must be above 0 and at most %g, or 0 for %g", given,
         largest_penalty, default_penalty);
  return given > 0 ? given : default_penalty;
}

void require_formed(const surface::Core& core) {
  if (core.root)
    fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
         "a vertex has more than %d neighbours; only hf_create makes solvers of bi-harmonic fields there",
         core.formed_valence);
}

}  // namespace hf_inner::peers
