/* hf/analysis.h - trace iso-lines, find critical points, measure geodesic distances, find the tips of a shape.
 *
 * Iso-lines, levels and critical points work on any field with one value per vertex. NaN marks a vertex without a
 * value: functions leave out the triangles and edges at that vertex. They refuse infinity. Where vertices were welded,
 * the value of the first copy counts. Functions ignore vertices that lie in no usable triangle. Distances and tips use
 * the harmonic factor of the surface. */
#ifndef HF_ANALYSIS_H
#define HF_ANALYSIS_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- levels and iso-lines ---- */

/* Selects how levels divide a field into strips. N levels give N + 1 strips. */
enum hf_levels {
  HF_LEVELS_VALUE = 0, /* equal steps of the value */
  HF_LEVELS_AREA = 1,  /* equal areas: the strips cover the same area each */
  HF_LEVELS_LENGTH = 2 /* equal mean widths: the width of a strip is its area over the mean length of its lines */
};

/* Writes levels, ascending. field: [vertex_count] of float or double. level_count: 1 to 1,000,000. spacing:
 * HF_LEVELS_*. out_levels: double[level_count]. HF_LEVELS_AREA makes all strips equal in area. HF_LEVELS_LENGTH makes
 * the mean widths of the strips equal. So iso-lines around point sites are evenly spaced, where equal steps of the
 * value would crowd them. HF_LEVELS_LENGTH leaves out the parts where the field is flat to 1e-9 of its range.
 *
 * In formulas, A(c) is the area where the field is below c, and L(c) is the length of the iso-line of level c. Both are
 * exact for the piecewise linear field. HF_LEVELS_AREA takes equal steps of A. HF_LEVELS_LENGTH takes equal steps of
 * the integral of A'(c) / L(c) dc. That integral is the height on a cylinder and the distance from the pole on a
 * sphere.
 *
 * Errors: HF_ERROR_INVALID_ARGUMENT (spacing, level_count, a constant field), HF_ERROR_NON_FINITE (index = vertex),
 * HF_ERROR_EMPTY (no triangle has three values). Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_space_levels(hf_surface surface, const hf_array* field, int32_t spacing,
                                         uint32_t level_count, double* out_levels);

/* Iso-lines as polylines. Each point lies on a mesh edge with the end vertices a and b, at the position (1 - parameter)
 * a + parameter b. So you can interpolate any vertex attribute at the point. The arrays are yours: each is NULL or as
 * large as its capacity. */
typedef struct hf_isolines {
  uint32_t struct_size;
  uint32_t point_capacity; /* in: points the arrays can take */
  uint32_t line_capacity;  /* in: lines the arrays can take */
  uint32_t point_count;    /* out */
  uint32_t line_count;     /* out */
  uint32_t reserved;       /* 0 */
  uint32_t* point_edges;   /* [point_capacity][2] vertices a and b of your mesh, the first of welded copies */
  double* parameters;      /* [point_capacity] 0 to 1 */
  double* positions;       /* [point_capacity][3] in the unit and frame of your mesh */
  uint32_t* line_starts;   /* [line_capacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1 */
  uint32_t* line_levels;   /* [line_capacity] position of its level in the list */
  int32_t* line_closed;    /* [line_capacity] 1: closed, the first point is not repeated; 0: ends at borders */
} hf_isolines;

/* Traces the iso-lines of levels. field: [vertex_count] of float or double. levels: double[level_count]. The levels
 * must be finite and can have any order; the lines come in the order of the levels. A vertex whose value equals a level
 * counts as just above it, so lines have no gaps. A line either closes or ends. It ends at a border or at a triangle
 * without values. At an edge of three or more triangles (non-manifold), these are taken in pairs. A line continues
 * inside a pair, and ends at a triangle without a partner. The function leaves out lines of length zero. Seen from
 * outside a consistently oriented mesh, the field is higher on the left of a line. Cost: O(edges log levels + points).
 * Errors: HF_ERROR_NON_FINITE (index = vertex, or position in levels), HF_ERROR_TOO_LARGE (2^32 points). Thread safety:
 * reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_trace_isolines(hf_surface surface, const hf_array* field, uint32_t level_count,
                                           const double* levels, hf_isolines* inout_lines);

/* ---- critical points ---- */

enum hf_critical { HF_CRITICAL_MINIMUM = 0, HF_CRITICAL_MAXIMUM = 1, HF_CRITICAL_SADDLE = 2 };

