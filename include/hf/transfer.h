/* hf/transfer.h - play the motion of one surface on another.
 *
 * You pair regions of the source surface with regions of the target surface. From the pairs both surfaces get the same
 * harmonic coordinates, and places of equal coordinates correspond. The vertices around such a place form a cluster.
 * The target takes over the rotations of the source's clusters. Its translations follow from its own shape (Xu, Zhang,
 * Cohen-Or and Xiong 2009, Section 6), and from where the source's clusters turn about one another. A limb whose parts
 * reach farther than the source's turns less, so that it moves as far: a held sword, a long tail, a large head. The
 * dial long_follow gives it the whole turn. */
#ifndef HF_TRANSFER_H
#define HF_TRANSFER_H

#include "hf/pose.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hf_transfer_object* hf_transfer;

enum hf_transfer_mode {
  HF_TRANSFER_FIELDS = 0, /* a cluster: vertices with similar values of all fields; the default */
  /* Transfers stretch too: faces, breathing, squash. Play each morph target of the source as a frame. Each target
   * vertex i matches a source point with the deformation gradient F_i (Sumner and Popovic 2004). The result x'
   * minimises sum over edges of w_ij |(x'_i - x'_j) - (F_i + F_j) / 2 (x_i - x_j)|^2 with cotangent weights w. It is a
   * Poisson equation with the factor of the surface. Borders match borders, and narrow openings between them, such as
   * lids, close as on the source. There is no ground, no rest alignment, no dial, no hold and no skin; flags of pairs
   * only set the scale. A surface on itself gets its own pose */
  HF_TRANSFER_STRETCH = 1
};

enum hf_ground {
  HF_GROUND_KEEP = 0, /* feet are held at the ground. A part goes no deeper under the ground than on the source; thin
                         parts may. The default */
  HF_GROUND_OFF = 1   /* there is no ground: for flying and swimming, or where the host has its own */
};

/* Bits that describe a pair of regions. */
enum hf_pair_flag {
  HF_PAIR_ANCHOR = 1,       /* the target's region follows the scaled path of the source's (feet, trunk) */
  HF_PAIR_FOOT = 2,         /* an anchor that also stands on the ground, and whose leg gives the scale */
  HF_PAIR_TRUNK = 4,        /* part of the trunk: no rest alignment */
  HF_PAIR_NO_ALIGNMENT = 8, /* keep the source's rotations as they are even if the rest limbs point elsewhere */
  HF_PAIR_CONTACT = 16,     /* comes as near to the ground as the source's region, scaled, while that is near it (a nose
                               that grazes, a hand that leans); elsewhere it is free */
  HF_PAIR_SINKS = 32,       /* this limb may sink into the ground, thick or thin (hf_transfer_get_sinking) */
  HF_PAIR_NECK = 64,        /* head, nose or ears: neck_follow of hf_transfer_dials turns the neck that they share */
  HF_PAIR_TAIL = 128,       /* part of the tail: tail_follow turns it */
  HF_PAIR_ARM = 256         /* a hand: arm_space turns the arms of each side */
};

enum { HF_PAIR_LIMIT = 256 }; /* most pairs of a transfer */

typedef struct hf_transfer_desc {
  uint32_t struct_size;
  int32_t mode;           /* HF_TRANSFER_* */
  uint32_t cluster_count; /* 1 to 512. 0 = the larger of 80 and 5 per pair */
  int32_t ground;         /* HF_GROUND_* */
  double kernel_width;    /* width of a cluster, in field values, 0.005 to 0.5. 0 = the larger of 0.03 and 0.004 per
                             pair, up to 0.12 */
  double scale; /* lengths of the target over lengths of the source, 1e-6 to 1e6; 0 = from the legs, or from the boxes
                  when no pair is a foot */
  /* A limb whose rest directions differ by this angle is aligned by half, radians. Below 0.6 times the angle it is not
   * aligned, from 1.4 times on it is aligned fully. 0 = 40 degrees; negative = never. */
  double alignment_angle;
  /* Rows right, up, forward of the source and of the target. All zero = x, y, z (glTF: up +y, forward +z). Lengths, and
   * right x up = forward, must hold within 1e-3. The library takes the nearest rotation. */
  double source_axes[9];
  double target_axes[9];
  /* Poses in which the two bodies correspond, in each surface's unit. NULL: the positions of the surface. Give a
   * standing pose here for a character bound in a crouch. Motion is measured from these poses. They do not change the
   * fields. */
  hf_array source_rest; /* NULL, or [source.vertex_count][3] of float or double */
  hf_array target_rest; /* NULL, or [target.vertex_count][3] of float or double */
} hf_transfer_desc;

