/* hf/peers.h - the methods that hf is compared with; a host needs none of them.
 *
 * Only builds with the CMake option HF_WITH_PEERS have these functions. hf/hf.h does not include this header. Each
 * function makes a solver, a pose or a transfer. All functions of that noun accept the object, except where a comment
 * below says otherwise.
 *
 * The two engines of solvers, updown and refactor, give the same fields as hf_create. Their solvers differ in five
 * ways:
 * - hf_solver_set_screening returns HF_ERROR_UNSUPPORTED.
 * - hf_solver_prepare_rebase returns HF_ERROR_UNSUPPORTED.
 * - A preview gives the exact field (hf_preview_info.exact is 1).
 * - hf_solver_statistics.last_route stays HF_ROUTE_NONE.
 * - A bi-harmonic field is refused with HF_ERROR_UNSUPPORTED if a vertex has more than 1,000 neighbours. */
#ifndef HF_PEERS_H
#define HF_PEERS_H

#include "hf/hf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Creates a solver with the engine of Xu, Zhang, Cohen-Or and Xiong (2009). A site is a penalty on the diagonal. An
 * update or a downdate puts it into a sparse factor. desc: NULL, or as hf_create. penalty: weight of a hard site
 * relative to the mean diagonal of K, up to 1e10; 0 = 1e8. The field misses its hard sites by about 1e-8 of the value
 * range, a bi-harmonic field by 2e-7. So the default tolerance of hf_solver_certify is 1e-5. Errors: as hf_create,
 * HF_ERROR_INVALID_ARGUMENT (penalty), HF_ERROR_UNSUPPORTED (a build without HF_WITH_GPL). Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_peer_updown_create(hf_surface surface, const hf_solver_desc* desc, double penalty,
                                       hf_solver* out_solver);

/* Creates a solver that eliminates its sites. It factorises again whenever the places of sites change. desc: NULL, or
 * as hf_create. Errors: as hf_create. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_peer_refactor_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver);

/* Creates a pose with the solve of Section 5 of Xu, Zhang, Cohen-Or and Xiong (2009). Bands of equal value are linear,
 * and overlapping clusters match their shapes. desc: NULL, or as hf_pose_create; band_count 0 = 12, iteration_count 0 =
 * 200, group_count has no effect. rim_site_count: sites on the boundary of a handle; 0 = all vertices of the boundary.
 * The paper takes "dozens". With fewer than all, fields leak (hf_handle_info.leak). Handles need a rotation:
 * free_rotation is refused with HF_ERROR_UNSUPPORTED. A handle added with in_place starts at the posed surface. The
 * next hf_deform moves the surface to the pose of all handles at once, also if no handle moves. Errors: as
 * hf_pose_create. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_peer_pose_create(hf_surface surface, const hf_pose_desc* desc, uint32_t rim_site_count,
                                     hf_pose* out_pose);

/* Creates a transfer with the clusters of Section 6 of Xu, Zhang, Cohen-Or and Xiong (2009): a cluster holds the
 * vertices between two levels of one field. There is no rest alignment and no ground. A part of the target that reaches
 * farther than its partner turns as much as its partner. desc: NULL, or as hf_transfer_create with HF_TRANSFER_FIELDS;
 * cluster_count is divided among the pairs, 2 to 64 per pair; 0 = 8 per pair. Errors: as hf_transfer_create. Thread
 * safety: reads the surfaces. Since 0.1. */
HF_API hf_result hf_peer_transfer_create(hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                                         hf_transfer* out_transfer);

#ifdef __cplusplus
}
#endif
#endif
