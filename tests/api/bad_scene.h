/* The scene the bad-input tables work on: one live object of each kind with a known state, and the check that nothing
 * has changed. */
#ifndef HF_API_BAD_SCENE_H
#define HF_API_BAD_SCENE_H

#include "api_support.h"

enum { TUBE_AROUND = 10, TUBE_RINGS = 14, TUBE_VERTICES = TUBE_AROUND * TUBE_RINGS };

typedef struct Scene {
  Surface cut, tube;
  hf_surface sheet;     /* the cut sheet */
  hf_surface body;      /* the tube */
  hf_solver solver;     /* on the cut sheet, one channel, sites at CUT_LEFT = 0, CUT_RIGHT = 1, CUT_SEAM_LEFT = 5 */
  hf_solver three;      /* on the cut sheet, three channels, no site */
  hf_pose pose;         /* on the tube, two handles, one turned */
  hf_transfer transfer; /* tube to tube, two pairs */
  hf_progress progress;
  hf_geodesics geodesics;   /* of the tube */
  hf_direction direction;   /* on the cut sheet, constraint 0 at CUT_LEFT and 1 at CUT_RIGHT */
  hf_region region;         /* on the tube, two vertices of its middle */
  hf_weights weights;       /* on the tube, three joints one after the other in it */
  hf_surface stale_surface; /* destroyed */
  hf_solver stale_solver;
  hf_pose stale_pose;
  hf_transfer stale_transfer;
  hf_progress stale_progress;
  hf_geodesics stale_geodesics;
  hf_direction stale_direction;
  hf_region stale_region;
  hf_weights stale_weights;
  uint32_t sites[3], handles[2], pairs[2];
  uint32_t* ends; /* the regions of both handles */
  float* posed;   /* a posed tube, the source of the transfer */
  double* field;  /* expected: field, pose and transfer */
  float *deformed, *transferred;
  float* skin; /* expected: the weights of scene.weights */
} Scene;

void scene_create(Scene* scene);
void scene_destroy(Scene* scene);
/* Whether field, sites, pose and transfer are the same bits as at scene_create. */
int solver_unchanged(const Scene* scene);
int pose_unchanged(const Scene* scene);
int transfer_unchanged(const Scene* scene);
int weights_unchanged(const Scene* scene);
/* The bones of scene.weights; the lists are static. */
hf_joints_desc scene_bones(void);

/* ROW(what is wrong, expected code, expected index, the change to the good input, the call): the variables of the good
 * input are refreshed by the function GOOD() of the including file, and UNCHANGED() is what must hold afterwards. */
#define ROW(what, expected, index, change, call)                      \
  do {                                                                \
    GOOD();                                                           \
    change;                                                           \
    check_row(__LINE__, what, #call, (call), expected, index);        \
    row_holds(__LINE__, what, "the state is unchanged", UNCHANGED()); \
  } while (0)

#endif
