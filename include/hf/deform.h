/* hf/deform.h - posing a surface with handles that come and go.
 *
 * A handle is a region of vertices that moves rigidly. One harmonic field per handle (1 on it, 0 on the others) says
 * how much each vertex belongs to it; the level bands of the fields are overlapping clusters; a small prefactored solve
 * finds their transforms and every vertex follows by interpolation (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5; the
 * mode HF_DEFORM_PAPER is that section to the letter). Handles live on layers: those of layer 0 stand where their
 * transforms put them from rest, those of higher layers edit the surface the layers below them make, coarse to fine,
 * and come and go without moving it.
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
  uint32_t iteration_count; /* iterations of a pose solve, 1 to 1000; 0 = 5 (smooth) or 200 (paper) */
  uint32_t
      samples_per_ring; /* sites on the boundary of a handle; 0 = the full ring (no leak). The paper takes "dozens" */
  uint32_t group_count; /* rotation groups of the smooth mode, 1 to 2000; 0 = 250 */
} hf_pose_desc;

/* Creates a pose without handles. desc: NULL for defaults. *out_pose is set to NULL first.
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT,
 * HF_ERROR_UNSUPPORTED (the solver's engine is not HF_ENGINE_GREEN, or its fields are bi-harmonic, which overshoot their
 * sites), HF_ERROR_OUT_OF_MEMORY. Thread safety: reads
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
  const double* points;            /* [handle_count][3], instead of regions: a region is what hangs together with the */
  const double* radii;             /* vertex nearest to its point at rest, within [handle_count] radii >= 0 of it */
  uint32_t layer;                  /* 0 to HF_LAYER_COUNT - 1; the same for the whole batch */
  uint32_t reserved;               /* 0 */
} hf_handles_desc;

enum { HF_LAYER_COUNT = 8 };

/* Adds handles, at any time. Their transforms start as the identity: on layer 0 that is the rest place, so the posed
 * surface is pulled there; on a higher layer it is where the layers below put the region, so nothing moves (to 1e-9 of
 * the box) until the handle is moved. Handles of the layers below are pins of a layer, moved or not.
 * out_handles: NULL, or uint32_t[handle_count]. All or nothing; a batch costs one field solve per layer from its own
 * up. Regions of all layers must not overlap, with welded copies counted as one vertex. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE (index =
 * position in region_vertices), HF_ERROR_INVALID_ARGUMENT (isolated vertex, layer, regions and points at once),
 * HF_ERROR_NON_FINITE (index = point or radius), HF_ERROR_OVERLAP (index = position in region_vertices, or handle when
 * given by points), HF_ERROR_TOO_LARGE (more than 256 handles), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after
 * failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_add_handles(hf_pose pose, const hf_handles_desc* handles, uint32_t* out_handles);

/* Removes handles by number: uint32_t[handle_count]. A handle of a higher layer takes its edit with it: the surface is
 * then, bit for bit, the one without it. So is that of layer 0 when the handles added last are removed. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_HANDLE (index = position in the
 * list), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after failure: unchanged. Thread safety: changes `pose`. Since
 * 0.1. */
HF_API hf_result hf_pose_remove_handles(hf_pose pose, uint32_t handle_count, const uint32_t* handles);

/* A rigid motion of a handle from its rest place: p -> rotation (p - centroid) + centroid + translation, centroid =
 * mean of the region's rest positions (hf_pose_get_handle), in the unit of the mesh. */
typedef struct hf_transform {
  double rotation[4]; /* unit quaternion x, y, z, w; normalised inside; all zero = identity */
  double translation[3];
} hf_transform;

