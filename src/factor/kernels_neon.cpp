// Kernels for one instruction set; see kernels.h. The vector types are included before the kernels that use them.
// clang-format off
#include "factor/simd_neon.h"
#define HF_KERNEL_SET kernels_neon_set
#define HF_KERNEL_NAME "neon"
#include "factor/kernels_set.inl"
// clang-format on
