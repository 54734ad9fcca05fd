/* hf/solver.h - sites that come and go, and the smooth field through them.
 *
 * A site holds the field at a value: at a vertex, at a point of a triangle, or on a disc. Between sites the field u is
 * harmonic: K u = W lambda, W' u = s. K is the Laplacian of the surface, W has one column w_i per site (three barycentric
 * weights, say), s holds the values, lambda the flux into each site. A soft site of stiffness alpha obeys
 * w_i' u + lambda_i / alpha = s_i, the penalty method of Xu, Zhang, Cohen-Or and Xiong (2009). Open borders have zero
 * flux. Edits do not factorise: only very many sites at once are moved into the factor, when that is quicker
 * (hf_solver_statistics.factorisation_count counts it).
 */
#ifndef HF_SOLVER_H
#define HF_SOLVER_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A set of sites on a surface, and their field. */
typedef struct hf_solver_object* hf_solver;

/* How sites act on the factor. All engines give the same field. */
enum {
  HF_ENGINE_GREEN = 0,  /* sites live in a small dense system beside the factor: the default */
  HF_ENGINE_UPDOWN = 1, /* the paper's: penalties on the diagonal, sparse update and downdate; builds with HF_WITH_GPL.
                           Sites hold to about 1e-8 of the value range, bi-harmonic fields to 2e-7 */
  HF_ENGINE_REFACTOR = 2 /* eliminates the sites and factorises again at every change: the baseline */
};

typedef struct hf_solver_desc {
  uint32_t struct_size;
  int32_t field_kind;     /* HF_FIELD_*; if the surface has no factor of that kind yet, it is made now */
  int32_t engine;         /* HF_ENGINE_* */
  uint32_t channel_count; /* fields solved at once, 1 to 64; 0 = 1 */
  uint32_t site_limit;    /* most sites the solver may hold; 0 = 100,000 */
  uint32_t reserved;      /* 0 */
  double penalty;         /* HF_ENGINE_UPDOWN: weight of a hard site relative to the mean diagonal; 0 = 1e8, at most 1e10 */
  hf_progress progress;   /* NULL, or an object to poll and cancel through */
} hf_solver_desc;

/* Creates a solver without sites. desc: NULL for defaults. Sets *out_solver to NULL first. Cost: nothing but the factor
 * that may be missing. Errors: HF_ERROR_INVALID_ARGUMENT, HF_ERROR_UNSUPPORTED (engine not in this build),
 * HF_ERROR_CANCELLED, HF_ERROR_NOT_POSITIVE_DEFINITE. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver);

/* Creates a solver with the same sites, without the undo stack. Costs the sites only: many sets of sites and many
 * threads can share one factor. Sets *out_solver to NULL first. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_clone(hf_solver solver, hf_solver* out_solver);

/* Destroys a solver. Ignores NULL and destroyed handles. Thread safety: a call under way on another thread ends first.
 * Since 0.1. */
HF_API void hf_solver_destroy(hf_solver solver);

/* What a solver was made with, defaults filled in, and what it holds. */
typedef struct hf_solver_info {
  uint32_t struct_size;
  int32_t field_kind;
  int32_t engine;
  uint32_t channel_count;
  uint32_t site_limit;
  uint32_t site_count;
  double penalty;
  uint32_t vertex_count; /* as given to the surface: rows of a field */
  uint32_t reserved;
} hf_solver_info;

/* Writes what a solver was made with. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_info(hf_solver solver, hf_solver_info* out_info);

/* ---- sites ---- */

/* Places and values of sites. Set vertices, or triangles with barycentrics. A point site loses influence as the mesh is
 * refined. A radius makes it independent of the mesh: the site then holds a geodesic disc, and is a point below the mesh
 * spacing. A soft disc shares its stiffness among its vertices. Vertices on the rim of a disc (all of it for bi-harmonic
 * fields) count towards site_limit. */
typedef struct hf_sites_desc {
  uint32_t struct_size;
  uint32_t site_count;        /* >= 1 */
  const uint32_t* vertices;   /* [site_count] vertices as given, or NULL */
  const uint32_t* triangles;  /* [site_count] triangles as given, or NULL */
  const double* barycentrics; /* [site_count][3] with triangles: weights of the corners, >= 0, of sum 1 within 1e-6 */
  const double* values;       /* [site_count][channel_count], up to 1e200 in size; NULL = 0 */
  const double* stiffness;    /* [site_count] relative to the mean diagonal of K; 0 = hard (exact); NULL = all hard;
                                 clamped to 1e-12 .. 1e12 */
  const double* radii;        /* [site_count] geodesic radius in the unit of the mesh; 0 = a point; NULL = all points */
} hf_sites_desc;

