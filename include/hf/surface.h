/* hf/surface.h - prepare a mesh once: weld it, check it and factorise its Laplacian.
 *
 * Make one surface per mesh, or per graph of your own (hf_surface_create_graph). Solvers, poses, direction fields,
 * regions, transfers and quads are made on a surface and share its factor. A surface never changes, so any number of
 * threads may use it: an edit makes another one (hf_surface_edit). An object made on a surface keeps the data it needs,
 * so you can destroy objects in any order. */
#ifndef HF_SURFACE_H
#define HF_SURFACE_H

#include "hf/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hf_surface_object* hf_surface;

/* Selects how the surface joins vertices at one place. Modelling tools split vertices at texture seams: a horse model
 * can have 1,109 separate pieces as stored and be one piece when welded. Functions write results to every copy of a
 * vertex. */
enum hf_weld {
  HF_WELD_EXACT = 0,    /* bit-equal positions (+0 and -0 are equal) */
  HF_WELD_NONE = 1,     /* vertices as stored */
  HF_WELD_TOLERANCE = 2 /* positions closer than weld_tolerance, transitively */
};

/* Selects the edge weights w_ij of the discrete Laplacian L of a field u: (L u)_i = sum_j w_ij (u_i - u_j). */
enum hf_operator {
  HF_OPERATOR_INTRINSIC_DELAUNAY = 0, /* cotangent weights of the intrinsic Delaunay triangulation, on the tufted cover
                                         where edges are open or non-manifold (Bobenko and Springborn 2007; Sharp and
                                         Crane 2020). Weights are never negative: a field keeps to the range of its
                                         sites on any mesh */
  HF_OPERATOR_CLAMPED = 1,            /* cotangents, at least 1e-3 of the median weight: keeps to the range too */
  HF_OPERATOR_UNIFORM = 2,            /* w_ij = 1 */
  HF_OPERATOR_COTANGENT = 3, /* w_ij = (cot a_ij + cot b_ij) / 2, the paper's; can be negative at obtuse triangles */
  HF_OPERATOR_GRAPH = 4      /* your own weights; only hf_surface_create_graph makes it */
};

/* Selects the matrix K that a field solves with. A bi-harmonic field is smooth at its sites and overshoots their
 * values. Its factor is 3 to 4 times larger than a harmonic one, and its solve adds one correction step. */
enum hf_field_kind {
  HF_FIELD_HARMONIC = 0,   /* K = L */
  HF_FIELD_BIHARMONIC = 1, /* K = L M^-1 L, M the vertex areas scaled to mean 1 by component: does not depend on the
                              scale of the mesh */
  HF_FIELD_BIHARMONIC_GRAPH = 2 /* K = L^2, as in the paper: fields change with the density of the vertices */
};

/* Selects how the unknowns are ordered. A good order keeps the factor small. */
enum hf_ordering {
  HF_ORDERING_NESTED_DISSECTION = 0, /* our own; gives the smallest factor */
  HF_ORDERING_MINIMUM_DEGREE = 1,    /* quicker to compute, larger factor on large meshes */
  HF_ORDERING_METIS = 2              /* builds with HF_WITH_GPL only */
};

/* A factor that hf_surface_save wrote. The surface loads it instead of computing it. */
typedef struct hf_factor_desc {
  uint32_t struct_size;
  int32_t borrow;    /* 0: the bytes are copied. 1: numbers are read in place (a mapped file, say). Then the bytes stay
                        unchanged until the surface and everything made on it are destroyed, and are aligned to
                        HF_FACTOR_ALIGNMENT */
  const void* bytes; /* all of them, as saved */
  size_t byte_count;
} hf_factor_desc;
enum { HF_FACTOR_ALIGNMENT = 64 };

/* Selects how the pieces of a mesh are linked. A piece is an edge-connected part, such as an eye or a plate of a robot.
 * Without links every piece is a domain of its own: a field or a pose ends where the piece ends. */
enum hf_link_mode {
  HF_LINK_NONE = 0,   /* pieces stay apart. The default, because a scan or a scene may hold bodies that do not belong
                         together; the programs and bindings for characters link by default */
  HF_LINK_PIECES = 1, /* automatic: a tree over the pieces by smallest distance, and all pieces that touch */
  HF_LINK_LIST = 2    /* the links you give, and no others; only light_vertices name light pieces then */
};

/* A spring from a vertex to a point of a triangle. hf_surface_get_links writes it, hf_links_desc reads it. */
typedef struct hf_link {
  uint32_t vertex;        /* of your mesh, the first of welded copies */
  uint32_t corners[3];    /* the triangle; a corner of barycentric 0 is ignored and can be HF_NO_INDEX */
  double barycentrics[3]; /* >= 0, of sum 1 within 1e-3. A single 1 links two vertices */
  double length;          /* out: at rest, in the unit of the positions. Ignored when read */
  double weight;          /* 1: as strong as an edge between two equilateral triangles; > 0 */
  int32_t in_tree;        /* out; 1: the tree over the pieces has it. Ignored when read */
  uint32_t reserved;      /* 0 */
} hf_link;

/* Says which pieces to link. Joints and weights or tags help the automatic links; each array may be NULL. A light
 * piece is a sheet over a larger one, such as cloth: it follows the surface below and hardly pulls it. More than 16
 * fields: they are the arrays of one search, and their counts. */
