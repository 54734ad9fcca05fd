/* hf/detail.h - detail modelling: a region of the surface, its smooth base surface, and what stands between the two.
 *
 * The base is the field of the region's three coordinates with the surface itself as boundary values (Xu, Zhang,
 * Cohen-Or and Xiong 2009): a membrane, K u = 0, where the solver's fields are harmonic, a thin plate that leaves its
 * rim smoothly where they are bi-harmonic. It has the surface's own connectivity, so a weight morphs between the two.
 * Only the rim holds sites on the solver's factor: a region grows and shrinks by inserting and removing them, without a
 * new factorisation. What the surface has more than the base is detail, and can be carried to another region.
 */
#ifndef HF_DETAIL_H
#define HF_DETAIL_H

#include "hf/field.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- regions ---- */

/* A region of a solver's surface with sites of its own on the solver's factor. Independent of the solver's sites. Keeps
 * what it needs of the solver alive. */
typedef struct hf_region_object* hf_region;

/* Zero every field that is not needed (HF_INIT). */
typedef struct hf_region_desc {
  uint32_t struct_size;
  uint32_t position_stride; /* bytes between vertices; 0 = packed */
  const float* positions;   /* [vertex_count][3] what weight 0 gives back, bit for bit, and the boundary values: the */
  const double* positions_f64; /* positions of hf_create, or any pose of them. Both NULL: the solver's own, which are */
                               /* those of hf_create to 1e-15 of the box. Copied */
} hf_region_desc;

/* Creates a region without vertices. desc: NULL for defaults. *out_region is set to NULL first. Cost: O(n), no
 * factorisation. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC,
 * HF_ERROR_INVALID_ARGUMENT (both positions set), HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_TOO_SMALL (stride),
 * HF_ERROR_UNSUPPORTED (the solver's engine is not HF_ENGINE_GREEN), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread
 * safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_region_create(hf_solver solver, const hf_region_desc* desc, hf_region* out_region);

/* A copy of the region as it is, sharing the factor and all it can; without the undo stack. *out_region is set to NULL
 * first. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread
 * safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_clone(hf_region region, hf_region* out_region);

/* Destroys it. NULL, stale and foreign handles are ignored. Since 0.1. */
HF_API void hf_region_destroy(hf_region region);

/* Which of the pieces that a closed curve cuts the surface into is the region. */
enum {
  HF_SIDE_SMALLER = 0, /* all but the piece of largest area */
  HF_SIDE_LARGER = 1,  /* the piece of largest area */
  HF_SIDE_SEED = 2     /* the piece that seed_vertex lies in */
};

/* A closed curve on the surface: at least 3 points in order, each joined to the next, and the last to the first, by a
 * shortest path along edges. The vertices on the curve are its rim, not part of the region. A
 * whole border is a curve too; it has one side. */
typedef struct hf_curve_desc {
  uint32_t struct_size;
  uint32_t point_count;
  const uint32_t* vertices;   /* [point_count] vertices of the mesh as given, or NULL */
  const uint32_t* triangles;  /* [point_count] triangles of the mesh as given, or NULL */
  const double* barycentrics; /* [point_count][3] with triangles: weights of the corners, >= 0, of sum 1 within 1e-6;
                                 the curve passes through the corner of largest weight */
  int32_t side;               /* HF_SIDE_* */
  uint32_t seed_vertex;       /* with HF_SIDE_SEED */
} hf_curve_desc;

/* A change of a region, in the order curve, rings, remove, add; parts that are 0 or NULL are left out. */
typedef struct hf_region_edit_desc {
  uint32_t struct_size;
  int32_t ring_count;         /* grows by so many rings of vertices; below 0: shrinks */
  const hf_curve_desc* curve; /* the region becomes what this curve encloses */
  uint32_t remove_count;
  uint32_t add_count;
  const uint32_t* remove_vertices; /* [remove_count] vertices that leave the region; those not in it are passed over */
  const uint32_t* add_vertices;    /* [add_count] vertices that join it; those in it already are passed over */
  hf_progress progress;            /* NULL, or an object to poll and cancel through */
} hf_region_edit_desc;

