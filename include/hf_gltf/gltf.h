/* hf_gltf/gltf.h - read glTF models, play their clips, propose pairs for a transfer, write what came out.
 *
 * hf_gltf is a library of its own beside hf. It calls nothing of hf: you pass its arrays to hf, and the results of hf
 * to it. Both have the same rules (hf/base.h): every function returns an hf_result, a failed call changes nothing,
 * structs start with struct_size, output arrays have a capacity and write a count. Every function can return
 * HF_ERROR_INVALID_OBJECT, HF_ERROR_NULL_POINTER, HF_ERROR_INVALID_DESC, HF_ERROR_BUSY, HF_ERROR_OUT_OF_MEMORY and
 * HF_ERROR_TOO_SMALL; its comment lists the others. Functions with "get", "pose", "propose" or "write" read a model;
 * several threads can do that at once.
 *
 * Files can be damaged or hostile: sizes, indices and values are checked before they are used. */
#ifndef HF_GLTF_H
#define HF_GLTF_H

#include "hf/base.h"

#if defined(HF_GLTF_STATIC)
#define HF_GLTF_API
#elif defined(_WIN32)
#if defined(HF_GLTF_BUILDING)
#define HF_GLTF_API __declspec(dllexport)
#else
#define HF_GLTF_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define HF_GLTF_API __attribute__((visibility("default")))
#else
#define HF_GLTF_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hf_gltf_model_object* hf_gltf_model;
typedef struct hf_gltf_pairs_object* hf_gltf_pairs;

enum {
  HF_GLTF_GLB = 0, /* one binary file */
  HF_GLTF_TEXT = 1 /* .gltf with the buffer inside */
};

/* Copies the detail of the last failed call of hf_gltf on this thread; all zero before the first. Thread safety: any
 * thread. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_error_get_detail(hf_error_detail* out_detail);

/* ---- models ---- */

typedef struct hf_gltf_read_desc {
  uint32_t struct_size;
  uint32_t reserved;   /* 0 */
  const void* bytes;   /* a file in memory, or NULL */
  uint64_t byte_count; /* of bytes */
  const char* file;    /* UTF-8. Without bytes: the file to read; files it names are read from below its folder. With
                          bytes: the name for messages, or NULL */
} hf_gltf_read_desc;

/* Reads a glTF 2.0 file. A build with assimp (HF_WITH_ASSIMP) also reads .fbx, .dae and .bvh files. It reads them in a
 * process of their own, which the call starts with fork(). Sets *out_model to NULL first. Errors:
 * HF_ERROR_INVALID_ARGUMENT (the file cannot be read or contradicts itself; the detail says where), HF_ERROR_TOO_LARGE.
 * Thread safety: any thread. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_read(const hf_gltf_read_desc* desc, hf_gltf_model* out_model);

typedef struct hf_gltf_mesh_desc {
  uint32_t struct_size;
  uint32_t vertex_count, triangle_count;
  uint32_t reserved;         /* 0 */
  const char* name;          /* UTF-8, or NULL */
  const double* positions;   /* [vertex_count][3]; far from 0 the model has a node that stands there */
  const uint32_t* triangles; /* [triangle_count][3] */
} hf_gltf_mesh_desc;

/* Makes a model of one mesh, for surfaces of other formats. Sets *out_model to NULL first. Errors: HF_ERROR_EMPTY,
 * HF_ERROR_NON_FINITE (index = vertex), HF_ERROR_OUT_OF_RANGE (index = triangle). Thread safety: any thread. Since
 * 0.1. */
HF_GLTF_API hf_result hf_gltf_model_create(const hf_gltf_mesh_desc* desc, hf_gltf_model* out_model);

/* Destroys a model. Ignores NULL and destroyed objects. Pairs made of it stay valid. Thread safety: any thread. Since
 * 0.1. */
HF_GLTF_API void hf_gltf_model_destroy(hf_gltf_model model);

typedef struct hf_gltf_model_info {
  uint32_t struct_size;
  uint32_t vertex_count, triangle_count; /* of all triangle meshes of the scene together */
  uint32_t clip_count;
  uint32_t joint_count;     /* nodes of the file: each is a joint of hf_gltf_skeleton */
  uint32_t note_count;      /* sentences of hf_gltf_model_get_note */
  int32_t has_skin;         /* 1 if a mesh has a skin */
  uint32_t name_byte_count; /* of the names of hf_gltf_skeleton, with the zero at the end */
} hf_gltf_model_info;

