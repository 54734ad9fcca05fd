/* hf/field.h - sites and harmonic fields.
 *
 * A field u is harmonic off its sites: K u = W lambda, W' u = s, with K the Laplacian of the surface, one column w_i of
 * W per site (a vertex, or a point inside a triangle as three barycentric weights) and s the site values (Dirichlet
 * conditions). A soft site of stiffness alpha obeys w_i' u + lambda_i / alpha = s_i instead, which is the penalty
 * method of Xu, Zhang, Cohen-Or and Xiong (2009). Open borders are natural (zero flux). Sites are inserted, removed and
 * moved at any time without a new factorisation; only batches of very many sites may be moved into the factor, when
 * that is predicted to be cheaper (hf_statistics.factorisation_count counts it).
 */
#ifndef HF_FIELD_H
#define HF_FIELD_H

#include "hf/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A batch of new sites. Either vertices, or triangles with barycentrics. A point is no obstacle in two dimensions: the
 * finer the mesh, the less it holds of the field. A site with a radius holds a geodesic disc of the surface and acts the
 * same on coarse and fine meshes; below the mesh spacing it is a point. A soft disc shares its stiffness among its
 * vertices. The vertices on its rim (all of the disc for bi-harmonic fields) count towards site_limit. */
typedef struct hf_sites_desc {
  uint32_t struct_size;
  uint32_t site_count;       /* >= 1 */
  const uint32_t* vertices;  /* [site_count] vertices of the mesh as given, or NULL */
  const uint32_t* triangles; /* [site_count] triangles of the mesh as given, or NULL */
  const double*
      barycentrics; /* [site_count][3] with triangles: weights of the three corners, >= 0, summing to 1 within 1e-6 */
  const double* values;    /* [site_count][channel_count], up to 1e200 in size; NULL = 0 */
  const double* stiffness; /* [site_count] relative to the mean diagonal of K; 0 = hard (exact); NULL = all hard;
                              clamped to [1e-12, 1e12] */
  const double* radii; /* [site_count] geodesic radius in the unit of the positions; 0 = a point; NULL = all points */
} hf_sites_desc;

/* Adds sites. out_sites: NULL, or uint32_t[site_count] receiving the numbers of the new sites. A site keeps its number
 * until it is removed; numbers are reused later. All or nothing. Results: HF_OK; HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_EMPTY (site_count 0); HF_ERROR_OUT_OF_RANGE (index = position
 * in the batch); HF_ERROR_NON_FINITE; HF_ERROR_INVALID_ARGUMENT (weights, stiffness; isolated vertex);
 * HF_ERROR_DUPLICATE_SITE (the vertex, or a welded copy of it, carries a site with the same values); HF_ERROR_CONFLICT
 * (... with other values; or the point depends linearly on hard sites that are there); HF_ERROR_TOO_LARGE (site_limit, value);
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after failure: unchanged. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_add_sites(hf_solver solver, const hf_sites_desc* sites, uint32_t* out_sites);

/* Removes sites by number: uint32_t[site_count]. Removing the last site of a component leaves it unreached; adding one
 * again is exact. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_SITE
 * (index = position in the list; also for a number named twice), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after
 * failure: unchanged. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_remove_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites);

/* Moves sites to new places, keeping their numbers, values and stiffness. to: where, its site_count must match; its
 * values and stiffness must be NULL. Results: as hf_add_sites and hf_remove_sites. State after failure: unchanged.
 * Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_move_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites, const hf_sites_desc* to);

/* Gives sites new values: double[site_count][channel_count]. Costs nothing until the next solve. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_SITE, HF_ERROR_NON_FINITE,
 * HF_ERROR_TOO_LARGE (a value), HF_ERROR_BUSY. State after failure: unchanged. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_set_site_values(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* values);

/* One batch of all of these, in the order remove, move, set, add; all or nothing. Counts of 0 leave a part out. */
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

/* Applies a batch. out_sites: NULL, or uint32_t[add->site_count]. Results and state after failure: as the single calls;
 * the detail's index is the position inside the failing part. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_edit_sites(hf_solver solver, const hf_edit_desc* edit, uint32_t* out_sites);

/* Number of sites the solver holds, 0 for an invalid handle. Thread safety: reads `solver`. Since 0.1. */
HF_API uint32_t hf_get_site_count(hf_solver solver);

/* Where sites are and what they hold. Arrays of the caller, each NULL or large enough for `capacity` sites. */
typedef struct hf_site_info {
  uint32_t struct_size;
  uint32_t capacity;  /* sites the arrays can take */
  uint32_t* sites;    /* site numbers, ascending */
  uint32_t* vertices; /* the vertex given, HF_NO_INDEX for a point in a triangle */
  uint32_t* components;
  double* values;    /* [capacity][channel_count] */
  double* stiffness; /* 0 = hard */
  double* flux; /* [capacity][channel_count] lambda of the last edit: what flows into the surface at the site, unit:
                   value x weight; of a disc the sum over its vertices */
  double* radii; /* 0 = a point */
} hf_site_info;

