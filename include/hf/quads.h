/* hf/quads.h - quad meshes and flow lines from harmonic fields.
 *
 * Both rest on the exact discrete flux f_ij = w_ij (u_j - u_i) of a field with positive weights w: a flow on the edges
 * of the mesh, balanced at every vertex that is no site. A flow line is an edge with an offset in its flux; it passes a
 * vertex by a planar matching of what comes in to what goes out. So lines never cross, never merge, rise all the way,
 * and end at extrema only, on surfaces of any genus. Weights are the cotangent ones floored at 1e-3 of their median
 * (HF_OPERATOR_CLAMPED), whatever operator the solver has.
 */
#ifndef HF_QUADS_H
#define HF_QUADS_H

#include "hf/analysis.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- quad meshes ---- */

typedef struct hf_quads_object* hf_quads;

enum {
  HF_QUADS_UNIFORM = 0, /* lines are added and ended, in pairs, so that edges keep about one length */
  HF_QUADS_PURE = 1     /* every line runs from a source to a sink: irregular places are sites, saddles, and where quads
                           were made smaller to keep to the surface; edges are as long as the field makes them */
};

typedef struct hf_quads_desc {
  uint32_t struct_size;
  int32_t kind;                  /* HF_QUADS_* */
  float edge_length;             /* aimed at, in the unit of the mesh; 0 = 0.022 of the box diagonal */
  uint32_t site_count;           /* 0 = sites are proposed: tips, and points far from them */
  const uint32_t* site_vertices; /* [site_count] as given; where lines start or end. Borders are sites of their own */
  const int32_t* site_lines;     /* NULL = chosen, or [site_count]: how many lines end (> 0) or start (< 0) there; both
                                    signs in every component, evened out to even numbers, at least 4, of one sum */
  int32_t keep_polygons;         /* 1: polygons at sites and saddles stay whole; 0: all faces are split into quads */
  uint32_t relax_count;          /* rounds of tangential relaxation, up to 1,000; 0 = 60; HF_NO_INDEX = none, and the
                                    mesh stays as the lines make it */
  hf_progress progress;          /* NULL, or an object to poll and cancel through */
} hf_quads_desc;

/* What came out. Angles in degrees. */
typedef struct hf_quads_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t face_count;
  uint32_t corner_count; /* of all faces */
  uint32_t quad_count;
  uint32_t polygon_count;       /* faces before splitting and fitting */
  uint32_t polygon_quad_count;  /* quads among them */
  uint32_t site_count;          /* borders included */
  uint32_t saddle_count;        /* a saddle of several valleys counts so many times, less one */
  int32_t euler_characteristic; /* vertices - edges + faces, that of the usable surface */
  float edge_length;            /* that was aimed at, in the unit of the mesh */
  uint32_t reserved;            /* 0 */
} hf_quads_info;

/* Makes a quad mesh of the solver's surface. The sites and values of the solver are not looked at; its factor is, for
 * proposing sites. Sources and sinks are chosen so that they carry the same number of lines and neighbours differ; a
 * Neumann problem with these numbers as fluxes gives the field; rings of nodes stand on its level loops edge_length
 * apart, arc by arc of its Reeb graph; the lines between them make the faces. Vertices lie on the surface. Where the
 * relaxed mesh and the surface are farther from each other than 0.39 edge lengths, vertices are drawn there and quads
 * added, in both kinds; HF_QUADS_UNIFORM also takes quads with short edges out. A quad starts at the corner whose
 * diagonal keeps nearer to the surface (at its reflex corner, if it has one): fans of triangles from first corners are
 * meant. Every result is checked before it is handed out: each directed edge once, no corner repeated in a face, the
 * Euler characteristic of the surface (a vertex where the surface touches itself counts once per sheet).
 *
 * Works on manifold surfaces with or without borders, of any genus, in several components; triangles that disagree in
 * orientation are turned. Every component gets at least 4 nodes around and 2 sites, so a mesh finer than its features
 * is no result of a large edge_length.
 * A border that the flux of the other sites would cross whatever its own holds all sites of its component at one of two
 * levels instead; site_lines are then the even numbers nearest to the fluxes.
 * out_quads: set to NULL first. Cost: a factorisation of the mesh, O(n log n + faces), and for sites that are proposed
 * up to four meshes of which the best is kept, and where none keeps within 0.43 edge lengths of the surface up to four
 * more with edges down to edge_length / 1.3. Progress: rises through factorisations, sites, critical points of the
 * field, and rounds of relaxation and fitting, and a cancel is heeded at each of them; ranking the vertices, and
 * measuring 100,000 points against a mesh, are one step each.
 * Results: HF_OK; HF_ERROR_INVALID_HANDLE (solver, progress), HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC,
 * HF_ERROR_INVALID_ARGUMENT (kind, edge_length, relax_count, lines of one sign or 0, an isolated vertex as site;
 * index = position in the list), HF_ERROR_NON_FINITE (edge_length), HF_ERROR_OUT_OF_RANGE (site vertex; index =
 * position in the list), HF_ERROR_DUPLICATE_SITE, HF_ERROR_UNSUPPORTED (non-manifold edge or surface that cannot be
 * oriented, index = a vertex; bi-harmonic solver; sites that no flux can part),
 * HF_ERROR_TOO_LARGE (more than 400 sites and borders in a component, a million rings), HF_ERROR_CANCELLED,
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY; HF_ERROR_INTERNAL when the check fails. Thread safety: reads `solver`. Since
 * 0.1. */