/* Creates a transfer between two surfaces; both may be the same. Sets *out_transfer to NULL first. desc: NULL for
 * defaults. Errors: HF_ERROR_INVALID_OBJECT (index 0 source, 1 target), HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE,
 * HF_ERROR_TOO_LARGE (index = vertex of a rest pose). Thread safety: reads the surfaces. Since 0.1. */
HF_API hf_result hf_transfer_create(hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                                    hf_transfer* out_transfer);
/* Destroys a transfer. Ignores NULL and destroyed objects. Since 0.1. */
HF_API void hf_transfer_destroy(hf_transfer transfer);

/* The pairs to add. The regions of each surface are vertex lists, one after the other. */
typedef struct hf_pairs_desc {
  uint32_t struct_size;
  uint32_t pair_count;             /* >= 1 */
  const uint32_t* source_counts;   /* [pair_count] number of vertices of each region, >= 1; repeats are allowed, up to
                                      four times the vertices of the mesh in all */
  const uint32_t* source_vertices; /* [sum(source_counts)] all regions one after the other; vertices of your mesh, up to
                                      4 entries per vertex */
  const uint32_t* target_counts;   /* [pair_count] */
  const uint32_t* target_vertices; /* [sum(target_counts)] */
  const uint32_t* flags;           /* [pair_count] HF_PAIR_*, or NULL for none */
  hf_progress progress;            /* NULL, or an object to poll and cancel through */
} hf_pairs_desc;

/* Adds pairs. out_pairs: NULL, or uint32_t[pair_count] for their numbers. Does not factorise. The fields and
 * clusters of the pairs are made by the next frame. With a progress this call makes them, so that they can be cancelled
 * too: give one with the last pairs you add. It changes no result. Errors: as hf_pose_add_handles, HF_ERROR_TOO_LARGE
 * (HF_PAIR_LIMIT), HF_ERROR_CANCELLED. Thread safety: changes `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_add_pairs(hf_transfer transfer, const hf_pairs_desc* pairs, uint32_t* out_pairs);
/* Removes pairs by number. pairs: uint32_t[pair_count]. Errors: HF_ERROR_NOT_FOUND. Thread safety: changes `transfer`.
 * Since 0.1. */
HF_API hf_result hf_transfer_remove_pairs(hf_transfer transfer, uint32_t pair_count, const uint32_t* pairs);

typedef struct hf_pair_info {
  uint32_t struct_size;
  uint32_t flags;
  double source_leak; /* of the pair's fields, see hf_handle_info */
  double target_leak;
  double
      alignment_angle; /* between the rest directions of the limb, radians; negative when unknown (trunk, short limb) */
  double confidence;   /* 0..1: share of the pair's clusters with enough source vertices */
  double alignment_share; /* how much of that angle the rest alignment takes away, 0 to 1 */
  int32_t aligned;        /* 1: alignment_share is above 0 */
  int32_t crossed;        /* 1: the region lies on one side of the source and on the other of the target, by the axes:
                             left and right may be exchanged */
} hf_pair_info;
/* Writes the info of a pair. The first call after a change of pairs solves the fields of all pairs, unless
 * hf_transfer_apply has done so. This changes no result. Errors: HF_ERROR_NOT_FOUND. Thread safety: reads
 * `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_get_pair(hf_transfer transfer, uint32_t pair, hf_pair_info* out_info);

/* hf_transfer_get_info writes counts and the scale of a transfer here. */
typedef struct hf_transfer_info {
  uint32_t struct_size;
  uint32_t pair_count;
  uint32_t cluster_count;
  uint32_t aligned_count; /* pairs whose rest alignment is applied */
  uint32_t crossed_count; /* pairs that change sides, see hf_pair_info */
  int32_t scale_found;    /* 1: from the legs or the boxes; 0: given in the desc */
  double scale;           /* lengths of the target over lengths of the source, each in the unit of its mesh */
} hf_transfer_info;
/* Writes the info of the whole transfer. The first call after a change of pairs solves fields, as hf_transfer_get_pair
 * does. Errors: HF_ERROR_EMPTY (no pair). Thread safety: reads `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_get_info(hf_transfer transfer, hf_transfer_info* out_info);

/* Work of a transfer. */
typedef struct hf_transfer_statistics {
  uint32_t struct_size;
  uint32_t source_factorisation_count; /* numeric factorisations by edits of pairs; 0 unless they are very many */
  uint32_t target_factorisation_count;
} hf_transfer_statistics;

