/* hf/weights.h - compute skin weights of a surface from a skeleton.
 *
 * Every vertex gets 4 or 8 bones with weights of sum 1. A vertex asks for its nearest bone if it sees that bone, the
 * more strongly the nearer it is. A smooth field gives the weights between (Baran and Popovic 2007). Pieces that do not
 * bend take one bone each: the parts of a robot, and eyes and buttons where their bone is clear. Pins are places whose
 * weights you give; they change the weights around them. No vertex stays without weights. Where the skeleton gives no
 * information, weights come from the nearest vertices, and the info counts them. */
#ifndef HF_WEIGHTS_H
#define HF_WEIGHTS_H

#include "hf/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The weights of one surface for one skeleton. */
typedef struct hf_weights_object* hf_weights;

/* The bones of a skeleton, in the unit and frame of the mesh. */
typedef struct hf_bones_desc {
  uint32_t struct_size;
  uint32_t bone_count; /* 1 to 1,048,576 */
  const double* heads; /* [bone_count][3] */
  const double* tails; /* [bone_count][3], or NULL: heads are joints, and the library finds the tails */
  const double* axes;  /* [bone_count][3] with tails NULL: where each bone points, any length, 0 for unknown; or NULL.
                          A bone reaches to the child that lies there, or to the end of the skin. A child that does
                          not deform says where a last bone ends */
  const uint32_t* parents; /* [bone_count] number of the parent, HF_NO_INDEX for a root; NULL: all are roots */
  const int32_t* deforms;  /* [bone_count] 1: the bone gets weights; NULL: all do */
  const uint32_t* sources; /* [bone_count] for hf_weights_set_bones: the number that the bone had before, HF_NO_INDEX
                              for a new one; NULL: the same number. hf_weights_create: NULL */
  hf_progress progress;    /* NULL, or an object to poll and cancel through */
} hf_bones_desc;

/* Computes weights. weight_count: bones per vertex, 4 or 8, or 0 for 4. Uses the harmonic factor of the surface; if it
 * has none, it is made now. Sets *out_weights to NULL first. Cost: a numeric factorisation and two sweeps for every 8
 * bones. Errors: HF_ERROR_EMPTY (no bone, or none deforms), HF_ERROR_NON_FINITE (index = bone), HF_ERROR_OUT_OF_RANGE
 * (a parent; index = bone), HF_ERROR_INVALID_ARGUMENT (weight_count; deforms, parents in a circle: index = bone),
 * HF_ERROR_UNSUPPORTED (a surface made of a graph), HF_ERROR_CANCELLED. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_weights_create(hf_surface surface, const hf_bones_desc* bones, uint32_t weight_count,
                                   hf_weights* out_weights);

/* Copies the weights, without the undo stack. The copy shares the factors. Sets *out_weights to NULL first. Thread
 * safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_clone(hf_weights weights, hf_weights* out_weights);

/* Destroys weights. Ignores NULL and destroyed handles. Since 0.1. */
HF_API void hf_weights_destroy(hf_weights weights);

/* Replaces all bones: moves, adds and removes them, and computes the weights. Pins and locks keep their bones. Errors:
 * as hf_weights_create, HF_ERROR_OUT_OF_RANGE (a source; index = bone), HF_ERROR_DUPLICATE_SITE (a source named twice;
 * index = bone), HF_ERROR_CONFLICT (a pin would lose all its bones; index = pin). Thread safety: changes `weights`.
 * Since 0.1. */
HF_API hf_result hf_weights_set_bones(hf_weights weights, const hf_bones_desc* bones);

/* Places with given weights. Set vertices, or triangles with barycentrics. Give every vertex of a painted region to
 * keep its weights. */
