/* hf/solver.h - add, move and remove sites on a surface, and solve the smooth field through them.
 *
 * A site holds the field at a value: at a vertex, at a point of a triangle, or on a disc. Elsewhere the field is
 * harmonic. The equations are K u = W lambda and W' u = s. u is the field and K is the Laplacian of the surface. W has
 * one column w_i per site, such as the three barycentric weights of a point. s holds the values, and lambda is the flux
 * into each site. A soft site of stiffness alpha obeys w_i' u + lambda_i / alpha = s_i. This is the penalty method of
 * Xu, Zhang, Cohen-Or and Xiong (2009). At open borders the flux is zero. Edits do not factorise, with one exception:
 * for very many sites at once, the solver factorises with them eliminated when that is quicker.
 * hf_solver_statistics.factorisation_count counts these factorisations. */
#ifndef HF_SOLVER_H
#define HF_SOLVER_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A set of sites on a surface, and their field. */
typedef struct hf_solver_object* hf_solver;

typedef struct hf_solver_desc {
  uint32_t struct_size;
  int32_t field_kind;     /* HF_FIELD_*; if the surface has no factor of that kind yet, it is made now */
  uint32_t channel_count; /* fields solved at once, 1 to 64; 0 = 1 */
  uint32_t site_limit;    /* at most this many sites; 0 = 100,000 */
  hf_progress progress;   /* NULL, or an object to poll and cancel through */
} hf_solver_desc;

/* Creates a solver without sites. desc: NULL for defaults. Sets *out_solver to NULL first. Cost: none, unless the
 * surface has no factor of that field kind and makes one. Errors: HF_ERROR_INVALID_ARGUMENT, HF_ERROR_CANCELLED,
 * HF_ERROR_NOT_POSITIVE_DEFINITE. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver);

/* Creates a solver with the same sites under the same numbers; its fields have the same bits. Both share the factor and
 * the solved sites, so a copy costs its list of sites only. Use one copy per thread or per set of sites. For undo, keep
 * copies: one before each edit. Sets *out_solver to NULL first. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_clone(hf_solver solver, hf_solver* out_solver);

/* Moves a solver to an edited surface. Its sites keep their numbers, values and screening. surface: any number of calls
 * of hf_surface_edit or hf_surface_relink make it from the solver's surface, or the solver's surface from it. Cost:
 * little where both share a factor, else the elimination paths of the sites; for screened fields a numeric
 * factorisation. Errors: HF_ERROR_CONFLICT (the surfaces have no common origin, or a site lies at a vertex without a
 * triangle on that surface; index = site), HF_ERROR_UNSUPPORTED (a baseline), HF_ERROR_CANCELLED (through the progress
 * of hf_solver_desc). Thread safety: changes `solver`, reads `surface`. Since 0.1. */
HF_API hf_result hf_solver_move_to(hf_solver solver, hf_surface surface);

/* Destroys a solver. Ignores NULL and destroyed objects. Thread safety: a call under way on another thread ends first;
 * it keeps the object alive. Since 0.1. */
HF_API void hf_solver_destroy(hf_solver solver);

/* hf_solver_get_info writes the options of a solver here, with defaults filled in, and the number of its sites. */
typedef struct hf_solver_info {
  uint32_t struct_size;
  int32_t field_kind; /* HF_FIELD_* */
  uint32_t channel_count;
  uint32_t site_limit;
  uint32_t site_count;
  uint32_t vertex_count; /* vertices of your mesh: rows of a field */
} hf_solver_info;

/* Writes the options of a solver. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_info(hf_solver solver, hf_solver_info* out_info);

/* ---- sites ---- */

/* Places and values of sites. Set one of vertices, places and points. The finer the mesh, the less influence a point
 * site has. Give the site a radius to avoid this: it then holds the field on a geodesic disc. A radius below the mesh
 * spacing still gives a point. A soft disc shares its stiffness among its vertices. For harmonic fields the boundary
 * vertices of a disc count towards site_limit; for bi-harmonic fields all its vertices do. */