/* Writes the counts of a model. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_get_info(hf_gltf_model model, hf_gltf_model_info* out_info);

/* Copies a sentence about the file: it names repaired, skipped or lost parts. text: UTF-8, zero-terminated, cut to
 * `capacity` bytes. Errors: HF_ERROR_OUT_OF_RANGE. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_get_note(hf_gltf_model model, uint32_t index, uint32_t capacity, char* text);

/* The surface of a model at rest, in the frame of the scene. Each array can be NULL. */
typedef struct hf_gltf_surface {
  uint32_t struct_size;
  uint32_t reserved;
  double* positions;   /* [vertex_count][3]: for positions of hf_surface_desc */
  uint32_t* triangles; /* [triangle_count][3] */
  uint16_t* joints;    /* [vertex_count][8] joints of hf_gltf_skeleton, and */
  float* weights;      /* [vertex_count][8], sum 1: for hf_links_desc and hf_skin_desc. A mesh without a skin has its
                          node as the one joint */
} hf_gltf_surface;

/* Writes the surface: the vertices of all meshes, one behind the other, each as often as the file has it. Copies can
 * differ by rounding, so give hf a weld tolerance, such as 1e-6 of the box. Errors: HF_ERROR_EMPTY (no
 * triangles), HF_ERROR_TOO_LARGE (more joints than `joints` can number). Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_get_surface(hf_gltf_model model, const hf_gltf_surface* out_surface);

/* The joints of a model at rest, for hf_skeleton_desc: every node of the file is a joint. Each array can be NULL. Fill
 * a hf_skin_desc with the arrays of hf_gltf_surface, positions as float and joints as uint32_t, and set its at_rest
 * to 1. */
typedef struct hf_gltf_skeleton {
  uint32_t struct_size;
  uint32_t name_capacity; /* bytes of names; hf_gltf_model_info.name_byte_count are needed */
  char* names;            /* one line for each joint in UTF-8, zero-terminated */
  uint32_t* parents;      /* [joint_count], HF_NO_INDEX for a root */
  float* rest;          /* [joint_count][10] translation x y z, rotation x y z w, scale x y z, relative to the parent */
  float* inverse_binds; /* [joint_count][16] columns first; all zero for a joint of no skin */
} hf_gltf_skeleton;

/* Writes the joints. Errors: HF_ERROR_TOO_SMALL (names). Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_get_skeleton(hf_gltf_model model, const hf_gltf_skeleton* out_skeleton);

/* Puts the vertices of the surface at new places at rest. Rig, clips and looks stay; normals follow. positions:
 * [vertex_count][3]. Errors: HF_ERROR_EMPTY, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (for floats; index = vertex).
 * Thread safety: changes the model. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_set_positions(hf_gltf_model model, const double* positions);

/* Writes the file. format: HF_GLTF_GLB or HF_GLTF_TEXT. bytes: NULL asks for the count alone. Errors:
 * HF_ERROR_INVALID_ARGUMENT. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_write(hf_gltf_model model, int32_t format, uint64_t capacity, void* bytes,
                                          uint64_t* out_count);

/* Writes a file, .glb or .gltf by its ending; file: UTF-8. The old object goes when the new one is complete. Errors:
 * HF_ERROR_INVALID_ARGUMENT (the file cannot be written; the detail says why). Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_save(hf_gltf_model model, const char* file);

/* ---- clips ---- */

typedef struct hf_gltf_clip_info {
  uint32_t struct_size;
  uint32_t key_count; /* of all channels */
  double duration;    /* seconds; a clip starts at 0 */
  char name[64];      /* UTF-8, zero-terminated, cut */
} hf_gltf_clip_info;

