// Kernels for one instruction set; see kernels.h. The vector types are included before the kernels that use them.
// clang-format off
#include "factor/simd_plain.h"
#define HF_KERNEL_SET kernels_plain_set
#define HF_KERNEL_NAME "plain"
#include "factor/kernels_set.inl"
// clang-format on
