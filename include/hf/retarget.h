/* hf/retarget.h - play the motion of one skeleton on another, at run time, on plain arrays.
 *
 *   hf_retarget_create(man, robot, NULL, &retarget);            once
 *   hf_retarget_solve(retarget, pose, 1.0 / 60, robot_pose);    each frame
 *
 * The steps of a frame:
 * 1. Turns. A joint of the target turns as its partner of the source has turned since rest, seen from the body. Where
 *    the rests differ, limbs are aligned about shoulder and hip first: T pose, A pose and crouch meet. Chains with
 *    different counts of joints share their turns by arc length.
 * 2. Travel. The hips travel by the ratio of leg lengths.
 * 3. Goals. A planted foot stays in its place, and legs bend so that feet reach. Soles, tails, necks and the trunk stay
 *    above the ground, as far as the clip keeps the source above it.
 * No bone changes its length. A joint without a partner keeps its rest under its parent. Between equal skeletons the
 * library copies the pose.
 *
 * A pose is 10 numbers for each joint, relative to its parent: translation x y z, rotation x y z w, scale x y z. A
 * frame allocates nothing. */
#ifndef HF_RETARGET_H
#define HF_RETARGET_H

#include "hf/skeleton.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The motion of one skeleton on another. */
typedef struct hf_retarget_object* hf_retarget;

/* Which joint gets the travel over the ground. */
enum hf_root_motion {
  HF_ROOT_MOTION_HIPS = 0,    /* the hips */
  HF_ROOT_MOTION_ROOT = 1,    /* the topmost joint above the hips, as engines want for root motion */
  HF_ROOT_MOTION_IN_PLACE = 2 /* none: the body stays in its place */
};

/* Bits that name steps to leave out. */
enum hf_retarget_step {
  HF_RETARGET_KEEP_RESTS = 1, /* limbs are not aligned: both rests are alike, or you want their difference */
  HF_RETARGET_NO_GOALS = 2,   /* joints turn and the hips travel; feet and ground are ignored */
  HF_RETARGET_NO_LOCK = 4, /* planted feet may slide. A frame then has no state: a scrubbed timeline gives the bits of
                              a played one */
  HF_RETARGET_NO_COPY = 8  /* equal skeletons are retargeted like others */
};

/* Options of a retarget. NULL in hf_retarget_create gives the defaults. */
typedef struct hf_retarget_desc {
  uint32_t struct_size;
  int32_t root_motion;       /* HF_ROOT_MOTION_* */
  uint32_t leave_out;        /* bits of HF_RETARGET_* */
  uint32_t reserved;         /* 0 */
  double scale;              /* travel of the target over travel of the source; 0: the ratio of leg lengths */
  double ground_velocity[3]; /* of the ground under a clip on the spot, in the space of the source, per second; 0: the
                                ground rests. hf_skeleton_get_ground_velocity finds it */
  const float* source_rest;  /* [source.joint_count][10] a pose that counts as rest, or NULL: the rest of the
                                skeleton. Give poses in which both characters stand alike */
  const float* target_rest;  /* [target.joint_count][10] the same for the target, or NULL */
  hf_progress progress;      /* NULL, or an object to poll and cancel through */
} hf_retarget_desc;

/* Pairs the joints of two skeletons. desc: NULL, or the options. The object needs neither skeleton afterwards. It
 * allocates through the allocator of the target. Sets *out_retarget to NULL first. Errors: HF_ERROR_EMPTY (no joint has
 * a partner), HF_ERROR_INVALID_ARGUMENT (root_motion, leave_out, a scale below 0; a rotation of length 0, a flat
 * transform, no joint above the hips with HF_ROOT_MOTION_ROOT: index = joint), HF_ERROR_NON_FINITE (index = joint).
 * Thread safety: reads both skeletons. Since 0.1. */
HF_API hf_result hf_retarget_create(hf_skeleton source, hf_skeleton target, const hf_retarget_desc* desc,
                                    hf_retarget* out_retarget);

/* Copies a retarget with the state of its feet: for another character with the same skeletons, and for undo. Sets
 * *out_retarget to NULL first. Thread safety: reads `retarget`. Since 0.1. */
HF_API hf_result hf_retarget_clone(hf_retarget retarget, hf_retarget* out_retarget);