/* Writes the name and the length of a clip. Errors: HF_ERROR_OUT_OF_RANGE. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_get_clip(hf_gltf_model model, uint32_t clip, hf_gltf_clip_info* out_info);

/* Writes where a clip moves the surface at a time, in seconds: joints, nodes and morph targets. Before the first and
 * after the last key the value is held. positions: [vertex_count][3]. Errors: HF_ERROR_OUT_OF_RANGE,
 * HF_ERROR_NON_FINITE (time), HF_ERROR_EMPTY. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_pose(hf_gltf_model model, uint32_t clip, double time, double* positions);

/* Writes the transform of every joint in a clip at a time, in seconds: for hf_retarget_solve. Before the first and
 * after the last key the value is held. joints: [joint_count][10], as in hf_gltf_skeleton. Errors:
 * HF_ERROR_OUT_OF_RANGE, HF_ERROR_NON_FINITE (time). Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_pose_joints(hf_gltf_model model, uint32_t clip, double time, float* joints);

/* Poses of the joints over time, such as the output of hf_retarget_solve. */
typedef struct hf_gltf_joints_desc {
  uint32_t struct_size;
  uint32_t frame_count;
  const char* name;    /* of the clip; UTF-8, or NULL */
  const double* times; /* [frame_count], increasing, from 0 on */
  const float* joints; /* [frame_count][joint_count][10], as in hf_gltf_skeleton */
} hf_gltf_joints_desc;

/* Adds a clip, as the first. It has keys for the joints that leave their rest. Errors: HF_ERROR_NON_FINITE (index =
 * frame), HF_ERROR_INVALID_ARGUMENT (times; a rotation of length 0, index = frame), HF_ERROR_EMPTY (no frame). Thread
 * safety: changes the model. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_add_joint_clip(hf_gltf_model model, const hf_gltf_joints_desc* desc);

/* Posed copies of a surface over time, such as the output of hf_transfer_apply. */
typedef struct hf_gltf_frames_desc {
  uint32_t struct_size;
  uint32_t frame_count;
  const char* name;        /* of the clip; UTF-8, or NULL */
  const double* times;     /* [frame_count], increasing, from 0 on */
  const double* positions; /* [frame_count][vertex_count][3] */
  const double* firm;      /* [frame_count][vertex_count], 0 to 1: how firmly a vertex must be met, such as a foot that
                              stands; or NULL */
} hf_gltf_frames_desc;

/* How far a written motion is from the given one: lengths. */
typedef struct hf_gltf_fit_info {
  uint32_t struct_size;
  uint32_t joint_count; /* joints that turn */
  double rms, max;
} hf_gltf_fit_info;

/* Adds a clip, as the first, whose joints follow the frames: each joint of the model's own skin turns so that the skin
 * comes nearest. Bones keep their lengths. The lowest y of all frames is the ground: a leg that is too long for a frame
 * bends, and stays above it to 0.01 of the box or so. Frames beside each other that are alike get one pose. out_info:
 * NULL is allowed. Errors: HF_ERROR_UNSUPPORTED (no skin), HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE (for floats; index =
 * frame), HF_ERROR_INVALID_ARGUMENT (times). Thread safety: changes the model. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_add_clip(hf_gltf_model model, const hf_gltf_frames_desc* desc,
                                             hf_gltf_fit_info* out_info);

/* The rigid motion of joints over time, such as the output of hf_pose_get_skin or hf_transfer_get_skin. */
typedef struct hf_gltf_skin_desc {
  uint32_t struct_size;
  uint32_t joint_count, frame_count;
  uint32_t influence_count;   /* for each vertex, 1 to 8 */
  const char* name;           /* of the clip; UTF-8, or NULL */
  const double* pivots;       /* [joint_count][3] */
  const uint32_t* joints;     /* [vertex_count][influence_count] */
  const float* weights;       /* the same, not negative */
  const double* times;        /* [frame_count], increasing, from 0 on */
  const double* rotations;    /* [frame_count][joint_count][4]: x y z w */
  const double* translations; /* [frame_count][joint_count][3]: where the pivot is */
} hf_gltf_skin_desc;

/* Makes a model of the surface of another, with a new skin and one clip; the looks stay. Sets *out_model to NULL first.
 * Errors: HF_ERROR_EMPTY, HF_ERROR_INVALID_ARGUMENT (the detail names joint, vertex or frame). Thread safety: reads the
 * model. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_create_skinned(hf_gltf_model model, const hf_gltf_skin_desc* desc,
                                                   hf_gltf_model* out_model);

/* Puts the clips of another model on this one, before its own. Joints are found by name, and lengths follow the
 * skeleton. out_joint_count: joints that were found, or NULL. Errors: HF_ERROR_INVALID_ARGUMENT (less than half of the
 * joints are here). Thread safety: changes the first model, reads the other. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_add_clips_of(hf_gltf_model model, hf_gltf_model other, uint32_t* out_joint_count);

/* Leaves out keys of a clip that its other keys give back by interpolation. tolerance: a length, no vertex is further
 * off in a key; out_distance: the largest distance found, or NULL. Errors: HF_ERROR_OUT_OF_RANGE (clip),
 * HF_ERROR_INVALID_ARGUMENT (tolerance). Thread safety: changes the model. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_model_remove_keys(hf_gltf_model model, uint32_t clip, double tolerance,
                                                double* out_distance);

/* ---- pairs: places of two models that correspond, for hf_transfer_add_pairs ---- */

