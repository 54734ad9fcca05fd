/* hf/peers.h - the methods that hf is compared with; a host needs none of them.
 *
 * The functions are in builds with the CMake option HF_WITH_PEERS only. hf/hf.h does not include this header. Each makes
 * a plain solver, pose or transfer, and all functions of these objects work on it. The exceptions stand here.
 *
 * The engines give the fields of hf_create. Both take away what needs the factor alone: hf_solver_set_screening and
 * hf_solver_prepare_rebase return HF_ERROR_UNSUPPORTED, a preview gives the exact field (hf_preview_info.exact is 1),
 * and hf_solver_statistics.last_route stays HF_ROUTE_NONE. They return HF_ERROR_UNSUPPORTED for a bi-harmonic field on a
 * surface with a vertex of more than 1,000 neighbours. */
#ifndef HF_PEERS_H
#define HF_PEERS_H

#include "hf/hf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Creates a solver with the engine of Xu, Zhang, Cohen-Or and Xiong (2009): sites are penalties on the diagonal, put
 * into a sparse factor by update and downdate. desc: NULL, or as hf_create. penalty: weight of a hard site relative to
 * the mean diagonal of K, up to 1e10; 0 = 1e8. The field meets its sites to about 1e-8 of the value range, a bi-harmonic
 * one to 2e-7, and the tolerance of hf_solver_certify is 1e-5 by default. Errors: as hf_create,
 * HF_ERROR_INVALID_ARGUMENT (penalty), HF_ERROR_UNSUPPORTED (a build without HF_WITH_GPL). Thread safety: reads
 * `surface`. Since 0.1. */
HF_API hf_result hf_peer_updown_create(hf_surface surface, const hf_solver_desc* desc, double penalty,
                                       hf_solver* out_solver);

/* Creates a solver that eliminates its sites and factorises again at every change of their places. desc: NULL, or as
 * hf_create. Errors: as hf_create. Thread safety: reads `surface`. Since 0.1. */
HF_API hf_result hf_peer_refactor_create(hf_surface surface, const hf_solver_desc* desc, hf_solver* out_solver);

#ifdef __cplusplus
}
#endif
#endif