/* Writes the statistics of a transfer. Thread safety: reads `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_get_statistics(hf_transfer transfer, hf_transfer_statistics* out_statistics);

/* Dials that an animator turns while a transfer plays. Neutral dials give the bits of a transfer without dials, and the
 * result is continuous in each dial. */
typedef struct hf_transfer_dials {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  double stride;     /* the paths of feet and trunk along the ground count this many times, 0.1 to 4; 0 = 1, neutral. A
                       planted foot does not slide. The body travels as much farther */
  double
      hip_height_share; /* raises the pairs flagged HF_PAIR_TRUNK and HF_PAIR_ANCHOR by this share of their mean height
                    at rest, -0.5 to 0.5; 0 = neutral. Feet stay, legs bend or stretch. A fallen body is not raised */
  /* How far a limb follows the source, -1 to 1. At 0 (neutral) the limb plays the source's motion from its own rest
   * direction. At 1 it also gets the rest direction of the source's limb. At -1 it does not move against its root. */
  double neck_follow; /* pairs flagged HF_PAIR_NECK, together one limb */
  double tail_follow; /* pairs flagged HF_PAIR_TAIL, together one limb */
  double arm_space;   /* turns arms (HF_PAIR_ARM) away from the body, about the forward axis at rest, -pi/2 to pi/2
                        radians; 0 = neutral */
  double long_follow; /* how far parts that reach farther than the source's follow, 0 to 1. 0 = neutral: they turn less,
                        so that they move as far. 1: they make the whole turn. Between, a part may jump that turns by
                        half a turn against the part before it */
} hf_transfer_dials;

/* Sets the dials of a transfer for the next frames. dials: NULL for neutral ones. Does not factorise and computes no
 * field. Errors: HF_ERROR_INVALID_ARGUMENT (out of range), HF_ERROR_NON_FINITE; the dials then stay. Thread safety:
 * changes `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_set_dials(hf_transfer transfer, const hf_transfer_dials* dials);
/* Writes the dials; stride is never 0. Thread safety: reads `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_get_dials(hf_transfer transfer, hf_transfer_dials* out_dials);

/* Names the rigid pieces of the target, such as a sword. A piece is an edge-connected part of the mesh. vertices:
 * uint32_t[vertex_count], one or more vertices of each rigid piece; vertex_count 0: no piece is rigid. The list
 * replaces the previous list and applies from the next frame on. The call does not factorise.
 *
 * Each frame moves a rigid piece by the rigid motion that fits the piece best, as hf_pose_set_rigid_pieces does. This
 * fit is the last step of a frame. So a hold on a part of a rigid piece may miss its position, and a rigid piece may
 * sink into the ground. Errors: HF_ERROR_OUT_OF_RANGE and HF_ERROR_INVALID_ARGUMENT (isolated vertex; index =
 * position), HF_ERROR_TOO_LARGE. Thread safety: changes `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_set_rigid_pieces(hf_transfer transfer, uint32_t vertex_count, const uint32_t* vertices);

/* Describes one frame: the input is the posed source, the output the posed target. Set at least one output. */
typedef struct hf_transfer_frame {
  uint32_t struct_size;
  uint32_t hold_count;       /* 0: none */
  hf_array source_positions; /* [source.vertex_count][3] of float or double: the posed source, its own vertex order */
  hf_array_out target_positions; /* NULL, or [target.vertex_count][3] of float or double */
  hf_array_out target_normals;   /* NULL, or [target.vertex_count][3] of float or double */
  /* A hold puts the target region of a pair exactly at a position of yours, such as a foot on a step or a hand on a
   * rail. The mean of the region's vertices lands there; welded copies count once. The rest of the surface follows. */
  const uint32_t* hold_pairs;   /* [hold_count] each pair at most once */
  const double* hold_positions; /* [hold_count][3] in the target's unit and frame */
} hf_transfer_frame;

