// Kernels for one instruction set; see kernels.h. The vector types are included before the kernels that use them.
// clang-format off
#include "factor/simd_avx512.h"
#define HF_KERNEL_SET kernels_avx512_set
#define HF_KERNEL_NAME "avx512"
#include "factor/kernels_set.inl"
// clang-format on
