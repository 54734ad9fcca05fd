/* hf/region.h - smooth a region of the surface, morph its detail, transfer the detail to another region.
 *
 * The smooth base of a region is a surface of the same connectivity without the detail (Xu, Zhang, Cohen-Or and Xiong
 * 2009). Each of its three coordinates is a field whose boundary values are the positions around the region. A harmonic
 * base is a membrane. A bi-harmonic base is a thin plate, which leaves the surrounding surface smoothly; it is the
 * default. A weight morphs between surface and base. Only vertices around the region hold sites, so a region grows and
 * shrinks without a factorisation. The detail is the difference between the surface and the base. */
#ifndef HF_REGION_H
#define HF_REGION_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- regions ---- */

/* A region of a surface and its smooth base. */
typedef struct hf_region_object* hf_region;

/* The smooth base of a region. */
enum hf_base {
  HF_BASE_DEFAULT = 0,         /* THIN_PLATE */
  HF_BASE_MEMBRANE = 1,        /* harmonic: the least area for its rim, nearly; it meets the rim with a crease */
  HF_BASE_THIN_PLATE = 2,      /* bi-harmonic (HF_FIELD_BIHARMONIC): leaves the surface around it without a crease */
  HF_BASE_THIN_PLATE_GRAPH = 3 /* the paper's bi-harmonic field (HF_FIELD_BIHARMONIC_GRAPH) */
};

typedef struct hf_region_desc {
  uint32_t struct_size;
  int32_t base;         /* HF_BASE_*. If the surface has no factor for it yet, it is made now */
  hf_array positions;   /* NULL, or [vertex_count][3] of float or double: positions of the mesh or of a pose. A morph of
                           weight 0 writes the same bits. NULL: the positions of the mesh, to 1e-15 of the box. The
                           call copies the array */
  hf_progress progress; /* NULL, or an object to poll and cancel through */
} hf_region_desc;

/* Creates a region without vertices. desc: NULL for defaults. Sets *out_region to NULL first. Cost: O(n), and the
 * factor that may be missing. hf_region_info::field_kind says which base it has. Errors: HF_ERROR_INVALID_ARGUMENT
 * (base), HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_NOT_POSITIVE_DEFINITE (the matrix of the base does not
 * factorise), HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_region_create(hf_surface surface, const hf_region_desc* desc, hf_region* out_region);

/* Copies a region. The copy shares the factor and all memory, until one of the two is edited. For undo, keep copies:
 * one before each edit. Sets *out_region to NULL first. Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_clone(hf_region region, hf_region* out_region);

/* Destroys a region. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_region_destroy(hf_region region);

/* A closed curve cuts the surface in two. The side says which part becomes the region. Where a curve along edges
 * touches itself there are more parts: SMALLER takes all but the largest, SEED the part of its vertex. */
enum hf_side {
  HF_SIDE_SMALLER = 0, /* the side of smaller area */
  HF_SIDE_LARGER = 1,  /* the side of larger area */
  HF_SIDE_SEED = 2     /* the side that seed_vertex lies in */
};

/* How the points of a curve are joined: each to the next, and the last to the first. */
enum hf_curve_kind {
  HF_CURVE_STRAIGHT = 0, /* by shortest paths along the surface, through triangles, exact up to rounding */
  HF_CURVE_EDGES = 1     /* by shortest paths along edges; points in triangles stand for their nearest corner */
};

/* Describes a closed curve through at least 3 points, on the mesh at rest. Set one of vertices, places and points. The
 * vertices on the chosen side of the curve are the region. A single vertex joins the region too if all its neighbours
 * but one are in it. The rim is the vertices next to the region, on or beyond the curve. It follows the curve within an
 * edge; where the curve runs along edges, the rim is the curve. A whole border of the surface is a curve too; it has
 * only one side. The curve passes a vertex at most 8 times. */
typedef struct hf_curve_desc {
  uint32_t struct_size;
  uint32_t point_count;     /* 3 to the number of vertices of the mesh */
  const uint32_t* vertices; /* [point_count] vertices of your mesh, or NULL */
  const hf_place* places;   /* [point_count], or NULL */
  const double* points; /* [point_count][3] points in space, at rest, in the unit and frame of the mesh, or NULL. Each
                           stands for the nearest point of the surface, up to two boxes away */
  int32_t side;         /* HF_SIDE_* */
  uint32_t seed_vertex; /* with HF_SIDE_SEED */
  int32_t kind;         /* HF_CURVE_* */
  uint32_t reserved;    /* 0 */
} hf_curve_desc;