typedef struct hf_sites_desc {
  uint32_t struct_size;
  uint32_t site_count;      /* >= 1 */
  const uint32_t* vertices; /* [site_count] vertices of your mesh, or NULL */
  const hf_place* places;   /* [site_count], or NULL */
  const double* points;    /* [site_count][3] points in space, at rest, in the unit and frame of the mesh, or NULL. Each
                              stands for the nearest point of the surface, up to two boxes away */
  const double* values;    /* [site_count][channel_count], up to 1e200 in size; NULL = 0 */
  const double* stiffness; /* [site_count] >= 0, relative to the mean diagonal of K; 0 = hard (exact); NULL = all
                              hard; clamped to 1e-12 to 1e12 */
  const double* radii;     /* [site_count] >= 0, geodesic, in the unit of the mesh; 0 = a point; NULL = all points */
} hf_sites_desc;

/* Adds sites. out_sites: NULL, or uint32_t[site_count] for their numbers. A site keeps its number until it is
 * removed; later sites reuse free numbers. Errors: HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE,
 * HF_ERROR_INVALID_ARGUMENT (barycentrics, stiffness, isolated vertex), HF_ERROR_UNSUPPORTED (places, points or a
 * disc on a graph), HF_ERROR_DUPLICATE (the vertex, or a welded copy, has a site of the same values),
 * HF_ERROR_CONFLICT (of other values, or the point depends linearly on hard sites), HF_ERROR_TOO_LARGE (site_limit, a
 * value, a point two boxes or more away). Cost of points: a tree over the triangles for each call. Thread safety:
 * changes `solver`. Since 0.1. */
HF_API hf_result hf_add_sites(hf_solver solver, const hf_sites_desc* sites, uint32_t* out_sites);

/* Adds one hard site at a vertex. values: double[channel_count], or NULL for 0. out_site: NULL, or receives the number
 * of the site. Errors: as hf_add_sites. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_add_site(hf_solver solver, uint32_t vertex, const double* values, uint32_t* out_site);

/* Removes sites by number. sites: uint32_t[site_count]. The field is 0 on a component that has no site left. If you add
 * a site there again, the field is exact. Errors: HF_ERROR_NOT_FOUND (also for a number named twice). Thread safety:
 * changes `solver`. Since 0.1. */
HF_API hf_result hf_remove_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites);

/* Moves sites to new places. Each site keeps its number, value, stiffness and radius. sites:
 * uint32_t[site_count]. to: one place for each site; its
 * values, stiffness and radii are NULL. Errors: as hf_add_sites and hf_remove_sites. Thread safety: changes `solver`.
 * Since 0.1. */
HF_API hf_result hf_solver_move_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                      const hf_sites_desc* to);

/* Gives sites new values. sites: uint32_t[site_count]. values: double[site_count][channel_count]. The call costs
 * nothing until the next solve. Errors: HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (a value). Thread
 * safety: changes `solver`. Since 0.1.
 */
HF_API hf_result hf_solver_set_values(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                      const double* values);

/* One batch of edits, applied in the order remove, move, set, add. A count of 0 skips its part. */
typedef struct hf_edit_desc {
  uint32_t struct_size;
  uint32_t remove_count;
  const uint32_t* remove_sites; /* [remove_count] */
  uint32_t move_count;
  uint32_t set_count;
  const uint32_t* move_sites;   /* [move_count] */
  const hf_sites_desc* move_to; /* NULL, or places of [move_count] sites */
  const uint32_t* set_sites;    /* [set_count] */
  const double* set_values;     /* [set_count][channel_count] */
  const hf_sites_desc* add;     /* NULL, or the sites to add */
} hf_edit_desc;

/* Applies a batch of edits at once. out_sites: NULL, or uint32_t[add->site_count]. Errors: as the single calls; `index`
 * is the position inside the failing part. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_edit_sites(hf_solver solver, const hf_edit_desc* edit, uint32_t* out_sites);

/* Returns the number of sites, or 0 for an invalid object. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_solver_get_site_count(hf_solver solver);

/* Places, values and fluxes of the sites. The arrays are yours; each is NULL or has `capacity` entries. The entries are
 * ordered by site number. */
