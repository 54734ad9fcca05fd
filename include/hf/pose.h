/* hf/pose.h - grab the surface with handles and pose it; add and remove handles at any time.
 *
 * A handle is a region of vertices that moves rigidly; every other vertex follows. One harmonic field per handle, 1 on it
 * and 0 on the others, says how much a vertex belongs to it. Level bands of the fields are overlapping clusters. A small
 * prefactored solve finds their motions, and vertices blend them (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5; the mode
 * HF_DEFORM_PAPER is that section to the letter).
 *
 * Handles live on layers. Those of layer 0 start at the rest pose. Those of higher layers edit the surface that the layers
 * below make, coarse to fine, and come and go without moving it.
 */
#ifndef HF_POSE_H
#define HF_POSE_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Handles on a surface. */
typedef struct hf_pose_object* hf_pose;

/* How vertices follow the handles. */
enum {
  HF_DEFORM_SMOOTH = 0, /* quadratic bands, reduced elastic energy: the default */
  HF_DEFORM_PAPER = 1   /* linear bands of equal value, shape matching of overlapping clusters */
};

enum {
  HF_LAYER_COUNT = 8,
  HF_HANDLE_LIMIT = 256 /* most handles of a pose */
};

typedef struct hf_pose_desc {
  uint32_t struct_size;
  int32_t mode;              /* HF_DEFORM_* */
  uint32_t band_count;       /* bands per field, 2 to 64; 0 = 10 (smooth) or 12 (paper) */
  uint32_t iteration_count;  /* iterations of a pose solve, 1 to 1000; 0 = 5 (smooth) or 200 (paper) */
  uint32_t samples_per_ring; /* sites on the boundary of a handle; 0 = the full ring. The paper takes "dozens" */
  uint32_t group_count;      /* rotation groups of the smooth mode, 1 to 2000; 0 = 250 */
} hf_pose_desc;

/* Creates a pose without handles. desc: NULL for defaults. Sets *out_pose to NULL first. Uses the harmonic factor of the
 * surface, and makes it if the surface has only another. Errors: HF_ERROR_INVALID_ARGUMENT. Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_pose_create(hf_surface surface, const hf_pose_desc* desc, hf_pose* out_pose);

/* Copies a pose with its handles and transforms: several poses of one rig on several threads. Thread safety: reads
 * `pose`. Since 0.1. */
HF_API hf_result hf_pose_clone(hf_pose pose, hf_pose* out_pose);

/* Destroys a pose. Ignores NULL and destroyed handles. Since 0.1. */
HF_API void hf_pose_destroy(hf_pose pose);

/* The options a pose was made with, defaults filled in, and what it holds. */
typedef struct hf_pose_info {
  uint32_t struct_size;
  int32_t mode;
  uint32_t band_count;
  uint32_t iteration_count;
  uint32_t samples_per_ring; /* 0: full rings */
  uint32_t group_count;
  uint32_t handle_count;
  uint32_t vertex_count; /* as given to the surface: rows of hf_deform */
} hf_pose_info;

/* Writes the options of a pose. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_info(hf_pose pose, hf_pose_info* out_info);

/* ---- handles ---- */

/* Handles to add: regions as vertex lists one after the other, or as points with radii. */
typedef struct hf_handles_desc {
  uint32_t struct_size;
  uint32_t handle_count;           /* >= 1 */
  const uint32_t* region_counts;   /* [handle_count] vertices of each region, >= 1 */
  const uint32_t* region_vertices; /* all regions one after the other; vertices as given */
  const double* points;            /* [handle_count][3] at rest. The region is the vertex nearest to the point and what */
  const double* radii;             /* is edge-connected to it within [handle_count] radii >= 0 of the point */
  uint32_t layer;                  /* 0 to HF_LAYER_COUNT - 1, for the whole batch */
  uint32_t reserved;               /* 0 */
  hf_progress progress;            /* NULL, or an object to poll and cancel through */
} hf_handles_desc;

