/* hf/pose.h - grab the surface with handles and pose it; add and remove handles at any time.
 *
 * A handle is a region of vertices that moves rigidly; every other vertex follows. You give its place, and its rotation
 * too or leave that free (free_rotation): then the solve finds it, as for a hand that is pulled. Each handle has one
 * harmonic field, which is 1 on the handle and 0 on the others. It says how much a vertex follows the handle. The
 * vertices between two levels of a field form a cluster, and clusters overlap. A small prefactored solve finds the
 * motion of each cluster, and each vertex blends these motions (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5, with
 * quadratic bands and a reduced elastic energy).
 *
 * Handles have layers. Handles of layer 0 move the rest pose. Handles of a higher layer edit the surface that the lower
 * layers produce. They do not move the lower layers, so you can add and remove them freely. */
#ifndef HF_POSE_H
#define HF_POSE_H

#include "hf/skeleton.h"
#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A set of handles on a surface. */
typedef struct hf_pose_object* hf_pose;

enum {
  HF_LAYER_COUNT = 8,
  HF_HANDLE_LIMIT = 256 /* most handles of a pose */
};

typedef struct hf_pose_desc {
  uint32_t struct_size;
  uint32_t band_count;      /* bands per field, 2 to 64; 0 = 10 */
  uint32_t iteration_count; /* iterations of a pose solve, 1 to 1000; 0 = 10 */
  uint32_t group_count;     /* groups of vertices that share a rotation, 1 to 2000; 0 = 250 */
} hf_pose_desc;

/* Creates a pose without handles. desc: NULL for defaults. Sets *out_pose to NULL first. The pose needs the harmonic
 * factor of the surface; the function makes that factor if the surface has none. Errors: HF_ERROR_INVALID_ARGUMENT.
 * Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_pose_create(hf_surface surface, const hf_pose_desc* desc, hf_pose* out_pose);

/* Copies a pose with its handles and transforms, so that several threads can pose one rig. Thread safety: reads `pose`.
 * Since 0.1. */
HF_API hf_result hf_pose_clone(hf_pose pose, hf_pose* out_pose);

/* Moves a pose to an edited surface: its handles keep their numbers, layers, transforms and options. The next
 * hf_deform goes on from the pose as it stands, with the new stiffness and links. So a faint stroke moves next to
 * nothing, also where handles of free rotation could rest in two poses. With restart the frame equals the frame of a
 * new pose on `surface`, to 1e-6 of the box. surface: any number of calls of hf_surface_edit or hf_surface_relink make
 * it from the pose's surface, or the pose's surface from it. Cost: as adding all handles at once, without elimination
 * paths. Errors: HF_ERROR_CONFLICT (the surfaces have no common origin), HF_ERROR_UNSUPPORTED (other triangles: make a
 * new pose with the handles of this one). Thread safety: changes `pose`, reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_pose_move_to(hf_pose pose, hf_surface surface);

/* Destroys a pose. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_pose_destroy(hf_pose pose);

/* hf_pose_get_info writes the options of a pose here, with defaults filled in, and the number of its handles. */
typedef struct hf_pose_info {
  uint32_t struct_size;
  uint32_t band_count;
  uint32_t iteration_count;
  uint32_t group_count;
  uint32_t handle_count;
  uint32_t vertex_count; /* vertices of your mesh: rows of hf_deform */
} hf_pose_info;

/* Writes the options of a pose. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_info(hf_pose pose, hf_pose_info* out_info);

/* ---- handles ---- */

/* The handles to add. Set region_counts and region_vertices, or radii and one of vertices, places and points. The
 * region of a place is its nearest vertex, and all vertices that are edge-connected to it within the radius. */
