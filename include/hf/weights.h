/* hf/weights.h - compute skin weights of a surface from a skeleton.
 *
 * Every vertex gets 4 or 8 joints with weights of sum 1. A joint is a segment here, from its head to its tail. A joint
 * is visible from a vertex if the segment between them stays inside the skin. A vertex with its nearest joint in sight
 * gets a constraint for this joint, which is stronger the nearer the joint is. A smooth field gives the weights between
 * (Baran and Popovic 2007). Pieces that do not bend take one joint each: the parts of a robot, and eyes and buttons
 * where their joint is clear. Pins are places whose weights you give; they change the weights around them. No vertex
 * stays without weights. Where the skeleton gives no information, weights come from the nearest vertices, and the info
 * counts them. */
#ifndef HF_WEIGHTS_H
#define HF_WEIGHTS_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The weights of one surface for one skeleton. */
typedef struct hf_weights_object* hf_weights;

/* The joints of a skeleton, in the unit and frame of the mesh. */
typedef struct hf_joints_desc {
  uint32_t struct_size;
  uint32_t joint_count;    /* 1 to 1,048,576 */
  const double* heads;     /* [joint_count][3] */
  const double* tails;     /* [joint_count][3], or NULL: heads are joints, and the library finds the tails */
  const double* axes;      /* [joint_count][3] with tails NULL: where each joint points, any length, a zero vector for
                              unknown; or NULL.      A joint reaches to the child that lies there, or to the end of the skin.
                              A      child that does      not deform says where a last joint ends */
  const uint32_t* parents; /* [joint_count] number of the parent, HF_NO_INDEX for a root; NULL: all are roots */
  const int32_t* deforms;  /* [joint_count] 1: the joint gets weights; NULL: all do */
  const uint32_t* sources; /* [joint_count] for hf_weights_set_joints: the number that the joint had before, HF_NO_INDEX
                              for a new one; NULL: the same number. hf_weights_create: NULL */
  hf_progress progress;    /* NULL, or an object to poll and cancel through */
} hf_joints_desc;

/* Computes weights. influence_count: joints per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if
 * it has none, it is made now. Sets *out_weights to NULL first. Cost: a numeric factorisation and two sweeps for every
 * 8 joints. Errors: HF_ERROR_EMPTY (no joint, or none deforms), HF_ERROR_NON_FINITE (index = joint),
 * HF_ERROR_OUT_OF_RANGE (a parent; index = joint), HF_ERROR_INVALID_ARGUMENT (influence_count; deforms, parents in a
 * circle: index = joint), HF_ERROR_UNSUPPORTED (a surface made of a graph), HF_ERROR_CANCELLED. Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_weights_create(hf_surface surface, const hf_joints_desc* joints, uint32_t influence_count,
                                   hf_weights* out_weights);

/* Copies the weights with joints, pins and locks. The copy shares the factors and all memory, until one of the two is
 * changed. For undo, keep copies: one before each change. Sets *out_weights to NULL first. Thread
 * safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_clone(hf_weights weights, hf_weights* out_weights);

/* Destroys weights. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_weights_destroy(hf_weights weights);

/* Replaces all joints: moves, adds and removes them, and computes the weights. Pins and locks keep their joints.
 * Errors: as hf_weights_create, HF_ERROR_OUT_OF_RANGE (a source; index = joint), HF_ERROR_DUPLICATE (a source named
 * twice; index = joint), HF_ERROR_CONFLICT (a pin would lose all its joints; index = pin). Thread safety: changes
 * `weights`. Since 0.1. */
HF_API hf_result hf_weights_set_joints(hf_weights weights, const hf_joints_desc* joints);

