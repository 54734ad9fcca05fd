/* hf/direction.h - the smoothest tangent directions through constraint vectors that come, go and turn.
 *
 * Minimises the sum over the edges of w_ij |z_j - r_ij z_i|^2. z is the field in the tangent planes, r the discrete
 * Levi-Civita connection, w the clamped cotangent weights (Knoeppel, Crane, Pinkall and Schroeder 2013). The field keeps
 * the length of its constraints. Vector length is not controlled between constraints, and is 0 at singularities. The
 * paper's simpler fields are hf_solver_solve_vectors.
 */
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
  uint32_t degree;      /* 1 vectors, 2 lines, 4 crosses: turning by 1 / degree of a turn changes nothing; 0 = 1 */
  uint32_t site_limit;  /* most constraints; 0 = 100,000 */
  uint32_t reserved;    /* 0 */
  hf_progress progress; /* NULL, or an object to poll and cancel through */
} hf_direction_desc;

/* Makes a direction field without constraints: connection, operator, and one numeric factorisation of two unknowns per
 * vertex. desc: NULL for defaults. Sets *out_direction to NULL first. Errors: HF_ERROR_INVALID_ARGUMENT
 * (degree), HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_direction_create(hf_surface surface, const hf_direction_desc* desc, hf_direction* out_direction);

/* Makes a direction field with the same constraints, without the undo stack. Shares connection and factor; costs the
 * constraints only. Sets *out_direction to NULL first. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_clone(hf_direction direction, hf_direction* out_direction);

/* Destroys a direction field. Ignores NULL and destroyed handles. Thread safety: a call under way on another thread ends
 * first. Since 0.1. */
HF_API void hf_direction_destroy(hf_direction direction);

/* Adds constraints: vectors at vertices, projected on the tangent planes. Costs two elimination paths and two dense rows
 * each. Very many at once go into the factor instead, by one factorisation; later changes cost paths and rows again.
 * vertices: [site_count] as given. vectors: [site_count][3], zero for a constraint of no length. out_sites: NULL, or
 * [site_count] numbers; a constraint keeps its number until it is removed. Errors: HF_ERROR_OUT_OF_RANGE,
 * HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (an isolated vertex, a vector normal to the surface),
 * HF_ERROR_DUPLICATE_SITE, HF_ERROR_TOO_LARGE (site_limit). Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_add_sites(hf_direction direction, uint32_t site_count, const uint32_t* vertices,
                                        const double* vectors, uint32_t* out_sites);

/* Removes constraints by number. Errors: HF_ERROR_NO_SUCH_SITE. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_remove_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites);

/* Moves constraints to other vertices of their components. The connection carries each vector along the shortest path of
 * edges. Errors: as hf_solver_move_vectors. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_move_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                         const uint32_t* vertices);

/* Gives constraints new vectors, [site_count][3], projected. Touches no factor. Errors: HF_ERROR_NO_SUCH_SITE,
 * HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (a vector normal to the surface). Thread safety: changes `direction`.
 * Since 0.1. */
HF_API hf_result hf_direction_set_vectors(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                          const double* vectors);

/* Turns constraints counter-clockwise, seen from outside, by angles[i] radians. Touches no factor. Errors:
 * HF_ERROR_NO_SUCH_SITE, HF_ERROR_NON_FINITE. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_rotate_sites(hf_direction direction, uint32_t site_count, const uint32_t* sites,
                                           const double* angles);

/* Records the constraints for undo. The last 256 records are kept. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_record(hf_direction direction);
/* Goes back to the last record, numbers included; the field then has the same bits as at the record. Errors:
 * HF_ERROR_NO_RECORD. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_undo(hf_direction direction);
/* Takes the last undo back. Errors: HF_ERROR_NO_RECORD. Thread safety: changes `direction`. Since 0.1. */
HF_API hf_result hf_direction_redo(hf_direction direction);

/* Number of constraints; 0 for an invalid handle. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_direction_get_site_count(hf_direction direction);

/* Writes the constraints by ascending number. Arrays are NULL or of `capacity` entries: sites (numbers), vertices (as
 * given), vectors ([capacity][3], tangent). out_count: NULL, or receives the number of constraints. Thread safety: reads
 * `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_sites(hf_direction direction, uint32_t capacity, uint32_t* out_sites,
                                        uint32_t* out_vertices, double* out_vectors, uint32_t* out_count);

/* Writes the field as vectors in space, [vertex_count][3], tangent to 1e-12 of their length; for degree 2 or 4 one of its
 * directions. Constrained vertices hold their vectors; vertices that no constraint reaches get 0. vector_stride: bytes
 * between vertices, 0 = packed. out_info: NULL, or what was not reached. Cost: a small dense solve and one backward sweep.
 * Errors: HF_ERROR_NO_SITES. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_solve(hf_direction direction, float* out_vectors, uint32_t vector_stride,
                                    hf_solve_info* out_info);
/* The same in double. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_solve_f64(hf_direction direction, double* out_vectors, uint32_t vector_stride,
                                        hf_solve_info* out_info);

/* A triangle around which the field turns against the surface. */
typedef struct hf_singularity {
  uint32_t triangle; /* as given */
  uint32_t vertex;   /* its corner where the field is shortest, as given; of welded copies the first */
  int32_t index;     /* in parts of 1 / degree: +1 a source or vortex of a vector field, -1 a saddle */
} hf_singularity;

/* Lists the singularities of the field, by triangle. On a component that is closed, manifold and of one orientation the
 * indices sum to degree times its Euler characteristic. out_singularities: NULL, or room for `capacity`. out_count: NULL,
 * or receives their number. Cost: a solve and a pass over the triangles. Crane, Desbrun and Schroeder 2010, Section 5.
 * Errors: HF_ERROR_NO_SITES. Thread safety: reads `direction`. Since 0.1. */
HF_API hf_result hf_direction_get_singularities(hf_direction direction, uint32_t capacity,
                                                hf_singularity* out_singularities, uint32_t* out_count);

/* What a direction field was made with, and what it holds and has done. */
typedef struct hf_direction_statistics {
  uint32_t struct_size;
  uint32_t degree;
  uint32_t site_limit;
  uint32_t unknown_count; /* two per vertex */
  uint32_t site_count;
  uint32_t factorisation_count;    /* the first included; grows when very many constraints go into the factor */
  uint32_t path_solve_count;       /* two per constraint added or moved */
  uint32_t sweep_count;            /* those of refused calls too */
  uint32_t irregular_vertex_count; /* vertices whose triangles are not one fan of one orientation */
  uint32_t eliminated_count;       /* constraints in the factor at present */
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