typedef struct hf_gltf_propose_desc {
  uint32_t struct_size;
  /* Extremities of the surfaces, largest first, as hf_surface_find_extremities (HF_EXTREMITIES_GEODESIC) finds them.
   * They help where skeletons do not. */
  uint32_t source_tip_count, target_tip_count;
  uint32_t reserved;           /* 0 */
  const uint32_t* source_tips; /* vertices, or NULL */
  const uint32_t* target_tips;
} hf_gltf_propose_desc;

/* Finds axes, feet, head, tail, hands and the trunk of both models by their skeletons, then by shape, and pairs them.
 * Sets *out_pairs to NULL first. desc: NULL for none. Errors: HF_ERROR_EMPTY (a model without triangles, or too little
 * in common; the detail says what each has), HF_ERROR_OUT_OF_RANGE (a tip). Thread safety: reads the models. Since 0.1.
 */
HF_GLTF_API hf_result hf_gltf_pairs_propose(hf_gltf_model source, hf_gltf_model target,
                                            const hf_gltf_propose_desc* desc, hf_gltf_pairs* out_pairs);

/* Reads pairs in the format of samples/transfer (JSON text) for two models. Sets *out_pairs to NULL first. Errors:
 * HF_ERROR_INVALID_ARGUMENT (the detail names the key), HF_ERROR_EMPTY. Thread safety: reads the models. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_pairs_read(hf_gltf_model source, hf_gltf_model target, const char* text,
                                         uint64_t byte_count, hf_gltf_pairs* out_pairs);

/* Destroys pairs. Ignores NULL and destroyed objects. Thread safety: any thread. Since 0.1. */
HF_GLTF_API void hf_gltf_pairs_destroy(hf_gltf_pairs pairs);

typedef struct hf_gltf_pairs_info {
  uint32_t struct_size;
  uint32_t pair_count;
  float source_axes[9], target_axes[9]; /* for hf_transfer_desc */
  float scale; /* for hf_transfer_desc: lengths of the target over lengths of the source by the legs of both skeletons,
                * or as the pairs say; 0: a skeleton has no legs that are known, or neither body is upright */
  int32_t ground; /* for hf_transfer_desc, HF_GROUND_* of hf/transfer.h: OFF where a body swims or the pairs say so */
} hf_gltf_pairs_info;

/* Writes the number of pairs, the axes of both models, the scale between them and whether there is a ground. Since
 * 0.1. */
HF_GLTF_API hf_result hf_gltf_pairs_get_info(hf_gltf_pairs pairs, hf_gltf_pairs_info* out_info);

typedef struct hf_gltf_pair {
  uint32_t struct_size;
  uint32_t flags;                          /* HF_PAIR_* of hf/transfer.h */
  uint32_t source_count, target_count;     /* vertices of the regions, copies included */
  double source_place[3], target_place[3]; /* the middle of each region */
  double source_radius, target_radius;     /* of the balls, lengths */
  double confidence;                       /* 0 to 1; 1 for pairs that were read */
  char name[48];                           /* UTF-8, zero-terminated, cut */
} hf_gltf_pair;

/* Writes one pair. Errors: HF_ERROR_OUT_OF_RANGE. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_pairs_get_pair(hf_gltf_pairs pairs, uint32_t index, hf_gltf_pair* out_pair);

/* Writes the vertices of the two regions of a pair; regions of different pairs share none. NULL leaves a list out.
 * Errors: HF_ERROR_OUT_OF_RANGE. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_pairs_get_regions(hf_gltf_pairs pairs, uint32_t index, uint32_t source_capacity,
                                                uint32_t* source_vertices, uint32_t target_capacity,
                                                uint32_t* target_vertices);

/* Writes the pairs as JSON text, as hf_gltf_pairs_read takes it. text: NULL asks for the count alone. Not
 * zero-terminated. Since 0.1. */
HF_GLTF_API hf_result hf_gltf_pairs_write(hf_gltf_pairs pairs, uint64_t capacity, char* text, uint64_t* out_count);

#ifdef __cplusplus
}
#endif
#endif