/* Changes the region and makes its base surface. Old and new rims are compared: sites that stay cost nothing, the rest
 * is one batch of hf_edit_sites' kind, so the factor is kept (but for very many sites at once, see hf_region_info), and
 * the base follows by one backward sweep, for small regions over the elimination paths of their vertices only. A region
 * may be in several pieces and components. Progress: curve, sites, base; a cancel takes effect between them.
 * Results: HF_OK; HF_ERROR_INVALID_HANDLE (region, progress), HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC,
 * HF_ERROR_EMPTY (fewer than 3 points, index = how many; no vertex would be left), HF_ERROR_OUT_OF_RANGE (vertex,
 * triangle; index = position in its list), HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (side, weights, isolated
 * vertex, points of different components: index = position in the list; the curve does not separate the surface; the
 * seed lies on the curve or in another component, index = the seed; a component would have no rim, index = a vertex of
 * it), HF_ERROR_TOO_LARGE (lists longer than the mesh has vertices), HF_ERROR_CANCELLED, HF_ERROR_OUT_OF_MEMORY,
 * HF_ERROR_BUSY. State after failure: unchanged. Thread safety: changes `region`. Since 0.1. */
HF_API hf_result hf_region_edit(hf_region region, const hf_region_edit_desc* edit);

/* Keeps the present region on its undo stack (at most 256 are kept; the oldest goes first). Costs nothing: what was
 * made is shared. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety:
 * changes `region`. Since 0.1. */
HF_API hf_result hf_region_record(hf_region region);
/* Goes back to the last record, bit for bit; hf_region_redo comes back. Results: HF_OK, HF_ERROR_NO_RECORD,
 * HF_ERROR_INVALID_HANDLE, HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. State after failure: unchanged. Thread safety:
 * changes `region`. Since 0.1. */
HF_API hf_result hf_region_undo(hf_region region);
HF_API hf_result hf_region_redo(hf_region region);

/* What a region is, and what its last edit did. Vertices are counted with welded copies as one. */
typedef struct hf_region_info {
  uint32_t struct_size;
  int32_t thin_plate;      /* 1: the base is a thin plate, 0: a membrane */
  uint32_t vertex_count;   /* of the region, without its rim */
  uint32_t rim_count;      /* vertices next to it */
  uint32_t site_count;     /* that hold the base: the rim, for thin plates two rings and more */
  uint32_t inserted_count; /* sites of the last edit ... */
  uint32_t removed_count;
  uint32_t kept_count;
  uint32_t factorisation_count; /* numeric factorisations of the region's edits so far; that of hf_create not counted */
  uint32_t path_solve_count;    /* sites whose path was solved, of all edits */
  uint32_t last_route;          /* HF_ROUTE_* of the last edit */
  uint32_t whole_sweep;         /* 1: the last base took a sweep through the whole factor */
  double area;                  /* of the triangles with a corner in the region, on the surface, in units^2 */
  double base_area;             /* the same on the base */
} hf_region_info;

/* Writes what is known of a region. out_info: a struct with struct_size set. Results: HF_OK, HF_ERROR_INVALID_HANDLE,
 * HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_BUSY. Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_get_info(hf_region region, hf_region_info* out_info);

/* Lists of a region's vertices. */
enum {
  HF_REGION_INSIDE = 0, /* the region */
  HF_REGION_RIM = 1,    /* the vertices next to it */
  HF_REGION_SITES = 2   /* those that hold the base */
};

/* Writes one list, ascending: vertices as given, of welded copies the first. list: HF_REGION_*; the counts are in
 * hf_region_info. out_vertices: uint32_t[capacity]. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER,
 * HF_ERROR_INVALID_ARGUMENT (list), HF_ERROR_TOO_SMALL (nothing is written), HF_ERROR_BUSY. Thread safety: reads
 * `region`. Since 0.1. */
HF_API hf_result hf_region_get_vertices(hf_region region, int32_t list, uint32_t capacity, uint32_t* out_vertices);

