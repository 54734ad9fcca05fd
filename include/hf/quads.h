/* hf/quads.h - make quad meshes of surfaces, and trace streamlines of fields. */
#ifndef HF_QUADS_H
#define HF_QUADS_H

#include "hf/analysis.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- quad meshes ---- */

typedef struct hf_quads_object* hf_quads;

/* Options of a quad mesh. HF_INIT gives quads along the curvature, with edges of 0.022 box diagonals. More than 16
 * fields: creases, guides and irregular vertices are lists with their counts. */
typedef struct hf_quads_desc {
  uint32_t struct_size;
  uint32_t face_count;  /* wanted number of quads, up to 10 million; it replaces edge_length. 0 = edge_length counts */
  double edge_length;   /* wanted length, in the unit of the mesh; 1e-4 to 1 box diagonals; 0 = 0.022 of it */
  double crease_angle;  /* edges of the surface that bend by more than this, radians, up to pi, become edges of quads; 0
                          = none.  If there are more than 1,024 lines of creases and borders, only the longest are kept.
                          Creases nearer to each other than an edge may be released */
  uint32_t relax_count; /* rounds of tangential relaxation, up to 1,000; 0 = 60; HF_NO_INDEX = none, and the mesh is
                           not fitted to the surface either */
  uint32_t crease_count;    /* edges of the surface that become edges of quads whatever their angle */
  uint32_t guide_count;     /* directions that edges of quads follow, such as strokes of an artist */
  uint32_t irregular_count; /* irregular vertices that the user places, up to 1,000 */
  double symmetry_plane[4]; /* a, b, c, d of the plane a x + b y + c z = d, in the unit of the mesh; 0, 0, 0, 0 = none.
                               Quads are made of the side that (a, b, c) points to, and mirrored. Creases, guides and
                               irregular vertices on the other side are not used */
  const uint32_t* crease_edges;       /* [crease_count][2] the two vertices of each edge, of your mesh */
  const uint32_t* guide_vertices;     /* [guide_count] vertices of your mesh; guides of one vertex are averaged */
  const double* guide_vectors;        /* [guide_count][3] along the surface, of any length above 0; quads run along the
                                         vector and across it */
  const float* guide_weights;         /* NULL = all 1, or [guide_count], above 0 to 1: 1 holds the direction. A smaller
                                         weight mixes it with the direction of the curvature, which has the rest of the
                                         weight */
  const double* irregular_points;     /* [irregular_count][3] at the surface, in the unit and frame of the mesh */
  const uint32_t* irregular_valences; /* [irregular_count] how many quads meet there: 3 or 5 */
  const double* irregular_directions; /* NULL = any, or [irregular_count][3]: one side of the irregular vertex runs
                                         along it; 0 0 0 = any */
  hf_progress progress;               /* NULL, or an object to poll and cancel through */
} hf_quads_desc;

/* Counts of a quad mesh. */
typedef struct hf_quads_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t face_count;
  int32_t euler_characteristic; /* vertices - edges + faces, equal to the Euler characteristic of the usable surface */
  double edge_length;           /* wanted length, in the unit of the mesh */
} hf_quads_info;