typedef struct hf_links_desc {
  uint32_t struct_size;
  int32_t mode;     /* HF_LINK_* */
  double distance;  /* longest automatic link, in the unit of the positions; 0 = 5 % of the bounding box diagonal */
  double stiffness; /* of all links, times each one's weight; 0 = 1 */
  double overlay_distance;  /* automatic: a piece is light if half of it is nearer than this to a larger one; 0 = 1.5 %
                              of the diagonal, below 0: no piece is light unless light_vertices say so */
  uint32_t influence_count; /* joints per vertex, 0 to 64 */
  uint32_t link_count;      /* for HF_LINK_LIST */
  uint32_t light_count;     /* entries of light_vertices */
  uint32_t heavy_count;     /* entries of heavy_vertices */
  uint32_t joint_count;     /* entries of joint_parents, up to 65,536; 0 = the skeleton is not known */
  uint32_t reserved;        /* 0 */
  const uint16_t* joints;   /* [vertex_count][influence_count] of a skin: pieces of the same joint link sooner */
  const float* weights;     /* [vertex_count][influence_count] of sum 1; where all are 0, a vertex shares no joint */
  const uint32_t* joint_parents;  /* [joint_count] parent of each joint, HF_NO_INDEX for a root; needs joints and
                                     weights. Pieces of parent and child link wherever they touch. Pieces of joints
                                     farther apart in the skeleton, such as two feet, link only if nothing else joins
                                     them */
  const uint32_t* tags;           /* [vertex_count]: pieces with different tags do not link, as a rider and a horse. The
                                     first vertex of a piece counts */
  const hf_link* links;           /* [link_count] */
  const uint32_t* light_vertices; /* [light_count]: their pieces are light */
  const uint32_t* heavy_vertices; /* [heavy_count]: their pieces are not, as one that gets a site or handle */
} hf_links_desc;

/* Faces of any number of corners. Set corners, and the arrays that your host stores: sizes alone (Maya, USD), starts
 * and sizes (Blender's loops), or starts alone as offsets (newer Blender). Where this interface names a triangle of
 * such a mesh, it names a face.
 *
 * No field depends on how you would cut a face into triangles. HF_OPERATOR_INTRINSIC_DELAUNAY takes the mean of both
 * cuts of a bent quad. It moves this mean towards the polygon Laplacian of Bunge and others 2020 until a weight would
 * become negative; docs/surfaces.md compares errors. HF_OPERATOR_COTANGENT and HF_OPERATOR_CLAMPED use that
 * polygon Laplacian. HF_OPERATOR_UNIFORM uses the sides of the faces. Directions, distances, iso-lines, streamlines and
 * quads work on triangles: the library cuts the faces. Its cut does not depend on the order of the corners. Normals of
 * poses are sums of the area vectors of faces. */
typedef struct hf_faces_desc {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  hf_array corners;  /* [corner_count] of uint32_t: vertices, counter-clockwise seen from outside */
  hf_array sizes;    /* NULL, or [faces] of uint32_t: corners of each face, 3 to 65,535. NULL: starts give them */
  hf_array starts;   /* NULL, or [faces] of uint32_t: first corner of each face. NULL: the faces follow one
                        another. Without sizes [faces + 1]: the corners of face f end where face f + 1 starts */
} hf_faces_desc;

/* The mesh and the options of a surface. Set either triangles or faces.
 *
 * More than 16 fields: limits and hooks are single fields, because languages pass them by name. */
typedef struct hf_surface_desc {
  uint32_t struct_size;
  int32_t weld;               /* HF_WELD_* */
  hf_array positions;         /* [vertex_count][3] of float or double, any unit, any offset */
  hf_array triangles;         /* [triangle_count][3] of uint32_t or uint16_t, counter-clockwise seen from outside */
  const hf_faces_desc* faces; /* NULL, or faces instead of triangles */
  double weld_tolerance;      /* for HF_WELD_TOLERANCE, in the unit of the positions, > 0 */
  int32_t operator_kind;      /* HF_OPERATOR_* */
  int32_t field_kind;         /* HF_FIELD_*: the factor made now. Others are made when a solver or region needs one */
  int32_t ordering;           /* HF_ORDERING_* */
  uint32_t thread_count;      /* threads the library may use, yours included, 1 to 256; 0 = 1 */
  uint32_t vertex_limit;      /* refuse larger meshes before allocating; 0 = 20,000,000. More than 357,913,941
                                 vertices, triangles or edges are always refused */
  uint32_t triangle_limit;    /* refuse more triangles, or faces that would be cut into more; 0 = eight per vertex
                                 of the vertex limit */
  uint32_t memory_limit_mb;   /* refuse to hold more memory than this, in MiB, surface and all on it; 0 = no limit */
  uint32_t work_limit_gflop;  /* refuse a factorisation of more than this many 10^9 operations. They are counted
                                 before it begins; 0 = 100,000, about an hour of one core */
  hf_allocator allocator;     /* zero = malloc */
  hf_job_runner job_runner;   /* zero = threads of the library's own */
  hf_progress progress;       /* NULL, or an object to poll and cancel through */
  const hf_factor_desc* saved_factor; /* NULL, or the saved factor of this mesh; ordering is then 0 or the factor's */
  const hf_links_desc* links;         /* NULL: HF_LINK_NONE. A saved factor needs the links it was made with */
} hf_surface_desc;