/* Adds handles. Their transforms start as the identity. On layer 0 that is the rest place, so a posed surface is pulled
 * there. On a higher layer nothing moves (to 1e-9 of the box) until the handle is moved. Handles of lower layers pin the
 * surface for a layer. out_handles: NULL, or uint32_t[handle_count]. Costs one field solve per layer from its own up. No
 * two regions may overlap, on any layer; welded copies count as one vertex. Errors: HF_ERROR_OUT_OF_RANGE and
 * HF_ERROR_OVERLAP (index = position in region_vertices, or handle when given by points), HF_ERROR_INVALID_ARGUMENT
 * (isolated vertex, layer, regions and points at once), HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (HF_HANDLE_LIMIT),
 * HF_ERROR_CANCELLED.
 * Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_add_handles(hf_pose pose, const hf_handles_desc* handles, uint32_t* out_handles);

/* Adds one handle on layer 0: what is edge-connected within `radius` of a point at rest, double[3]. out_handle: NULL, or
 * its number. Errors: as hf_pose_add_handles. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_add_handle_at(hf_pose pose, const double* point, double radius, uint32_t* out_handle);

/* Removes handles by number: uint32_t[handle_count]. A handle of a higher layer takes its edit with it: the surface is
 * then, bit for bit, the one without it. So it is on layer 0 when the handles added last are removed. Errors:
 * HF_ERROR_NO_SUCH_HANDLE. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_remove_handles(hf_pose pose, uint32_t handle_count, const uint32_t* handles);

/* A rigid motion of a handle from its rest place: p -> rotation (p - centroid) + centroid + translation. centroid is the
 * mean of the region's rest positions (hf_pose_get_handle), in the unit of the mesh. */
typedef struct hf_transform {
  double rotation[4]; /* unit quaternion x, y, z, w; normalised inside; all zero = identity */
  double translation[3];
} hf_transform;

/* Places handles: hf_transform[handle_count] for uint32_t[handle_count] handles. On layer 0 the motion is from the rest
 * place. On a higher layer it is an edit in the rest frame of the handle, on top of F, the rigid motion the layers below
 * give it: the region moves by F (edit) F^-1. Turns are followed from call to call, so a handle dragged past 180 degrees
 * stays turned that far. Takes effect at the next hf_deform. Errors: HF_ERROR_NO_SUCH_HANDLE, HF_ERROR_NON_FINITE. Thread
 * safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_transforms(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                        const hf_transform* transforms);

/* Places one handle. Errors: as hf_pose_set_transforms. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_transform(hf_pose pose, uint32_t handle, const hf_transform* transform);

/* Places handles by 4 x 4 matrices: double[handle_count][16], column by column, elements 12 to 14 the translation; from
 * rest place to posed place, p -> M p. The linear part is a rotation within 1e-4 (the nearest one is taken), the last row
 * 0 0 0 1. Errors: as hf_pose_set_transforms, HF_ERROR_INVALID_ARGUMENT (not a rigid motion). Thread safety: changes
 * `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_matrices(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                      const double* matrices);

/* What a handle is and where it stands. */
typedef struct hf_handle_info {
  uint32_t struct_size;
  uint32_t vertex_count; /* of the region, welded copies counted once */
  uint32_t site_count;   /* of its boundary */
  uint32_t component;
  double centroid[3];    /* of the rest region, in the unit of the mesh */
  double leak;           /* with samples_per_ring: how far fields are off on the regions; 0 with full rings */
  double rotation[4];    /* where the handle stood in the last hf_deform, as in hf_transform; on higher layers with */
  double translation[3]; /* what the layers below did to it */
  uint32_t layer;
  uint32_t reserved;
} hf_handle_info;

/* Writes what is known of a handle. Errors: HF_ERROR_NO_SUCH_HANDLE. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_handle(hf_pose pose, uint32_t handle, hf_handle_info* out_info);

/* Number of handles; 0 for an invalid handle. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_pose_get_handle_count(hf_pose pose);

/* The field of a handle: how much each vertex belongs to it. All handles sum to 1 where one reaches. float[vertex_count],
 * value_stride bytes apart (0 = packed). Errors: HF_ERROR_NO_SUCH_HANDLE. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_field(hf_pose pose, uint32_t handle, float* out_values, uint32_t value_stride);

/* ---- posing ---- */

/* What a deform did. */
typedef struct hf_deform_info {
  uint32_t struct_size;
  uint32_t iteration_count; /* done */
  uint32_t cluster_count;
  uint32_t unreached_vertex_count; /* in components without a handle; they stay at rest */
  double last_change;              /* largest change of a rotation in the last iteration */
  double solve_ms, blend_ms, normal_ms;
  double refine_ms;
} hf_deform_info;