typedef struct hf_sites_info {
  uint32_t struct_size;
  uint32_t capacity;    /* in: entries of each array */
  uint32_t count;       /* out: number of sites */
  uint32_t reserved;    /* 0 */
  uint32_t* sites;      /* [capacity] numbers */
  uint32_t* vertices;   /* [capacity] the vertex of the place, HF_NO_INDEX for a point in a triangle */
  uint32_t* components; /* [capacity] */
  double* values;       /* [capacity][channel_count] */
  double* stiffness;    /* [capacity] 0 = hard */
  double* flux;         /* [capacity][channel_count] lambda: what flows into the surface at the site, in value x weight;
                        the sum over a disc */
  double* radii;        /* [capacity] 0 = a point */
} hf_sites_info;

/* Writes all sites. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_sites(hf_solver solver, hf_sites_info* inout_info);

/* ---- screening ---- */

/* Screens the field: (K + A H) u = A H p + W lambda, with A the vertex areas. The field follows p where H is large, and
 * the influence of a site fades over a distance of about 1 / sqrt(H). A H is at most 1e12 times the mean diagonal of K.
 * Such a field needs no site on a component where some H is above 0. screening: double[vertex_count] H >= 0, in
 * 1 / length^2 with the unit of the mesh; NULL removes the screening. targets: double[vertex_count][channel_count] p,
 * or NULL for 0. Both are copied. The values of the first of welded copies hold for all of them. Sites stay. A site
 * with a radius holds the rim of its disc only. Undo restores the screening with the sites. Cost: a numeric
 * factorisation with the ordering of the surface, two sweeps and the paths of the sites. Errors: HF_ERROR_NON_FINITE,
 * HF_ERROR_INVALID_ARGUMENT (H below 0) and HF_ERROR_TOO_LARGE (A H, or p above 1e200), index = vertex;
 * HF_ERROR_NOT_POSITIVE_DEFINITE (all H of a component are lost in rounding), and HF_ERROR_UNSUPPORTED (a graph, a
 * bi-harmonic field). Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_set_screening(hf_solver solver, const double* screening, const double* targets);

/* ---- fields ---- */

/* The components that the sites of a solve did not reach. */
typedef struct hf_solve_info {
  uint32_t struct_size;
  uint32_t unreached_component_count; /* components without a site */
  uint32_t first_unreached_component; /* HF_NO_INDEX for none */
  uint32_t unreached_vertex_count;    /* given vertices in them, isolated ones included */
} hf_solve_info;

/* Solves for the field at every vertex of your mesh, in single precision. out_values:
 * float[vertex_count][channel_count], rows value_stride bytes apart (0 = packed). Hard sites hold their values exactly.
 * The field is 0 on components without a site. out_info: NULL, or receives the counts of these components. Cost: one
 * backward sweep through the factor, or three sweeps for a bi-harmonic field. If a vertex has more than 1,000
 * neighbours, a bi-harmonic solve needs 30 to 700 sweeps, by the number of sites. Errors: HF_ERROR_EMPTY,
 * HF_ERROR_TOO_LARGE (a value does not fit a float; index = vertex). Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solve(hf_solver solver, float* out_values, uint32_t value_stride, hf_solve_info* out_info);

/* Solves for the field at every vertex of your mesh, in single or double precision. out_values:
 * [vertex_count][channel_count] of float or double. Hard sites hold their values exactly. The field is 0 on components
 * without a site. out_info: NULL, or receives the counts of these components. Cost: as hf_solve. Errors: as hf_solve.
 * Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve(hf_solver solver, const hf_array_out* out_values, hf_solve_info* out_info);

/* Solves for the field at chosen vertices only, with the same bits as hf_solver_solve in double. out_values:
 * double[vertex_count][channel_count]. vertices: uint32_t[vertex_count]. The call reads only those columns of the
 * factor on which these vertices depend (elimination paths), on the calling thread. One path is up to a sixth of the
 * factor, but the paths of many vertices share most of their columns. The call costs a whole solve for bi-harmonic
 * fields, and whenever sites are eliminated in the factor (see hf_solver_prepare_rebase). A vertex of a component
 * without a site gets 0. Errors: HF_ERROR_EMPTY, HF_ERROR_TOO_LARGE (more vertices than the mesh has),
 * HF_ERROR_OUT_OF_RANGE. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_at(hf_solver solver, uint32_t vertex_count, const uint32_t* vertices,
                                    double* out_values);

/* Solves for a tangent vector field, with a solver of 3 channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.3). The
 * channels are the x, y and z of the constraint vectors, and the call solves each as a field. It then projects the
 * vector v of each vertex on the tangent plane: v - (n . v) n. Here n is the area-weighted normal. out_vectors:
 * [vertex_count][3] of float or double, not normalised. out_normals: NULL, or double[vertex_count][3], packed: the
 * normals used. out_info: NULL, or receives the counts of components without a site. Errors: as hf_solve,
 * HF_ERROR_INVALID_ARGUMENT (not 3 channels). Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_vectors(hf_solver solver, const hf_array_out* out_vectors, double* out_normals,
                                         hf_solve_info* out_info);

/* ---- previews in single precision ---- */

