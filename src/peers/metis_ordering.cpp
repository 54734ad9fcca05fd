// The ordering of METIS, through CHOLMOD's Partition module. In builds without HF_WITH_GPL gpl_absent.cpp takes
// its place.
#include <cholmod.h>
#include <stdlib.h>

#include "base/error.h"
#include "factor/ordering.h"

namespace hf_inner::factor {
namespace {

// Saves the host's rand() sequence and restores it at the end of its life, because METIS seeds rand() and draws from
// it. Not safe for several threads at once.
class RandomState {
 public:
  RandomState() noexcept : host_(initstate(1, state_, sizeof state_)) {}
  ~RandomState() { setstate(host_); }
  RandomState(const RandomState&) = delete;
  RandomState& operator=(const RandomState&) = delete;

 private:
  char state_[128];
  char* host_;
};

}  // namespace

void require_metis() {}

void order_by_metis(const SymmetricMatrix& matrix, Memory& memory, Buffer<std::int32_t>& order) {
  const std::int32_t n = matrix.size();
  order.allocate(memory, static_cast<std::size_t>(n));
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(n);
  view.nzmax = matrix.row.size();
  view.p = const_cast<std::int32_t*>(matrix.column_start.data());
  view.i = const_cast<std::int32_t*>(matrix.row.data());
  view.x = const_cast<double*>(matrix.value.data());
  view.stype = 1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  int done = 0;
  {
    RandomState aside;
    done = cholmod_metis(&view, nullptr, 0, 1, order.data(), &common);
  }
  const int status = common.status;
  cholmod_finish(&common);
  if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (!done) fail(HF_ERROR_INTERNAL, HF_NO_INDEX, "METIS failed with CHOLMOD status %d", status);
}

}  // namespace hf_inner::factor