typedef struct hf_handles_desc {
  uint32_t struct_size;
  uint32_t handle_count;           /* >= 1 */
  const uint32_t* region_counts;   /* [handle_count] number of vertices of each region, >= 1; repeats are allowed, up to
                                      four times the vertices of the mesh in all */
  const uint32_t* region_vertices; /* [sum(region_counts)] all regions one after the other; NULL: places are given */
  const uint32_t* vertices;        /* [handle_count] vertices of your mesh, or NULL */
  const hf_place* places;          /* [handle_count], or NULL */
  const double* points;  /* [handle_count][3] points in space, at rest, in the unit and frame of the mesh, or NULL. A
                            point can lie inside the body, as a joint does: its nearest vertex counts */
  const double* radii;   /* [handle_count] of the regions of places, in the unit of the mesh; NULL: regions are given.
                            A radius below 1 % of the box makes regions of 2 vertices or more */
  uint32_t layer;        /* 0 to HF_LAYER_COUNT - 1, for the whole batch */
  int32_t in_place;      /* 1: handles of layer 0 start on the posed surface, not at rest; see below */
  int32_t free_rotation; /* 1: you give the places alone of all these handles; hf_pose_set_free_rotations frees single
                            ones */
  uint32_t reserved;     /* 0 */
  hf_progress progress;  /* NULL, or an object to poll and cancel through */
} hf_handles_desc;

/* Adds handles with identity transforms. On layer 0 the identity is the rest place, so a new handle pulls a posed
 * surface back to rest there. Use in_place to grab a posed surface. Each new handle then gets the rigid motion of its
 * region in the last pose (hf_pose_get_handle writes it). The surface stays in place (to 1e-6 of the box). It goes over
 * to the best pose of the new handles while handles move by 0.05 of the box, or back to rest. Until then the region of
 * the new handle keeps a part of its bend. restart ends this at once. On a higher layer the surface does not move (to
 * 1e-9 of the box) until you move the handle. Handles of lower layers hold the surface in place for the higher layers.
 * out_handles: NULL, or uint32_t[handle_count]. Cost: one field solve for the layer of the handles and for each higher
 * layer. On large meshes a frame may be late. To avoid that, add the handles to a clone in another thread and pose the
 * old one meanwhile. Then set the transforms of the clone. No two regions may overlap, on any layer; welded copies
 * count as one vertex. Errors: HF_ERROR_OUT_OF_RANGE and HF_ERROR_CONFLICT (index = position in region_vertices, or
 * handle when given by places), HF_ERROR_INVALID_ARGUMENT (isolated vertex, barycentrics, layer, in_place,
 * free_rotation, a radius, two forms at once), HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (HF_HANDLE_LIMIT, a point two
 * boxes or more away). Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_add_handles(hf_pose pose, const hf_handles_desc* handles, uint32_t* out_handles);

/* Adds one handle on layer 0. Its region has the vertex nearest to a point at rest. It also has all vertices within
 * `radius` of the point that are edge-connected to this vertex. point: double[3]. out_handle: NULL, or receives the
 * number of the handle. Errors: as hf_pose_add_handles. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_add_handle_at(hf_pose pose, const double* point, double radius, uint32_t* out_handle);

/* Removes handles by number. handles: uint32_t[handle_count]. A handle on a higher layer takes its edit with it: the
 * surface is then, bit for bit, as if the handle had never been added. On layer 0 this holds when you remove the
 * handles that were added last, and for frames with `restart`. Errors: HF_ERROR_NOT_FOUND. Thread safety: changes
 * `pose`. Since 0.1.
 */
HF_API hf_result hf_pose_remove_handles(hf_pose pose, uint32_t handle_count, const uint32_t* handles);

/* A rigid motion of a handle from its rest place. It takes a point p to rotation (p - centroid) + centroid +
 * translation. The centroid is the mean of the region's rest positions, in the unit of the mesh: copies of a vertex
 * along seams count once (hf_pose_get_handle writes it). */
typedef struct hf_transform {
  double rotation[4]; /* unit quaternion x, y, z, w; normalised inside; all zero = identity; ignored where it is free */
  double translation[3]; /* up to 1e15 box diagonals */
} hf_transform;