/* Places with given weights. Set one of vertices, places and points. To keep a painted region, pin all its vertices. */
typedef struct hf_pins_desc {
  uint32_t struct_size;
  uint32_t pin_count;       /* 0 removes all pins */
  const uint32_t* vertices; /* [pin_count] vertices of your mesh, or NULL */
  const hf_place* places;   /* [pin_count], or NULL */
  const double* points;     /* [pin_count][3] points in space, at rest, in the unit and frame of the mesh, or NULL. Each
                               stands for the nearest point of the surface, up to two boxes away */
  const double* radii;      /* [pin_count] of the geodesic disc around the place, in the unit of the mesh; NULL or 0:
                               the place alone */
  uint32_t influence_count; /* joints of each pin, 1 to 8 */
  uint32_t reserved;        /* 0 */
  const uint32_t* joints;   /* [pin_count][influence_count] joints */
  const float* weights;     /* [pin_count][influence_count] >= 0, scaled to the sum 1 */
  hf_progress progress;     /* NULL, or an object to poll and cancel through */
} hf_pins_desc;

/* Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices of a disc.
 * Pins at the same places with other weights cost no path. Cost: one elimination path and a dense row for each place,
 * and a sweep for every 8 joints that change. Errors, with index = pin: HF_ERROR_OUT_OF_RANGE (vertex, joint),
 * HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (barycentrics, a weight below 0, a sum of 0, a radius below 0, a
 * vertex without a triangle; influence_count), HF_ERROR_DUPLICATE (two pins share a vertex), HF_ERROR_CONFLICT (more
 * than three pins in one triangle), HF_ERROR_TOO_LARGE (more pins than vertices, a point two boxes or more away),
 * HF_ERROR_CANCELLED. Thread safety: changes `weights`. Since 0.1. */
HF_API hf_result hf_weights_set_pins(hf_weights weights, const hf_pins_desc* pins);

/* Locks joints: their weights stay, and the other joints share the rest. Replaces all locks; lock_count 0 unlocks.
 * joints: uint32_t[lock_count]. values: float[vertex_count][lock_count] weights to keep, 0 to 1, or NULL for the
 * present ones. Welded copies take the values of the first. Pinned vertices keep the weights of their pins. Errors:
 * HF_ERROR_OUT_OF_RANGE (index = entry), HF_ERROR_DUPLICATE (a joint named twice; index = entry), HF_ERROR_NON_FINITE
 * and HF_ERROR_INVALID_ARGUMENT (a value; index = vertex). Thread safety: changes `weights`. Since 0.1. */
HF_API hf_result hf_weights_set_locks(hf_weights weights, uint32_t lock_count, const uint32_t* joints,
                                      const float* values);

/* How the weights of a vertex were found. */
enum hf_weights_origin {
  HF_WEIGHTS_INFORMED = 0, /* its nearest joint is in sight */
  HF_WEIGHTS_SOLVED = 1,   /* from the vertices around it */
  HF_WEIGHTS_PINNED = 2,   /* given by a pin */
  HF_WEIGHTS_NEAREST = 3,  /* guessed: its piece has no information; from the nearest vertices of others */
  HF_WEIGHTS_RIGID = 4,    /* guessed, as NEAREST: one mean for all vertices of a small piece */
  HF_WEIGHTS_ISOLATED = 5, /* guessed: it belongs to no triangle; from the nearest vertex */
  HF_WEIGHTS_MATCHED = 6,  /* transferred or mirrored: from a near point whose normal agrees */
  HF_WEIGHTS_KEPT = 7      /* mirrored: it is on the side to copy from */
};

/* Receives the weights. The arrays are yours; each may be NULL. */
typedef struct hf_weights_out {
  uint32_t struct_size;
  uint32_t vertex_capacity; /* in: vertices the arrays can take */
  uint32_t vertex_count;    /* out */
  uint32_t influence_count; /* out: joints per vertex, 4 or 8 */
  uint32_t* joints;         /* [vertex_capacity][influence_count] */
  uint16_t* joints_u16;     /* [vertex_capacity][influence_count] the same in 16 bits */
  float* weights;           /* [vertex_capacity][influence_count] descending, of sum exactly 1 */
  uint8_t* origins;         /* [vertex_capacity] HF_WEIGHTS_* */
} hf_weights_out;

/* Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first joint of the
 * vertex. Errors: HF_ERROR_TOO_LARGE (joints_u16 with more than 65,536 joints). Thread safety: reads `weights`. Since
 * 0.1. */
HF_API hf_result hf_weights_get(hf_weights weights, hf_weights_out* inout_weights);

/* Bits that say why a joint deserves a look. */
enum hf_joint_flag {
  HF_JOINT_NO_LENGTH = 1,    /* it is a point */
  HF_JOINT_COINCIDENT = 2,   /* it lies exactly on a joint of a lower number */
  HF_JOINT_INFORMS_NONE = 4, /* no vertex has it as its nearest joint in sight */
  HF_JOINT_OUTSIDE = 8,      /* no part of it is inside the skin */
  HF_JOINT_HELPER = 16 /* a proposal that follows from the other flags: it looks like a helper that should not deform */
};

/* Writes the flags of each joint, and how many vertices have a constraint for it. Joints that do not deform have no
 * flags. out_flags: NULL, or uint32_t[capacity] of HF_JOINT_*. out_vertex_counts: NULL, or uint32_t[capacity].
 * out_count: NULL, or receives the count of joints. Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_joints(hf_weights weights, uint32_t capacity, uint32_t* out_flags,
                                       uint32_t* out_vertex_counts, uint32_t* out_count);

/* Counts of the weights. Vertices are vertices of your mesh. */
typedef struct hf_weights_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t joint_count;
  uint32_t pin_count;
  uint32_t lock_count;
  uint32_t informed_count; /* vertices by HF_WEIGHTS_* */
  uint32_t solved_count;
  uint32_t pinned_count;
  uint32_t nearest_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
} hf_weights_info;

/* Writes the info. Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_info(hf_weights weights, hf_weights_info* out_info);

/* Figures of weights for developers: pieces that were guessed, joints to check, work done. */
typedef struct hf_weights_statistics {
  uint32_t struct_size;
  uint32_t nearest_piece_count; /* pieces without information */
  uint32_t rigid_piece_count;   /* small ones of them */
  int32_t blind;            /* 1: none of the nearest joints of some piece is in its sight; it uses them nevertheless */
  uint32_t no_length_count; /* joints by HF_JOINT_* */
  uint32_t coincident_count;
  uint32_t informs_none_count;
  uint32_t outside_count;
  uint32_t helper_count;
  uint32_t factorisation_count; /* numeric factorisations since the object was made */
  uint32_t path_solve_count;    /* elimination paths of pins since then */
} hf_weights_statistics;

/* Writes the statistics. Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_statistics(hf_weights weights, hf_weights_statistics* out_statistics);

/* Bits that say why a joint looks like a helper: a root, a target or a control that moves no skin. */
enum hf_helper_reason {
  HF_HELPER_PROPOSED = 1,     /* the reasons together are enough to propose it */
  HF_HELPER_NAME_ROOT = 2,    /* its name says root, armature, master, ... */
  HF_HELPER_NAME_CONTROL = 4, /* its name says pole, target, IK, control, ... */
  HF_HELPER_NAME_END = 8,     /* its name says end, tip, slot, ... */
  HF_HELPER_ROOT = 16,        /* it has no parent, but children */
  HF_HELPER_APART = 32,       /* it has no child, and its parent is a root with other joints */
  HF_HELPER_NO_LENGTH = 64,   /* as HF_JOINT_NO_LENGTH, and so on */
  HF_HELPER_COINCIDENT = 128,
  HF_HELPER_OUTSIDE = 256,
  HF_HELPER_INFORMS_NONE = 512
};

