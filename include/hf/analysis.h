/* hf/analysis.h - looking into a field and into the shape: iso-lines and their levels, critical points, geodesic
 * distance, extremities.
 *
 * Iso-lines, levels and critical points take any field over the solver's vertices, the solver's own or another; they
 * need nothing of the solver but its mesh. Distances and extremities work on the solver's factor (harmonic fields, any
 * operator and engine) and do not look at its sites.
 */
#ifndef HF_ANALYSIS_H
#define HF_ANALYSIS_H

#include "hf/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A field with one value per vertex of the mesh as given. One of values and values_f64 is set. NaN marks a vertex
 * without a value (one that no site reaches, say): the triangles and edges at it are left out. Infinity is refused. Of
 * welded copies the first one's value counts; vertices in no usable triangle are not looked at. */
typedef struct hf_scalars {
  uint32_t struct_size;
  uint32_t value_stride;    /* bytes between vertices; 0 = packed */
  const float* values;      /* [vertex_count] */
  const double* values_f64; /* [vertex_count], instead of values */
} hf_scalars;

/* ---- levels and iso-lines ---- */

/* How N levels divide a field into N + 1 strips. */
enum {
  HF_LEVELS_VALUE = 0, /* equal steps of the value */
  HF_LEVELS_AREA = 1,  /* equal areas: the strips cover the same area each */
  HF_LEVELS_LENGTH = 2 /* equal mean widths: the width of a strip is its area over the mean length of its lines */
};

/* Writes level_count levels (1 to 1,000,000), ascending. With A(c) the area where the field is below c and L(c) the
 * length of the line of level c, both exact for the piecewise linear field: AREA takes equal steps of A, LENGTH equal
 * steps of the integral of A'(c) / L(c) dc (on a cylinder: of the height; on a sphere: of the distance from the pole),
 * so that rings around point sites are evenly spaced where equal values crowd; where the field is flat to 1e-9 of its
 * range there are no lines, and LENGTH leaves that out. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT (spacing,
 * level_count; the field is constant), HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_EMPTY (no triangle has three
 * values), HF_ERROR_TOO_SMALL (stride), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: reads `solver`. Since
 * 0.1.
 */
HF_API hf_result hf_space_levels(hf_solver solver, const hf_scalars* field, int32_t spacing, uint32_t level_count,
                                 double* out_levels);

/* Iso-lines as polylines. A point lies on an edge of the mesh: (1 - parameter) a + parameter b, so that anything stored
 * at vertices can be taken along. Arrays of the caller, each NULL or large enough for the capacities. */
typedef struct hf_isolines {
  uint32_t struct_size;
  uint32_t point_capacity; /* points the arrays can take */
  uint32_t line_capacity;  /* lines the arrays can take */
  uint32_t point_count;    /* out */
  uint32_t line_count;     /* out */
  uint32_t reserved;       /* 0 */
  uint32_t* point_edges;   /* [point_capacity][2] vertices a and b as given, of welded copies the first */
  double* parameters;      /* [point_capacity] 0 to 1 */
  double* positions;       /* [point_capacity][3] in the unit and frame of the mesh as given */
  uint32_t* line_starts;   /* [line_capacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1 */
  uint32_t* line_levels;   /* [line_capacity] position of its level in the list */
  int32_t* line_closed;    /* [line_capacity] 1: closed, the first point is not repeated; 0: ends at borders */
} hf_isolines;