/* Makes a surface: welds and checks the mesh, builds the operator, orders and factorises it. The call copies the mesh.
 * Afterwards the surface uses only the allocator and the job runner of the desc. The mesh may be dirty: the surface
 * counts non-manifold edges, flipped, duplicate and zero-area triangles, isolated vertices and components.
 * hf_surface_get_report gives these counts.
 *
 * A doubled face counts once: fields, poses, quads and all else are the same on the mesh without it. Faces are doubled
 * if they have the same corners after welding, in either direction. So a two-sided sheet, such as a leaf, hair or a
 * cape, is one sheet with a border. Results give the index of the first of doubled triangles; calls take the index of
 * any. Vertices of the second side alone get opposite normals from poses, and a ray with front_only hits both sides.
 *
 * out_surface: receives NULL at the start of the call and the new surface on success. Cost: about 2 us per vertex for
 * 300,000 vertices, one thread. Errors: HF_ERROR_INVALID_ARGUMENT, HF_ERROR_EMPTY (no vertex or no triangle),
 * HF_ERROR_OUT_OF_RANGE (index = triangle or face; a face of fewer than three corners is HF_ERROR_INVALID_ARGUMENT, one
 * of too many HF_ERROR_TOO_LARGE), HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_TOO_LARGE (a limit),
 * HF_ERROR_UNSUPPORTED (ordering not in this build), HF_ERROR_CANCELLED, HF_ERROR_NOT_POSITIVE_DEFINITE. With links
 * also HF_ERROR_OUT_OF_RANGE, _NON_FINITE and _INVALID_ARGUMENT (index = link, or position in a list of vertices; for
 * weights and joints the vertex, for joint_parents the joint) and HF_ERROR_TOO_LARGE (joint_count; more than 20,000
 * pieces to link automatically). With saved_factor also HF_ERROR_INVALID_ARGUMENT (damaged bytes, or bytes of another
 * mesh, operator or field_kind; borrowed bytes that are not aligned) and HF_ERROR_UNSUPPORTED (another format version
 * or byte order). Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_surface_create(const hf_surface_desc* desc, hf_surface* out_surface);

/* A graph of your own and the options of its surface: tetrahedra, points, a network. The weights w_ij of its edges make
 * the Laplacian (L u)_i = sum_j w_ij (u_i - u_j). Limits and hooks are as in hf_surface_desc.
 *
 * More than 16 fields: they mirror hf_surface_desc. */
typedef struct hf_graph_desc {
  uint32_t struct_size;
  uint32_t vertex_count;  /* >= 1, also without masses */
  hf_array edges;         /* [edge_count][2] of uint32_t or uint16_t: vertices, in any order. The weights of parallel
                             edges are added up. Self loops are ignored */
  hf_array weights;       /* [edge_count] of float or double, any unit, up to 1e100 in size. An edge of weight 0 is left
                             out */
  hf_array masses;        /* NULL, or [vertex_count] of float or double: M of HF_FIELD_BIHARMONIC, any unit, above 0 and
                             up to 1e100; NULL: all 1. A mass below 1e-4 of the mean of its component is raised to it */
  int32_t allow_negative; /* 1: weights may be below 0, if L stays positive semi-definite. The cotangent weights of
                             tetrahedra do. A field can then leave the range of its sites. 0: they are refused */
  int32_t field_kind;     /* HF_FIELD_*: the factor made now. Others are made when a solver asks */
  int32_t ordering;       /* HF_ORDERING_* */
  uint32_t thread_count;  /* threads the library may use, yours included, 1 to 256; 0 = 1 */
  uint32_t vertex_limit;  /* refuse larger graphs before allocating; 0 = 20,000,000 */
  uint32_t edge_limit;    /* refuse more edges; 0 = sixteen per vertex of the vertex limit */
  uint32_t memory_limit_mb;           /* refuse to hold more memory than this, in MiB; 0 = no limit */
  uint32_t work_limit_gflop;          /* refuse a factorisation of more than this many 10^9 operations; 0 = 100,000 */
  hf_allocator allocator;             /* zero = malloc */
  hf_job_runner job_runner;           /* zero = threads of the library's own */
  hf_progress progress;               /* NULL, or an object to poll and cancel through */
  const hf_factor_desc* saved_factor; /* NULL, or the saved factor of this graph; ordering is then 0 or the factor's */
} hf_graph_desc;

/* Makes a surface of a graph, for fields on any domain whose edges and weights you compute. The call copies the graph.
 * Solvers with sites at vertices, fields, previews, certificates, clones, saved factors, components and reports
 * work as on a mesh. A call that needs triangles returns HF_ERROR_UNSUPPORTED. These are poses, regions, directions,
 * geodesics, iso-lines, extremities, quads, flow, picking, transfers, skin weights, vector fields, links and screening.
 * Sites at places, at points or on discs need triangles too.
 *
 * A vertex without an edge is isolated: fields are 0 there, and it takes no site. Weights that differ from the median
 * of their component by a factor above 1e30 are limited; hf_mesh_statistics counts their vertices as changed.
 * Bi-harmonic fields limit weights to 1e3 times the median. out_surface: receives NULL at the start of the call and the
 * new surface on success. Cost: the factor. The factor of a volume is larger than the factor of a mesh with as many
 * vertices. Errors: HF_ERROR_INVALID_ARGUMENT (index = edge or vertex: a negative weight, a mass), HF_ERROR_EMPTY (no
 * vertex, no edge, or none left), HF_ERROR_OUT_OF_RANGE (index = edge), HF_ERROR_NON_FINITE (index = edge, or vertex of
 * a mass), HF_ERROR_TOO_LARGE (a limit, a weight, a mass), HF_ERROR_UNSUPPORTED (ordering not in this build),
 * HF_ERROR_CANCELLED, HF_ERROR_NOT_POSITIVE_DEFINITE (index = vertex: negative weights outweigh the others). With
 * saved_factor also as hf_surface_create. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_surface_create_graph(const hf_graph_desc* desc, hf_surface* out_surface);

/* Destroys a surface. Ignores NULL and destroyed objects. Objects that were made on the surface stay valid. Thread
 * safety: any thread. Since 0.1. */