/* Adds sites. out_sites: NULL, or uint32_t[site_count] for their numbers. A site keeps its number until it is removed;
 * free numbers are used again. Errors: HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (weights,
 * stiffness, isolated vertex), HF_ERROR_DUPLICATE_SITE (the vertex, or a welded copy, has a site of the same values),
 * HF_ERROR_CONFLICT (of other values, or the point depends linearly on hard sites), HF_ERROR_TOO_LARGE (site_limit, a
 * value). Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_add_sites(hf_solver solver, const hf_sites_desc* sites, uint32_t* out_sites);

/* Adds one hard site at a vertex. values: double[channel_count], or NULL for 0. out_site: NULL, or its number. Errors: as
 * hf_add_sites. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_add_site(hf_solver solver, uint32_t vertex, const double* values, uint32_t* out_site);

/* Removes sites by number: uint32_t[site_count]. A component without sites is not reached; adding one again is exact.
 * Errors: HF_ERROR_NO_SUCH_SITE (also for a number named twice). Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_remove_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites);

/* Moves sites to new places. They keep number, value, stiffness and radius. to: the places, as many as sites; its values,
 * stiffness and radii are NULL. Errors: as hf_add_sites and hf_remove_sites. Thread safety: changes `solver`. Since 0.1.
 */
HF_API hf_result hf_solver_move_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                      const hf_sites_desc* to);

/* Gives sites new values: double[site_count][channel_count]. Costs nothing until the next solve. Errors:
 * HF_ERROR_NO_SUCH_SITE, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (a value). Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_set_values(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                      const double* values);

/* One batch of edits, in the order remove, move, set, add. A count of 0 leaves a part out. */
typedef struct hf_edit_desc {
  uint32_t struct_size;
  uint32_t remove_count;
  const uint32_t* remove_sites; /* [remove_count] */
  uint32_t move_count;
  uint32_t set_count;
  const uint32_t* move_sites;   /* [move_count] */
  const hf_sites_desc* move_to; /* move_count places */
  const uint32_t* set_sites;    /* [set_count] */
  const double* set_values;     /* [set_count][channel_count] */
  const hf_sites_desc* add;     /* NULL, or the sites to add */
} hf_edit_desc;

/* Applies a batch of edits at once. out_sites: NULL, or uint32_t[add->site_count]. Errors: as the single calls; `index`
 * is the position inside the failing part. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_edit_sites(hf_solver solver, const hf_edit_desc* edit, uint32_t* out_sites);

/* Number of sites; 0 for an invalid handle. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_solver_get_site_count(hf_solver solver);

/* Where sites are and what they hold. Arrays are yours, NULL or of `capacity` entries, by ascending site number. */
typedef struct hf_sites_info {
  uint32_t struct_size;
  uint32_t capacity;    /* in: entries of each array */
  uint32_t count;       /* out: number of sites */
  uint32_t reserved;    /* 0 */
  uint32_t* sites;      /* numbers */
  uint32_t* vertices;   /* the vertex given, HF_NO_INDEX for a point in a triangle */
  uint32_t* components;
  double* values;       /* [capacity][channel_count] */
  double* stiffness;    /* 0 = hard */
  double* flux;         /* [capacity][channel_count] lambda: what flows into the surface at the site, in value x weight;
                           the sum over a disc */
  double* radii;        /* 0 = a point */
} hf_sites_info;

/* Writes all sites. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_sites(hf_solver solver, hf_sites_info* inout_info);

/* ---- fields ---- */

/* What the sites of a solve did not reach. */
typedef struct hf_solve_info {
  uint32_t struct_size;
  uint32_t unreached_component_count; /* components without a site */
  uint32_t first_unreached_component; /* HF_NO_INDEX for none */
  uint32_t unreached_vertex_count;    /* given vertices in them, isolated ones included */
} hf_solve_info;