/* Traces the lines of level_count levels (finite, in any order; lines come in the order of the list). A vertex whose
 * value is a level counts as just above it, so lines have no gaps whatever the values: they close, or end at a border
 * of the mesh, at a triangle without values, or at a non-manifold edge (whose triangles are taken in pairs). Lines
 * without extent, around a vertex or an edge at the level, are left out. Higher values lie on the left of a line, seen
 * from outside, where the mesh is consistently oriented.
 *
 * out_lines: point_count and line_count are always written, also with HF_ERROR_TOO_SMALL; call with both capacities 0
 * and NULL arrays to ask for them. An array that is NULL is left out. Cost: O(edges log levels + points). Results:
 * HF_OK; HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC; HF_ERROR_EMPTY (level_count 0);
 * HF_ERROR_NON_FINITE (index = vertex, or position in levels); HF_ERROR_TOO_SMALL (an array is given, but its capacity
 * is below the count; stride); HF_ERROR_TOO_LARGE (2^32 points or more); HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. On
 * failure the arrays are not written. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_trace_isolines(hf_solver solver, const hf_scalars* field, uint32_t level_count,
                                   const double* levels, hf_isolines* out_lines);

/* ---- critical points ---- */

enum { HF_CRITICAL_MINIMUM = 0, HF_CRITICAL_MAXIMUM = 1, HF_CRITICAL_SADDLE = 2 };

typedef struct hf_critical_point {
  uint32_t vertex;    /* as given, of welded copies the first */
  int32_t kind;       /* HF_CRITICAL_* */
  int32_t index;      /* 1 for extrema (0 for a maximum on a border), -k for a saddle where k + 1 valleys meet */
  uint32_t component; /* as hf_get_components */
  double value;
} hf_critical_point;

typedef struct hf_critical_info {
  uint32_t struct_size;
  uint32_t point_count; /* minima + maxima + saddles */
  uint32_t minimum_count;
  uint32_t maximum_count;
  uint32_t saddle_count;        /* a saddle of several valleys counts once */
  int32_t index_sum;            /* of all points */
  int32_t euler_characteristic; /* vertices - edges + triangles of the usable surface that has values */
  uint32_t reserved;            /* 0 */
} hf_critical_info;

/* Critical points of the piecewise linear field by the signs around each vertex (Banchoff 1970): index = 1 - chi(part
 * of the ring around the vertex that lies below it). Equal values are told apart by the vertex number, so a flat area
 * has critical points of its own. The indices always sum to the Euler characteristic, on every component, with borders
 * and non-manifold edges. On meshes that are not Delaunay a harmonic field may seem to have an extremum off its sites
 * here, along the mesh's edges: the operator has others (HF_OPERATOR_CLAMPED has not). out_points: NULL, or room for `capacity` points, ordered by welded vertex; out_info: NULL, or
 * a struct with struct_size set, written also with HF_ERROR_TOO_SMALL. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER (field, or both outputs), HF_ERROR_INVALID_DESC, HF_ERROR_NON_FINITE (index = vertex),
 * HF_ERROR_TOO_SMALL (capacity below the count; stride), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: reads
 * `solver`. Since 0.1. */
HF_API hf_result hf_find_critical_points(hf_solver solver, const hf_scalars* field, uint32_t capacity,
                                         hf_critical_point* out_points, hf_critical_info* out_info);

/* ---- geodesic distance ---- */

/* What geodesic distances on one surface need beside the solver's factor. Keeps what it needs of the solver alive. */
typedef struct hf_geodesics_object* hf_geodesics;

typedef struct hf_geodesics_desc {
  uint32_t struct_size;
  float smoothing; /* m of the time step m h^2, h the mean edge length; larger is smoother; 0 = 1; 0.1 to 10,000 */
} hf_geodesics_desc;

/* Makes the second factor of the heat method (Crane, Weischedel and Wardetzky 2013) with the ordering of the solver's:
 * one numeric factorisation. desc: NULL for defaults. *out_geodesics is set to NULL first. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT,
 * HF_ERROR_UNSUPPORTED (the solver is bi-harmonic), HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_geodesics_create(hf_solver solver, const hf_geodesics_desc* desc, hf_geodesics* out_geodesics);

/* Destroys it. NULL, stale and foreign handles are ignored. Since 0.1. */
HF_API void hf_geodesics_destroy(hf_geodesics geodesics);