typedef struct hf_pins_desc {
  uint32_t struct_size;
  uint32_t pin_count;         /* 0 removes all pins */
  const uint32_t* vertices;   /* [pin_count] vertices as given, or NULL */
  const uint32_t* triangles;  /* [pin_count] triangles as given, or NULL */
  const double* barycentrics; /* [pin_count][3] with triangles, else NULL: weights of the corners, >= 0, of sum 1 within 1e-6 */
  const double* radii;        /* [pin_count] of the geodesic disc around the place, in the unit of the mesh; NULL or 0:
                                 the place alone */
  uint32_t joint_count;       /* bones of each pin, 1 to 8 */
  uint32_t reserved;          /* 0 */
  const uint32_t* joints;     /* [pin_count][joint_count] bones */
  const float* weights;       /* [pin_count][joint_count] >= 0, scaled to the sum 1 */
  hf_progress progress;       /* NULL, or an object to poll and cancel through */
} hf_pins_desc;

/* Replaces all pins and computes the weights. A pinned vertex gets its weights exactly; so do all vertices of a disc.
 * Pins at the same places with other weights cost no path. Cost: one elimination path and a dense row for each place,
 * and a sweep for every 8 bones that change. Errors, with index = pin: HF_ERROR_OUT_OF_RANGE (vertex, triangle, joint),
 * HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (a weight below 0, a sum of 0, a radius below 0, a vertex without a
 * triangle; joint_count), HF_ERROR_DUPLICATE_SITE (two pins share a vertex), HF_ERROR_CONFLICT (more than three pins in
 * one triangle), HF_ERROR_TOO_LARGE (more pins than vertices), HF_ERROR_CANCELLED. Thread safety: changes `weights`.
 * Since 0.1. */
HF_API hf_result hf_weights_set_pins(hf_weights weights, const hf_pins_desc* pins);

/* Locks bones: their weights stay, and the other bones share the rest. Replaces all locks; lock_count 0 unlocks.
 * bones: uint32_t[lock_count].
 * values: float[vertex_count][lock_count] weights to keep, 0 to 1, or NULL for the present ones. Welded copies take the
 * values of the first. Pinned vertices keep the weights of their pins. Errors: HF_ERROR_OUT_OF_RANGE (index = entry),
 * HF_ERROR_DUPLICATE_SITE (a bone named twice; index = entry), HF_ERROR_NON_FINITE and HF_ERROR_INVALID_ARGUMENT (a
 * value; index = vertex). Thread safety: changes `weights`. Since 0.1. */
HF_API hf_result hf_weights_set_locks(hf_weights weights, uint32_t lock_count, const uint32_t* bones,
                                      const float* values);

/* How the weights of a vertex were found. */
enum hf_weights_origin {
  HF_WEIGHTS_INFORMED = 0, /* it sees its nearest bone */
  HF_WEIGHTS_SOLVED = 1,   /* from the vertices around it */
  HF_WEIGHTS_PINNED = 2,   /* given by a pin */
  HF_WEIGHTS_CARRIED = 3,  /* guessed: its island has no information; from the nearest vertices of others */
  HF_WEIGHTS_RIGID = 4,    /* guessed, as carried: one mean for all vertices of a small island */
  HF_WEIGHTS_ISOLATED = 5, /* guessed: it belongs to no triangle; from the nearest vertex */
  HF_WEIGHTS_MATCHED = 6,  /* carried or mirrored: from a near point whose normal agrees */
  HF_WEIGHTS_KEPT = 7      /* mirrored: it is on the side that gives */
};

/* Receives the weights. The arrays are yours; each may be NULL. */
typedef struct hf_weights_out {
  uint32_t struct_size;
  uint32_t vertex_capacity; /* in: vertices the arrays can take */
  uint32_t vertex_count;    /* out */
  uint32_t weight_count;    /* out: bones per vertex, 4 or 8 */
  uint32_t* joints;         /* [vertex_capacity][weight_count] */
  uint16_t* joints_u16;     /* [vertex_capacity][weight_count] the same in 16 bits */
  float* weights;           /* [vertex_capacity][weight_count] descending, of sum exactly 1 */
  uint8_t* origins;         /* [vertex_capacity] HF_WEIGHTS_* */
} hf_weights_out;

