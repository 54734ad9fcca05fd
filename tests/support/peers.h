/* The baselines of hf/peers.h beside hf's own methods, chosen by a number, and whether the library at hand has METIS
 * and the engine updown (HF_WITH_GPL). A test asks at run time: the same program runs with and without. */
#ifndef HF_TESTS_SUPPORT_PEERS_H
#define HF_TESTS_SUPPORT_PEERS_H

#include <hf/peers.h>

enum { ENGINE_GREEN = 0, ENGINE_UPDOWN = 1, ENGINE_REFACTOR = 2 };

/* hf_create, or a baseline with its default penalty. */
static inline hf_result create_with(int32_t engine, hf_surface surface, const hf_solver_desc* desc,
                                    hf_solver* out_solver) {
  if (engine == ENGINE_UPDOWN) return hf_peer_updown_create(surface, desc, 0, out_solver);
  if (engine == ENGINE_REFACTOR) return hf_peer_refactor_create(surface, desc, out_solver);
  return hf_create(surface, desc, out_solver);
}

enum { POSE_SMOOTH = 0, POSE_PAPER = 1 };

/* hf_pose_create, or the baseline with whole rings. */
static inline hf_result create_pose_with(int32_t mode, hf_surface surface, const hf_pose_desc* desc,
                                         hf_pose* out_pose) {
  if (mode == POSE_PAPER) return hf_peer_pose_create(surface, desc, 0, out_pose);
  return hf_pose_create(surface, desc, out_pose);
}

enum { TRANSFER_FIELDS = 0, TRANSFER_PAPER = 1, TRANSFER_STRETCH = 2 };

/* The mode that a desc must have. */
static inline int32_t mode_of(int32_t kind) {
  return kind == TRANSFER_STRETCH ? HF_TRANSFER_STRETCH : HF_TRANSFER_FIELDS;
}
static inline hf_result create_transfer_with(int32_t kind, hf_surface source, hf_surface target,
                                             const hf_transfer_desc* desc, hf_transfer* out_transfer) {
  if (kind == TRANSFER_PAPER) return hf_peer_transfer_create(source, target, desc, out_transfer);
  return hf_transfer_create(source, target, desc, out_transfer);
}

static inline int has_gpl(void) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t triangle[] = {0, 1, 2};
  hf_surface surface;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(positions, 3);
  desc.triangles = HF_ARRAY(triangle, 1);
  desc.ordering = HF_ORDERING_METIS;
  if (hf_surface_create(&desc, &surface) != HF_OK) return 0;
  hf_surface_destroy(surface);
  return 1;
}

#endif