/* Transfers one posed frame. If the source is at rest, the target is at rest too. If a limb's rest directions differ
 * much on the two surfaces (hf_pair_info), it takes the direction of the source's limb instead, by a share.
 *
 * The bits of a frame depend on the pairs, in the order of their numbers, on the dials and on this desc alone. Removed
 * pairs and earlier frames have no effect, so a scrubbed timeline and a played one give the same frames, bit for bit.
 * The result changes as little as the source does: a source that stands still except for noise gives a target that
 * stands still.
 *
 * The ground counts too if the mode is HF_TRANSFER_FIELDS and some pairs are anchors (their target region follows the
 * path of the source's region). While a foot of the source stands on the ground, the target's foot follows its scaled
 * path exactly. No vertex of the target sinks deeper into the ground than the source, scaled, except the vertices
 * of hf_transfer_get_sinking. A part that would sink bends up. The ground does not move regions that you hold. A lying
 * target rests on the parts that the source rests on. A rigid motion of the whole source is copied unchanged. All rules
 * of the ground come in continuously. The ground is under the feet of each body at rest, and what hangs lower is none:
 * a cape, a tail, scenery. Without feet, or where the trunk is below them, it is the lowest vertex. HF_GROUND_OFF
 * switches it off. Errors: HF_ERROR_EMPTY (no pair), HF_ERROR_NON_FINITE or HF_ERROR_TOO_LARGE (index = source vertex,
 * or position in the holds; 1e15 boxes away), HF_ERROR_TOO_LARGE (holds), HF_ERROR_NOT_FOUND, HF_ERROR_INVALID_ARGUMENT
 * (a pair held twice), HF_ERROR_UNSUPPORTED (holds with HF_TRANSFER_STRETCH). Thread safety: changes `transfer`. Since
 * 0.1. */
HF_API hf_result hf_transfer_apply(hf_transfer transfer, const hf_transfer_frame* frame);

/* Writes which target vertices may sink into the ground. out_sinking: uint8_t[target.vertex_count], 1: it may sink.
 * These are limbs flagged HF_PAIR_SINKS, tails (HF_PAIR_TAIL) where they are thin, thin parts that no pair moves
 * (antlers, ears, a held weapon), and what hangs below the feet at rest. Thin is less than 4 % of the bounding box
 * through. Legs (HF_PAIR_FOOT) never sink by themselves. Thin parts around an anchor, a contact or the trunk do not
 * sink either, except loose pieces without a pair. The first call after a change of pairs solves fields. Errors:
 * HF_ERROR_EMPTY (no pair). Thread safety: reads `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_get_sinking(hf_transfer transfer, uint8_t* out_sinking);

/* Writes the transfer as a skin (hf/pose.h), with the motion of the last frame. With influence_count 4 the skin replays
 * hf_transfer_apply exactly, because that function also uses the four largest weights. Each rigid piece is one
 * joint. These joints come after the joints of clusters. Errors: HF_ERROR_INVALID_ARGUMENT (influence_count),
 * HF_ERROR_EMPTY (no pair), HF_ERROR_UNSUPPORTED (HF_TRANSFER_STRETCH). Thread safety: reads `transfer`. Since 0.1. */
HF_API hf_result hf_transfer_get_skin(hf_transfer transfer, hf_skin_info* inout_skin);

#ifdef __cplusplus
}
#endif
#endif