/* Places handles. handles: uint32_t[handle_count]. transforms: hf_transform[handle_count]. On layer 0 a transform is a
 * motion from the rest place. On a higher layer it is an edit in the rest frame of the handle. There the region moves
 * by F (edit) F^-1, with F the rigid motion that the lower layers give the handle. Rotations continue from call to
 * call, so a handle that you dragged past 180 degrees stays turned that far. The transforms take effect at the next
 * hf_deform. Errors: HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_transforms(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                        const hf_transform* transforms);

/* Places one handle. Errors: as hf_pose_set_transforms. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_transform(hf_pose pose, uint32_t handle, const hf_transform* transform);

/* Frees the rotations of handles, or lets you give them again. handles: uint32_t[handle_count]. free_rotation: 1: the
 * solve finds the rotations; 0: you give them.
 *
 * A handle of free rotation is a positional constraint (Sorkine and Alexa 2007). Its centroid lands exactly where its
 * transform puts it; the rotation of the transform is ignored. Each hf_deform finds the rotation together with the
 * pose, and hf_pose_get_handle writes it. The rotation has the least as-rigid-as-possible energy. The energy of a
 * pulled group of vertices is measured from a longer and thinner shape than the rest shape of the group. So the
 * rotation is not exactly the rotation of least energy from the rest shape.
 *
 * Free the rotation while the user drags a handle: the wrist then follows the hand. Give the rotation while the user
 * turns a ring. A given rotation starts at the present rotation of the handle, so the pose does not change. When you
 * free a rotation on layer 0, the surface stays as it is. It releases the old rotation as handles move, as with
 * in_place; so move the handles after this call. On a higher layer a changed handle moves the surface at the next
 * frame. A handle alone in its component keeps its rotation. The first frame of a pose, and a frame with restart, move
 * free handles to their places in 8 steps, as a drag does. Such a frame takes the time of about 8 pose solves. refine
 * keeps the rotation of the smooth pose. Cost: one iteration of a solve for each free handle, at this call and when
 * handles are added or removed; little in a frame. Errors: HF_ERROR_NOT_FOUND, HF_ERROR_INVALID_ARGUMENT
 * (free_rotation). Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_free_rotations(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                            int32_t free_rotation);

/* Sets how much of the surface follows handles of layer 0. handles: uint32_t[handle_count]. following: 0 to 1. At 1 all
 * of the surface follows the handle; a new handle has 1. At 0 only the limb of the handle follows, such as an arm.
 *
 * Below 1, soft pins hold the surface where it would be without these handles. So a body does not lean after a dragged
 * hand. Where the field of the handle is near 1, the pins are weak, so the limb stays free. Keep 1 for the handles that
 * hold the body, and set less for a handle that is dragged. Every handle still lands exactly, and a limb that is too
 * short gets longer. The next hf_deform shows a change at once. But a handle that was just added in place leaves the
 * surface where it stands until a handle moves. Full-mesh steps (refine) ignore the pins. Repeated steps
 * (refine_from_last) let the body lean again. Cost: one field solve for the other handles, and as many solves of the
 * reduced system as in a few frames. You pay it at this call, and when handles are added or removed. While other
 * handles move, the pose solve of a frame takes up to twice the time. No factor is recomputed. Errors:
 * HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE and HF_ERROR_INVALID_ARGUMENT (following), HF_ERROR_UNSUPPORTED (a handle of
 * a higher layer). Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_following(hf_pose pose, uint32_t handle_count, const uint32_t* handles, double following);

/* Keeps the lengths of edges on the limbs of handles of layer 0, such as an arm whose hand is pulled. handles:
 * uint32_t[handle_count]. refine: 0 to 64 steps of as-rigid-as-possible on the limb in every frame; 0 = none, as in a
 * new handle. With 1, bends stay smooth. With 8 and more, most edges keep their lengths to a
 * few per cent, and the limb bends like two bones. Edges beside the handle can change more.
 *
 * The limb is the part of the surface where the field of the handle falls a long way over little area. It ends at the
 * trunk, or at the next handle on the limb. The steps move the limb alone. All other vertices keep their bits, so the
 * body leans no more than without the steps. A limb that is pulled beyond its length is stretched evenly. The limbs
 * take their steps after the steps of hf_deform_desc.refine. If handles have different counts of steps, all their limbs
 * take the largest count. Cost: a factor for the vertices of the limbs, at this call and when handles are added or
 * removed. A step takes as long per vertex as a step of refine. hf_pose_get_skin writes the motions before the steps.
 * Errors: HF_ERROR_NOT_FOUND, HF_ERROR_INVALID_ARGUMENT (refine), HF_ERROR_UNSUPPORTED (a handle of a higher layer).
 * Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_limb_refine(hf_pose pose, uint32_t handle_count, const uint32_t* handles, int32_t refine);

/* Names the rigid pieces of the mesh, such as a sword. A piece is an edge-connected part of the mesh. vertices:
 * uint32_t[vertex_count], one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
 * replaces the previous list.
 *
 * Each frame moves a rigid piece by the rigid motion that fits the piece best, also after refine. Vertices near links
 * count most in this fit. If the region of a handle touches a rigid piece, the whole piece joins the region and moves
 * with the handle. A second handle on the same piece is refused (HF_ERROR_CONFLICT). Call this function before you add
 * such handles. hf_pose_get_skin writes the motions before this fit. Errors: HF_ERROR_CONFLICT (a handle has a part of
 * a piece; index = position), HF_ERROR_OUT_OF_RANGE and HF_ERROR_INVALID_ARGUMENT (isolated vertex; index = position),
 * HF_ERROR_TOO_LARGE. Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_rigid_pieces(hf_pose pose, uint32_t vertex_count, const uint32_t* vertices);

/* Places handles by 4 x 4 matrices M. handles: uint32_t[handle_count]. matrices: double[handle_count][16], column by
 * column. The last column is the translation. M moves a rest position p to the posed position M p. Its linear part must
 * be a rotation within 1e-4; the function takes the nearest rotation. Its last row must be 0 0 0 1. Errors: as
 * hf_pose_set_transforms, HF_ERROR_INVALID_ARGUMENT (not a rigid motion). Thread safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_set_matrices(hf_pose pose, uint32_t handle_count, const uint32_t* handles,
                                      const double* matrices);

/* hf_pose_get_handle writes the region of a handle here, its layer, and its motion in the last hf_deform. */
typedef struct hf_handle_info {
  uint32_t struct_size;
  uint32_t vertex_count; /* of the region, welded copies counted once */
  uint32_t site_count;   /* of its boundary */
  uint32_t component;
  double centroid[3];    /* of the rest region, in the unit of the mesh */
  double leak;           /* how far fields are off on the regions: 0 in poses of hf_pose_create */
  double rotation[4];    /* of the handle in the last hf_deform, as in hf_transform. On a higher layer the motion of
                            the lower layers is included */
  double translation[3]; /* of the handle, in the same way */
  uint32_t layer;
  int32_t free_rotation; /* 1: the solve finds the rotation */
  double following;      /* how much of the surface follows; see hf_pose_set_following */
  int32_t limb_refine;   /* steps on its limb; see hf_pose_set_limb_refine */
  uint32_t reserved;     /* 0 */
} hf_handle_info;