HF_API void hf_surface_destroy(hf_surface surface);

/* The options a surface was made with, defaults filled in. More than 16 fields: they mirror hf_surface_desc. */
typedef struct hf_surface_info {
  uint32_t struct_size;
  uint32_t vertex_count;   /* of your mesh */
  uint32_t triangle_count; /* of your mesh; of faces, the triangles of their cut */
  int32_t weld;            /* HF_WELD_* */
  double weld_tolerance;
  int32_t operator_kind; /* HF_OPERATOR_* */
  int32_t field_kind;    /* HF_FIELD_* */
  int32_t ordering;      /* HF_ORDERING_* */
  uint32_t thread_count;
  uint32_t vertex_limit;
  uint32_t triangle_limit;  /* 0: eight per vertex of the vertex limit */
  uint32_t memory_limit_mb; /* 0: none */
  uint32_t work_limit_gflop;
  uint32_t edge_count;   /* of the desc of hf_surface_create_graph; 0 for a mesh */
  uint32_t edge_limit;   /* of a graph, 0: sixteen per vertex of the vertex limit */
  uint32_t face_count;   /* of your mesh; 0 where triangles were given */
  uint32_t corner_count; /* of your mesh */
} hf_surface_info;

/* Writes the options of a surface. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_info(hf_surface surface, hf_surface_info* out_info);

/* Counts that the surface found in the mesh. A graph has no triangles: its counts of triangles are 0. If faces were
 * given, the report counts collapsed and duplicate faces, and sides of faces as edges. It counts the degenerate
 * triangles of the cut. */
typedef struct hf_surface_report {
  uint32_t struct_size;
  uint32_t vertex_count;              /* of your mesh */
  uint32_t triangle_count;            /* of your mesh; of faces, the triangles of their cut */
  uint32_t welded_vertex_count;       /* after welding */
  uint32_t component_count;           /* connected components with at least one triangle (or edge), after welding;
                                         linked pieces are one component */
  uint32_t isolated_vertex_count;     /* given vertices in no usable triangle (or edge); fields are 0 there */
  uint32_t degenerate_triangle_count; /* zero area to working precision */
  uint32_t collapsed_triangle_count;  /* equal corners after welding, or on a line and joining nothing; left out */
  uint32_t duplicate_triangle_count;  /* the same corners again after welding, in either direction; they do not count
                                         in the edges below */
  uint32_t non_manifold_edge_count;   /* edges of three or more triangles */
  uint32_t flipped_edge_count;        /* edges that two triangles run through in the same direction */
  uint32_t boundary_edge_count;
  uint32_t inside_out_count; /* closed pieces whose triangles face inwards: a mesh turned inside out, or the inner wall
                                of a hollow body. Fields do not change. Results that use normals do */
  uint32_t first_inside_out_vertex; /* vertex of your mesh: the first of such a piece; HF_NO_INDEX without one */
  double bounding_box_diagonal;     /* in the unit of the positions, without isolated vertices */
} hf_surface_report;

/* Writes the report of the mesh. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_report(hf_surface surface, hf_surface_report* out_report);

/* Figures of a mesh for developers: its faces, and the weights of its operator. */
typedef struct hf_mesh_statistics {
  uint32_t struct_size;
  uint32_t polygon_count;        /* faces of more than three corners */
  uint32_t non_planar_count;     /* polygons with a corner farther than 1 % of their diameter from their mean plane */
  uint32_t largest_face;         /* corners of the largest face; 0 where triangles were given */
  uint32_t negative_edge_count;  /* edges of the cut of negative cotangent weight, before any clamping */
  uint32_t changed_vertex_count; /* welded vertices with a changed weight, in the operator of field_kind. A weight is
                                    changed if its triangles are too thin, or if a double has too few digits for it. A
                                    certificate holds for the weights used; near these vertices the field may differ
                                    from the field of the mesh */
  uint32_t first_changed_vertex; /* the first of them in your mesh; HF_NO_INDEX without one */
  uint32_t reserved;             /* 0 */
  double smallest_angle;         /* radians, over the usable triangles of the cut */
} hf_mesh_statistics;

/* Writes the statistics of the mesh. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_mesh_statistics(hf_surface surface, hf_mesh_statistics* out_statistics);

/* Writes the component of every vertex of your mesh, and HF_NO_INDEX for isolated vertices. Components are numbered in
 * the order of their lowest vertex numbers. out_components: NULL, or uint32_t[capacity]. out_count: NULL, or receives
 * vertex_count. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_components(hf_surface surface, uint32_t capacity, uint32_t* out_components,
                                           uint32_t* out_count);

/* ---- links ---- */

