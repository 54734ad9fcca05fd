/* hf/mesh.h - the surface a solver works on: intake, repair report, components. */
#ifndef HF_MESH_H
#define HF_MESH_H

#include "hf/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A solver: one surface, its operator and factor, and a set of sites. Children (poses, transfers, clones) keep what
 * they share alive, so handles may be destroyed in any order. */
typedef struct hf_solver_object* hf_solver;

/* How vertices at one place are joined before anything is computed. Game assets are cut at texture seams: a horse is
 * 1,109 pieces as stored and one welded. Results are scattered back to every copy. */
enum {
  HF_WELD_EXACT = 0,    /* bit-equal positions (+0 and -0 are equal) */
  HF_WELD_NONE = 1,     /* vertices as stored */
  HF_WELD_TOLERANCE = 2 /* positions closer than weld_tolerance, transitively */
};

/* The discrete Laplacian K: (K u)_i = sum_j w_ij (u_i - u_j). */
enum {
  HF_OPERATOR_INTRINSIC_DELAUNAY = 0, /* the default: cotangent weights of the intrinsic Delaunay triangulation of the
                                         same surface, on the tufted cover where edges are open or shared by more than
                                         two triangles (Bobenko and Springborn 2007; Sharp and Crane 2020): never
                                         negative, so the maximum principle holds on any mesh; equal to the cotangent
                                         operator where the triangles are Delaunay already */
  HF_OPERATOR_CLAMPED = 1,  /* cotangents, floored at 1e-3 of the median weight: the maximum principle holds on any mesh */
  HF_OPERATOR_UNIFORM = 2,  /* w_ij = 1 */
  HF_OPERATOR_COTANGENT = 3 /* w_ij = (cot a_ij + cot b_ij) / 2, the paper's; may be negative on obtuse triangles */
};

/* What the field minimises, with L the operator_kind's Laplacian. All site edits and engines are the same. A bi-harmonic
 * field is smooth through its sites and overshoots their values; its factor is 3 to 4 times larger, its solve takes one
 * correction with the true operator. HF_ENGINE_UPDOWN, whose sites are penalties, gives a bi-harmonic field to about 2e-7
 * of the largest value; the other engines to 1e-10. */
enum {
  HF_FIELD_HARMONIC = 0,        /* K = L */
  HF_FIELD_BIHARMONIC = 1,      /* K = L M^-1 L, M the lumped vertex areas scaled to mean 1 by component: the same field
                                   at any scale of the mesh */
  HF_FIELD_BIHARMONIC_GRAPH = 2 /* K = L^2, the paper's: depends on how the surface is sampled */
};

/* How sites act on the factor; all three give the same field. See the README for which to choose. */
enum {
  HF_ENGINE_GREEN = 0,  /* factor once; sites live in a small dense system. The default */
  HF_ENGINE_UPDOWN = 1, /* the paper's: penalty on the diagonal, sparse update and downdate (builds with HF_WITH_GPL) */
  HF_ENGINE_REFACTOR = 2 /* eliminates the sites and factorises again at every change: the baseline */
};

/* Fill-reducing ordering of the factor. */
enum {
  HF_ORDERING_NESTED_DISSECTION = 0, /* our own */
  HF_ORDERING_MINIMUM_DEGREE = 1,    /* approximate minimum degree of the whole matrix */
  HF_ORDERING_METIS = 2              /* METIS (builds with HF_WITH_GPL) */
};

/* A factor saved by hf_save_factor (hf/factor.h), to be loaded instead of made. byte_count is a size_t like the size of
 * any block of memory: as wide as the pointer beside it. */
typedef struct hf_factor_desc {
  uint32_t struct_size;
  int32_t borrow;    /* 0: the bytes are copied. Otherwise the numbers are read in place: the host keeps the bytes (a
                        mapped file, say) where they are and unchanged until the solver, its clones and everything made
                        from them are destroyed; bytes must then be aligned to HF_FACTOR_ALIGNMENT */
  const void* bytes; /* all of them, as saved */
  size_t byte_count;
} hf_factor_desc;
enum { HF_FACTOR_ALIGNMENT = 64 };

/* What hf_create is given. Zero every field that is not needed (HF_INIT).
 * Either positions or positions_f64 is set. Strides are in bytes between vertices; 0 means tightly packed. */