typedef struct hf_critical_point {
  uint32_t vertex;    /* of your mesh, the first of welded copies */
  int32_t kind;       /* HF_CRITICAL_* */
  int32_t index;      /* 1 for extrema (0 for a maximum on a border), -k for a saddle where k + 1 valleys meet */
  uint32_t component; /* its piece, as hf_surface_get_pieces: links do not count here */
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

/* Lists the minima, maxima and saddles of the piecewise linear field. The signs of the field around each vertex decide
 * (Banchoff 1970). Take its neighbours with lower values and the edges between them. The index of the vertex is 1 minus
 * their Euler characteristic. The vertex number breaks ties, so a flat area has critical points too. The indices sum to
 * the Euler characteristic on every component. On a mesh that is not Delaunay a harmonic field can show an extremum
 * away from its sites, because the default operator uses other edges than the mesh. HF_OPERATOR_CLAMPED uses the edges
 * of the mesh and avoids this. field: [vertex_count] of float or double. out_points: NULL, or
 * hf_critical_point[capacity], out_info->point_count of them, ordered by welded vertex. out_info: NULL, or receives the
 * counts. Errors: HF_ERROR_NON_FINITE (index = vertex). Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_find_critical_points(hf_surface surface, const hf_array* field, uint32_t capacity,
                                                 hf_critical_point* out_points, hf_critical_info* out_info);

/* ---- geodesic distance ---- */

/* Computes geodesic distances on one surface: the lengths of shortest paths along it. */
typedef struct hf_geodesics_object* hf_geodesics;

/* Selects how distances are computed. docs/geodesics.md has the errors of each. */
enum hf_distance_method {
  HF_GEODESICS_AUTO = 0,  /* EXACT up to 10,000 vertices, FRONT beyond */
  HF_GEODESICS_FRONT = 1, /* fast: circular fronts on the intrinsic Delaunay triangulation (Novotni and Klein 2002) */
  HF_GEODESICS_EXACT = 2, /* exact up to rounding: windows (Mitchell, Mount and Papadimitriou 1987) */
  HF_GEODESICS_HEAT = 3   /* smooth, and least exact: the heat method (Crane, Weischedel and Wardetzky 2013) */
};

typedef struct hf_geodesics_desc {
  uint32_t struct_size;
  int32_t method;       /* HF_GEODESICS_* */
  double smoothing;     /* of HEAT: m of the time step m h^2, h the mean edge length; larger is smoother. From 0.1 to
                           10,000; 0 = 1 */
  hf_progress progress; /* NULL, or an object to poll and cancel through: creation and every later call report to it */
} hf_geodesics_desc;

/* Creates the object and the tables of its method. FRONT and EXACT take a pass over the triangles. HEAT takes one
 * numeric factorisation and holds a factor of its own beside the surface's. desc: NULL for defaults. Sets
 * *out_geodesics to NULL first. Errors: HF_ERROR_INVALID_ARGUMENT (smoothing, method), HF_ERROR_NOT_POSITIVE_DEFINITE
 * (HEAT), HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_geodesics_create(hf_surface surface, const hf_geodesics_desc* desc, hf_geodesics* out_geodesics);

/* Destroys the object. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_geodesics_destroy(hf_geodesics geodesics);

/* Writes the distance along the surface from every vertex to the nearest source, in the unit of the mesh.
 * out_distances: [vertex_count] of float or double. The distance is 0 at the sources, and -1
 * at vertices that no source can reach. sources: uint32_t[source_count] vertices of your mesh; repeats are allowed.
 * Paths follow the triangles and ignore links. Triangles with the same corners count once: a two-sided sheet measures
 * as a single one. No distance of EXACT and FRONT is below the straight line to the nearest source. EXACT is right up
 * to rounding. The error of FRONT falls with the edge length. HEAT rounds the distance off at corners and where two
 * shortest paths meet. Cost: O(n log n) for FRONT, about n^1.5 for EXACT, two solves for HEAT. Errors:
 * HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT (isolated vertex), HF_ERROR_TOO_LARGE (more sources than vertices;
 * EXACT: more windows than 20 t^1.5 + 10^6 for t triangles), HF_ERROR_CANCELLED (nothing is written). Thread safety:
 * reads `geodesics`; calls on several threads share its progress. Since 0.1. */
HF_API hf_result hf_geodesics_solve(hf_geodesics geodesics, uint32_t source_count, const uint32_t* sources,
                                    const hf_array_out* out_distances);

/* A path along the surface, from its first point to its last. Each point lies on a mesh edge with the end vertices a
 * and b, at the position (1 - parameter) a + parameter b; at a vertex a is b. An end inside a triangle has HF_NO_INDEX
 * for both. The arrays are yours: each is NULL or as large as the capacity. */
typedef struct hf_path {
  uint32_t struct_size;
  uint32_t point_capacity; /* in: points the arrays can take */
  uint32_t point_count;    /* out; 0: no path leads from one to the other */
  uint32_t reserved;       /* 0 */
  double length;           /* out: in the unit of the mesh; -1: no path */
  uint32_t* point_edges;   /* [point_capacity][2] vertices a and b of your mesh, the first of welded copies */
  double* parameters;      /* [point_capacity] 0 to 1 */
  double* positions;       /* [point_capacity][3] in the unit and frame of your mesh */
} hf_path;

/* Finds the shortest path between two points, exact up to rounding, whatever the method of the object. If several are
 * as short, it writes one of them. The path is straight where its triangles are unfolded; it bends at vertices only.
 * Cost: exact distances, but only where a path no longer than one along edges can run. An object of HF_GEODESICS_EXACT
 * has their tables; for others the call makes them in a pass over the triangles. Errors: HF_ERROR_OUT_OF_RANGE,
 * HF_ERROR_INVALID_ARGUMENT (isolated vertex, barycentrics, corners of no triangle), HF_ERROR_NON_FINITE, each with
 * index 0 for `from` and 1 for `to`; HF_ERROR_TOO_SMALL (point_capacity; the counts are written), HF_ERROR_TOO_LARGE
 * (as EXACT of hf_geodesics_solve), HF_ERROR_CANCELLED. Thread safety: as hf_geodesics_solve. Since 0.1. */
HF_API hf_result hf_geodesics_find_path(hf_geodesics geodesics, const hf_place* from, const hf_place* to,
                                        hf_path* inout_path);

/* Lays the surface around a point out in a plane (logarithmic map): for decals, brushes and textures. A vertex lies at
 * the length of its shortest path from the point, in the direction in which the path starts. out_map:
 * double[vertex_count][2] in the unit of the mesh, the point at 0, 0; NaN where no path leads. radius: vertices farther
 * away get NaN too and take no time; 0 = no bound. out_frame: NULL, or double[6]: the directions in space of the two
 * axes, unit vectors. Around a vertex of a closed fan, angles are scaled to 2 pi in all. Seen from outside a
 * consistently oriented mesh, the second axis is to the left of the first. The map is exact up to rounding, and tears
 * where two shortest paths meet. Errors: as hf_geodesics_find_path, with index 0; HF_ERROR_INVALID_ARGUMENT (radius).
 * Thread safety: as hf_geodesics_solve. Since 0.1. */
HF_API hf_result hf_geodesics_get_map(hf_geodesics geodesics, const hf_place* centre, double radius, double* out_map,
                                      double* out_frame);

/* ---- extremities ---- */

/* Selects how hf_surface_find_extremities finds tips. Both kinds take the maxima of a field that rises towards
 * protruding parts. */
enum hf_extremity_kind {
  HF_EXTREMITIES_POISSON = 0, /* a field with a source at every vertex: one solve */
  HF_EXTREMITIES_GEODESIC = 1 /* mean geodesic distance to the rest of the component (Hilaga et al. 2001) */
};

typedef struct hf_extremities_desc {
  uint32_t struct_size;
  int32_t kind;              /* HF_EXTREMITIES_* */
  double least_length_share; /* tips that protrude less are left out: share of the box diagonal; 0 = 0.05; up to 10 */
  uint32_t source_count;     /* sources of the mean distance per component, 1 to 1,000; 0 = 40 */
  uint32_t reserved;         /* 0 */
  hf_geodesics geodesics;    /* for HF_EXTREMITIES_GEODESIC: an object of this surface. If its method is
                                HF_GEODESICS_HEAT its factor serves; else, and for NULL, the call makes a factor */
  hf_progress progress;      /* NULL, or an object to poll and cancel through */
  double* out_field; /* NULL, or [vertex_count], packed: the field whose peaks are proposed, 0 at isolated vertices.
                        Unit: length^2 (Poisson), length (geodesic), each up to a constant per component */
} hf_extremities_desc;

typedef struct hf_extremity {
  uint32_t vertex;    /* of your mesh, the first of welded copies */
  uint32_t component; /* its piece, as hf_surface_get_pieces: links do not count here */
  double length;      /* how far the tip protrudes, in the unit of the mesh. With p the persistence of the peak of the
                         field: sqrt(2 p) for POISSON, p for GEODESIC */
  double position[3];
} hf_extremity;

/* Proposes the tips of the surface as places for sites and handles, the longest tip first. The list does not depend on
 * the order of the vertices. Pose and meshing change it only within the resolution of the mesh. desc: NULL for
 * defaults. out_extremities: NULL, or hf_extremity[capacity]. out_count: NULL, or receives the number of tips. A
 * component that is no larger than least_length_share has no tips. Cost: HF_EXTREMITIES_POISSON takes one solve and a
 * few passes over the mesh. HF_EXTREMITIES_GEODESIC takes two solves per eight sources, and one numeric factorisation
 * without such a factor. Errors: HF_ERROR_INVALID_ARGUMENT (kind, counts, geodesics of another surface),
 * HF_ERROR_CANCELLED. Thread safety: reads `surface` and desc->geodesics. Since 0.1. */
HF_API hf_result hf_surface_find_extremities(hf_surface surface, const hf_extremities_desc* desc, uint32_t capacity,
                                             hf_extremity* out_extremities, uint32_t* out_count);

#ifdef __cplusplus
}
#endif
#endif