/* How the pieces of a mesh are linked. */
typedef struct hf_links_info {
  uint32_t struct_size;
  uint32_t piece_count; /* edge-connected pieces, linked or not */
  uint32_t link_count;  /* hf_surface_get_links writes them */
  uint32_t light_piece_count;
  uint32_t lone_piece_count; /* pieces without a link, if there are several */
  uint32_t contact_count;    /* with joint_parents: places where two pieces touch and have no link, such as two feet.
                                hf_surface_measure_gaps measures how far they open */
  double longest_tree_link;  /* longest link of the tree over the pieces, in the unit of the positions */
} hf_links_info;

/* Writes how the pieces of a surface are linked. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_links_info(hf_surface surface, hf_links_info* out_info);

/* Writes the links of a surface. You can edit them and give them back with HF_LINK_LIST. A list does not say which
 * pieces are light: name them in light_vertices, as hf_surface_get_pieces marks them. Then the list alone gives the
 * same surface, bit for bit, without a search. out_links: NULL, or hf_link[capacity]. out_count: NULL, or receives the
 * count. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_links(hf_surface surface, uint32_t capacity, hf_link* out_links, uint32_t* out_count);

/* Writes the piece of every vertex of your mesh, and HF_NO_INDEX for isolated vertices. Pieces are numbered in the
 * order of their lowest vertices. out_pieces: NULL, or uint32_t[capacity]. out_light: NULL, or int32_t[capacity], 1: of
 * a light piece. A site or handle there hardly moves the rest. out_count: NULL, or receives vertex_count. Thread
 * safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_pieces(hf_surface surface, uint32_t capacity, uint32_t* out_pieces, int32_t* out_light,
                                       uint32_t* out_count);

/* How far linked pieces have opened, in the unit of the positions. */
typedef struct hf_gaps_info {
  uint32_t struct_size;
  uint32_t link_count;
  double percentile_95;    /* 95 of 100 links opened no more than this; 0 without links */
  double worst;            /* the widest gap of a link; 0 without links */
  uint32_t worst_link;     /* position in hf_surface_get_links of the link with that gap; HF_NO_INDEX without links */
  uint32_t contact_count;  /* as in hf_links_info; the fields above leave contacts out */
  double worst_contact;    /* the widest gap of a contact; 0 without contacts */
  uint32_t contact_vertex; /* vertex of your mesh in that contact; HF_NO_INDEX without contacts */
  uint32_t touching_count; /* vertices that touch a linked piece at rest, once for each such piece */
  double worst_opening;    /* the widest opening of a touching vertex; 0 without one */
  uint32_t opening_vertex; /* vertex of your mesh with that opening; HF_NO_INDEX where nothing opened */
  uint32_t reserved;       /* 0 */
} hf_gaps_info;

/* Measures the gaps that a deformation opens between linked pieces. The gap of a link is how much farther its ends are
 * apart than at rest, and 0 if they are nearer. The gap of a contact (hf_links_info) is measured in the same way.
 * A vertex touches a piece if it is nearer to it than 0.5 % of the bounding box. With joint_parents its joint must be
 * the joint of the nearest point there, or the parent or child of that joint. Each touches one point of the piece: the
 * nearest at rest. Its opening is the smaller of two distances, minus the distance at rest: its own distance from the
 * piece, and the distance of the point that it touched from the piece of the vertex. So a piece that slides along
 * another opens no vertex, but its links have gaps. Touching vertices are found where links are: by hf_surface_create
 * and hf_surface_relink. Links that an edit adds have none. positions: [vertex_count][3] of float or double: the
 * deformed mesh. It can come from a pose, a transfer or any other source. out_gaps: NULL, or double[capacity],
 * out_info->link_count of them, in the order of hf_surface_get_links. out_info: NULL, or a struct. Set one of the two
 * at least. Errors: HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (index = vertex). Thread safety: reads `surface`. Since
 * 0.1. */
HF_API hf_result hf_surface_measure_gaps(hf_surface surface, const hf_array* positions, uint32_t capacity,
                                         double* out_gaps, hf_gaps_info* out_info);

/* Makes a surface with other links from the mesh of a surface. The new surface orders the unknowns as the old one where
 * its matrix has the same pattern: other stiffness, weights or light pieces. links: NULL: HF_LINK_NONE. Memory limits
 * hold for both surfaces together. progress: NULL, or an object to poll and cancel through. out_surface: as in
 * hf_surface_create. Errors: as hf_surface_create for links, HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since
 * 0.1. */
HF_API hf_result hf_surface_relink(hf_surface surface, const hf_links_desc* links, hf_progress progress,
                                   hf_surface* out_surface);

/* ---- edits ---- */

/* Lists triangles that go, vertices and triangles that come in, and edges to cut along. Vertices and triangles keep
 * their numbers; new ones follow those there are. New vertices are welded to no other, so two can lie at one place. A
 * vertex without a triangle is isolated from then on, and a new triangle can take it again.
 *
 * A cut gives the vertices along it copies, and the triangles on one side take these. hf_surface_get_cuts lists the
 * corners. The end of a cut inside the surface stays one vertex, so a cut takes two edges there. A cut around a part,
 * or from border to border, parts it from the rest: it is a component then. */