/* Makes a quad mesh of a surface. Every face is a quad. Edges follow smooth crosses along the curvature. Creases and
 * borders are straight lines of edges. Irregular vertices are the singularities of the crosses, and places where the
 * function split quads to keep to the surface.
 *
 * The function relaxes the mesh along the surface. Where mesh and surface are farther apart than 0.39 edge lengths, it
 * snaps vertices to the surface and adds quads. A relaxed quad starts at the corner whose diagonal keeps nearer to the
 * surface, so a renderer should split quads into triangles from the first corner. If the mesh stays farther than an
 * edge length from the surface, a limb is lost. Then the function makes up to three finer meshes, and removes rows of
 * quads until the number is right. The function checks every result. Each directed edge occurs once. No face repeats a
 * corner. The result has the Euler characteristic of the surface.
 *
 * The surface may have borders, any genus and several components; the function turns triangles that disagree in
 * orientation. Where three or more triangles share an edge, the two flattest are joined, then the next two. A triangle
 * without a partner gets a border. hf_surface_get_report counts such edges. A Moebius band is parted across.
 *
 * With symmetry_plane a vertex on the plane is its own image, and all others come in pairs, exact to rounding. Half of
 * the quads lie on each side. Where surface and mirror image differ, by up to 0.05 box diagonals, the side of
 * the normal counts.
 *
 * The user can place irregular vertices and drag them. The function makes each by guides on a ring around the place, an
 * edge of the quads away. The crosses on the ring make a quarter turn along it. 96 % of 1,000 irregular vertices at
 * random places of 20 meshes come out within an edge of the place; such a vertex then moves to the place and stays
 * there. A vertex of 5 quads brings others of 3 with it, because the indices of the crosses sum to four times the Euler
 * characteristic. On a torus or a knot a single one of 5 is often lost.
 *
 * desc: NULL = HF_INIT. Sets *out_quads to NULL first. Cost: two factorisations of the mesh and O(n log n + faces);
 * a thousand singularities take most of a minute. Progress covers factorisations, relaxation and fitting; each can be
 * cancelled.
 *
 * Errors: HF_ERROR_INVALID_ARGUMENT (face_count, edge_length, crease_angle, relax_count, an array without its count, an
 * isolated vertex, symmetry_plane without a normal; index = crease, that is no edge of the surface; index = guide, that
 * is 0, is normal to the surface or has a weight outside 0 to 1; index = irregular vertex, of other than 3 or 5 quads,
 * or where the surface has no normal), HF_ERROR_NON_FINITE (edge_length, crease_angle, symmetry_plane, index = guide or
 * irregular vertex), HF_ERROR_OUT_OF_RANGE (index = crease or guide), HF_ERROR_UNSUPPORTED (more than 5 % of the edges
 * have three triangles or cannot be oriented, index = a vertex; a surface that symmetry_plane does not mirror, index =
 * the vertex that is off most; no triangle on the side of the normal), HF_ERROR_TOO_LARGE (more than a million quads of
 * the default edge length, more creases than edges, index = irregular vertex that is two boxes or more away),
 * HF_ERROR_CANCELLED, HF_ERROR_NOT_POSITIVE_DEFINITE, HF_ERROR_INTERNAL when the check fails. Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_quads_create(hf_surface surface, const hf_quads_desc* desc, hf_quads* out_quads);

/* Makes the mesh of `quads` again, with other options: for strokes and creases that the user drags. hf_quads_create
 * with the same options gives the same result, bit for bit. The first update takes as long. It keeps the tables that do
 * not depend on guides, creases and relax_count. Later updates with the same edge_length, face_count and symmetry_plane
 * take less time. Without relaxation (relax_count = HF_NO_INDEX) they take 0.1 s for 15,000 vertices. Use that while
 * the user drags, and relax_count = 0 at the end. Other sizes and planes are allowed; what belongs to them is made
 * again. After an error `quads` is unchanged. Kept memory: 2 to 4 kB per vertex, until `quads` is destroyed. Errors: as
 * for hf_quads_create. Thread safety: changes `quads`, reads its surface. Since 0.1. */
HF_API hf_result hf_quads_update(hf_quads quads, const hf_quads_desc* desc);

/* Destroys a quad mesh. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_quads_destroy(hf_quads quads);

/* Writes the counts. Thread safety: reads `quads`. Since 0.1. */
HF_API hf_result hf_quads_get_info(hf_quads quads, hf_quads_info* out_info);

