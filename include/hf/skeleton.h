/* hf/skeleton.h - know a character: its axes, and which joints are its spine, arms, legs and tail.
 *
 * You give the joints of a character as plain arrays, and the skin if there is one. The library finds up, forward and
 * left, gives each joint a role and a side, and orders joints into chains from root to tip. It sets apart joints that
 * only control others. It trusts, in this order: the axes and roles that you declare, the words of joint names, the
 * tree of the joints with its mirrored sides, and the skin. Where two of these disagree, it takes the better founded
 * one, lowers a confidence, and says so in a sentence.
 *
 * hf_retarget_create (hf/retarget.h) plays the motion of one skeleton on another. */
#ifndef HF_SKELETON_H
#define HF_SKELETON_H

#include "hf/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A skeleton at rest and the findings about it. Calls read the object, none changes it. */
typedef struct hf_skeleton_object* hf_skeleton;

/* The part of the body that a joint or a chain is. */
enum hf_role {
  HF_ROLE_OTHER = 0,
  HF_ROLE_SPINE = 1,
  HF_ROLE_NECK = 2,
  HF_ROLE_HEAD = 3,
  HF_ROLE_JAW = 4,
  HF_ROLE_SHOULDER = 5,
  HF_ROLE_ARM = 6,
  HF_ROLE_HAND = 7,
  HF_ROLE_FINGER = 8,
  HF_ROLE_LEG = 9,
  HF_ROLE_FOOT = 10,
  HF_ROLE_TOE = 11,
  HF_ROLE_TAIL = 12,
  HF_ROLE_WING = 13,
  HF_ROLE_EAR = 14,
  HF_ROLE_EYE = 15,
  HF_ROLE_ANTENNA = 16,
  HF_ROLE_FIN = 17
};

/* The side of the character, not of the person who looks at it. */
enum hf_body_side { HF_SIDE_MIDDLE = 0, HF_SIDE_LEFT = 1, HF_SIDE_RIGHT = 2 };

/* How a joint serves the body. */
enum hf_joint_kind {
  HF_JOINT_KIND_BODY = 0,   /* it moves a part of the body */
  HF_JOINT_KIND_HELPER = 1, /* a control, a pole, a target or a root: it moves no part */
  HF_JOINT_KIND_END = 2,    /* it marks the tip of a chain */
  HF_JOINT_KIND_TWIST = 3   /* it lies along a bone and takes a share of its turn */
};

/* The skin of a character: its surface, and the joints of each vertex. These are the arrays of a glTF skin as the file
 * has them: with inverse_binds the library moves the surface from the pose of binding to the pose `rest`. */
typedef struct hf_skin_desc {
  uint32_t struct_size;
  uint32_t vertex_count;
  uint32_t triangle_count;   /* 0: no triangles */
  uint32_t influence_count;  /* joints of each vertex in the arrays, 1 to 64 */
  int32_t at_rest;           /* 1: positions are in the pose `rest` and in the space of the joints, also with
                                inverse_binds. 0: in the pose of inverse_binds if there are any */
  uint32_t reserved;         /* 0 */
  const float* positions;    /* [vertex_count][3] */
  const uint32_t* triangles; /* [triangle_count][3], or NULL with triangle_count 0 */
  const uint32_t* joints;    /* [vertex_count][influence_count] */
  const float* weights;      /* [vertex_count][influence_count] >= 0; a vertex whose weights are all 0 has no joint */
} hf_skin_desc;

/* The joints of a character at rest. A joint transform is 10 numbers relative to the parent: translation x y z,
 * rotation x y z w, scale x y z. */
typedef struct hf_skeleton_desc {
  uint32_t struct_size;
  uint32_t joint_count;       /* 1 to 65,536 */
  const char* names;          /* one line for each joint in UTF-8, or NULL: names then say nothing */
  const uint32_t* parents;    /* [joint_count] number of the parent, HF_NO_INDEX for a root */
  const float* rest;          /* [joint_count][10] joint transforms */
  const float* inverse_binds; /* [joint_count][16] inverse bind matrices, columns first. All zero: no skin names the
                                 joint; it moves its children and rigid meshes only. NULL: the skin is given in the pose
                                 `rest`, and every joint can bend it */
  const float* up;            /* [3] declared axis, any length, or NULL: find it */
  const float* forward;       /* [3] declared axis, any length, or NULL: find it */
  const int32_t* roles;       /* [joint_count] declared HF_ROLE_*, -1 for a joint without; or NULL */
  const int32_t* sides;       /* [joint_count] HF_SIDE_* of joints with a declared role; or NULL: find the sides */
  uint32_t travel_count;      /* clips of the character, or 0 */
  uint32_t reserved;          /* 0 */
  const float* travels;       /* [travel_count][3] where each clip leads from its first to its last frame; it tells
                                 forward; or NULL */
  const hf_skin_desc* skin;   /* NULL: there is none, and joints are judged by names and places alone */
  hf_allocator allocator;     /* NULLs: malloc */
  hf_progress progress;       /* NULL, or an object to poll and cancel through */
} hf_skeleton_desc;