/* Solves for the field at every vertex as given. out_values: float[vertex_count] rows of channel_count values,
 * value_stride bytes apart (0 = packed). out_info: NULL, or what was not reached; the field is 0 there. Hard sites hold
 * their values exactly. Cost: one backward sweep through the factor; bi-harmonic fields three sweeps. Errors:
 * HF_ERROR_NO_SITES. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve(hf_solver solver, float* out_values, uint32_t value_stride, hf_solve_info* out_info);

/* The same in double. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_f64(hf_solver solver, double* out_values, uint32_t value_stride,
                                     hf_solve_info* out_info);

/* The field at chosen vertices only, with the same bits as hf_solver_solve_f64: double[vertex_count][channel_count] for
 * uint32_t[vertex_count] vertices. Sweeps the union of their elimination paths only, on the calling thread. One path is
 * up to a sixth of the factor; many share most of it. Costs a whole solve for bi-harmonic fields, and after very many
 * sites were moved into the factor. Unreached vertices get 0. Errors: HF_ERROR_NO_SITES, HF_ERROR_TOO_LARGE (more
 * vertices than the mesh has), HF_ERROR_OUT_OF_RANGE. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_at(hf_solver solver, uint32_t vertex_count, const uint32_t* vertices,
                                    double* out_values);

/* A tangent vector field the paper's way (Section 3.3), for solvers of 3 channels. Channels are the components of the
 * constraint vectors. Each is solved as a field; the result is projected on the tangent plane of the vertex,
 * v - (n . v) n, n the area-weighted normal. out_vectors: float[vertex_count][3], vector_stride bytes apart (0 = packed),
 * not normalised. out_normals: NULL, or double[vertex_count][3], packed: the normals used. Errors: as hf_solve,
 * HF_ERROR_INVALID_ARGUMENT (not 3 channels). Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_vectors(hf_solver solver, float* out_vectors, uint32_t vector_stride,
                                         double* out_normals, hf_solve_info* out_info);

/* The same in double. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_vectors_f64(hf_solver solver, double* out_vectors, uint32_t vector_stride,
                                             double* out_normals, hf_solve_info* out_info);

/* ---- previews in single precision ---- */

/* What a preview reached. */
typedef struct hf_preview_info {
  uint32_t struct_size;
  int32_t exact;                      /* 1: solved in double, as hf_solve does */
  uint32_t correction_count;          /* corrections made; 0 when exact */
  uint32_t unreached_component_count; /* components without a site; their vertices hold 0 */
  double value_range;                 /* largest less smallest site value, the widest over components and channels */
  double largest_correction;          /* largest change of a value by the last correction: about the error before it */
  double error_estimate; /* of the largest error, in the unit of the values: measured when corrections were made, else
                            1e-5 of value_range; 0 when exact */
  double preview_bytes;  /* memory of the single-precision copy, shared by the surface */
} hf_preview_info;

/* Solves with the factor in single precision: half the bytes of hf_solve, for a value or a site that is being dragged.
 * The error is about 1e-6 of the value range for harmonic fields, up to 1e-5 for bi-harmonic ones and crowded sites.
 * Hard sites at vertices are exact. A correction (iterative refinement, Wilkinson 1963) takes the error below 1e-9,
 * a second below 1e-12; each costs two to three calls of hf_solve.
 *
 * The single-precision copy is made at the first call (about two solves), shared by all solvers of that kind on the
 * surface, and freed with the last of them or by hf_solver_release_preview. Other engines, and solvers whose sites were
 * moved into the factor, answer with the exact field and say so in out_info.
 *
 * out_values: as hf_solve. correction_count: 0 to 8. out_info: NULL, or a struct. Errors: HF_ERROR_INVALID_ARGUMENT
 * (correction_count), HF_ERROR_NO_SITES. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_preview(hf_solver solver, float* out_values, uint32_t value_stride,
                                         uint32_t correction_count, hf_preview_info* out_info);

/* The same into double, where corrections show. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_preview_f64(hf_solver solver, double* out_values, uint32_t value_stride,
                                             uint32_t correction_count, hf_preview_info* out_info);

/* Frees the single-precision copy, for all solvers that share it, after calls that use it. The next preview makes it
 * again. Thread safety: any thread, beside any function. Since 0.1. */
HF_API hf_result hf_solver_release_preview(hf_solver solver);

/* ---- vectors of a 3-channel solver ---- */

/* Moves vector sites to other vertices of their components. Each vector is carried along the shortest path of edges,
 * from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3). vertices: [site_count].
 * Errors: HF_ERROR_INVALID_ARGUMENT (not 3 channels, another component, isolated vertex), HF_ERROR_NO_SUCH_SITE,
 * HF_ERROR_OUT_OF_RANGE, HF_ERROR_DUPLICATE_SITE, HF_ERROR_CONFLICT. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_move_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                        const uint32_t* vertices);

/* Turns vectors of sites about their vertex normals, counter-clockwise by angles[i] radians. Touches no factor. Errors:
 * HF_ERROR_INVALID_ARGUMENT (not 3 channels), HF_ERROR_NO_SUCH_SITE, HF_ERROR_NON_FINITE. Thread safety: changes
 * `solver`. Since 0.1. */
HF_API hf_result hf_solver_rotate_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                          const double* angles);

/* ---- how right a field is ---- */

/* Errors are relative to the range of the site values of the component and channel (to their size where all are equal).
 * A value that is not finite counts as infinitely wrong. */