/* Writes the info of a handle. Errors: HF_ERROR_NOT_FOUND. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_handle(hf_pose pose, uint32_t handle, hf_handle_info* out_info);

/* Returns the number of handles, or 0 for an invalid object. Thread safety: any thread. Since 0.1. */
HF_API uint32_t hf_pose_get_handle_count(hf_pose pose);

/* Writes the field of a handle, which says how much each vertex follows the handle. At a vertex that a handle reaches,
 * the fields of all handles sum to 1. out_values: [vertex_count] of float or double. Errors: HF_ERROR_NOT_FOUND. Thread
 * safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_field(hf_pose pose, uint32_t handle, const hf_array_out* out_values);

/* ---- posing ---- */

/* The work of a deform. */
typedef struct hf_deform_info {
  uint32_t struct_size;
  uint32_t iteration_count;        /* done */
  uint32_t unreached_vertex_count; /* in components without a handle; they stay at rest */
  uint32_t reserved;               /* 0 */
  double last_change;              /* largest change of a rotation in the last iteration */
} hf_deform_info;

/* Solves the pose and writes every vertex. out_positions: float[vertex_count][3], packed, in the unit and frame of the
 * mesh. Regions of layer 0 land exactly where their transforms put them. Regions of higher layers add their edits to
 * the surface of the lower layers. Identity transforms give the rest positions. Repeated calls start from the last pose
 * and allocate nothing, as dragging needs. out_info: NULL, or a struct. Errors: HF_ERROR_EMPTY (no handle). Thread
 * safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_deform(hf_pose pose, float* out_positions, hf_deform_info* out_info);

/* The options of hf_pose_deform are outputs and a range of vertices. Set at least one output. */
typedef struct hf_deform_desc {
  uint32_t struct_size;
  uint32_t iteration_count; /* 1 to 1000; 0 = the pose's */
  hf_array_out positions;   /* NULL, or [vertex_count][3] of float or double: posed positions */
  hf_array_out normals;     /* NULL, or [vertex_count][3] of float or double: unit normals of the posed surface, shared
                               across seams */
  int32_t restart;          /* 1: forget the last pose and start from the fields. The frame then has the bits of a fresh
                               pose with the same handles, added in the same order, and the same transforms. Without
                               restart a frame continues from the last one, so it also depends on that */
  int32_t refine; /* 0 to 64: steps of as-rigid-as-possible on the whole surface, with the same factor. A step takes
                     about 0.2 us per vertex. 0 and 1 keep bends smooth. 8 and more keep the lengths of edges; bends get
                     sharper */
  int32_t refine_from_last; /* 1: the steps go on from the surface of the last call, instead of starting at the smooth
                               pose. Then one step a frame keeps lengths in a drag as well as 8 do without. If the
                               handles do not move, more calls converge to the minimum. A restart, or a call without it,
                               forgets that surface. Needs a refine of 1 or more. Higher layers start at the smooth
                               pose. Memory: 72 bytes per vertex */
  uint32_t first_vertex;    /* outputs hold vertex_count vertices from this one on; 0 and 0: all */
  uint32_t vertex_count;    /* positions of a range cost only the range; but with higher layers, rigid pieces, refine,
                               limb_refine or normals they cost the whole surface */
  uint32_t reserved;        /* 0 */
} hf_deform_desc;

