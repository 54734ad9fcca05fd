// Collects the kernels of one instruction set; see kernels.h. The including file has already included its vector types.
// It names the set by HF_KERNEL_SET and HF_KERNEL_NAME.
// clang-format off
#include "factor/kernels_factor.inl"
#include "factor/kernels_sweep.inl"
#include "factor/kernels_narrow.inl"
#include "factor/kernels_triangle.inl"
#include "factor/kernels_path.inl"
// clang-format on

// Sweeps in single precision serve previews alone, which the small WebAssembly build leaves out.
#ifdef HF_WITHOUT_PREVIEWS
#define HF_PREVIEW_KERNEL(name) nullptr
#else
#define HF_PREVIEW_KERNEL(name) name
#endif

namespace hf_inner::factor {

extern const Kernels HF_KERNEL_SET = {
    HF_KERNEL_NAME,
    factor_triangle,
    solve_tiles,
    form_update,
    extend_add,
    invert_triangle,
    multiply_inverse,
    store_tiles,
    backward_rows,
    backward_triangle,
    backward_narrow,
    HF_PREVIEW_KERNEL(backward_narrow_f32),
    HF_PREVIEW_KERNEL(backward_rows_f32),
    HF_PREVIEW_KERNEL(backward_triangle_f32),
    forward_triangle,
    forward_rows,
    HF_PREVIEW_KERNEL(forward_triangle_f32),
    HF_PREVIEW_KERNEL(forward_rows_f32),
    path_triangle,
    path_rows,
    gram,
};

}  // namespace hf_inner::factor