/* Reads a character and finds its axes, roles and chains. The skin says where soles and heads end, so give it if feet
 * shall stand on the ground. The object keeps a copy of everything. Sets *out_skeleton to NULL first. Cost: linear in
 * joints, vertices and triangles; loose pieces cost their square. Errors: HF_ERROR_NON_FINITE (index = joint or
 * vertex), HF_ERROR_INVALID_ARGUMENT (a rotation of length 0, parents in a circle, a role or a side that is none: index
 * = joint; names with another count of lines; a weight below 0: index = vertex; an axis of length 0),
 * HF_ERROR_OUT_OF_RANGE (a parent, index = joint; a joint, index = vertex; a vertex, index = triangle), HF_ERROR_EMPTY
 * (no joint), HF_ERROR_TOO_LARGE, HF_ERROR_CANCELLED. A character that is not understood is no error: its confidences
 * are low. Thread safety: any thread. Since 0.1. */
HF_API hf_result hf_skeleton_create(const hf_skeleton_desc* desc, hf_skeleton* out_skeleton);

/* Destroys a skeleton. Ignores NULL and destroyed objects. A retarget made from it stays valid. Since 0.1. */
HF_API void hf_skeleton_destroy(hf_skeleton skeleton);

/* The findings about a character. Confidences are 0 to 1. Lengths are in the unit of the joints; a length is 0
 * where the body has no such part. Lengths of legs belong to the hindmost pair that stands. */
typedef struct hf_skeleton_info {
  uint32_t struct_size;
  uint32_t joint_count;
  uint32_t chain_count;
  uint32_t reserved; /* 0 */
  double up[3];      /* unit axes in the space of the joints */
  double forward[3];
  double left[3];   /* up x forward */
  double middle[3]; /* a point on the ground in the plane of symmetry */
  double up_confidence;
  double forward_confidence;
  double left_confidence;
  double role_confidence;
  double height;     /* along up, over the ground */
  double leg_length; /* hip to knee to foot, and the height of the foot */
  double hip_height; /* of the joint of the thigh, over the ground */
  double arm_length; /* upper arm to hand */
} hf_skeleton_info;

/* Writes the findings. Thread safety: reads `skeleton`. Since 0.1. */
HF_API hf_result hf_skeleton_get_info(hf_skeleton skeleton, hf_skeleton_info* out_info);

/* The findings about a joint. */
typedef struct hf_joint_info {
  int32_t kind;   /* HF_JOINT_KIND_* */
  int32_t role;   /* HF_ROLE_*; of a twist joint, the role of its bone */
  int32_t side;   /* HF_SIDE_* */
  uint32_t chain; /* number of its chain, HF_NO_INDEX: none */
  uint32_t mate;  /* the joint that mirrors it, HF_NO_INDEX: none */
} hf_joint_info;

/* Writes one entry for each joint. out_joints: NULL, or hf_joint_info[capacity]. out_count: NULL, or receives the count
 * of joints. Thread safety: reads `skeleton`. Since 0.1. */
HF_API hf_result hf_skeleton_get_joints(hf_skeleton skeleton, uint32_t capacity, hf_joint_info* out_joints,
                                        uint32_t* out_count);

/* Joints of one role and side, from root to tip. */
typedef struct hf_chain {
  int32_t role;         /* HF_ROLE_* */
  int32_t side;         /* HF_SIDE_* */
  uint32_t number;      /* counts the chains of one role and side: legs from the front, others as their joints come */
  uint32_t parent;      /* the chain it hangs on, HF_NO_INDEX: none */
  uint32_t first;       /* its first entry in hf_skeleton_get_chain_joints */
  uint32_t joint_count; /* entries there, from root to tip */
  double length;        /* along the joints, up to the first joint of the chain at its tip */
} hf_chain;

/* Writes the chains. out_chains: NULL, or hf_chain[capacity]. out_count: NULL, or receives the count of chains. Thread
 * safety: reads `skeleton`. Since 0.1. */
HF_API hf_result hf_skeleton_get_chains(hf_skeleton skeleton, uint32_t capacity, hf_chain* out_chains,
                                        uint32_t* out_count);

/* Writes the joints of chain after chain. out_joints: NULL, or uint32_t[capacity]. out_count: NULL, or receives the
 * count of entries. Thread safety: reads `skeleton`. Since 0.1. */
HF_API hf_result hf_skeleton_get_chain_joints(hf_skeleton skeleton, uint32_t capacity, uint32_t* out_joints,
                                              uint32_t* out_count);

/* Writes the reasons as text. The reasons for the axes come first. Then each doubtful finding has one line.
 * out_text: NULL, or char[capacity] in UTF-8, zero-terminated. out_size: NULL, or receives the bytes with the zero.
 * Thread safety: reads `skeleton`. Since 0.1. */
HF_API hf_result hf_skeleton_get_reasons(hf_skeleton skeleton, size_t capacity, char* out_text, size_t* out_size);

#ifdef __cplusplus
}
#endif
#endif