/* Does the same as hf_deform, with the options of a desc. out_info: NULL, or a struct. Errors: HF_ERROR_EMPTY (no
 * handle), HF_ERROR_OUT_OF_RANGE (the range), HF_ERROR_INVALID_ARGUMENT, HF_ERROR_TOO_LARGE (for floats). Thread
 * safety: changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_deform(hf_pose pose, const hf_deform_desc* desc, hf_deform_info* out_info);

/* Size of a pose and times of its last deform, in milliseconds; 0 before the first. */
typedef struct hf_pose_statistics {
  uint32_t struct_size;
  uint32_t cluster_count;
  double solve_ms;
  double blend_ms;
  double normal_ms;
  double refine_ms; /* steps of refine and of limb_refine */
} hf_pose_statistics;

/* Writes the statistics of a pose. Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_statistics(hf_pose pose, hf_pose_statistics* out_statistics);

/* ---- skins ---- */

/* This struct receives a pose or a transfer as a skin for linear blend skinning. The clusters become joints with fixed
 * vertex weights, and the skin holds their motion in the last frame. Joint j takes a point p to R (p - pivot) +
 * translation, with R its rotation. Its inverse bind matrix is the translation by -pivot.
 *
 * If you ask for scales, a joint may also stretch along its own axes. With B the rotation of `axes`, the joint takes p
 * to R B diag(scale) B^-1 (p - pivot) + translation. In a scene file that is a node with rotation R B and that scale,
 * and the inverse bind matrix takes p to B^-1 (p - pivot). The arrays are yours; each may be NULL. */
typedef struct hf_skin_info {
  uint32_t struct_size;
  uint32_t joint_capacity;  /* in: joints the arrays can take */
  uint32_t vertex_capacity; /* in: vertices the arrays can take */
  uint32_t influence_count; /* in: joints per vertex, 4 or 8; 0 = 4 */
  uint32_t joint_count;     /* out: joints, one per cluster of vertices and per rigid piece of a transfer */
  uint32_t vertex_count;    /* out */
  double* pivots;           /* [joint_capacity][3] rest centroid of what each joint moves */
  double* rotations;        /* [joint_capacity][4] quaternion x, y, z, w of the last frame */
  double* translations;     /* [joint_capacity][3] posed place of the pivot */
  double* axes;             /* [joint_capacity][4] quaternion of B, fixed while handles stay */
  double* scales;           /* [joint_capacity][3] along the axes in the last frame; NULL = joints are rigid */
  uint32_t* vertex_joints;  /* [vertex_capacity][influence_count] */
  float* vertex_weights;    /* [vertex_capacity][influence_count] of sum 1, descending */
} hf_skin_info;

