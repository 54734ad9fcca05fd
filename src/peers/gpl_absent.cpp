// Stands in place of updown.cpp and metis_ordering.cpp in builds without HF_WITH_GPL: asking for them is refused.
#include "base/error.h"
#include "factor/ordering.h"
#include "peers/updown.h"

namespace hf_inner::peers {

void require_updown() {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
       "the engine updown needs a build with HF_WITH_GPL; hf_create makes a solver of the same fields");
}

std::shared_ptr<solve::SiteSolver> make_updown_solver(std::shared_ptr<const surface::Core>, double) {
  require_updown();
  return nullptr;
}

}  // namespace hf_inner::peers

namespace hf_inner::factor {

void require_metis() {
  fail(HF_ERROR_UNSUPPORTED, HF_NO_INDEX,
       "HF_ORDERING_METIS needs a build with HF_WITH_GPL; use HF_ORDERING_NESTED_DISSECTION");
}

void order_by_metis(const SymmetricMatrix&, Memory&, Buffer<std::int32_t>&) { require_metis(); }

}  // namespace hf_inner::factor