/* Distance along the surface from every vertex to the nearest of the sources, in the unit of the mesh: float
 * [vertex_count], value_stride bytes apart (0 = packed); exactly 0 at the sources, -1 where no source can be reached
 * (another component, isolated). sources: uint32_t[source_count] vertices of the mesh as given; repeats are allowed.
 * The error falls with the mesh's edge length; corners and the places where two shortest paths meet are rounded off.
 * Cost: two solves. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_EMPTY (no source),
 * HF_ERROR_OUT_OF_RANGE (index = position in the list), HF_ERROR_INVALID_ARGUMENT (isolated vertex; index = position in
 * the list), HF_ERROR_TOO_LARGE (more sources than vertices), HF_ERROR_TOO_SMALL, HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. On failure the output is not written. Thread safety: reads `geodesics`. Since 0.1. */
HF_API hf_result hf_geodesics_distance(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources,
                                       float* out_distances, uint32_t value_stride);

/* The same in double. Thread safety: reads `geodesics`. Since 0.1. */
HF_API hf_result hf_geodesics_distance_f64(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources,
                                           double* out_distances, uint32_t value_stride);

/* ---- extremities ---- */

/* What makes a vertex an extremity: the peaks of a field that rises towards the tips of what protrudes. */
enum {
  HF_EXTREMITIES_POISSON = 0, /* every point a source, a sink in the middle: one solve on the solver's own factor */
  HF_EXTREMITIES_GEODESIC = 1 /* mean geodesic distance to the rest of the component (Hilaga et al. 2001) */
};

typedef struct hf_extremities_desc {
  uint32_t struct_size;
  int32_t kind;           /* HF_EXTREMITIES_* */
  float least_length;     /* leave out what protrudes less, as a share of the box diagonal; 0 = 0.05; up to 10 */
  uint32_t source_count;  /* sources of the mean distance per component, 1 to 1,000; 0 = 40 */
  hf_geodesics geodesics; /* for HF_EXTREMITIES_GEODESIC: one made of this solver's mesh, or NULL to make one */
  hf_progress progress;   /* NULL, or an object to poll and cancel through */
  double* out_field; /* NULL, or [vertex_count], packed: the field whose peaks are proposed, 0 at isolated vertices.
                        Unit: length^2 (Poisson), length (geodesic), each up to a constant per component */
} hf_extremities_desc;

typedef struct hf_extremity {
  uint32_t vertex;    /* as given, of welded copies the first */
  uint32_t component; /* as hf_get_components */
  double length;      /* how far it protrudes, in the unit of the mesh: the field's persistence (how far it falls before
                         it rises to something higher), as a length: sqrt(2 p) for Poisson, p for geodesic */
  double position[3];
} hf_extremity;

/* Proposes the tips of the surface as places for sites and handles, those that protrude farthest first; the list does
 * not depend on the order of the vertices, on pose, or, up to the resolution, on the meshing. desc: NULL for defaults.
 * out_extremities: NULL, or room for `capacity`; out_count: the number found, written also with HF_ERROR_TOO_SMALL;
 * either may be NULL, not both. A component no larger than least_length has none. Cost: Poisson one
 * solve and a few passes over the mesh; geodesic a numeric factorisation (unless desc->geodesics is set) and two solves
 * per eight sources. Results: HF_OK, HF_ERROR_INVALID_HANDLE (solver, geodesics, progress), HF_ERROR_NULL_POINTER,
 * HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT (kind, counts; geodesics of another mesh), HF_ERROR_UNSUPPORTED (the
 * solver is bi-harmonic), HF_ERROR_TOO_SMALL, HF_ERROR_CANCELLED, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. On failure no
 * array is written. Thread safety: reads `solver` and desc->geodesics. Since 0.1. */
HF_API hf_result hf_find_extremities(hf_solver solver, const hf_extremities_desc* desc, uint32_t capacity,
                                     hf_extremity* out_extremities, uint32_t* out_count);

#ifdef __cplusplus
}
#endif
#endif
