/* hf/factor.h - the factor as bytes, and previews in single precision.
 *
 * Making the factor of a large mesh takes most of hf_create. An authoring tool saves it once; a game ships the bytes
 * beside the mesh and gives them to hf_create (hf_create_desc.saved_factor), which then starts in a fraction of the
 * time. Saved bytes are the same for the same mesh, options and library version, whatever the number of threads.
 */
#ifndef HF_FACTOR_H
#define HF_FACTOR_H

#include "hf/field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the number of bytes hf_save_factor needs. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER.
 * Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_get_factor_size(hf_solver solver, size_t* out_size);

/* Writes the factor of the solver's surface: ordering, structure and numbers, with a hash of the matrix it belongs to
 * and a checksum of everything. Sites are not part of it. The format is little-endian, starts with a version, and is
 * read by libraries of the same format version on processors of the same byte order.
 *
 * out_bytes: memory of the caller, `size` bytes, any alignment; nothing behind the first hf_get_factor_size bytes is
 * written. Cost: one copy of the factor (hf_statistics.factor_bytes).
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_TOO_SMALL (size), HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. On failure the output is undefined. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_save_factor(hf_solver solver, void* out_bytes, size_t size);

/* What a preview reached; struct_size must be set. */
typedef struct hf_preview_info {
  uint32_t struct_size;
  uint32_t exact;                     /* 1: solved in double, as hf_solve does */
  uint32_t correction_count;          /* corrections made; 0 when exact */
  uint32_t unreached_component_count; /* components without a site; their vertices hold 0 */
  double value_range;                 /* largest less smallest site value, the widest over components and channels */
  double largest_correction;          /* largest change of a value by the last correction: about the error before it */
  double error_estimate; /* of the largest error of a value, in the unit of the values: measured when corrections were
                            made, otherwise 1e-5 of value_range, which hard cases reach; 0 when exact */
  double preview_bytes;  /* memory of the single-precision copy, shared with all clones */
} hf_preview_info;

/* Solves like hf_solve with the factor in single precision: for previews while a value or a site is dragged. A backward
 * sweep through half the bytes; paths and dense system stay double. The error is about 1e-6 of the range of the site
 * values (2e-6 measured for harmonic fields, up to 1e-5 for bi-harmonic ones and crowded sites); values of hard sites
 * on vertices are exact. Each correction forms the residual (W lambda)_v - sum_j K_vj (u_j - u_v) in double and takes
 * it through both sweeps in single precision (iterative refinement, Wilkinson 1963): below 1e-9 of the range after one,
 * below 1e-12 after two. A correction costs as much as two or three calls of hf_solve: it is for bounding the error and
 * for the moment when nothing moves any more and hf_solve is not at hand, not for every frame.
 *
 * The single-precision copy is made at the first call (half the factor's bytes, about the time of two solves), shared
 * with all clones, and kept until the last of them is destroyed or hf_release_preview is called. Solvers of another
 * engine than HF_ENGINE_GREEN, and solvers whose sites were moved into the factor, have no such copy: they answer with
 * the exact field and say so in out_info.
 *
 * out_values: float[vertex_count] rows of channel_count values, value_stride bytes apart (0 = packed).
 * correction_count: 0 to 8. out_info: NULL, or a struct with struct_size set. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT (correction_count), HF_ERROR_TOO_SMALL
 * (stride), HF_ERROR_NO_SITES, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. On failure the output is not written. Thread
 * safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve_preview(hf_solver solver, float* out_values, uint32_t value_stride, uint32_t correction_count,
                                  hf_preview_info* out_info);

/* The same into double, where corrections show. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve_preview_f64(hf_solver solver, double* out_values, uint32_t value_stride,
                                      uint32_t correction_count, hf_preview_info* out_info);

/* Gives the memory of the single-precision copy back, for this solver and all that share its factor; calls that are
 * using it finish first. The next preview makes it again. Results: HF_OK, HF_ERROR_INVALID_HANDLE. Thread safety: any
 * thread, beside any function. Since 0.1. */
HF_API hf_result hf_release_preview(hf_solver solver);

#ifdef __cplusplus
}
#endif
#endif