/* Writes all sites. out_info->capacity must be at least hf_get_site_count. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_TOO_SMALL, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread
 * safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_get_sites(hf_solver solver, hf_site_info* out_info);

/* What a solve reached. struct_size must be set. */
typedef struct hf_solve_info {
  uint32_t struct_size;
  uint32_t unreached_component_count; /* components without a site */
  uint32_t first_unreached_component; /* HF_NO_INDEX for none */
  uint32_t unreached_vertex_count;    /* given vertices that hold the unreached value, isolated ones included */
} hf_solve_info;

/* Solves for the field at every vertex of the mesh as given (welded copies get the same value).
 * out_values: float[vertex_count] rows of channel_count values, value_stride bytes apart (0 = packed).
 * Vertices that no site reaches (isolated, or in a component without a site) are written as unreached_value 0 and
 * counted in out_info (NULL, or a struct with struct_size set). The values of hard sites are exact. Cost: one backward
 * sweep through the factor; bi-harmonic fields take a refinement step, three sweeps in all. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_TOO_SMALL
 * (stride), HF_ERROR_NO_SITES, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. On failure the output is not written. Thread
 * safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve(hf_solver solver, float* out_values, uint32_t value_stride, hf_solve_info* out_info);

/* The same in double. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve_f64(hf_solver solver, double* out_values, uint32_t value_stride, hf_solve_info* out_info);

/* A tangent vector field, the paper's way (its Section 3.3): the three channels are the components of the constraint
 * vectors; each is solved as a harmonic field, and the result is projected on the tangent plane of the vertex, v - (n .
 * v) n, n the area-weighted vertex normal. The solver needs channel_count 3. Constraint vectors are turned with
 * hf_set_site_values, which touches no factor. out_vectors: float[vertex_count][3], vector_stride bytes apart (0 =
 * packed), not normalised. out_normals: NULL, or double[vertex_count][3], packed: the normals used. Results: as
 * hf_solve; HF_ERROR_INVALID_ARGUMENT when channel_count is not 3. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve_vectors(hf_solver solver, float* out_vectors, uint32_t vector_stride, double* out_normals,
                                  hf_solve_info* out_info);

/* The same in double. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve_vectors_f64(hf_solver solver, double* out_vectors, uint32_t vector_stride,
                                      double* out_normals, hf_solve_info* out_info);

/* The field at chosen vertices only: double[vertex_count][channel_count] for uint32_t[vertex_count] vertices, the same
 * bits as hf_solve_f64 gives them. No sweep over the mesh: the backward sweep is done on the union of their elimination
 * paths (one path is up to a sixth of the factor on a surface, many share most of it), on the calling thread. After very
 * many sites were moved into the factor, and for bi-harmonic fields, it costs a whole solve. Unreached vertices get 0.
 * Results: as hf_solve; HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE (more vertices than the mesh has), HF_ERROR_OUT_OF_RANGE
 * (index = position in the list). Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve_at(hf_solver solver, uint32_t vertex_count, const uint32_t* vertices, double* out_values);

/* How right a field is; struct_size must be set. Errors are relative to the range of the site values of the component and
 * channel (where all are equal, to their size); what is not finite counts as infinitely wrong. */
typedef struct hf_certificate {
  uint32_t struct_size;
  uint32_t overshoot_checked; /* out: 1 when the maximum principle holds here: no positive weight off the diagonal of K
                                 (the intrinsic and clamped operators), harmonic, all sites at vertices */
  double tolerance;   /* in: largest error to accept, > 0; 0 = 1e-8, for HF_ENGINE_UPDOWN, whose sites are penalties, 1e-5;
                         out: the one used */
  double value_range; /* out: largest less smallest site value, the widest over components and channels */
  double residual;    /* out: largest |(K u - W lambda)_v| / K_vv, how far a value is from the mean of its neighbours */
  double site_error;  /* out: largest |w_i' u + lambda_i / alpha_i - s_i|, what a site misses its value by */
  double overshoot;   /* out: how far the field leaves the range of its sites' values; 0 when not checked */
  uint32_t worst_vertex; /* out: of the mesh as given, where the largest of the three is */
  uint32_t reserved;     /* 0 */
} hf_certificate;