/* Places handles: hf_transform[handle_count] for uint32_t[handle_count] handles. On layer 0 the motion is from the rest
 * place. On a higher layer it is an edit in the handle's rest frame, on top of where the layers below carry it: the
 * region moves by F (edit) F^-1, F the rigid motion they give it. Turns are followed from call to call, so that a
 * handle dragged past 180 degrees stays turned that far. Takes effect at the next hf_deform. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_HANDLE, HF_ERROR_NON_FINITE,
 * HF_ERROR_BUSY. State after failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_transforms(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                        const hf_transform* transforms);

/* The same from 4 x 4 matrices: double[handle_count][16], column by column (element [12 + i] is the translation), rest
 * place to posed place, p -> M p. The linear part must be a rotation within 1e-4 (the nearest one is taken) and the
 * last row 0 0 0 1. Results as hf_pose_set_transforms, and HF_ERROR_INVALID_ARGUMENT (index = position: no rigid
 * motion). State after failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_matrices(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                      const double* matrices);

/* What is known of a handle. */
typedef struct hf_handle_info {
  uint32_t struct_size;
  uint32_t vertex_count; /* inner (welded) vertices of the region */
  uint32_t site_count;   /* of its boundary */
  uint32_t component;
  double centroid[3]; /* of the rest region, in the unit of the mesh */
  double leak; /* largest deviation of the fields from 1 on this region and from 0 on the others' when only samples of
                  the rings are sites; 0 with full rings */
  double rotation[4];    /* where the handle stood in the last hf_deform, as in hf_transform: on higher layers with */
  double translation[3]; /* what the layers below did to it */
  uint32_t layer;
  uint32_t reserved;
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
  int32_t refine;        /* 1: one step of the whole surface towards as-rigid-as-possible on top, with the factor that
                            is there: three sweeps, about 0.5 us a vertex more. 0: none */
  uint32_t first_vertex; /* outputs hold vertex_count vertices from this one on; 0 and 0: all. Positions of a range */
  uint32_t vertex_count; /* alone, without layers, refine and normals, cost what the range costs */
} hf_deform_desc;

typedef struct hf_deform_info {
  uint32_t struct_size;
  uint32_t iteration_count; /* done */
  uint32_t cluster_count;
  uint32_t unreached_vertex_count; /* in components without a handle; they stay at rest */
  double last_change;              /* largest change of a rotation in the last iteration */
  double solve_ms, blend_ms, normal_ms;
  double refine_ms;
} hf_deform_info;

/* Solves the pose and writes the vertices. Regions of layer 0 land exactly where their transforms put them; those of
 * higher layers carry the surface the layers below gave them. With identity transforms the rest positions come back.
 * Repeated calls start from the last pose (dragging); without refine they allocate nothing. Higher layers depend on
 * nothing but the surface below and their own transforms.
 * out_info: NULL, or a struct with struct_size set. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER
 * (desc, or no output at all), HF_ERROR_INVALID_DESC, HF_ERROR_TOO_SMALL, HF_ERROR_EMPTY (no handle),
 * HF_ERROR_OUT_OF_RANGE (the range), HF_ERROR_INVALID_ARGUMENT, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after
 * failure: unchanged. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info);

/* A pose or a transfer (hf/transfer.h) as a skin for linear blend skinning: clusters as joints, with their motion in
 * the last frame, and the fixed weights. Joint j takes p to R (p - pivot) + translation: its inverse bind matrix is the
 * translation by minus its pivot. With scales asked for, joints may stretch along their own axes B and take p to
 * R B diag(scale) B^-1 (p - pivot) + translation: a node with rotation R B and that scale, inverse bind matrix
 * B^-1 (p - pivot). */
typedef struct hf_skin_info {
  uint32_t struct_size;
  uint32_t joint_count;    /* out: clusters */
  uint32_t weight_count;   /* in: joints per vertex, 4 or 8; 0 = 4 */
  uint32_t reserved;       /* 0 */
  double* pivots;          /* [joint_count][3] rest centroid of each cluster, or NULL */
  double* rotations;       /* [joint_count][4] quaternion x, y, z, w of the last frame, or NULL */
  double* translations;    /* [joint_count][3] posed place of the pivot, or NULL */
  uint32_t* vertex_joints; /* [vertex_count][weight_count], or NULL */
  float* vertex_weights;   /* [vertex_count][weight_count] summing to 1, descending, or NULL */
  double* axes;            /* [joint_count][4] quaternion of B, fixed while handles stay, or NULL */
  double* scales;          /* [joint_count][3] along the axes in the last frame; NULL = joints are rigid */
} hf_skin_info;

/* The joints and weights of a pose. Joint 0 to handle_count - 1 are its handles in the order they were added; a last
 * one that never moves is there when some vertices are out of the handles' reach. Weights are the 4 or 8 largest of a
 * vertex, scaled to sum 1 exactly in single precision, descending; they and the pivots change only when handles come or
 * go. Joint motions are those that bring the skin nearest to the last hf_deform. With scales the classic bends, twists
 * and lifts replay within 0.5 per cent of the box; rigid joints keep bends and twists within 1 per cent and stretched
 * surfaces within about 2.5. Write what is asked for; call with NULL arrays first for joint_count.
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT (weight_count), HF_ERROR_EMPTY (no handle),
 * HF_ERROR_UNSUPPORTED (handles on higher layers: their surface is no blend of clusters), HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. State after failure: unchanged. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_skin(hf_pose pose, hf_skin_info* info);

#ifdef __cplusplus
}
#endif
#endif
