// Collects the kernels of one instruction set; see kernels.h. The including file has already included its vector types.
// It names the set by HF_KERNEL_SET and HF_KERNEL_NAME.
// clang-format off
#include "factor/kernels_factor.inl"
#include "factor/kernels_sweep.inl"
#include "factor/kernels_narrow.inl"
#include "factor/kernels_triangle.inl"
#include "factor/kernels_path.inl"
// clang-format on

namespace hf_inner {

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
    backward_narrow_f32,
    backward_rows_f32,
    backward_triangle_f32,
    forward_triangle,
    forward_rows,
    forward_triangle_f32,
    forward_rows_f32,
    path_triangle,
    path_rows,
    gram,
};

}  // namespace hf_inner
