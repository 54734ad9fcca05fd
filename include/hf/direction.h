/* hf/direction.h - compute the smoothest tangent direction field through constraint vectors, which you can edit.
 *
 * The field minimises the sum of w_ij |z_j - r_ij z_i|^2 over the edges ij (Knoeppel, Crane, Pinkall and Schroeder
 * 2013). z_i is the vector in the tangent plane of vertex i. The rotation r_ij takes z_i to the tangent plane of j
 * (discrete Levi-Civita connection). The weights w_ij are clamped cotangents. The field has the length of the
 * constraint vectors at the constraints. Nothing fixes its length between them, and its length is 0 at singularities.
 * The function hf_solver_solve_vectors computes the simpler vector fields of Xu, Zhang, Cohen-Or and Xiong (2009). */
#ifndef HF_DIRECTION_H
#define HF_DIRECTION_H

#include "hf/solver.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A direction field on a surface, with a factor and constraints of its own. */
typedef struct hf_direction_object* hf_direction;

typedef struct hf_direction_desc {
  uint32_t struct_size;
  uint32_t degree;      /* 1 vectors, 2 lines, 4 crosses. A turn by 360 / degree changes nothing. 0 = 1 */
  uint32_t site_limit;  /* most constraints; 0 = 100,000 */
  uint32_t reserved;    /* 0 */
  hf_progress progress; /* NULL, or an object to poll and cancel through */
} hf_direction_desc;

/* Makes a direction field without constraints. It computes the connection between tangent planes and the operator, and
 * factorises once, with two unknowns per vertex. desc: NULL for defaults. Sets *out_direction to NULL first. Errors:
 * HF_ERROR_INVALID_ARGUMENT (degree), HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_CANCELLED. Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_direction_create(hf_surface surface, const hf_direction_desc* desc, hf_direction* out_direction);

/* Makes a direction field with the same constraints under the same numbers; it has the same bits. Both share
 * connection and factor, so the copy costs the constraints only. For undo, keep copies: one before each edit. Sets
 * *out_direction to NULL first. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_clone(hf_direction direction, hf_direction* out_direction);

/* Destroys a direction field. Ignores NULL and destroyed objects. Thread safety: a call under way on another thread
 * ends first; it keeps the object alive. Since 0.1. */
HF_API void hf_direction_destroy(hf_direction direction);

/* Adds constraints: vectors at vertices. The function projects the vectors on the tangent planes. Each constraint costs
 * two sparse triangular solves (elimination paths) and two rows of a small dense system. For a batch of very many
 * constraints, the function factorises once instead, with their vertices eliminated. Later edits cost paths and rows
 * again.
 *
 * vertices: [site_count] vertices of your mesh. vectors: [site_count][3]; a zero vector makes the field 0 there.
 * out_sites: NULL, or receives uint32_t[site_count] numbers. A constraint keeps its number until it is removed. Errors:
 * HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (an isolated vertex, a vector normal to the
 * surface), HF_ERROR_DUPLICATE, HF_ERROR_TOO_LARGE (site_limit). Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_add_sites(hf_direction direction, uint32_t site_count, const uint32_t* vertices,
                                        const double* vectors, uint32_t* out_sites);

/* Removes constraints by number. sites: uint32_t[site_count]. Errors: HF_ERROR_NOT_FOUND. Thread safety: changes
 * `direction`. Since 0.1. */
HF_API hf_result hf_direction_remove_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites);

/* Moves constraints to other vertices of the same component. sites, vertices: uint32_t[site_count]. The connection
 * transports each vector along the shortest path of edges, from tangent plane to tangent plane. Errors: as
 * hf_solver_move_vectors. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_move_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                         const uint32_t* vertices);

/* Gives constraints new vectors and projects them on the tangent planes. sites: uint32_t[site_count]. vectors:
 * double[site_count][3]. Does not factorise. Errors:
 * HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (a vector normal to the surface). Thread
 * safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_set_vectors(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                          const double* vectors);

/* Turns constraint i by angles[i] radians, counter-clockwise seen from outside. sites: uint32_t[site_count]. angles:
 * double[site_count]. Does not factorise. Errors:
 * HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_rotate_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                           const double* angles);

/* Returns the number of constraints, or 0 for an invalid object. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_direction_get_site_count(hf_direction direction);

/* Writes the constraints. Their numbers ascend. out_sites: NULL, or uint32_t[capacity] numbers. out_vertices: NULL, or
 * uint32_t[capacity] vertices of your mesh. out_vectors: NULL, or double[capacity][3], tangent. out_count: NULL, or
 * receives the number of constraints. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_sites(hf_direction direction, uint32_t capacity, uint32_t* out_sites,
                                        uint32_t* out_vertices, double* out_vectors, uint32_t* out_count);

/* Writes the field as vectors in space. out_vectors: [vertex_count][3] of float or double. The vectors are tangent to
 * the surface up to 1e-12 of their length. For degree 2 or 4 the function writes one of the 2 or 4 directions.
 * Constrained vertices hold their vectors; vertices that no constraint reaches get 0. out_info: NULL, or receives the
 * counts of components without a constraint. Cost: a small dense solve and one backward sweep over the factor. Errors:
 * HF_ERROR_EMPTY. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_solve(hf_direction direction, const hf_array_out* out_vectors, hf_solve_info* out_info);

/* A singularity is a triangle, or a face, around which the field makes extra turns. They are counted in parts of 1 /
 * degree of a full turn. */
typedef struct hf_singularity {
  uint32_t triangle; /* or face, of your mesh */
  uint32_t vertex;   /* its corner where the field is shortest, of your mesh; the first of welded copies */
  int32_t index;     /* in parts of 1 / degree: +1 a source or vortex of a vector field, -1 a saddle */
} hf_singularity;

/* Lists the singularities of the field, ordered by triangle (Crane, Desbrun and Schroeder 2010, Section 5). On a closed
 * manifold component of one orientation the indices sum to degree times the Euler characteristic. out_singularities:
 * NULL, or hf_singularity[capacity]. out_count: NULL, or receives the number of singularities. Cost: a solve and a pass
 * over the triangles. Errors: HF_ERROR_EMPTY. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_singularities(hf_direction direction, uint32_t capacity,
                                                hf_singularity* out_singularities, uint32_t* out_count);

/* The options a direction field was made with, and counts of its constraints and of the work done so far. */
typedef struct hf_direction_statistics {
  uint32_t struct_size;
  uint32_t degree;
  uint32_t site_limit;
  uint32_t unknown_count; /* two per vertex */
  uint32_t site_count;
  uint32_t factorisation_count; /* the first included; grows when very many constraints go into the factor */
  uint32_t path_solve_count;    /* two per constraint added or moved */
  uint32_t sweep_count;
  uint32_t irregular_vertex_count; /* vertices whose triangles are not one fan of one orientation */
  uint32_t eliminated_count;       /* constraints that the factor eliminates now */
  double operator_ms;
  double numeric_ms;
  double factor_entries;
  double factor_bytes;
  double site_memory_bytes;
} hf_direction_statistics;

/* Writes the statistics. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_statistics(hf_direction direction, hf_direction_statistics* out_statistics);

#ifdef __cplusplus
}
#endif
#endif