/* Writes the joints and weights of a pose. Joints 0 to handle_count - 1 are its handles in the order they were added.
 * If the handles do not reach some vertices, a last joint that never moves holds those vertices. The weights of a
 * vertex are its 4 or 8 largest, scaled so that their sum is exactly 1 in single precision. Weights and pivots change
 * only when handles are added or removed.
 *
 * The joint motions bring the skin as near as possible to the last hf_deform, as it is without refine. With scales,
 * classic bends, twists and lifts replay within 0.5 per cent of the box. Without scales, bends and twists replay within
 * 1 per cent and stretched surfaces within about 2.5 per cent. Errors: HF_ERROR_INVALID_ARGUMENT (influence_count),
 * HF_ERROR_EMPTY (no handle), HF_ERROR_UNSUPPORTED (handles on higher layers: their surface is not a blend of
 * clusters). Thread safety: reads `pose`. Since 0.1.
 *
 * The function is for authoring, not for frames of a game: each call fits the joints over all vertices. */
HF_API hf_result hf_pose_get_skin(hf_pose pose, hf_skin_info* inout_skin);

/* ---- on a GPU ----
 *
 * A pose blends the transforms of clusters by fixed weights, so a shader can compute the vertices of a frame. Each
 * vertex has a row of entries. An entry names a cluster, with a weight w and the gradient g of that weight. Rows stay
 * the same until `revision` changes. Each frame has a new 3 x 4 transform A for every cluster. A vertex with the rest
 * position p goes to the sum of w A (p, 1) over its row, plus offset_share times its offset. Rest positions, transforms
 * and posed positions are relative to `centre`, so floats keep their digits far from 0.
 *
 * Let L be the 3 x 3 part of A, and J the sum of w L + (A (p, 1)) g^T over the row. A vector u in the tangent plane at
 * rest goes to J u, as does the tangent of a texture. Take two unit tangents u and v whose cross product u x v is the
 * rest normal. The posed normal has the direction J u x J v. J leaves the offsets out, so normals are some degrees off
 * while offsets fade. */

/* hf_pose_get_blend_info writes here how the last frame of a pose is blended. */
typedef struct hf_blend_info {
  uint32_t struct_size;
  uint32_t cluster_count; /* transforms that hf_pose_get_blend_transforms writes */
  uint32_t revision;      /* changes when rows or offsets change: call hf_pose_get_blend_rows again */
  uint32_t reserved;      /* 0 */
  double offset_share;    /* 0 to 1: share of its offset that a vertex gets. 0 unless handles were added in place or
                             rotations freed; it falls as handles move */
  double centre[3];       /* in the unit and frame of the mesh; positions are relative to this point */
  double low[3];  /* for culling: the smallest x, y and z of a box that holds all vertices of the last frame. In the
                     unit and frame of the mesh, relative to centre */
  double high[3]; /* the largest x, y and z. The box may be larger than needed: see docs/renderer.md */
} hf_blend_info;

/* Writes the info of a blend. Errors: HF_ERROR_EMPTY (no handle), HF_ERROR_UNSUPPORTED (higher layers, rigid pieces or
 * limb_refine: the surface is no blend), HF_ERROR_TOO_LARGE (for floats). Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_blend_info(hf_pose pose, hf_blend_info* out_info);

/* Receives the rows of a blend. The arrays are yours; each may be NULL. Positions and offsets are in the unit of the
 * mesh, gradients per unit of the mesh. */
typedef struct hf_blend_rows {
  uint32_t struct_size;
  uint32_t vertex_capacity; /* in: vertices the arrays can take */
  uint32_t entry_capacity;  /* in: entries the arrays can take */
  uint32_t vertex_count;    /* out: vertices of your mesh */
  uint32_t entry_count;     /* out: entries of all rows together */
  uint32_t longest_row;     /* out: entries of the vertex that has the most */
  uint32_t* rows;           /* [vertex_capacity][2] number of the first entry of the vertex, and count of its entries */
  uint16_t* clusters;       /* [entry_capacity] each below the count of clusters */
  float* weights;           /* [entry_capacity] multiples of 2^-24; the weights of a vertex sum to 1 */
  float* gradients;         /* [entry_capacity][3] of the weights along the rest surface, for normals */
  float* positions;         /* [vertex_capacity][3] at rest, relative to centre */
  float* normals;           /* [vertex_capacity][3] unit, at rest */
  float* offsets;           /* [vertex_capacity][3] 0 unless handles were added in place or rotations freed */
} hf_blend_rows;