/* A change of a region. The parts are applied in the order curve, rings, remove, add. A part that is 0 or NULL is
 * skipped. */
typedef struct hf_region_edit_desc {
  uint32_t struct_size;
  int32_t ring_count;         /* rings of vertices by which the region grows; below 0 it shrinks */
  const hf_curve_desc* curve; /* the region becomes what this curve encloses */
  uint32_t remove_count;
  uint32_t add_count;
  const uint32_t* remove_vertices; /* [remove_count] vertices that leave the region; others are passed over */
  const uint32_t* add_vertices;    /* [add_count] vertices that join it; those in it already are passed over */
  hf_progress progress;            /* NULL, or an object to poll and cancel through */
} hf_region_edit_desc;

/* Changes the region and computes its new base. The vertices next to the region (its rim) are sites with their
 * positions as values. Sites that stay cost nothing; the others are one batch as in hf_solver_edit_sites. One backward
 * sweep over the factor then gives the base; for a small region the sweep covers only the part of the factor that its
 * vertices need. A region may have several pieces, in several components. Progress covers curve, sites and base; the
 * call can be cancelled between them. Errors: HF_ERROR_EMPTY (fewer than 3 points, index = how many; no vertex would be
 * left), HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (lists longer than the mesh has vertices, a
 * point two boxes or more away), HF_ERROR_CANCELLED, and HF_ERROR_INVALID_ARGUMENT: side, kind, weights, isolated
 * vertex, points of different components; corners of no triangle (index = the point); a curve that crosses itself
 * (index = the point before the crossing; it may touch itself); a STRAIGHT curve through a vertex whose triangles are
 * not one fan (index = the point before it); a curve that does not separate the surface or goes round no vertex; a seed
 * on the curve or in another component (index = the seed); a component without a rim (index = a vertex of it). Thread
 * safety: changes `region`. Since 0.1. */
HF_API hf_result hf_region_edit(hf_region region, const hf_region_edit_desc* edit);

/* Counts and areas of a region. Welded copies count as one vertex. */
typedef struct hf_region_info {
  uint32_t struct_size;
  int32_t field_kind;    /* HF_FIELD_* */
  uint32_t vertex_count; /* of the region, without its rim */
  uint32_t rim_count;    /* vertices next to the region */
  uint32_t site_count;   /* vertices that fix the base: the rim, for thin plates two rows or more */
  uint32_t reserved;     /* 0 */
  double area;           /* of the triangles with a corner in the region, on the surface, in units^2 */
  double base_area;      /* the same on the base */
} hf_region_info;

/* Writes the info of a region. Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_get_info(hf_region region, hf_region_info* out_info);

/* Work of the last edit of a region, and of all its edits. */
typedef struct hf_region_statistics {
  uint32_t struct_size;
  uint32_t inserted_count; /* sites of the last edit, as in the next two fields */
  uint32_t removed_count;
  uint32_t kept_count;
  uint32_t factorisation_count; /* numeric factorisations of the region's edits so far */
  uint32_t path_solve_count;    /* sparse solves for added sites, over all edits */
  uint32_t last_route;          /* HF_ROUTE_* of the last edit */
  int32_t whole_sweep;          /* 1: the last base took a sweep through the whole factor */
} hf_region_statistics;

/* Writes the statistics of a region. Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_get_statistics(hf_region region, hf_region_statistics* out_statistics);

/* Lists of vertices of a region. */
enum hf_region_list {
  HF_REGION_INSIDE = 0, /* the region */
  HF_REGION_RIM = 1,    /* the vertices next to it */
  HF_REGION_SITES = 2   /* vertices whose positions fix the base */
};

