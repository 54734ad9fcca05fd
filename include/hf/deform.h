/* hf/deform.h - posing a surface with handles that come and go.
 *
 * A handle is a region of vertices that moves rigidly. One harmonic field per handle (1 on it, 0 on the others) says
 * how much each vertex belongs to it; the level bands of the fields are overlapping clusters; a small prefactored solve
 * finds their transforms and every vertex follows by interpolation (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5; the
 * mode HF_DEFORM_PAPER is that section to the letter).
 */
#ifndef HF_DEFORM_H
#define HF_DEFORM_H

#include "hf/field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A pose: handles on the surface of a solver, with their own sites on the solver's factor. Independent of the solver's
 * scalar sites. Keeps what it needs of the solver alive. */
typedef struct hf_pose_object* hf_pose;

/* How vertices follow the handles. */
enum {
  HF_DEFORM_SMOOTH = 0, /* quadratic bands, reduced elastic energy: the default */
  HF_DEFORM_PAPER = 1   /* linear bands of equal value, shape matching of overlapping clusters */
};

typedef struct hf_pose_desc {
  uint32_t struct_size;
  int32_t mode;             /* HF_DEFORM_* */
  uint32_t band_count;      /* bands per field, 2 to 64; 0 = 10 (smooth) or 12 (paper) */
  uint32_t iteration_count; /* iterations of a pose solve, 1 to 1000; 0 = 8 (smooth) or 200 (paper) */
  uint32_t
      samples_per_ring; /* sites on the boundary of a handle; 0 = the full ring (no leak). The paper takes "dozens" */
  uint32_t group_count; /* rotation groups of the smooth mode, 1 to 2000; 0 = 200 */
} hf_pose_desc;

/* Creates a pose without handles. desc: NULL for defaults. *out_pose is set to NULL first.
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT,
 * HF_ERROR_UNSUPPORTED (the solver's engine is not HF_ENGINE_GREEN), HF_ERROR_OUT_OF_MEMORY. Thread safety: reads
 * `solver`. Since 0.1. */
HF_API hf_result hf_pose_create(hf_solver solver, const hf_pose_desc* desc, hf_pose* out_pose);

/* A copy with the same handles and transforms, sharing the factor: several poses of one rig on several threads. Since
 * 0.1. Thread safety: reads `pose`. */
HF_API hf_result hf_pose_clone(hf_pose pose, hf_pose* out_pose);

/* Destroys a pose. NULL, stale and foreign handles are ignored. Since 0.1. */
HF_API void hf_pose_destroy(hf_pose pose);

/* Handles to add: a region of vertices each, given as lists one after the other. */
typedef struct hf_handles_desc {
  uint32_t struct_size;
  uint32_t handle_count;           /* >= 1 */
  const uint32_t* region_counts;   /* [handle_count] vertices of each region, >= 1 */
  const uint32_t* region_vertices; /* all regions one after the other; vertices of the mesh as given */
} hf_handles_desc;

/* Adds handles; they start at rest (identity). out_handles: NULL, or uint32_t[handle_count]. All or nothing; a batch
 * costs one field solve. Regions must not overlap, with welded copies counted as one vertex. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE (index =
 * position in region_vertices), HF_ERROR_INVALID_ARGUMENT (isolated vertex), HF_ERROR_OVERLAP (index = position in
 * region_vertices), HF_ERROR_TOO_LARGE (more than 256 handles), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after
 * failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_add_handles(hf_pose pose, const hf_handles_desc* handles, uint32_t* out_handles);

/* Removes handles by number: uint32_t[handle_count]. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_HANDLE (index = position in the list), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State
 * after failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_remove_handles(hf_pose pose, uint32_t handle_count, const uint32_t* handles);

/* A rigid motion of a handle from its rest place: p -> rotation (p - centroid) + centroid + translation, centroid =
 * mean of the region's rest positions (hf_pose_get_handle), in the unit of the mesh. */
typedef struct hf_transform {
  double rotation[4]; /* unit quaternion x, y, z, w; normalised inside; all zero = identity */
  double translation[3];
} hf_transform;

/* Places handles: hf_transform[handle_count] for uint32_t[handle_count] handles. Takes effect at the next hf_deform.
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_HANDLE,
 * HF_ERROR_NON_FINITE, HF_ERROR_BUSY. State after failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_transforms(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                        const hf_transform* transforms);

/* What is known of a handle. */
typedef struct hf_handle_info {
  uint32_t struct_size;
  uint32_t vertex_count; /* inner (welded) vertices of the region */
  uint32_t site_count;   /* of its boundary */
  uint32_t component;
  double centroid[3]; /* of the rest region, in the unit of the mesh */
  double leak; /* largest deviation of the fields from 1 on this region and from 0 on the others' when only samples of
                  the rings are sites; 0 with full rings */
} hf_handle_info;

/* Writes what is known of a handle. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_INVALID_DESC, HF_ERROR_NO_SUCH_HANDLE. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_handle(hf_pose pose, uint32_t handle, hf_handle_info* out_info);

/* Number of handles, 0 for an invalid handle. Since 0.1. */
HF_API uint32_t hf_pose_get_handle_count(hf_pose pose);

/* The field of a handle (how much each vertex belongs to it; all handles sum to 1 where any reaches):
 * float[vertex_count], value_stride bytes apart (0 = packed). Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_NO_SUCH_HANDLE, HF_ERROR_TOO_SMALL. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_field(hf_pose pose, uint32_t handle, float* out_values, uint32_t value_stride);

/* Where hf_deform writes, and what it found. */
typedef struct hf_deform_desc {
  uint32_t struct_size;
  uint32_t position_stride; /* bytes between vertices; 0 = packed */
  float* positions; /* [vertex_count][3] posed positions, in the unit and frame of the mesh as given; NULL = none */
  double* positions_f64; /* the same in double, instead */
  float* normals; /* [vertex_count][3] unit normals of the posed surface, shared across seams, packed by normal_stride;
                     NULL = none */
  uint32_t normal_stride;
  uint32_t iteration_count; /* 0 = the pose's */
  int32_t restart;          /* non-zero: forget the last pose and start from the fields */
  int32_t reserved;         /* 0 */
} hf_deform_desc;

typedef struct hf_deform_info {
  uint32_t struct_size;
  uint32_t iteration_count; /* done */
  uint32_t cluster_count;
  uint32_t unreached_vertex_count; /* in components without a handle; they stay at rest */
  double last_change;              /* largest change of a rotation in the last iteration */
  double solve_ms, blend_ms, normal_ms;
} hf_deform_info;

/* Solves the pose and writes every vertex. Handle regions land exactly where their transforms put them. With identity
 * transforms the rest positions come back. Repeated calls start from the last pose (dragging); they allocate nothing.
 * out_info: NULL, or a struct with struct_size set. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER
 * (desc, or no output at all), HF_ERROR_INVALID_DESC, HF_ERROR_TOO_SMALL, HF_ERROR_EMPTY (no handle),
 * HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after failure: unchanged. Thread safety:
 * changes `pose`. Since 0.1. */
HF_API hf_result hf_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info);

#ifdef __cplusplus
}
#endif
#endif