/* Proposes joints that should not deform, and says why. The weights do not change: to follow a proposal, set deforms to
 * 0. names: one line for each joint in UTF-8, or NULL. out_reasons: uint32_t[capacity], bits of HF_HELPER_* by joint, 0
 * for joints that do not deform; or NULL. out_count: NULL, or receives the count of joints. Errors:
 * HF_ERROR_INVALID_ARGUMENT (names with another count of lines). Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_helpers(hf_weights weights, const char* names, uint32_t capacity, uint32_t* out_reasons,
                                        uint32_t* out_count);

/* Weights to transfer from one surface to another. */
typedef struct hf_weights_transfer_desc {
  uint32_t struct_size;
  uint32_t source_influence_count; /* joints of each vertex in the arrays, 1 to 64 */
  const uint32_t* joints;          /* [source.vertex_count][source_influence_count] */
  const float* weights; /* [source.vertex_count][source_influence_count] >= 0; a vertex whose weights are all 0 gives
                           none */
  double distance;      /* a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal */
  double angle;         /* between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees) */
  uint32_t influence_count; /* joints of each vertex in the result: 4 or 8; 0: 4 */
  uint32_t reserved;        /* 0 */
  hf_progress progress;     /* NULL, or an object to poll and cancel through */
} hf_weights_transfer_desc;

/* Counts of transferred weights. Vertices are vertices of the target mesh. */
typedef struct hf_weights_transfer_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t matched_count; /* vertices by HF_WEIGHTS_* */
  uint32_t solved_count;
  uint32_t nearest_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t guessed_piece_count; /* pieces without a match */
} hf_weights_transfer_info;

/* Transfers weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand in the same
 * frame. A vertex gets the weights of the nearest point of the source whose normal agrees. One bi-harmonic field fills
 * in the vertices without such a point. A piece without any takes the weights of the nearest points. inout_weights: as
 * in hf_weights_get, with influence_count of the desc. out_info: NULL, or receives the counts. Cost: a search for each
 * vertex, one factorisation, and a sweep for every 8 joints. Errors: HF_ERROR_EMPTY (all weights are 0),
 * HF_ERROR_NON_FINITE and HF_ERROR_INVALID_ARGUMENT (a weight; index = vertex; distance, angle, source_influence_count,
 * influence_count), HF_ERROR_OUT_OF_RANGE (a joint of 1,048,576 or more; index = vertex), HF_ERROR_TOO_SMALL
 * (vertex_capacity), HF_ERROR_TOO_LARGE (joints_u16 with a joint above 65,535), HF_ERROR_UNSUPPORTED (a surface made of
 * a graph), HF_ERROR_CANCELLED. Thread safety: reads both surfaces. Since 0.1. */
HF_API hf_result hf_weights_transfer(hf_surface source, hf_surface target, const hf_weights_transfer_desc* desc,
                                     hf_weights_out* inout_weights, hf_weights_transfer_info* out_info);

/* Which side of the plane gives its weights. */
enum hf_mirror_to {
  HF_MIRROR_TO_NEGATIVE = 0, /* the side that the normal points to */
  HF_MIRROR_TO_POSITIVE = 1, /* the other side */
  HF_MIRROR_BOTH = 2         /* each side takes the mean of both */
};

/* Where a plane of symmetry comes from. */
enum hf_mirror_plane {
  HF_MIRROR_PLANE_GIVEN = 0,
  HF_MIRROR_PLANE_JOINTS = 1, /* from joints with partners */
  HF_MIRROR_PLANE_SURFACE = 2 /* from the surface */
};

/* How a joint found its partner. */
enum hf_mirror_pairing {
  HF_MIRROR_JOINT_ALONE = 0,  /* it has none, and moves the other side too */
  HF_MIRROR_JOINT_NAMED = 1,  /* the names differ in the side: arm.L and arm.R, LeftArm and RightArm */
  HF_MIRROR_JOINT_PLACED = 2, /* it lies where the partner's reflection lies */
  HF_MIRROR_JOINT_CENTRE = 3, /* it lies on the plane, and is its own partner */
  HF_MIRROR_JOINT_GIVEN = 4
};