/* Writes the arrays that a shader needs once for each `revision`. Call it without arrays for the counts, then with
 * arrays. If handles do not reach some vertices, a last cluster that never moves holds those vertices. Errors: as
 * hf_pose_get_blend_info, HF_ERROR_TOO_LARGE (too many entries). Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_blend_rows(hf_pose pose, hf_blend_rows* inout_rows);

/* Receives a blend as rows of one length, as vertex buffers of engines have them (JOINTS_0 and WEIGHTS_0 of glTF).
 * The arrays are yours; each may be NULL. Rows hold the heaviest entries of a vertex, by falling weight. Unused entries
 * have weight 0.
 *
 * The errors say what shorter rows and rounded weights cost. A vertex is off by at most the change of its weights times
 * the largest distance between the places to which its clusters move it. */
typedef struct hf_blend_influences {
  uint32_t struct_size;
  uint32_t vertex_capacity; /* in: vertices the arrays can take */
  uint32_t influence_count; /* in: clusters of each vertex, the length of a row, 1 to 64; 0 = 8 */
  uint32_t vertex_count;    /* out: vertices of your mesh */
  double change;            /* out: the largest change of a vertex's weights, 0 to 1: half the sum of the differences */
  double byte_change;       /* out: the same for byte_weights */
  double error;           /* out: the largest distance of a vertex from its place in the last frame, in box diagonals */
  double byte_error;      /* out: the same for byte_weights */
  uint16_t* clusters;     /* [vertex_capacity][influence_count] each below the count of clusters */
  uint16_t* weights;      /* [vertex_capacity][influence_count] 65535ths; the weights of a vertex sum to 65535 */
  uint8_t* byte_clusters; /* [vertex_capacity][influence_count] NULL = not wanted. Refused for more than 256 clusters */
  uint8_t* byte_weights;  /* [vertex_capacity][influence_count] NULL = not wanted. 255ths, of sum 255; weights that
                             round to 0 are left out */
} hf_blend_influences;

/* Writes rows of one length. They change with `revision`, as the rows of hf_pose_get_blend_rows do. Call it without
 * arrays for the count and the errors. Errors: as hf_pose_get_blend_info, HF_ERROR_INVALID_ARGUMENT (influence_count),
 * HF_ERROR_TOO_LARGE (byte_clusters). Thread safety: reads `pose`. Since 0.1. */
HF_API hf_result hf_pose_get_blend_influences(hf_pose pose, hf_blend_influences* inout_influences);

/* Solves a frame without writing vertices, for a shader that computes them. The pose is the same as after
 * hf_pose_deform. Higher layers, rigid pieces and limb_refine need the surface. With them the call costs as much as
 * hf_deform. iteration_count: 1 to 1000; 0 = as in hf_pose_desc. restart: 1: as in hf_deform_desc. out_info: NULL, or a
 * struct. Errors: HF_ERROR_EMPTY (no handle), HF_ERROR_INVALID_ARGUMENT (iteration_count, restart). Thread safety:
 * changes `pose`. Since 0.1. */
HF_API hf_result hf_pose_solve(hf_pose pose, uint32_t iteration_count, int32_t restart, hf_deform_info* out_info);

/* Writes the transforms of the clusters in the last hf_pose_solve or hf_deform, without its refine. Before the first
 * solve they are identities. After handles were added or removed, solve before you read them: they may be identities
 * until then. The call allocates nothing. out_transforms: NULL, or float[capacity][12], 3 x 4 matrices row by row.
 * out_count: NULL, or receives cluster_count. Errors: as hf_pose_get_blend_info. Thread safety: reads `pose`. Since
 * 0.1. */
HF_API hf_result hf_pose_get_blend_transforms(hf_pose pose, uint32_t capacity, float* out_transforms,
                                              uint32_t* out_count);

/* ---- proposed handles ---- */

/* Says why a place is proposed as a handle. */
enum hf_handle_reason {
  HF_HANDLE_REASON_FOOT = 0,  /* stands on the ground: the surface rises from it along a leg */
  HF_HANDLE_REASON_TIP = 1,   /* a protruding part ends there: head, tail, hand, horn (hf_surface_find_extremities) */
  HF_HANDLE_REASON_END = 2,   /* one of the two ends of a component without feet or tips */
  HF_HANDLE_REASON_JOINT = 3, /* a joint of the given skeleton: an end, or where it branches. Or a head, hand or foot
                                 that is no tip of the surface */
  /* The trunk of the largest component: the chest of a biped; pinned, inside the surface. With a skeleton of an upright
   * body, the vertices of chest and shoulders are held, up to the neck */
  HF_HANDLE_REASON_MIDDLE = 4
};

