/* hf/peers.h - the methods that hf is compared with; a host needs none of them.
 *
 * The functions are in builds with the CMake option HF_WITH_PEERS only. hf/hf.h does not include this header. Each
 * makes a plain solver, pose or transfer, and all functions of these objects work on it. The exceptions stand here.
 *
 * The engines give the fields of hf_create. Both take away what needs the factor alone: hf_solver_set_screening and
 * hf_solver_prepare_rebase return HF_ERROR_UNSUPPORTED, a preview gives the exact field (hf_preview_info.exact is 1),
 * and hf_solver_statistics.last_route stays HF_ROUTE_NONE. They return HF_ERROR_UNSUPPORTED for a bi-harmonic field on
 * a surface with a vertex of more than 1,000 neighbours. */
#ifndef HF_PEERS_H
#define HF_PEERS_H

#include "hf/hf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Creates a solver with the engine of Xu, Zhang, Cohen-Or and Xiong (2009): sites are penalties on the diagonal, put
 * into a sparse factor by update and downdate. desc: NULL, or as hf_create. penalty: weight of a hard site relative to
 * the mean diagonal of K, up to 1e10; 0 = 1e8. The field meets its sites to about 1e-8 of the value range, a
 * bi-harmonic one to 2e-7, and the tolerance of hf_solver_certify is 1e-5 by default. Errors: as hf_create,
 * HF_ERROR_INVALID_ARGUMENT (penalty), HF_ERROR_UNSUPPORTED (a build without HF_WITH_GPL). Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_peer_updown_create(hf_surface surface, const hf_solver_desc* desc, double penalty,
                                       hf_solver* out_solver);

/* Creates a solver that eliminates its sites and factorises again at every change of their places. desc: NULL, or as
 * hf_create. Errors: as hf_create. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_peer_refactor_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver);

/* Creates a pose that is solved as Section 5 of Xu, Zhang, Cohen-Or and Xiong (2009) describes: linear bands of equal
 * value, and shape matching of overlapping clusters. desc: NULL, or as hf_pose_create; band_count 0 = 12,
 * iteration_count 0 = 200, group_count has no effect. rim_site_count: sites on the boundary of a handle, the paper
 * takes "dozens"; 0 = all of its vertices. With fewer, fields leak (hf_handle_info.leak). Handles need a rotation:
 * free_rotation is refused with HF_ERROR_UNSUPPORTED. A handle in place goes where the surface stands, and the surface
 * does not wait for it. Errors: as hf_pose_create. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_peer_pose_create(hf_surface surface, const hf_pose_desc* desc, uint32_t rim_site_count,
                                     hf_pose* out_pose);

/* Creates a transfer with the clusters of Section 6 of Xu, Zhang, Cohen-Or and Xiong (2009): a cluster holds the
 * vertices between two levels of one field. There is no rest alignment and no ground, and no part turns less because it
 * reaches farther. desc: NULL, or as hf_transfer_create with HF_TRANSFER_FIELDS; cluster_count is shared out among the
 * pairs, 2 to 64 for each, 0 = 8 for each. Errors: as hf_transfer_create. Thread safety: reads the surfaces. Since 0.1.
 */
HF_API hf_result hf_peer_transfer_create(hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                                         hf_transfer* out_transfer);

#ifdef __cplusplus
}
#endif
#endif
