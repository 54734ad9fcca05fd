// Kernels for one instruction set; see kernels.h. The vector types are included before the kernels that use them.
// clang-format off
#include "factor/simd_avx2.h"
#define HF_KERNEL_SET kernels_avx2_set
#define HF_KERNEL_NAME "avx2"
#include "factor/kernels_set.inl"
// clang-format on
