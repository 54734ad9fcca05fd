// The baselines of hf/peers.h, for programs that show the figures of the paper.
#ifndef HF_SAMPLES_COMMON_PEERS_H
#define HF_SAMPLES_COMMON_PEERS_H

#include "hf/hf.h"

namespace samples {

enum class Engine { green, updown, refactor };

// As hf_create, with a baseline if the engine is one. A program of a build without HF_WITH_PEERS throws
// std::runtime_error for a baseline.
hf_result create_solver(Engine engine, hf_surface surface, const hf_solver_desc& desc, hf_solver* out_solver);

// The same with hf_pose_create and hf_transfer_create. paper: the methods of the paper.
hf_result create_pose(bool paper, hf_surface surface, const hf_pose_desc& desc, hf_pose* out_pose);
hf_result create_transfer(bool paper, hf_surface source, hf_surface target, const hf_transfer_desc& desc,
                          hf_transfer* out_transfer);

}  // namespace samples

#endif