/* Writes the weights. Welded copies of a vertex get the same. Unused places have weight 0 and the first bone of the
 * vertex. Errors: HF_ERROR_TOO_LARGE (joints_u16 with more than 65,536 bones). Thread safety: reads `weights`. Since
 * 0.1. */
HF_API hf_result hf_weights_get(hf_weights weights, hf_weights_out* inout_weights);

/* Bits that say why a bone deserves a look. */
enum hf_bone_flag {
  HF_BONE_NO_LENGTH = 1,    /* it is a point */
  HF_BONE_COINCIDENT = 2,   /* it lies exactly on a bone of a lower number */
  HF_BONE_INFORMS_NONE = 4, /* no vertex has it as its nearest bone in sight */
  HF_BONE_OUTSIDE = 8,      /* no part of it is inside the skin */
  HF_BONE_HELPER = 16 /* a proposal that follows from the other flags: it looks like a helper that should not deform */
};

/* Writes what was found about each bone: flags, and the vertices that ask for it. Bones that do not deform have no
 * flags. out_flags: NULL, or uint32_t[capacity] of HF_BONE_*. out_vertex_counts: NULL, or uint32_t[capacity].
 * out_count: NULL, or receives the count of bones. Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_bones(hf_weights weights, uint32_t capacity, uint32_t* out_flags,
                                      uint32_t* out_vertex_counts, uint32_t* out_count);

/* Counts of the weights. Vertices are counted as given. */
typedef struct hf_weights_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t bone_count;
  uint32_t pin_count;
  uint32_t lock_count;
  uint32_t informed_count; /* vertices by HF_WEIGHTS_* */
  uint32_t solved_count;
  uint32_t pinned_count;
  uint32_t carried_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t carried_island_count; /* islands without information */
  uint32_t rigid_island_count;   /* small ones of them */
  int32_t blind;                 /* 1: an island sees none of its nearest bones and asks for them unseen */
  uint32_t no_length_count;      /* bones by HF_BONE_* */
  uint32_t coincident_count;
  uint32_t informs_none_count;
  uint32_t outside_count;
  uint32_t helper_count;
  uint32_t factorisation_count; /* numeric factorisations since the object was made */
  uint32_t path_solve_count;    /* elimination paths of pins since then */
  uint32_t reserved;            /* 0 */
} hf_weights_info;

/* Writes the info. Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_info(hf_weights weights, hf_weights_info* out_info);

/* Records bones, pins and locks for undo. The library keeps the last 256 records. Thread safety: changes `weights`.
 * Since 0.1. */
HF_API hf_result hf_weights_record(hf_weights weights);
/* Restores the last record and computes its weights, bit for bit. Errors: HF_ERROR_NO_RECORD. Thread safety: changes
 * `weights`. Since 0.1. */
HF_API hf_result hf_weights_undo(hf_weights weights);
/* Reverts the last undo. Errors: HF_ERROR_NO_RECORD. Thread safety: changes `weights`. Since 0.1. */
HF_API hf_result hf_weights_redo(hf_weights weights);

/* Bits that say why a bone looks like a helper: a root, a target or a control that carries no skin. */
enum hf_helper_reason {
  HF_HELPER_PROPOSED = 1,     /* the reasons together are enough to propose it */
  HF_HELPER_NAME_ROOT = 2,    /* its name says root, armature, master, ... */
  HF_HELPER_NAME_CONTROL = 4, /* its name says pole, target, IK, control, ... */
  HF_HELPER_NAME_END = 8,     /* its name says end, tip, slot, ... */
  HF_HELPER_ROOT = 16,        /* it has no parent, but children */
  HF_HELPER_APART = 32,       /* it has no child, and its parent is a root with other bones */
  HF_HELPER_NO_LENGTH = 64,   /* as HF_BONE_NO_LENGTH, and so on */
  HF_HELPER_COINCIDENT = 128,
  HF_HELPER_OUTSIDE = 256,
  HF_HELPER_INFORMS_NONE = 512
};