typedef struct hf_certificate {
  uint32_t struct_size;
  int32_t overshoot_checked; /* out: 1 where a field must keep to the range of its sites: harmonic, intrinsic Delaunay or
                                clamped operator, all sites at vertices */
  double tolerance;   /* in: largest error to accept, > 0; 0 = 1e-8, HF_ENGINE_UPDOWN 1e-5; out: the one used */
  double value_range; /* out: largest less smallest site value, the widest over components and channels */
  double residual;    /* out: largest |(K u - W lambda)_v| / K_vv, how far a value is from the mean of its neighbours.
                         Not judged: on a long shape the error may be many times larger, on others smaller */
  double site_error;  /* out: largest |w_i' u + lambda_i / alpha_i - s_i|, what a site misses its value by */
  double overshoot;   /* out: how far the field leaves the range of its sites; 0 when not checked */
  uint32_t worst_vertex; /* out: as given, where the largest of error_estimate, site_error and overshoot is */
  uint32_t reserved;     /* 0 */
  double error_estimate; /* out: how far a value may be from the exact field: a bound by K alone where no weight is
                            negative and the field harmonic, else an estimate by corrections */
} hf_certificate;

/* Solves the field, puts it back into its equations and bounds its error. It trusts only K and the site values, so it
 * finds a damaged factor, borrowed bytes that changed, or a fault of the machine. inout_certificate is also written with
 * HF_ERROR_INACCURATE when error_estimate, site_error or overshoot is above the tolerance (index = worst vertex): do not use
 * fields of this solver then, make the surface again. K has the weights used: hf_surface_report says where a rule set
 * them. Cost: three solves and a pass over the edges. Errors: HF_ERROR_INACCURATE, HF_ERROR_INVALID_ARGUMENT (tolerance), HF_ERROR_NO_SITES.
 * Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_certify(hf_solver solver, hf_certificate* inout_certificate);

/* ---- undo ---- */

/* Records the sites for undo. The last 256 records are kept. Costs the site list; the rest is shared. Thread safety:
 * changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_record(hf_solver solver);
/* Goes back to the last record; the field then has the same bits as at the record. Errors: HF_ERROR_NO_RECORD. Thread
 * safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_undo(hf_solver solver);
/* Takes the last undo back. Errors: HF_ERROR_NO_RECORD. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_redo(hf_solver solver);

/* ---- very many sites ---- */

/* Moves the hard vertex sites into the factor without a pause. It factorises once on the calling thread, one of yours,
 * while other threads edit and solve this solver. The next edit takes the result over. Fields are the same before and
 * after, to rounding. Call it when hf_solver_statistics.rebase_advised is 1. An edit of very many sites does it by itself
 * when that is quicker. Memory: one more factor while sites stay in it. Errors: HF_ERROR_NO_SITES (no hard site at a
 * vertex), HF_ERROR_UNSUPPORTED (other engines), HF_ERROR_BUSY (another thread prepares). Thread safety: beside any
 * function of the same solver. Since 0.1. */
HF_API hf_result hf_solver_prepare_rebase(hf_solver solver);

/* How the last edit of places was done (hf_solver_statistics.last_route). */
enum {
  HF_ROUTE_NONE = 0,  /* no place was edited yet, or the engine is not green */
  HF_ROUTE_DENSE = 1, /* rows of the dense system came and went */
  HF_ROUTE_FRESH = 2, /* the dense system was recomputed, which was quicker */
  HF_ROUTE_REBASE = 3 /* hard vertex sites were moved into the factor */
};

/* What a solver holds and has done. Bytes are doubles (exact to 2^53). */
typedef struct hf_solver_statistics {
  uint32_t struct_size;
  uint32_t site_count;
  uint32_t factorisation_count; /* numeric factorisations this solver made; the surface's own is not counted */
  uint32_t path_solve_count;    /* sites whose elimination path was solved */
  uint32_t sweep_count;         /* backward sweeps */
  uint32_t last_route;          /* HF_ROUTE_* of the last edit */
  uint32_t rebase_count;        /* times sites were moved into the factor */
  uint32_t dense_edit_count;    /* edits by rows of the dense system */
  uint32_t dense_row_count;     /* sites in the dense system at present */
  uint32_t eliminated_count;    /* sites in the factor at present */
  int32_t rebase_advised;       /* 1: elimination paths outweigh the factor, fields get slower: hf_solver_prepare_rebase */
  uint32_t reserved;
  double site_memory_bytes;   /* paths and dense part of the sites */
  double predicted_dense_ms;  /* the cost model's estimate for the last edit by rows of the dense system ... */
  double predicted_rebase_ms; /* ... and by a rebase, on one thread of the machine it was measured on; 0: none */
} hf_solver_statistics;

/* Writes the statistics. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_statistics(hf_solver solver, hf_solver_statistics* out_statistics);

#ifdef __cplusplus
}
#endif
#endif
