#include "factor/kernels.h"

namespace hf_inner {

#if defined(HF_KERNELS_X86)
extern const Kernels kernels_avx2_set, kernels_avx512_set;
#endif
extern const Kernels kernels_plain_set;

const Kernels* plain_kernels() noexcept { return &kernels_plain_set; }

const Kernels* avx2_kernels() noexcept {
#if defined(HF_KERNELS_X86)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &kernels_avx2_set;
#endif
  return nullptr;
}

const Kernels* avx512_kernels() noexcept {
#if defined(HF_KERNELS_X86)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return &kernels_avx512_set;
#endif
  return nullptr;
}

const Kernels& choose_kernels() noexcept {
  if (const Kernels* set = avx512_kernels()) return *set;
  if (const Kernels* set = avx2_kernels()) return *set;
  return kernels_plain_set;
}

}  // namespace hf_inner