/* Writes one list of vertices of your mesh, ascending. Where vertices were welded, the list has the first copy. list:
 * HF_REGION_*. out_vertices: NULL, or uint32_t[capacity]. out_count: NULL, or receives the length. Errors:
 * HF_ERROR_INVALID_ARGUMENT (list). Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_get_vertices(hf_region region, int32_t list, uint32_t capacity, uint32_t* out_vertices,
                                        uint32_t* out_count);

/* Writes the corners of the region's last curve, to draw it, in order, in the unit and frame of
 * the positions in hf_region_desc. The last corner is joined to the first. Rings, added and removed vertices leave it
 * as it is. out_points: NULL, or double[capacity][3]. out_count: NULL, or receives the number of corners, 0
 * without a curve. Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_get_curve(hf_region region, uint32_t capacity, double* out_points, uint32_t* out_count);

/* Gives hf_region_morph and hf_detail_morph their weight and outputs. Set at least one output. */
typedef struct hf_morph_desc {
  uint32_t struct_size;
  uint32_t reserved;      /* 0 */
  double weight;          /* any finite number */
  hf_array_out positions; /* NULL, or [vertex_count][3] of float or double, in the unit of the mesh */
  hf_array_out normals;   /* NULL, or [vertex_count][3] of float or double: unit normals of the morphed surface, shared
                             across seams */
} hf_morph_desc;

/* Morphs the region. A vertex of the region moves from p to p + weight (base - p), with p its position in
 * hf_region_desc. All other vertices stay at p. Weight 0 gives p bit for bit, and weight 1 gives the base. A weight
 * below 0 exaggerates detail, and a weight above 1 turns it inside out. An empty region gives p. The call solves
 * nothing. Errors: HF_ERROR_NON_FINITE (weight), HF_ERROR_TOO_LARGE (index = vertex that does not fit the output).
 * Thread safety: reads `region`. Since 0.1. */
HF_API hf_result hf_region_morph(hf_region region, const hf_morph_desc* desc);

/* ---- detail transferred to another region ---- */

/* The detail of a source region, transferred to a target region. Both may be on one surface or on two. */
typedef struct hf_detail_object* hf_detail;

typedef struct hf_detail_desc {
  uint32_t struct_size;
  uint32_t pair_count;             /* corresponding points of the two rims, in order along both; 0 = the rim vertex
                                      nearest to the first point of each curve, without a curve the lowest one */
  const uint32_t* source_vertices; /* [pair_count] rim vertices of the source mesh */
  const uint32_t* target_vertices; /* [pair_count] rim vertices of the target mesh */
  double scale;                    /* of the detail, > 0; 0 = square root of target base area over source base area */
  hf_progress progress;            /* NULL, or an object to poll and cancel through */
} hf_detail_desc;

/* Carries the detail of the source region to the target region. A harmonic map with positive weights takes each region
 * to the unit disc (an embedding: Tutte 1963, Floater 1997). Vertices around a region (its rim) lie on the circle, by
 * arc length between the pairs of desc. Points at the same place in the disc correspond. The function stores the offset
 * from base to surface in a local frame of the source. The axes of the frame are the normal of the base and the
 * direction in which the first disc coordinate grows. It interpolates the offsets in the triangles of the source, and
 * applies them in the same frames of the target. The detail fades to nothing at the rim. If source and target are the
 * same region, the result is the surface itself. Later edits of the regions do not change the object.
 *
 * Both regions must be discs: in one piece, one rim loop, no hole, manifold, of one orientation. desc: NULL for
 * defaults. Sets *out_detail to NULL first. Cost: a factorisation of each region's own Laplacian. Progress covers
 * source, target and frames; the call can be cancelled between them. Errors: HF_ERROR_NON_FINITE (scale),
 * HF_ERROR_INVALID_ARGUMENT (scale below 0; pairs off the rims or out of order), HF_ERROR_OUT_OF_RANGE,
 * HF_ERROR_TOO_LARGE, HF_ERROR_EMPTY (a region without vertices), HF_ERROR_UNSUPPORTED (not a disc; index = a vertex),
 * HF_ERROR_CANCELLED. Thread safety: reads both regions. Since 0.1. */
HF_API hf_result hf_detail_create(hf_region source, hf_region target, const hf_detail_desc* desc,
                                  hf_detail* out_detail);

/* Destroys the object. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_detail_destroy(hf_detail detail);

/* Writes the target's surface with its detail replaced. A vertex of the target region gets base + weight (transferred
 * detail); all others keep their positions. Weight 0 gives the smooth base, and weight 1 the detail as it was on the
 * source. A weight above 1 exaggerates the detail, and a weight below 0 turns it inside out. Errors: as
 * hf_region_morph. Thread safety: reads `detail`. Since 0.1. */
HF_API hf_result hf_detail_morph(hf_detail detail, const hf_morph_desc* desc);

#ifdef __cplusplus
}
#endif
#endif