/* Solves the pose and writes every vertex: float[vertex_count][3], packed, in the unit and frame of the mesh. Regions of
 * layer 0 land exactly where their transforms put them; those of higher layers carry the surface the layers below give
 * them. Identity transforms give the rest positions. Repeated calls start from the last pose (dragging) and allocate
 * nothing. out_info: NULL, or a struct. Errors: HF_ERROR_EMPTY (no handle). Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_deform(hf_pose pose, float* out_positions, hf_deform_info* out_info);

/* More ways to write a pose. Set at least one output. */
typedef struct hf_deform_desc {
  uint32_t struct_size;
  uint32_t position_stride; /* bytes between vertices; 0 = packed */
  float* positions;         /* [vertex_count][3] posed positions, or NULL */
  double* positions_f64;    /* the same in double, or NULL; set one of the two at most */
  float* normals;           /* [vertex_count][3] unit normals of the posed surface, shared across seams, or NULL */
  uint32_t normal_stride;   /* bytes between normals; 0 = packed */
  uint32_t iteration_count; /* 0 = the pose's */
  int32_t restart;          /* 1: forget the last pose and start from the fields */
  int32_t refine;           /* 1: one step of the whole surface towards as-rigid-as-possible on top, with the same factor:
                               three sweeps, about 0.5 us a vertex more */
  uint32_t first_vertex;    /* outputs hold vertex_count vertices from this one on; 0 and 0: all. A range of positions */
  uint32_t vertex_count;    /* alone, without layers, refine and normals, costs what the range costs */
} hf_deform_desc;

/* Like hf_deform, with the options of a desc. Errors: HF_ERROR_EMPTY (no handle), HF_ERROR_OUT_OF_RANGE (the range),
 * HF_ERROR_INVALID_ARGUMENT. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info);

/* ---- skins ---- */

/* A pose or a transfer as a skin for linear blend skinning: clusters are joints, with their motion in the last frame and
 * fixed weights. Joint j takes p to R (p - pivot) + translation; its inverse bind matrix is the translation by -pivot. If
 * you ask for scales, joints may stretch along their own axes B and take p to R B diag(scale) B^-1 (p - pivot) +
 * translation: a node with rotation R B and that scale, inverse bind matrix B^-1 (p - pivot). Arrays are yours or NULL. */
typedef struct hf_skin_info {
  uint32_t struct_size;
  uint32_t joint_capacity;  /* in: joints the arrays can take */
  uint32_t vertex_capacity; /* in: vertices the arrays can take */
  uint32_t weight_count;    /* in: joints per vertex, 4 or 8; 0 = 4 */
  uint32_t joint_count;     /* out: clusters */
  uint32_t vertex_count;    /* out */
  double* pivots;           /* [joint_capacity][3] rest centroid of each cluster */
  double* rotations;        /* [joint_capacity][4] quaternion x, y, z, w of the last frame */
  double* translations;     /* [joint_capacity][3] posed place of the pivot */
  double* axes;             /* [joint_capacity][4] quaternion of B, fixed while handles stay */
  double* scales;           /* [joint_capacity][3] along the axes in the last frame; NULL = joints are rigid */
  uint32_t* vertex_joints;  /* [vertex_capacity][weight_count] */
  float* vertex_weights;    /* [vertex_capacity][weight_count] of sum 1, descending */
} hf_skin_info;

/* Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they were added. A
 * last one that never moves is there when handles do not reach some vertices. Weights are the 4 or 8 largest of a vertex,
 * scaled to sum 1 exactly in single precision. They and the pivots change only when handles come or go. Joint motions
 * bring the skin nearest to the last hf_deform: with scales classic bends, twists and lifts replay within 0.5 per cent of
 * the box. Rigid joints keep bends and twists within 1 per cent, stretched surfaces within about 2.5. Errors:
 * HF_ERROR_INVALID_ARGUMENT (weight_count), HF_ERROR_EMPTY (no handle), HF_ERROR_UNSUPPORTED (handles on higher layers:
 * their surface is not a blend of clusters). Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_skin(hf_pose pose, hf_skin_info* inout_skin);

#ifdef __cplusplus
}
#endif
#endif