/* Proposes bones that should not deform, and says why. The weights stay as they are: the caller decides, and sets
 * deforms to 0. names: one line for each bone in UTF-8, or NULL. out_reasons: uint32_t[capacity], bits of HF_HELPER_*
 * by bone, 0 for bones that do not deform; or NULL. out_count: NULL, or receives the count of bones. Errors:
 * HF_ERROR_INVALID_ARGUMENT (names with another count of lines). Thread safety: reads `weights`. Since 0.1. */
HF_API hf_result hf_weights_get_helpers(hf_weights weights, const char* names, uint32_t capacity, uint32_t* out_reasons,
                                        uint32_t* out_count);

/* Weights to carry from one surface to another. */
typedef struct hf_carry_desc {
  uint32_t struct_size;
  uint32_t influence_count; /* bones of each vertex in the arrays, 1 to 64 */
  const uint32_t* joints;   /* [source.vertex_count][influence_count] */
  const float* weights;  /* [source.vertex_count][influence_count] >= 0; a vertex whose weights are all 0 gives none */
  double distance;       /* a vertex matches points within it, unit of the mesh; 0: 0.05 of the source's diagonal */
  double angle;          /* between the normals of vertex and point, radians, up to 3.15; 0: 0.52 (30 degrees) */
  uint32_t weight_count; /* bones of each vertex in the result: 4 or 8; 0: 4 */
  uint32_t reserved;     /* 0 */
  hf_progress progress;  /* NULL, or an object to poll and cancel through */
} hf_carry_desc;

/* Counts of carried weights. Vertices of the target are counted as given. */
typedef struct hf_carry_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t matched_count; /* vertices by HF_WEIGHTS_* */
  uint32_t solved_count;
  uint32_t carried_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t guessed_island_count; /* islands without a match */
} hf_carry_info;

/* Carries weights from one surface to another: clothes, hair, levels of detail, new topology. Both stand in the same
 * frame. A vertex takes the weights of the nearest point of the source whose normal agrees. One bi-harmonic field fills
 * in the vertices without such a point. An island without any takes the weights of the nearest points. inout_weights:
 * as in hf_weights_get, with weight_count of the desc. out_info: NULL, or receives the counts. Cost: a search for each
 * vertex, one factorisation, and a sweep for every 8 bones. Errors: HF_ERROR_EMPTY (all weights are 0),
 * HF_ERROR_NON_FINITE and HF_ERROR_INVALID_ARGUMENT (a weight; index = vertex; distance, angle, influence_count,
 * weight_count), HF_ERROR_OUT_OF_RANGE (a joint of 1,048,576 or more; index = vertex), HF_ERROR_TOO_SMALL
 * (vertex_capacity), HF_ERROR_TOO_LARGE (joints_u16 with a joint above 65,535), HF_ERROR_UNSUPPORTED (a surface made of
 * a graph), HF_ERROR_CANCELLED. Thread safety: reads both surfaces. Since 0.1. */
HF_API hf_result hf_weights_carry(hf_surface source, hf_surface target, const hf_carry_desc* desc,
                                  hf_weights_out* inout_weights, hf_carry_info* out_info);

/* Which side of the plane gives its weights. */
enum hf_mirror_to {
  HF_MIRROR_TO_NEGATIVE = 0, /* the side that the normal points to */
  HF_MIRROR_TO_POSITIVE = 1, /* the other side */
  HF_MIRROR_BOTH = 2         /* each side takes the mean of both */
};

/* Where a plane of symmetry comes from. */
enum hf_mirror_plane {
  HF_MIRROR_PLANE_GIVEN = 0,
  HF_MIRROR_PLANE_BONES = 1,  /* from bones with partners */
  HF_MIRROR_PLANE_SURFACE = 2 /* from the surface */
};

/* How a bone found its partner. */
enum hf_mirror_pairing {
  HF_MIRROR_BONE_ALONE = 0,  /* it has none, and moves the other side too */
  HF_MIRROR_BONE_NAMED = 1,  /* the names differ in the side: arm.L and arm.R, LeftArm and RightArm */
  HF_MIRROR_BONE_PLACED = 2, /* it lies where the partner's reflection lies */
  HF_MIRROR_BONE_CENTRE = 3, /* it lies on the plane, and is its own partner */
  HF_MIRROR_BONE_GIVEN = 4
};