/* hf_quads_get_mesh writes the quad mesh to these arrays. They are yours: each is NULL or as large as its capacity. */
typedef struct hf_quads_mesh {
  uint32_t struct_size;
  uint32_t vertex_capacity, face_capacity; /* in */
  uint32_t vertex_count, face_count;       /* out */
  uint32_t reserved;                       /* 0 */
  double* positions;                       /* [vertex_capacity][3] in the unit and frame of your mesh */
  uint32_t* faces;                         /* [face_capacity][4] vertices of each quad, counter-clockwise */
  uint32_t* triangles;                     /* [vertex_capacity] triangle or face of your mesh that contains the
                                              vertex */
  double* barycentrics; /* [vertex_capacity][3] weights of that triangle's corners, in its own order, of sum 1; in a
                           face of more corners the weights of `corners` */
  uint32_t* corners;    /* [vertex_capacity][3] vertices of your mesh that barycentrics belong to, the first of welded
                           copies */
} hf_quads_mesh;

/* Writes every array that is not NULL. Errors: HF_ERROR_TOO_SMALL (a capacity). Thread safety: reads `quads`. Since
 * 0.1. */
HF_API hf_result hf_quads_get_mesh(hf_quads quads, hf_quads_mesh* inout_mesh);

/* ---- streamlines ----
 *
 * Streamlines follow the flux f_ij = w_ij (u_j - u_i) of a field u along the mesh edge ij. The weights w are positive:
 * the call uses HF_OPERATOR_CLAMPED, whatever operator the surface has. At a vertex of a harmonic field that is not a
 * site, the flux that comes in equals the flux that goes out. Imagine each edge as a strip as wide as its flux. A
 * streamline runs along such strips and keeps a place across each strip. At every vertex a planar matching connects the
 * incoming strips to the outgoing strips. So streamlines never cross or merge, and their value always rises, on
 * surfaces of any genus. */

/* A surface that is prepared for tracing streamlines. */
typedef struct hf_flow_object* hf_flow;

/* Prepares a surface for tracing: computes half-edges and weights. Sets *out_flow to NULL first. Cost: O(n log n),
 * no factorisation. Edges of three or more triangles are parted as for quads. Errors: HF_ERROR_UNSUPPORTED (as for
 * quads; index = a vertex). Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_flow_create(hf_surface surface, hf_flow* out_flow);

/* Destroys the object. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_flow_destroy(hf_flow flow);

typedef struct hf_streamlines {
  uint32_t struct_size;
  uint32_t
      wanted_count; /* in: lines from the minima of the field, each for the same flux, 1 to 1,000,000; without seeds */
  uint32_t seed_count;                    /* in: lines through chosen vertices instead, up to 1,000,000; 0 = none */
  uint32_t point_capacity, line_capacity; /* in */
  uint32_t point_count, line_count;       /* out */
  uint32_t reserved;                      /* 0 */
  const uint32_t* seeds;                  /* in: [seed_count] vertices of your mesh */
  double* positions;                      /* [point_capacity][3] in the unit and frame of your mesh */
  double* values;                         /* [point_capacity] of the field, rising along every line */
  uint32_t* line_starts; /* [line_capacity + 1] line i holds the points line_starts[i] to line_starts[i + 1] - 1 */
  uint32_t* line_ends;   /* [line_capacity][2] vertices where it starts and ends, of welded copies the first */
} hf_streamlines;

/* Traces streamlines of any field that is finite at every vertex in a triangle. For a harmonic field of
 * HF_OPERATOR_CLAMPED the lines are denser where the field is steeper. hf_surface_trace_isolines gives the lines
 * that cross the streamlines. field: [vertex_count] of float or double. Cost: O(n log n), and O(degree) for every
 * edge that a line runs along. This is quick enough to redraw the lines while the user drags a site. Errors:
 * HF_ERROR_INVALID_ARGUMENT (wanted_count, isolated seed), HF_ERROR_OUT_OF_RANGE (seed), HF_ERROR_NON_FINITE (index
 * = vertex). Thread safety: reads `flow`. Since 0.1. */
HF_API hf_result hf_flow_trace(hf_flow flow, const hf_array* field, hf_streamlines* inout_lines);

#ifdef __cplusplus
}
#endif
#endif