typedef struct hf_create_desc {
  uint32_t struct_size;
  uint32_t vertex_count;       /* >= 1 */
  uint32_t triangle_count;     /* >= 1 */
  uint32_t position_stride;    /* bytes; 0 = packed xyz */
  const float* positions;      /* [vertex_count][3], any unit, any offset: centred and scaled inside */
  const double* positions_f64; /* [vertex_count][3], instead of positions */
  const uint32_t* triangles;   /* [triangle_count][3], counter-clockwise, packed */
  int32_t weld;                /* HF_WELD_* */
  float weld_tolerance;        /* for HF_WELD_TOLERANCE, in the unit of the positions, > 0 */
  int32_t operator_kind;       /* HF_OPERATOR_* */
  int32_t engine;              /* HF_ENGINE_* */
  int32_t ordering;            /* HF_ORDERING_* */
  uint32_t channel_count;      /* fields solved at once, 1 to 64; 0 = 1 */
  uint32_t thread_count;       /* threads the library may use, the caller's included, 1 to 256; 0 = 1 */
  uint32_t site_limit;         /* most sites the solver may hold; 0 = 100,000 */
  uint32_t vertex_limit;       /* refuse larger meshes before allocating; 0 = 20,000,000 */
  uint32_t memory_limit_mb;    /* refuse to hold more memory than this, in MiB; 0 = no limit */
  double penalty; /* weight of a hard site in HF_ENGINE_UPDOWN relative to the mean diagonal; 0 = the paper's 1e8;
                     clamped to 1e10 */
  hf_allocator allocator;   /* zero = malloc */
  hf_job_runner job_runner; /* zero = threads of our own */
  hf_progress progress;     /* NULL, or an object to poll and cancel through */
  const hf_factor_desc* saved_factor; /* NULL, or the factor of this mesh; ordering must then be 0 or that of the
                                         factor */
  int32_t field_kind;      /* HF_FIELD_* */
  uint32_t triangle_limit; /* refuse more triangles before allocating; 0 = eight per vertex of the vertex limit */
} hf_create_desc;

/* Creates a solver: welds, builds the operator, orders and factorises it. The mesh is copied; nothing of the desc is
 * kept but the hooks. Dirty input is accepted with a defined result and counted in the report (hf_get_mesh_report):
 * non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices, islands.
 *
 * desc: see above. out_solver: set to NULL first, to the new handle on success.
 * Results: HF_OK; HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT; HF_ERROR_EMPTY (no vertex or
 * no triangle); HF_ERROR_OUT_OF_RANGE (index = triangle); HF_ERROR_NON_FINITE (index = vertex); HF_ERROR_TOO_LARGE
 * (a limit); HF_ERROR_UNSUPPORTED (engine or ordering not in this build); HF_ERROR_OUT_OF_MEMORY; HF_ERROR_CANCELLED;
 * HF_ERROR_NOT_POSITIVE_DEFINITE. With saved_factor also: HF_ERROR_INVALID_ARGUMENT (bytes that are no saved factor, are
 * cut short or damaged, belong to another mesh, to other positions or to another operator; borrowed bytes that are not
 * aligned), HF_ERROR_UNSUPPORTED (another format version or byte order). Damage is found by a checksum; forged bytes can
 * give a wrong field but no access outside them. After a failure nothing exists. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_create(const hf_create_desc* desc, hf_solver* out_solver);

/* Creates a solver that shares mesh, operator and factor with this one and has its own copy of the sites: many site
 * sets, undo, many threads on one immutable factor. Costs the site set only. *out_solver is set to NULL first. Results:
 * HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: reads
 * `solver`. Since 0.1. */
HF_API hf_result hf_clone(hf_solver solver, hf_solver* out_solver);

/* Destroys a solver. NULL, stale and foreign handles are ignored. What children share lives until the last of them is
 * gone. Thread safety: not while another thread uses this handle (that call is finished first, safely). Since 0.1. */
HF_API void hf_destroy(hf_solver solver);

/* What was found in the mesh. */
typedef struct hf_mesh_report {
  uint32_t struct_size;
  uint32_t vertex_count;          /* as given */
  uint32_t triangle_count;        /* as given */
  uint32_t welded_vertex_count;   /* after welding */
  uint32_t component_count;       /* connected components with at least one triangle, after welding */
  uint32_t isolated_vertex_count; /* given vertices in no usable triangle; their field value is the unreached value */
  uint32_t degenerate_triangle_count; /* zero area to working precision */
  uint32_t collapsed_triangle_count;  /* two or three equal corners after welding; left out */
  uint32_t duplicate_triangle_count;  /* the same three corners again */
  uint32_t non_manifold_edge_count;   /* edges of three or more triangles */
  uint32_t flipped_edge_count;        /* edges that two triangles run through in the same direction */
  uint32_t boundary_edge_count;
  uint32_t negative_edge_count; /* edges of negative cotangent weight, before any clamping */
  float smallest_angle;         /* radians, over the usable triangles */
  double bounding_box_diagonal; /* in the unit of the positions */
} hf_mesh_report;

/* Writes the report of the solver's mesh; out_report->struct_size must be set. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_get_mesh_report(hf_solver solver, hf_mesh_report* out_report);

/* Writes the component of every given vertex, uint32_t[vertex_count]; HF_NO_INDEX for isolated vertices. Components are
 * numbered by their smallest vertex. vertex_count: size of the array, must equal the mesh's. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_TOO_SMALL. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_get_components(hf_solver solver, uint32_t vertex_count, uint32_t* out_components);

#ifdef __cplusplus
}
#endif
#endif