HF_API hf_result hf_quads_create(hf_solver solver, const hf_quads_desc* desc, hf_quads* out_quads);

/* Destroys it. NULL, stale and foreign handles are ignored. Since 0.1. */
HF_API void hf_quads_destroy(hf_quads quads);

/* Sizes and counts. out_info: a struct with struct_size set. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_BUSY. Thread safety: reads `quads`. Since 0.1. */
HF_API hf_result hf_quads_get_info(hf_quads quads, hf_quads_info* out_info);

/* Arrays of the caller, each NULL or as large as hf_quads_get_info says. */
typedef struct hf_quads_mesh {
  uint32_t struct_size;
  uint32_t vertex_capacity, face_capacity, corner_capacity, site_capacity;
  uint32_t reserved;       /* 0 */
  double* positions;       /* [vertex_capacity][3] in the unit and frame of the mesh as given */
  uint32_t* triangles;     /* [vertex_capacity] triangle of the mesh as given that the vertex lies in */
  double* barycentrics;    /* [vertex_capacity][3] weights of that triangle's corners, in its own order, of sum 1 */
  uint32_t* face_starts;   /* [face_capacity + 1] face i has the corners face_starts[i] .. face_starts[i + 1] - 1 */
  uint32_t* face_corners;  /* [corner_capacity] vertices, counter-clockwise */
  uint32_t* site_vertices; /* [site_capacity] of the mesh as given; HF_NO_INDEX for a border */
  int32_t* site_lines;     /* [site_capacity] lines that end (> 0) or start (< 0) there in kind pure */
} hf_quads_mesh;

/* Writes the arrays that are given. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_INVALID_DESC, HF_ERROR_TOO_SMALL (an array is given, but its capacity is below the count; nothing is
 * written), HF_ERROR_BUSY. Thread safety: reads `quads`. Since 0.1. */
HF_API hf_result hf_quads_get_mesh(hf_quads quads, const hf_quads_mesh* out_mesh);

/* ---- flow lines ---- */

/* A surface prepared for tracing. Keeps what it needs of the solver alive. */
typedef struct hf_flow_object* hf_flow;

/* Prepares the solver's surface: half-edges and weights. out_flow: set to NULL first. Cost: O(n log n), no
 * factorisation. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_UNSUPPORTED (non-manifold
 * edge or surface that cannot be oriented; index = a vertex), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety:
 * reads `solver`. Since 0.1. */
HF_API hf_result hf_flow_create(hf_solver solver, hf_flow* out_flow);

/* Destroys it. NULL, stale and foreign handles are ignored. Since 0.1. */
HF_API void hf_flow_destroy(hf_flow flow);

typedef struct hf_flow_lines {
  uint32_t struct_size;
  uint32_t wanted_count; /* lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds */
  uint32_t seed_count;   /* lines through chosen vertices instead; 0 = none */
  uint32_t point_capacity, line_capacity; /* what the arrays can take */
  uint32_t point_count, line_count;       /* out */
  uint32_t reserved;                      /* 0 */
  const uint32_t* seeds;                  /* [seed_count] vertices as given */
  double* positions;                      /* [point_capacity][3] in the unit and frame of the mesh as given */
  double* values;                         /* [point_capacity] of the field, rising along every line */
  uint32_t* line_starts; /* [line_capacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1 */
  uint32_t* line_ends;   /* [line_capacity][2] vertices where it starts and ends, of welded copies the first */
} hf_flow_lines;

/* Traces flow lines of any field over the solver's vertices: finite at every vertex in a triangle. Of a harmonic field
 * of the clamped operator they stand as dense as the field is steep. hf_trace_isolines gives the lines across them.
 * inout_lines: point_count and line_count are always written, also with HF_ERROR_TOO_SMALL; an array that is NULL is
 * left out. Cost: O(n log n) for n vertices and O(degree) for every edge a line runs in: quick enough to follow a site
 * that is dragged. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC,
 * HF_ERROR_INVALID_ARGUMENT (wanted_count, isolated seed), HF_ERROR_OUT_OF_RANGE (seed; index = position in the list),
 * HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_TOO_SMALL (an array is given, but its capacity is below the count),
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. On failure no array is written. Thread safety: reads `flow`. Since 0.1. */
HF_API hf_result hf_flow_trace(hf_flow flow, const hf_scalars* field, hf_flow_lines* inout_lines);

#ifdef __cplusplus
}
#endif
#endif
