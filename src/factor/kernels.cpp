#include "factor/kernels.h"

#include "base/compiler.h"

namespace hf_inner::factor {

#if defined(HF_KERNELS_X86)
extern const Kernels kernels_avx2_set, kernels_avx512_set;
#endif
#if defined(HF_KERNELS_NEON)
extern const Kernels kernels_neon_set;
#endif
extern const Kernels kernels_plain_set;

const Kernels* plain_kernels() noexcept { return &kernels_plain_set; }

const Kernels* avx2_kernels() noexcept {
#if defined(HF_KERNELS_X86)
  if (HF_PROCESSOR_HAS("avx2") && HF_PROCESSOR_HAS("fma")) return &kernels_avx2_set;
#endif
  return nullptr;
}

const Kernels* avx512_kernels() noexcept {
#if defined(HF_KERNELS_X86)
  if (HF_PROCESSOR_HAS("avx512f") && HF_PROCESSOR_HAS("avx512vl") && HF_PROCESSOR_HAS("avx512dq"))
    return &kernels_avx512_set;
#endif
  return nullptr;
}

const Kernels* neon_kernels() noexcept {
#if defined(HF_KERNELS_NEON)
  return &kernels_neon_set;
#else
  return nullptr;
#endif
}

const Kernels& choose_kernels() noexcept {
  if (const Kernels* set = avx512_kernels()) return *set;
  if (const Kernels* set = avx2_kernels()) return *set;
  if (const Kernels* set = neon_kernels()) return *set;
  return kernels_plain_set;
}

}  // namespace hf_inner::factor
