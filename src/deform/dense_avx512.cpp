// The sweeps of dense.cpp with eight rows or columns (lanes) in a register; the bits are the same. The build uses
// -mavx512f, and the program chooses the loop at run time. The file includes no header with inline functions, because
// their AVX-512 code could be linked into other files.
#include <cstring>

#include "base/compiler.h"
#include "deform/dense_panels.h"

namespace hf_inner::deform {
namespace {

HF_VECTOR(Lanes, double, 8);

#include "deform/dense_loops.inl"

}  // namespace

void solve_dense_avx512(const DensePanels& factor, int sides, double* x) noexcept {
  if (sides == 3) return solve_panels<Lanes, 3, 3>(factor, x);
  solve_panels<Lanes, 4, 4>(factor, x);
}

}  // namespace hf_inner::deform