/* Counts and errors of a preview. */
typedef struct hf_preview_info {
  uint32_t struct_size;
  int32_t exact;                      /* 1: solved in double, as hf_solve does */
  uint32_t correction_count;          /* corrections made; 0 when exact */
  uint32_t unreached_component_count; /* components without a site; their vertices hold 0 */
  double value_range;                 /* largest less smallest site value, the widest over components and channels */
  double largest_correction;          /* largest change of a value by the last correction: about the error before it */
  double error_estimate; /* of the largest error, in the unit of the values. Measured when corrections were made, else
                            1e-5 of value_range; 0 when exact. Infinite where only corrections can measure it:
                            bi-harmonic fields, long shapes, crowded sites */
  double preview_bytes;  /* memory of the single-precision copy, shared by the surface */
} hf_preview_info;

/* Solves with a single-precision copy of the factor. This reads half the bytes of hf_solve; use it while the user drags
 * a value or a site. The error is about 1e-6 of the value range for harmonic fields. Bi-harmonic fields, long shapes
 * and crowded sites can have an error of any size: ask for corrections there and read error_estimate. Hard sites at
 * vertices are exact. One correction (iterative refinement, Wilkinson 1963) reduces the error of a harmonic field below
 * 1e-9, a second one below 1e-12. Each correction costs as much as two to three calls of hf_solve.
 *
 * The first call makes the single-precision copy, which costs about two solves. All solvers of that field kind on the
 * surface share the copy. It is freed with the last of these solvers, or by hf_solver_release_preview. A solver whose
 * factor eliminates sites gives the exact field. out_info->exact is then 1.
 *
 * out_values: [vertex_count][channel_count] of float or double, as hf_solver_solve. Single precision rounds most
 * corrections away. correction_count: 0 to 8. out_info: NULL, or a struct. Errors: HF_ERROR_INVALID_ARGUMENT
 * (correction_count), HF_ERROR_EMPTY. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_solve_preview(hf_solver solver, const hf_array_out* out_values, uint32_t correction_count,
                                         hf_preview_info* out_info);

/* Frees the single-precision copy for all solvers that share it, as soon as no running call uses it. The next preview
 * makes the copy again. Thread safety: any thread, during any other call. Since 0.1. */
HF_API hf_result hf_solver_release_preview(hf_solver solver);

/* ---- vectors of a 3-channel solver ---- */

/* Moves vector sites to other vertices of their components. Each vector is carried along the shortest path of edges,
 * from vertex normal to vertex normal (parallel transport; Xu and others 2009, Section 3.3). sites, vertices:
 * uint32_t[site_count].
 * Errors: HF_ERROR_INVALID_ARGUMENT (not 3 channels, another component, isolated vertex), HF_ERROR_NOT_FOUND,
 * HF_ERROR_OUT_OF_RANGE, HF_ERROR_DUPLICATE, HF_ERROR_CONFLICT. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_move_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                        const uint32_t* vertices);

/* Turns the vector of site i about its vertex normal, counter-clockwise by angles[i] radians. sites:
 * uint32_t[site_count]. angles: double[site_count]. Does not factorise.
 * Errors: HF_ERROR_INVALID_ARGUMENT (not 3 channels), HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE. Thread safety:
 * changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_rotate_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                          const double* angles);

/* ---- how right a field is ---- */