typedef struct hf_patch_desc {
  uint32_t struct_size;
  uint32_t removed_triangle_count;   /* entries of removed_triangles */
  uint32_t new_vertex_count;         /* entries of new_positions */
  uint32_t new_triangle_count;       /* entries of new_triangles */
  uint32_t cut_edge_count;           /* entries of cut_edges; then the other counts are 0 */
  uint32_t reserved;                 /* 0 */
  const uint32_t* removed_triangles; /* [removed_triangle_count] triangles of your mesh */
  const double* new_positions;       /* [new_vertex_count][3] in the unit of your mesh */
  const uint32_t* new_triangles;     /* [new_triangle_count][3] vertices of your mesh and new ones */
  const uint32_t* cut_edges;         /* [cut_edge_count][2] the two vertices of an edge */
} hf_patch_desc;

/* Lists the changes of hf_surface_edit: stiffness and links, or a patch. The stiffness of a vertex is a number by which
 * the weights of its edges are multiplied: an edge from i to j counts 2 s_i s_j / (s_i + s_j) times, as two springs in
 * a row. A region of large stiffness bends and stretches little and hardly changes its surroundings: a belt, a shield,
 * a shell. A region of small stiffness takes up the bending around it. */
typedef struct hf_surface_edit_desc {
  uint32_t struct_size;
  uint32_t vertex_count; /* entries of vertices and stiffness */
  const uint32_t*
      vertices; /* [vertex_count] as given; other vertices keep their stiffness. NULL: all vertices in order */
  const double* stiffness; /* [vertex_count] 1e-4 to 1e4; 1: as the surface was made. Welded copies share one. NULL: no
                              stiffness changes, and vertex_count is 0 */
  uint32_t link_count;     /* entries of links */
  uint32_t removed_link_count;   /* entries of removed_links */
  const hf_link* links;          /* [link_count] links that come in, after those that stay */
  const uint32_t* removed_links; /* [removed_link_count] links that go out, by their numbers in hf_surface_get_links */
  const hf_patch_desc* patch;    /* NULL, or triangles that go and come, or a cut; the edit changes nothing else then */
  hf_progress progress;          /* NULL, or an object to poll and cancel through */
} hf_surface_edit_desc;

/* Makes a surface with another stiffness, other links or other triangles from a surface, which stays as it is. The new
 * surface shares the factor: an edit of up to a few thousand vertices costs the elimination paths of its rim, as sites
 * do, and a link costs up to six paths. The library factorises again with the same ordering where that costs less, and
 * for bi-harmonic fields. A surface that is edited back has the fields of the old one.
 *
 * Fields, poses and weights follow the stiffness. Where the stiffness is 100 or more, a pose changes
 * lengths of edges by about half a percent in the mean. A part that must not bend at all is a rigid piece
 * (hf_pose_set_rigid_pieces).
 * Bi-harmonic operators square it, so they count at most 100 and at least 0.01. Lengths do not change, so regions,
 * transfers, distances, directions and quads do not see stiffness.
 *
 * A link joins two pieces, and removing the last link between two pieces parts them: a sword that is taken up and
 * dropped. The new surface is the one that hf_surface_relink makes of the same list of links. hf_surface_get_components
 * gives the new components. Light pieces and contacts stay as they are.
 *
 * After a patch the surface is the one that hf_surface_create makes of the triangles without the removed ones and with
 * the new ones, HF_WELD_NONE for the new vertices. Vertices keep their stiffness. New ones, and those that were
 * isolated, have 1. Distances, directions and quads make a factor of their own when they are first asked for, as on a
 * new surface. Patches over a quarter of the surface, and with HF_OPERATOR_CLAMPED, make the whole operator and its
 * factor anew. Take links out before, and put them in again after it.
 *
 * hf_solver_move_to takes sites along, and hf_pose_move_to takes handles along. After a patch or a cut make a new pose:
 * hf_pose_move_to refuses other triangles. Soft sites keep the unit of their stiffness while
 * links and triangles stay; others change it as they do for hf_surface_relink. hf_surface_save is refused: save the
 * factor of the surface before its edits. Memory limits hold for both surfaces together. out_surface: as in
 * hf_surface_create. Errors: HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (a stiffness out of
 * range, a link as hf_surface_create refuses it, equal corners or ends) and HF_ERROR_CONFLICT (a vertex, or a welded
 * copy, listed twice with different numbers; a removed link or triangle listed twice; a new triangle on another one),
 * index = position in the list; HF_ERROR_NOT_FOUND (a removed link or triangle that is not there, an edge of no
 * triangle, index = position in the list); HF_ERROR_EMPTY (nothing to edit, a cut that parts nothing, no triangle
 * left), HF_ERROR_INVALID_ARGUMENT (vertices is NULL and the surface has another vertex count; a patch together with
 * other changes), HF_ERROR_UNSUPPORTED (links or a patch of a graph; a patch of a surface with links, of polygons, or
 * where triangles lie on each other), HF_ERROR_TOO_LARGE (vertex_limit or triangle_limit),
 * HF_ERROR_NOT_POSITIVE_DEFINITE (negative weights, or weights that span too many digits; index = vertex),
 * HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_edit(hf_surface surface, const hf_surface_edit_desc* desc, hf_surface* out_surface);

/* A corner of a triangle that a cut gave another vertex. Give the new vertex what the old one has, and write it into
 * your index array: indices[3 * triangle + corner] = vertex. The old one is what your index array has there. At a seam
 * the copies of a vertex share one new vertex, so what differs between them, such as a UV, belongs to the corner. */
typedef struct hf_cut_corner {
  uint32_t triangle; /* of your mesh */
  uint32_t corner;   /* 0, 1 or 2 */
  uint32_t vertex;   /* new since the surface was made */
  uint32_t copied;   /* the vertex that it copies, the first of welded copies */
} hf_cut_corner;

