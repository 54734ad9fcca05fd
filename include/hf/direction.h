/* hf/direction.h - tangent vector fields with constraint vectors that are moved and turned.
 *
 * Two ways. The paper's: a solver of three channels, its sites vectors, the field projected on the tangent planes
 * (hf_solve_vectors); here are the moves it needs, carrying and turning a vector on the surface. The accurate one: a
 * direction object, the smoothest field for the connection of the surface itself, with its singularities.
 */
#ifndef HF_DIRECTION_H
#define HF_DIRECTION_H

#include "hf/field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the paper's vector fields: a solver with channel_count 3 ---- */

/* Moves sites to other vertices; each vector is carried along the shortest way of edges, turned from vertex normal to
 * vertex normal (parallel transport). Costs what hf_move_sites costs, and the way. All or nothing.
 * vertices: [site_count], in the component of the site. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT (the solver has not three channels; another component; an isolated vertex),
 * HF_ERROR_NO_SUCH_SITE, HF_ERROR_OUT_OF_RANGE, HF_ERROR_DUPLICATE_SITE, HF_ERROR_CONFLICT (index = position in the
 * list), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. After a failure nothing has changed. Thread safety: changes `solver`.
 * Since 0.1. Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.3. */
HF_API hf_result hf_move_vector_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                      const uint32_t* vertices);

/* Turns the vectors of sites about the normals of their vertices, counter-clockwise by angles[i] radians. Touches no
 * factor and solves no path. All or nothing. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT (the solver has not three channels), HF_ERROR_NO_SUCH_SITE,
 * HF_ERROR_NON_FINITE (index = position in the list), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. After a failure nothing has
 * changed. Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_rotate_vector_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                        const double* angles);

/* ---- direction fields ---- */

/* A direction field on a solver's surface, with a factor and constraints of its own: minimises the sum over the edges of
 * w_ij |z_j - r_ij z_i|^2, z the field in the tangent planes, r the discrete Levi-Civita connection, w the clamped
 * cotangent weights (Knoeppel, Crane, Pinkall and Schroeder 2013). Vectors keep their lengths where they are
 * constrained; between constraints the length is whatever the energy makes of it, and 0 at singularities. Keeps what it
 * shares with the solver alive. */
typedef struct hf_direction_object* hf_direction;

/* Zero every field that is not needed (HF_INIT). */
typedef struct hf_direction_desc {
  uint32_t struct_size;
  uint32_t degree;     /* 1 vectors, 2 lines, 4 crosses: the field is the same when turned by 1 / degree of a turn; 0 = 1 */
  uint32_t site_limit; /* most constraints; 0 = 100,000 */
  uint32_t reserved;   /* 0 */
} hf_direction_desc;

/* Makes a direction object: connection, operator and one numeric factorisation of two unknowns per vertex, in the
 * ordering the solver has (its sites and field_kind play no part). desc: NULL for all defaults. out_direction: set to
 * NULL first. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC,
 * HF_ERROR_INVALID_ARGUMENT (degree, reserved), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_BUSY.
 * After a failure nothing exists. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_direction_create(hf_solver solver, const hf_direction_desc* desc, hf_direction* out_direction);

/* Makes a direction object that shares connection and factor with this one and has its own copy of the constraints,
 * without the undo stack: many sets of constraints, many threads on one immutable factor. Costs the constraints only.
 * *out_direction is set to NULL first. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_clone(hf_direction direction, hf_direction* out_direction);

/* Destroys a direction object. NULL, stale and foreign handles are ignored. Thread safety: not while another thread uses
 * this handle (that call is finished first, safely). Since 0.1. */
HF_API void hf_direction_destroy(hf_direction direction);

/* Adds constraints: vectors at vertices, projected on the tangent planes. Costs two paths and two dense rows each. Very
 * many at once go into the factor instead, by one factorisation; later changes cost paths and rows again. All or nothing.
 * vertices: [site_count] as given; vectors: [site_count][3], zero for a constraint of no length. out_sites: NULL, or
 * [site_count] numbers that stay until the constraint is removed. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (an
 * isolated vertex; a vector upright on the surface), HF_ERROR_DUPLICATE_SITE (index = position in the list),
 * HF_ERROR_TOO_LARGE, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. After a failure nothing has changed. Thread safety: changes
 * `direction`. Since 0.1. */
HF_API hf_result hf_direction_add_sites(hf_direction direction, uint32_t site_count, const uint32_t* vertices,
                                        const double* vectors, uint32_t* out_sites);