typedef struct hf_handle_proposals_desc {
  uint32_t struct_size;
  uint32_t joint_count;      /* joints of a skeleton that the mesh has already, up to 65,536; 0 = none */
  const double* joints;      /* [joint_count][3] their places at rest, in the unit and frame of the mesh */
  const uint32_t* parents;   /* [joint_count] position of each joint's parent in the list; HF_NO_INDEX for a root */
  hf_skeleton skeleton;      /* NULL, or the skeleton of the mesh, instead of joints and parents. It rests in the unit
                                and frame of the mesh. If it has a skin, the skin has the vertices of the mesh */
  double up[3];              /* direction away from the ground, of any length; zero = up of the skeleton where it is
                                known, else the y axis */
  double least_length_share; /* as in hf_extremities_desc; 0 = 0.05 */
  uint32_t limit;            /* most proposals, 1 to HF_HANDLE_LIMIT; 0 = 32 */
  uint32_t reserved;         /* 0 */
  hf_progress progress;      /* NULL, or an object to poll and cancel through */
  uint32_t* out_regions;     /* NULL, or [vertex_count]: position in the list of the proposal whose region has the
                                vertex; HF_NO_INDEX for a vertex of no region */
} hf_handle_proposals_desc;

/* One proposed handle. position and radius are as in hf_handles_desc: the regions of all proposals are disjoint. If a
 * skeleton with known roles is given, out_regions has all vertices of a head, a hand or a foot: give these to
 * hf_handles_desc for the whole part. The region of position and radius is then a part of these vertices. */
typedef struct hf_handle_proposal {
  uint32_t vertex;    /* nearest to the position; of your mesh, the first of welded copies */
  uint32_t component; /* as hf_surface_get_components */
  int32_t reason;     /* HF_HANDLE_REASON_* */
  int32_t pinned;     /* 1: add it at once, it holds the body; 0: offer it, and add it when it is dragged */
  uint32_t joint;     /* with a skin: the first joint of a head, hand or foot; for another region the lowest joint
                         that moves more than half of it, together with the joints below. Without a skin: the end joint
                         nearby, or the joint proposed. HF_NO_INDEX = none */
  int32_t role;       /* HF_ROLE_* that has most of the weights in the region. A sword has the role of its hand */
  int32_t side;       /* HF_SIDE_* of the same joints */
  uint32_t reserved;  /* 0 */
  double position[3]; /* at rest, in the unit and frame of the mesh; inside the surface for a joint and the trunk */
  double radius;      /* in the unit of the mesh */
  double length;      /* how far the part protrudes, in the unit of the mesh */
  double following;   /* pass it to hf_pose_set_following while the handle is dragged: 1 for a pinned proposal, else
                         0.25 */
} hf_handle_proposal;

/* Proposes handles for the first drag of a mesh: feet and the trunk hold, tips are dragged. Pinned proposals come
 * first, then the others, each group by length, the longest first. The places do not depend on the order of the
 * vertices. They follow translation and scale. desc: NULL for defaults. out_proposals: NULL, or
 * hf_handle_proposal[capacity]. out_count: NULL, or receives the number of proposals.
 *
 * A skeleton gives each proposal the joint that moves it, a role and a side. If its roles are known, feet and the trunk
 * are pinned. Hands, heads, tails and pieces that hang on them, such as a sword, are not. Each head, hand, foot, tail,
 * ear and wing gets at most one proposal. A part that no joint of the skin moves, such as the box that an animator
 * drags, gets none. Cost: as hf_surface_find_extremities, and some passes over the mesh. Errors:
 * HF_ERROR_INVALID_ARGUMENT (least_length_share, limit, joints without parents, joints and a skeleton, a skin of
 * another mesh), HF_ERROR_NON_FINITE (up; index = joint), HF_ERROR_OUT_OF_RANGE (a parent; index = joint),
 * HF_ERROR_CANCELLED. Thread safety: reads `surface` and the skeleton. Since 0.1. */
HF_API hf_result hf_surface_propose_handles(hf_surface surface, const hf_handle_proposals_desc* desc, uint32_t capacity,
                                            hf_handle_proposal* out_proposals, uint32_t* out_count);

#ifdef __cplusplus
}
#endif
#endif