/* Solves the field and measures what is left of its equations when it is put in. The factor, the sites' paths and the
 * dense system are not trusted: K and the site values alone are looked at, so that a damaged factor (borrowed bytes that
 * changed, forged ones) or a fault of the library or the machine shows. Cost: a solve and a product with K.
 * inout_certificate: written also with HF_ERROR_INACCURATE, which says that an error exceeds the tolerance (index =
 * worst vertex); then the solver's fields are not to be used, and it is to be made anew. Results: HF_OK,
 * HF_ERROR_INACCURATE, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT
 * (tolerance), HF_ERROR_NO_SITES, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Nothing is changed. Thread safety: reads
 * `solver`. Since 0.1. */
HF_API hf_result hf_certify(hf_solver solver, hf_certificate* inout_certificate);

/* Keeps the present site set on the undo stack (at most 256 are kept; the oldest goes first). Costs the site set,
 * shared parts are not copied. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread
 * safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_record(hf_solver solver);
/* Goes back to the last record; hf_redo comes back. The field afterwards is the same bits as it was at the record.
 * Results: HF_OK, HF_ERROR_NO_RECORD, HF_ERROR_INVALID_HANDLE, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after
 * failure: unchanged. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_undo(hf_solver solver);
HF_API hf_result hf_redo(hf_solver solver);

/* Moves the hard vertex sites there are into the factor, without a pause: factorises once on the calling thread, which
 * is to be one of the host's own, while other threads go on editing and solving this solver. The result waits inside and
 * the next edit takes it over, with what changed meanwhile applied on top, at the price of those changes; fields are the
 * same before and after, to rounding. Worth calling when hf_statistics.rebase_advised says so; very large batches of new
 * sites are moved by the edit itself when that is cheaper. Memory: one more factor while sites stay in it. Results:
 * HF_OK; HF_ERROR_INVALID_HANDLE; HF_ERROR_NO_SITES (no hard site on a vertex); HF_ERROR_UNSUPPORTED (other engines than
 * green); HF_ERROR_BUSY (another thread prepares one); HF_ERROR_OUT_OF_MEMORY. State after failure: unchanged. Thread
 * safety: may run beside any function of the same solver. Since 0.1. */
HF_API hf_result hf_prepare_rebase(hf_solver solver);

/* Which way the last edit of places went (hf_statistics.last_route). */
enum {
  HF_ROUTE_NONE = 0,   /* no place was edited yet, or the engine is not green */
  HF_ROUTE_DENSE = 1,  /* rows of the dense system came and went */
  HF_ROUTE_FRESH = 2,  /* the dense system was made anew, which was cheaper */
  HF_ROUTE_REBASE = 3  /* hard vertex sites were moved into the factor */
};

/* Figures of a solver. Times in milliseconds of the phases of hf_create; bytes as double (exact to 2^53). */
typedef struct hf_statistics {
  uint32_t struct_size;
  uint32_t unknown_count; /* size of the factored matrix */
  double weld_ms, operator_ms, ordering_ms, symbolic_ms, numeric_ms;
  double factor_entries; /* non-zeros of the Cholesky factor */
  double factor_bytes;   /* memory of the stored factor with its indices */
  double factor_flops;
  double memory_bytes; /* live, of this solver and all that share its allocator state */
  double peak_memory_bytes;
  double site_memory_bytes; /* paths and dense part of this solver's sites */
  uint32_t site_count;
  uint32_t factorisation_count; /* numeric factorisations since hf_create, that of hf_create included */
  uint32_t path_solve_count;    /* sites whose path was solved */
  uint32_t sweep_count;         /* backward sweeps */
  uint32_t engine;              /* HF_ENGINE_* */
  uint32_t thread_count;
  double load_ms;          /* of hf_create, to load a saved factor; the times to make it are then 0 */
  uint32_t factor_loaded;  /* 1: the factor was loaded */
  uint32_t factor_borrowed; /* 1: its numbers are read in place; factor_bytes counts them, memory_bytes does not */
  uint32_t last_route;       /* HF_ROUTE_* of the last edit */
  uint32_t rebase_count;     /* times sites were moved into the factor */
  uint32_t dense_edit_count; /* edits that took the dense way */
  uint32_t dense_row_count;  /* sites in the dense system at present */
  uint32_t eliminated_count; /* sites in the factor at present */
  uint32_t rebase_advised;   /* 1: the sites' paths outweigh the factor, fields get slower; see hf_prepare_rebase */
  double predicted_dense_ms; /* what the cost model gave the last edit by rows of the dense system ... */
  double predicted_rebase_ms; /* ... and by a rebase, on one thread of the machine it was measured on; 0: none */
} hf_statistics;

/* Writes the figures. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC. Thread
 * safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_get_statistics(hf_solver solver, hf_statistics* out_statistics);

#ifdef __cplusplus
}
#endif
#endif