/* Writes the corners that all cuts gave other vertices since the surface was made, in the order of the cuts. A second
 * cut adds its corners behind the corners of the first cut: go on from the last count. out_cuts: NULL, or
 * hf_cut_corner[capacity]. out_count: NULL, or receives their number. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_cuts(hf_surface surface, uint32_t capacity, hf_cut_corner* out_cuts,
                                     uint32_t* out_count);

/* Writes the stiffness of every vertex of your mesh, and 1 for isolated vertices. out_stiffness: NULL, or
 * double[capacity]. out_count: NULL, or receives vertex_count. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_stiffness(hf_surface surface, uint32_t capacity, double* out_stiffness,
                                          uint32_t* out_count);

/* hf_surface_get_statistics writes sizes and times of a surface here. Times are in milliseconds. Bytes are doubles
 * (exact to 2^53). */
typedef struct hf_surface_statistics {
  uint32_t struct_size;
  uint32_t unknown_count; /* size of the factored matrix */
  double weld_ms, operator_ms, ordering_ms, symbolic_ms, numeric_ms;
  double factor_entries; /* non-zeros of the Cholesky factor */
  double factor_bytes;   /* memory of the stored factor with its indices */
  double factor_flops;
  double memory_bytes; /* in use by this surface and everything made on it, and up to 16 work buffers of a field each
                          that calls leave for the next, refused calls too */
  double peak_memory_bytes;
  double load_ms;          /* to load a saved factor; the times to make it are then 0 */
  int32_t factor_loaded;   /* 1: the factor was loaded */
  int32_t factor_borrowed; /* 1: its numbers are read in place; factor_bytes counts them, memory_bytes does not */
  double links_ms;         /* to find the links; operator_ms counts them too */
} hf_surface_statistics;

/* Writes the statistics of a surface and of the factor it was made with. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_get_statistics(hf_surface surface, hf_surface_statistics* out_statistics);

/* ---- the factor as bytes ---- */

/* Saves the factor of one kind of field. An authoring tool saves it once. A game ships the bytes beside the mesh and
 * gives them to hf_surface_create, which then takes a fraction of the time. The bytes are the same for the same
 * mesh, options and library version, whatever the number of threads. The bytes are little-endian and hold a format
 * version, a hash of the matrix and a checksum. They hold no sites.
 *
 * field_kind: HF_FIELD_*. If its factor does not exist yet, the call makes it first. progress: NULL, or an object to
 * poll and cancel through. out_bytes: NULL, or `capacity` bytes, any alignment. out_size: NULL, or receives the size.
 * Cost: one copy of the factor. On failure out_bytes is undefined. Errors: HF_ERROR_CANCELLED, HF_ERROR_TOO_SMALL.
 * Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_save(hf_surface surface, int32_t field_kind, hf_progress progress, size_t capacity,
                                 void* out_bytes, size_t* out_size);

/* ---- places ---- */

/* A place on a surface: a vertex, or a point between three corners of a face. hf_hit gives a place. Sites, pins,
 * curves, handles and paths take places. A list of places has three forms: `vertices` (4 bytes each), `places`, and
 * `points` in space. Set one of the three. */
typedef struct hf_place {
  uint32_t corners[3];    /* vertices of one face of your mesh; a corner of barycentric 0 is ignored and can be
                             HF_NO_INDEX */
  uint32_t reserved;      /* 0 */
  double barycentrics[3]; /* weights of the corners, >= 0, of sum 1 within 1e-6. A single 1 is a vertex */
} hf_place;

/* ---- cuts through triangles ---- */

/* Describes the line of a knife: points on the surface, each joined to the next by the shortest path along triangles.
 * Set one of vertices, places and points. A line whose last point is its first is closed. */
typedef struct hf_cut_desc {
  uint32_t struct_size;
  uint32_t point_count;     /* 2 to 10,000,000 */
  const uint32_t* vertices; /* [point_count] vertices of your mesh, or NULL */
  const hf_place* places;   /* [point_count], or NULL */
  const double* points;     /* [point_count][3] points in space, at rest, in the unit and frame of the mesh, or NULL.
                               Each stands for the nearest point of the surface, up to two boxes away */
  double snap_share;        /* a point nearer to a vertex than this share of its edge becomes the vertex, and one nearer
                               to an edge than this share of the height moves onto the edge. So no slivers come in.
                               From 1e-6 to 0.4; 0 = 0.05 */
  uint32_t crossing_limit;  /* refuse a line of more points and crossings of edges; 0 = 1,000,000 */
  uint32_t reserved;        /* 0 */
  hf_progress progress;     /* NULL, or an object to poll and cancel through */
} hf_cut_desc;

/* A cut as triangles that go and come. The first three arrays fit hf_patch_desc. New vertices and triangles
 * have the numbers after the last ones of your mesh. The arrays are yours: each is NULL or as large as its capacity.
 *
 * More than 16 fields: they are the arrays of one patch, and their counts. */