/* The certificate says how accurate a field is. Each error is relative to the range of the site values of its component
 * and channel, and of its targets where it is screened. Where all are equal, it is relative to their size. A value that
 * is not finite counts as infinitely wrong. */
typedef struct hf_certificate {
  uint32_t struct_size;
  int32_t overshoot_checked; /* out; 1: the field must keep to the range of its sites: harmonic, intrinsic Delaunay
                                or clamped operator, all sites at vertices */
  double tolerance;          /* in: largest error to accept, > 0; 0 = 1e-8; out: the one used */
  double value_range;        /* out: largest less smallest value (or target), the widest over components and channels */
  double residual;   /* out: largest |(K u - W lambda)_v| / K_vv, how far a value is from the mean of its neighbours */
  double site_error; /* out: largest |w_i' u + lambda_i / alpha_i - s_i|, what a site misses its value by */
  double overshoot;  /* out: how far the field leaves the range of its sites; 0 when not checked */
  uint32_t worst_vertex;         /* out: of your mesh, where the largest of the three is */
  uint32_t changed_vertex_count; /* out: welded vertices with a changed weight (hf_mesh_statistics). The errors hold
                                    for the weights used. Harmonic fields on a graph use your own weights, within 1e30
                                    of their median */
  double error_estimate; /* out: how far a value may be from the exact field: a bound by K alone where no weight is
                            negative and the field harmonic, else an estimate by corrections */
} hf_certificate;

/* Solves the field and checks it against its equations. The check uses only the operator K and the site values. So it
 * finds a damaged factor, borrowed bytes that changed, or a fault of the machine. The call returns HF_ERROR_INACCURATE
 * (index = worst vertex) if the check fails, and writes inout_certificate then too. Do not use fields of that solver;
 * make the surface again. Cost: a solve and a product with K. Errors: HF_ERROR_INACCURATE, HF_ERROR_INVALID_ARGUMENT
 * (tolerance), HF_ERROR_EMPTY. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_certify(hf_solver solver, hf_certificate* inout_certificate);

/* ---- very many sites ---- */

/* Factorises in the background with the hard vertex sites eliminated, so that they cost no dense solve. It runs on the
 * calling thread, while other threads edit and solve with this solver. The next edit switches to the new factor. Fields
 * before and after are the same up to rounding. Call it on a thread of yours when hf_solver_statistics.rebase_advised
 * is 1. An edit of very many sites does this by itself when that is quicker. Memory: one more factor, for as long as it
 * eliminates sites. Errors: HF_ERROR_EMPTY (no hard site at a vertex), HF_ERROR_BUSY (another
 * thread is in this call). Thread safety: can run during any other call on the same solver.
 * Since 0.1. */
HF_API hf_result hf_solver_prepare_rebase(hf_solver solver);

/* These values say how the solver carried out the last edit of site places (hf_solver_statistics.last_route). */
enum hf_route {
  HF_ROUTE_NONE = 0,  /* no place was edited yet */
  HF_ROUTE_DENSE = 1, /* rows of the dense system were added and removed */
  HF_ROUTE_FRESH = 2, /* the dense system was recomputed, which was quicker */
  HF_ROUTE_REBASE = 3 /* factorised again with hard vertex sites eliminated */
};

/* Counts, memory and cost estimates of a solver. Bytes are doubles (exact to 2^53). */
typedef struct hf_solver_statistics {
  uint32_t struct_size;
  uint32_t site_count;
  uint32_t factorisation_count; /* numeric factorisations this solver made; the surface's own is not counted */
  uint32_t path_solve_count;    /* sparse solves (elimination paths) for added sites */
  uint32_t sweep_count;         /* backward sweeps */
  uint32_t last_route;          /* HF_ROUTE_* of the last edit */
  uint32_t rebase_count;        /* times sites were moved into the factor */
  uint32_t dense_edit_count;    /* edits by rows of the dense system */
  uint32_t dense_row_count;     /* sites in the dense system at present */
  uint32_t eliminated_count;    /* sites that the factor eliminates now */
  int32_t rebase_advised; /* 1: elimination paths outweigh the factor, fields get slower: hf_solver_prepare_rebase */
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