/* Weights to mirror. */
typedef struct hf_weights_mirror_desc {
  uint32_t struct_size;
  uint32_t joint_count;            /* 1 to 1,048,576 */
  const double* heads;             /* [joint_count][3] the joints at rest, in the frame of the mesh */
  const char* names;               /* one line for each joint in UTF-8, or NULL: joints are paired by their places */
  const uint32_t* partners;        /* [joint_count] the joint of the other side, HF_NO_INDEX: find it; or NULL */
  const double* plane;             /* [6] a point and a normal, or NULL: find the plane */
  uint32_t source_influence_count; /* joints of each vertex in the arrays, 1 to 64 */
  int32_t to;                      /* HF_MIRROR_* */
  const uint32_t* joints;          /* [vertex_count][source_influence_count] */
  const float* weights; /* [vertex_count][source_influence_count] >= 0; a vertex whose weights are all 0 gives none */
  double distance;      /* as in hf_weights_transfer_desc */
  double angle;         /* as in hf_weights_transfer_desc */
  uint32_t influence_count; /* joints of each vertex in the result: 4 or 8; 0: 4 */
  uint32_t reserved;        /* 0 */
  hf_progress progress;     /* NULL, or an object to poll and cancel through */
} hf_weights_mirror_desc;

/* The plane that hf_weights_mirror found, and counts of joints and vertices. Vertices are vertices of your mesh. */
typedef struct hf_weights_mirror_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  int32_t plane_from;   /* HF_MIRROR_PLANE_* */
  uint32_t named_count; /* joints by HF_MIRROR_JOINT_* */
  uint32_t placed_count;
  uint32_t centre_count;
  uint32_t given_count;
  uint32_t alone_count;
  uint32_t kept_count; /* vertices by HF_WEIGHTS_* */
  uint32_t matched_count;
  uint32_t solved_count;
  uint32_t nearest_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  double point[3]; /* of the plane */
  double normal[3];
} hf_weights_mirror_info;

/* Distances of a surface and its joints from their reflections, in the unit of the mesh. */
typedef struct hf_weights_mirror_statistics {
  uint32_t struct_size;
  uint32_t worst_joint;  /* the joint farthest off, HF_NO_INDEX: none has a partner */
  uint32_t worst_vertex; /* the vertex farthest off, HF_NO_INDEX: none was mirrored */
  uint32_t reserved;     /* 0 */
  double joint_off;      /* mean distance of reflected joints from their partners */
  double worst_joint_off;
  double vertex_off; /* mean distance of reflected vertices from the surface */
  double worst_vertex_off;
} hf_weights_mirror_statistics;

/* Mirrors the weights of one side to the other. The mesh need not be symmetric. A vertex gets the weights of the
 * nearest point to its reflection whose normal agrees, with the joints of the other side. One bi-harmonic field fills
 * in the rest. The plane comes from joints with partners, else from the surface. The largest component of a found
 * normal is positive. So for a normal along x, HF_MIRROR_TO_NEGATIVE copies from +x to -x. inout_weights: as in
 * hf_weights_get. out_partners: uint32_t[joint_count] partners, or NULL. out_pairings: uint32_t[joint_count]
 * HF_MIRROR_JOINT_*, or NULL. out_info: NULL, or receives the findings. out_statistics: NULL, or receives the
 * distances. Errors: as hf_weights_transfer, HF_ERROR_EMPTY (no joint; no weight on the side to copy from),
 * HF_ERROR_OUT_OF_RANGE (a partner, index = joint; a joint, index = vertex), HF_ERROR_INVALID_ARGUMENT (names with
 * another count of lines; a partner that has another partner, index = joint; a normal of length 0). Thread safety:
 * reads `surface`. Since 0.1. */
HF_API hf_result hf_weights_mirror(hf_surface surface, const hf_weights_mirror_desc* desc,
                                   hf_weights_out* inout_weights, uint32_t* out_partners, uint32_t* out_pairings,
                                   hf_weights_mirror_info* out_info, hf_weights_mirror_statistics* out_statistics);

#ifdef __cplusplus
}
#endif
#endif