/* Weights to mirror. */
typedef struct hf_mirror_desc {
  uint32_t struct_size;
  uint32_t bone_count;      /* 1 to 1,048,576 */
  const double* heads;      /* [bone_count][3] the joints at rest, in the frame of the mesh */
  const char* names;        /* one line for each bone in UTF-8, or NULL: bones are paired by their places */
  const uint32_t* partners; /* [bone_count] the bone of the other side, HF_NO_INDEX: find it; or NULL */
  const double* plane;      /* [6] a point and a normal, or NULL: find the plane */
  uint32_t influence_count; /* bones of each vertex in the arrays, 1 to 64 */
  int32_t to;               /* HF_MIRROR_* */
  const uint32_t* joints;   /* [vertex_count][influence_count] */
  const float* weights;     /* [vertex_count][influence_count] >= 0; a vertex whose weights are all 0 gives none */
  double distance;          /* as in hf_carry_desc */
  double angle;             /* as in hf_carry_desc */
  uint32_t weight_count;    /* bones of each vertex in the result: 4 or 8; 0: 4 */
  uint32_t reserved;        /* 0 */
  hf_progress progress;     /* NULL, or an object to poll and cancel through */
} hf_mirror_desc;

/* The findings of a mirror. Vertices are counted as given; lengths are in the unit of the mesh. */
typedef struct hf_mirror_info {
  uint32_t struct_size;
  uint32_t vertex_count;
  int32_t plane_from;   /* HF_MIRROR_PLANE_* */
  uint32_t named_count; /* bones by HF_MIRROR_BONE_* */
  uint32_t placed_count;
  uint32_t centre_count;
  uint32_t given_count;
  uint32_t alone_count;
  uint32_t kept_count; /* vertices by HF_WEIGHTS_* */
  uint32_t matched_count;
  uint32_t solved_count;
  uint32_t carried_count;
  uint32_t rigid_count;
  uint32_t isolated_count;
  uint32_t worst_bone;   /* the bone farthest off, HF_NO_INDEX: none has a partner */
  uint32_t worst_vertex; /* the vertex farthest off, HF_NO_INDEX: none was mirrored */
  double point[3];       /* of the plane */
  double normal[3];
  double bone_off; /* mean distance of reflected bones from their partners */
  double worst_bone_off;
  double vertex_off; /* mean distance of reflected vertices from the surface */
  double worst_vertex_off;
} hf_mirror_info;

/* Mirrors the weights of one side to the other. Vertices need not mirror: a vertex takes the weights of the nearest
 * point to its reflection whose normal agrees, with the bones of the other side. One bi-harmonic field fills in the
 * rest. The plane comes from bones with partners, else from the surface. A found normal has a positive largest
 * component, so along x, HF_MIRROR_TO_NEGATIVE copies from +x to -x. inout_weights: as in hf_weights_get. out_bones:
 * uint32_t[bone_count] partners, or NULL. out_pairings: uint32_t[bone_count] HF_MIRROR_BONE_*, or NULL. out_info:
 * NULL, or receives what was found. Errors: as hf_weights_carry, HF_ERROR_EMPTY (no bone; no weight on the side that
 * gives), HF_ERROR_OUT_OF_RANGE (a partner, index = bone; a joint, index = vertex), HF_ERROR_INVALID_ARGUMENT (names
 * with another count of lines; a partner that has another partner, index = bone; a normal of length 0). Thread safety:
 * reads `surface`. Since 0.1. */
HF_API hf_result hf_weights_mirror(hf_surface surface, const hf_mirror_desc* desc, hf_weights_out* inout_weights,
                                   uint32_t* out_bones, uint32_t* out_pairings, hf_mirror_info* out_info);

#ifdef __cplusplus
}
#endif
#endif