/* Destroys a retarget. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_retarget_destroy(hf_retarget retarget);

/* Computes the pose of the target. source_pose: float[source.joint_count][10]. seconds: time since the last frame, 0
 * for the first frame and for a repeated frame. out_target_pose: float[target.joint_count][10]. The frame depends on
 * the source pose and on the state of the feet: whether each is planted, and how far it is moved to keep its place. The
 * state comes from the frames since the last reset and fades within a step. Errors: HF_ERROR_NON_FINITE and
 * HF_ERROR_INVALID_ARGUMENT (a joint transform, index = joint; seconds, HF_NO_INDEX). Thread safety: changes
 * `retarget`; use one for each character that moves. Since 0.1. */
HF_API hf_result hf_retarget_solve(hf_retarget retarget, const float* source_pose, double seconds,
                                   float* out_target_pose);

/* Forgets the state of the feet and the figures of the info. Call it where the clip jumps. Thread safety: changes
 * `retarget`. Since 0.1. */
HF_API hf_result hf_retarget_reset(hf_retarget retarget);

/* Says where the scale comes from. */
enum hf_scale_from {
  HF_SCALE_GIVEN = 0,
  HF_SCALE_LEGS = 1,  /* lengths of legs, from hip to sole */
  HF_SCALE_HIPS = 2,  /* heights of hips: both stand on four legs or more */
  HF_SCALE_HEIGHT = 3 /* heights of bodies: one has no legs */
};

/* Figures of a retarget. Angles, stride and drop count all frames since the last reset. */
typedef struct hf_retarget_info {
  uint32_t struct_size;
  uint32_t source_joint_count;
  uint32_t target_joint_count;
  uint32_t matched_joint_count; /* joints of the target that follow the source */
  uint32_t chain_count;         /* chains of the target that follow */
  int32_t same_skeleton;        /* 1: keys are copied */
  int32_t scale_from;           /* HF_SCALE_* */
  uint32_t frame_count;
  double scale;        /* travel of the target over travel of the source */
  double limb_angle;   /* mean angle between the bones of arms and legs and the same bones of the source, radians */
  double stride_share; /* how far planted feet would travel without the goals, over `scale` times the travel of the
                          source. A clip on the spot needs the least correction if the body moves at scale x
                          stride_share times the speed of the clip */
  double deepest_drop; /* how far the hips sank so that feet reach, unit of the target */
} hf_retarget_info;

/* Writes the figures. Thread safety: reads `retarget`. Since 0.1. */
HF_API hf_result hf_retarget_get_info(hf_retarget retarget, hf_retarget_info* out_info);

/* How a chain of the target follows the source. Angles lie between a bone of the target and the same bone of the
 * source, in radians. They are 0 for a chain of one joint, and for a chain whose rest is not aligned. */
typedef struct hf_chain_match {
  int32_t role; /* HF_ROLE_* */
  int32_t side; /* HF_SIDE_* */
  uint32_t source_joint_count;
  uint32_t target_joint_count;
  double mean_angle;
  double worst_angle;
} hf_chain_match;

/* Writes how chains follow. out_chains: NULL, or hf_chain_match[capacity]. out_count: NULL, or receives chain_count of
 * the info. Thread safety: reads `retarget`. Since 0.1. */
HF_API hf_result hf_retarget_get_chains(hf_retarget retarget, uint32_t capacity, hf_chain_match* out_chains,
                                        uint32_t* out_count);

/* Writes which joint of the source each joint of the target follows. A
 * joint between two gets the nearer, a joint without a partner HF_NO_INDEX. out_partners: NULL, or uint32_t[capacity].
 * out_count: NULL, or receives the count of joints of the target. Thread safety: reads `retarget`. Since 0.1. */
HF_API hf_result hf_retarget_get_partners(hf_retarget retarget, uint32_t capacity, uint32_t* out_partners,
                                          uint32_t* out_count);

/* Finds the velocity of the soles where they touch the ground, for a clip on the spot: a treadmill under a walk. It is
 * 0 for a clip that travels. poses: float[frame_count][joint_count][10]. seconds: between two frames, above 0.
 * out_velocity: double[3] in the space of the skeleton, per second. Errors: HF_ERROR_EMPTY (no frame),
 * HF_ERROR_NON_FINITE and HF_ERROR_INVALID_ARGUMENT (index = frame; seconds). Thread safety: reads `skeleton`. Since
 * 0.1. */
HF_API hf_result hf_skeleton_get_ground_velocity(hf_skeleton skeleton, uint32_t frame_count, const float* poses,
                                                 double seconds, double* out_velocity);

#ifdef __cplusplus
}
#endif
#endif