/* Removes constraints. No work on the sparse factor. All or nothing. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_SITE (index = position in the list), HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_remove_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites);

/* Moves constraints to other vertices of their components; each vector is carried along the shortest way of edges by the
 * connection. All or nothing. Results: as hf_move_vector_sites. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_move_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                         const uint32_t* vertices);

/* Gives constraints new vectors, [site_count][3], projected. Touches no factor and solves no path. All or nothing.
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_SITE,
 * HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (upright vector; index = position in the list), HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_set_vectors(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                          const double* vectors);

/* Turns constraints counter-clockwise, seen from outside, by angles[i] radians. Touches no factor and solves no path.
 * All or nothing. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY, HF_ERROR_NO_SUCH_SITE,
 * HF_ERROR_NON_FINITE (index = position in the list), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: changes
 * `direction`. Since 0.1. */
HF_API hf_result hf_direction_rotate_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                           const double* angles);

/* Keeps the present constraints on the undo stack (at most 256 are kept; the oldest goes first). Costs the constraints,
 * shared parts are not copied. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread
 * safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_record(hf_direction direction);
/* Goes back to the last record, numbers of constraints included; hf_direction_redo comes back. The field afterwards is
 * the same bits as it was at the record. Results: HF_OK, HF_ERROR_NO_RECORD, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. After a failure nothing has changed. Thread safety: changes `direction`. Since
 * 0.1. */
HF_API hf_result hf_direction_undo(hf_direction direction);
HF_API hf_result hf_direction_redo(hf_direction direction);

/* Number of constraints; 0 for an invalid handle. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_direction_get_site_count(hf_direction direction);

/* Writes the constraints in the order of their numbers. capacity: entries of each array, at least the number of
 * constraints; arrays may be NULL. sites: numbers; vertices: as given; vectors: [capacity][3] tangent vectors.
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_TOO_SMALL, HF_ERROR_BUSY. Thread safety: reads `direction`. Since
 * 0.1. */
HF_API hf_result hf_direction_get_sites(hf_direction direction, uint32_t capacity, uint32_t* out_sites,
                                        uint32_t* out_vertices, double* out_vectors);

/* Writes the field as vectors in space, [vertex_count][3], tangent to 1e-12 of their length; of a field of degree 2 or 4
 * one of its directions. Constrained vertices hold their vectors. Vertices that no constraint reaches get 0.
 * vector_stride: bytes between vertices, 0 = packed. out_info: NULL, or what was not reached (struct_size set).
 * Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_TOO_SMALL (stride),
 * HF_ERROR_NO_SITES, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Cost: a small dense solve and one backward sweep. Thread
 * safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_solve(hf_direction direction, float* out_vectors, uint32_t vector_stride,
                                    hf_solve_info* out_info);
/* The same in double precision. Since 0.1. */
HF_API hf_result hf_direction_solve_f64(hf_direction direction, double* out_vectors, uint32_t vector_stride,
                                        hf_solve_info* out_info);

/* A triangle around which the field turns against the surface. */
typedef struct hf_singularity {
  uint32_t triangle; /* as given */
  uint32_t vertex;   /* its corner where the field is shortest, as given; of welded copies the first */
  int32_t index;     /* in parts of 1 / degree: +1 a source or vortex of a vector field, -1 a saddle */
} hf_singularity;

/* Lists the singularities of the field, by triangle. On a component that is closed, manifold and of one orientation the
 * indices sum to degree times its Euler characteristic; elsewhere the border takes its part. out_count: how many there
 * are. out_singularities: NULL to ask for the count, or room for `capacity`. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_NO_SITES, HF_ERROR_TOO_SMALL (nothing is written but out_count),
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Cost: that of hf_direction_solve and a pass over the triangles. Crane, Desbrun
 * and Schroeder 2010, Section 5. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_singularities(hf_direction direction, uint32_t capacity,
                                                hf_singularity* out_singularities, uint32_t* out_count);

/* What the object has done and holds. */
typedef struct hf_direction_statistics {
  uint32_t struct_size;
  uint32_t unknown_count;          /* two per vertex */
  uint32_t site_count;
  uint32_t factorisation_count;    /* the first included; grows when very many constraints go into the factor */
  uint32_t path_solve_count;       /* two per constraint added or moved */
  uint32_t sweep_count;
  uint32_t irregular_vertex_count; /* vertices whose triangles are no fan of one orientation */
  uint32_t sites_eliminated;       /* 1: so many constraints that they are eliminated from the factor */
  double operator_ms;
  double numeric_ms;
  double factor_entries;
  double factor_bytes;
  double site_memory_bytes;
} hf_direction_statistics;

/* Writes the statistics; out_statistics->struct_size must be set. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_BUSY. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_statistics(hf_direction direction, hf_direction_statistics* out_statistics);

#ifdef __cplusplus
}
#endif
#endif