typedef struct hf_cut {
  uint32_t struct_size;
  uint32_t removed_triangle_capacity; /* in: triangles the array can take */
  uint32_t new_vertex_capacity;       /* in: vertices the arrays can take */
  uint32_t new_triangle_capacity;     /* in: triangles the arrays can take */
  uint32_t rim_capacity;              /* in: points of the line the array can take */
  uint32_t removed_triangle_count;    /* out */
  uint32_t new_vertex_count;          /* out */
  uint32_t new_triangle_count;        /* out */
  uint32_t rim_count;                 /* out: points of the line; the first of a closed line is not repeated */
  uint32_t reserved;                  /* 0 */
  uint32_t* removed_triangles;        /* [removed_triangle_capacity] triangles of your mesh, ascending */
  double* new_positions;              /* [new_vertex_capacity][3] in the unit of your mesh */
  uint32_t* new_triangles;     /* [new_triangle_capacity][3] vertices of your mesh, the first of welded copies, and
                                  new ones */
  uint32_t* vertex_corners;    /* [new_vertex_capacity][3] vertices of your mesh; the new vertex lies between
                                  them. Mix their attributes, as skin weights. HF_NO_INDEX where a weight is 0 */
  double* vertex_barycentrics; /* [new_vertex_capacity][3] their weights, of sum 1. A single 1 copies a vertex */
  uint32_t* source_triangles;  /* [new_triangle_capacity] the removed triangle that each new one is a part of */
  double* corner_barycentrics; /* [new_triangle_capacity][3][3] three weights for each corner of a new triangle, of
                                  the corners of its source: for what corners have, as UVs at seams */
  uint32_t* rim_vertices;      /* [rim_capacity][2] along the line: the vertex on its left and that on its right;
                                  one and the same where the line ends inside the surface. At a
                                  border between its ends: those after it */
} hf_cut;

/* Turns a line on the surface into a cut through triangles. Give the arrays to hf_surface_edit as a patch, and change
 * your mesh in the same way. The surface itself does not change.
 *
 * A line from border to border, or a closed line around a part, parts it from the rest. A line that starts at the
 * border opens it. An end inside the surface stays closed. The line may pass vertices and run along edges. It is
 * straight where its triangles are unfolded, and bends at its points and at vertices only. The parts of a triangle are
 * a Delaunay triangulation of it. Points are whole multiples of 2^-29 of an edge. On a mesh whose triangles are turned
 * alike, left is left for a viewer who looks at the outside along the line. New vertices have the stiffness 1.
 *
 * Cost: a shortest path for each two points in different triangles, and a pass over the vertices. Errors:
 * HF_ERROR_EMPTY (fewer than 2 points, no length, or nothing is parted), HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE,
 * HF_ERROR_INVALID_ARGUMENT (snap_share; isolated vertex, barycentrics, corners of no triangle: index = point),
 * HF_ERROR_TOO_LARGE (a point two boxes or more away, index = point; too many points or crossings),
 * HF_ERROR_CONFLICT (a line that crosses or touches itself), HF_ERROR_NOT_FOUND (a point in another component than the
 * point before), both with the index of the segment: 0 from the first point to the second; HF_ERROR_UNSUPPORTED
 * (a graph, polygons; a triangle that lies on another one, index = triangle), HF_ERROR_TOO_SMALL (a capacity; the
 * counts are written), HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_trace_cut(hf_surface surface, const hf_cut_desc* desc, hf_cut* inout_cut);

/* ---- picking ---- */

/* Options of picking: posed positions, if the surface is not at rest, and which triangles count. */
typedef struct hf_pick_desc {
  uint32_t struct_size;
  int32_t front_only; /* 1: a ray passes through triangles seen from behind */
  hf_array positions; /* NULL, or [vertex_count][3] of float or double: posed positions (hf_deform writes them). NULL:
                         the rest positions */
} hf_pick_desc;

/* hf_surface_cast_ray writes the first triangle that a ray hits here. */
typedef struct hf_hit {
  uint32_t struct_size;
  int32_t found;      /* 1: a triangle was hit; 0: none, and all else is 0 or HF_NO_INDEX */
  uint32_t triangle;  /* or face, of your mesh */
  uint32_t vertex;    /* its corner nearest to the hit, of your mesh, the first of welded copies */
  hf_place place;     /* the point hit: corners of the triangle (the first of welded copies) and their barycentrics.
                         A face of more corners is cut into triangles; these are the corners of the triangle hit */
  double position[3]; /* in the unit of the positions */
  double distance;    /* from the origin, in lengths of `direction` */
} hf_hit;

/* Finds what a mouse click hits: the first triangle on a ray. origin, direction: double[3] in the frame of the
 * positions. The direction can have any length above 0. desc: NULL for the rest positions. A ray through an edge or a
 * vertex never slips between the triangles there. A face of more than three corners is hit as its cut. If several
 * triangles are at the same distance, the one with the lowest index counts. Cost: a pass over the triangles, about 10
 * ns each on one thread. Errors: HF_ERROR_NON_FINITE (origin, direction, a position: index = vertex),
 * HF_ERROR_INVALID_ARGUMENT (direction 0). Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_surface_cast_ray(hf_surface surface, const double* origin, const double* direction,
                                     const hf_pick_desc* desc, hf_hit* out_hit);

/* Finds the vertex nearest to a point. point: double[3] in the frame of the positions. desc: NULL for the rest
 * positions. The call ignores isolated vertices. Among several at one distance, such as welded copies, the lowest index
 * counts. out_vertex: receives the vertex. out_distance: NULL, or receives the distance. Cost: a pass over the
 * vertices. Errors: HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_TOO_LARGE (1e15 boxes). Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_surface_find_vertex(hf_surface surface, const double* point, const hf_pick_desc* desc,
                                        uint32_t* out_vertex, double* out_distance);

#ifdef __cplusplus
}
#endif
#endif