/* Where hf_region_morph and hf_detail_morph write. */
typedef struct hf_morph_desc {
  uint32_t struct_size;
  uint32_t position_stride; /* bytes between vertices; 0 = packed */
  double weight;            /* any finite number */
  float* positions;         /* [vertex_count][3] in the unit and frame of the mesh as given; NULL = none */
  double* positions_f64;    /* the same in double, instead */
  float* normals; /* [vertex_count][3] unit normals of the morphed surface, area-weighted, shared across seams;
                     NULL = none */
  uint32_t normal_stride;
  uint32_t reserved; /* 0 */
} hf_morph_desc;

/* Writes p + weight (base - p) for the vertices of the region and p for all others, p = the positions of
 * hf_region_desc. Weight 0 gives p bit for bit, 1 the base, between 0 and 1 a morph, below 0 detail exaggerated, above
 * 1 detail turned inside out. An empty region gives p. Solves nothing. Cost: O(n) for writing, normals by the size of
 * the region. Results: HF_OK, HF_ERROR_INVALID_HANDLE, HF_ERROR_NULL_POINTER (desc, or no output at all),
 * HF_ERROR_INVALID_DESC, HF_ERROR_INVALID_ARGUMENT (both positions set), HF_ERROR_NON_FINITE (weight),
 * HF_ERROR_TOO_SMALL (stride), HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_morph(hf_region region, const hf_morph_desc* desc);

/* ---- detail carried to another region ---- */

/* The detail of one region on another one, of the same surface or of another. */
typedef struct hf_detail_object* hf_detail;

typedef struct hf_detail_desc {
  uint32_t struct_size;
  uint32_t pair_count;             /* points of the two rims that correspond, in order along both; 0 = the first point
                                      of each region's curve, or where there was none its rim vertex of lowest number */
  const uint32_t* source_vertices; /* [pair_count] rim vertices of the source, as given */
  const uint32_t* target_vertices; /* [pair_count] rim vertices of the target, as given */
  double scale;                    /* of the detail; 0 = square root of target base area over source base area */
  hf_progress progress;            /* NULL, or an object to poll and cancel through */
} hf_detail_desc;

/* Carries detail by local frames: both regions are mapped to the unit disc by a harmonic map of positive weights (an
 * embedding: Tutte 1963, Floater 1997), their rims by arc length between the pairs; the offset from base to surface is
 * read in the source's frames (normal of the base, direction in which the first disc coordinate grows), interpolated in
 * the source's triangles, and set up in the target's frames. It fades to nothing at the rim. Onto the region itself it
 * gives the surface back. Takes both regions as they are; later edits of them change nothing.
 * Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation.
 * desc: NULL for defaults. *out_detail is set to NULL first. Cost: a factorisation of each region's own Laplacian, and
 * O(vertices). Progress: source, target, frames; a cancel takes effect between them. Results: HF_OK,
 * HF_ERROR_INVALID_HANDLE (source, target, progress), HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_NON_FINITE
 * (scale), HF_ERROR_INVALID_ARGUMENT (scale below 0; pairs that are not on the rims or not in order: index = position
 * in the list), HF_ERROR_OUT_OF_RANGE (vertex; index = position in the list), HF_ERROR_TOO_LARGE, HF_ERROR_EMPTY (a
 * region without vertices), HF_ERROR_UNSUPPORTED (a region that is no disc; index = a vertex), HF_ERROR_CANCELLED,
 * HF_ERROR_OUT_OF_MEMORY, HF_ERROR_BUSY. Thread safety: reads both regions. Since 0.1. */
HF_API hf_result hf_detail_create(hf_region source, hf_region target, const hf_detail_desc* desc,
                                  hf_detail* out_detail);

/* Destroys it. NULL, stale and foreign handles are ignored. Since 0.1. */
HF_API void hf_detail_destroy(hf_detail detail);

/* Writes the target's surface with its detail replaced: base + weight (carried detail) for the vertices of the target
 * region, the target's positions for all others. Weight 0 is the smooth base, 1 the detail as it was on the source,
 * more exaggerates, below 0 turns it inside out. Results, cost: as hf_region_morph. Thread safety: reads `detail`.
 * Since 0.1. */
HF_API hf_result hf_detail_morph(hf_detail detail, const hf_morph_desc* desc);

#ifdef __cplusplus
}
#endif
#endif
