#include "common/peers.h"

#ifdef HF_WITH_PEERS
#include "hf/peers.h"
#else
#include <stdexcept>
#endif

namespace samples {

#ifdef HF_WITH_PEERS

hf_result create_solver(Engine engine, hf_surface surface, const hf_solver_desc& desc, hf_solver* out_solver) {
  if (engine == Engine::updown) return hf_peer_updown_create(surface, &desc, 0, out_solver);
  if (engine == Engine::refactor) return hf_peer_refactor_create(surface, &desc, out_solver);
  return hf_create(surface, &desc, out_solver);
}

hf_result create_pose(bool paper, hf_surface surface, const hf_pose_desc& desc, hf_pose* out_pose) {
  return paper ? hf_peer_pose_create(surface, &desc, 0, out_pose) : hf_pose_create(surface, &desc, out_pose);
}

hf_result create_transfer(bool paper, hf_surface source, hf_surface target, const hf_transfer_desc& desc,
                          hf_transfer* out_transfer) {
  return paper ? hf_peer_transfer_create(source, target, &desc, out_transfer)
               : hf_transfer_create(source, target, &desc, out_transfer);
}

#else

namespace {

void refuse(bool baseline) {
  if (baseline)
    throw std::runtime_error("this program was built without the paper's methods; configure with -DHF_WITH_PEERS=ON");
}

}  // namespace

hf_result create_solver(Engine engine, hf_surface surface, const hf_solver_desc& desc, hf_solver* out_solver) {
  refuse(engine != Engine::green);
  return hf_create(surface, &desc, out_solver);
}

hf_result create_pose(bool paper, hf_surface surface, const hf_pose_desc& desc, hf_pose* out_pose) {
  refuse(paper);
  return hf_pose_create(surface, &desc, out_pose);
}

hf_result create_transfer(bool paper, hf_surface source, hf_surface target, const hf_transfer_desc& desc,
                          hf_transfer* out_transfer) {
  refuse(paper);
  return hf_transfer_create(source, target, &desc, out_transfer);
}

#endif

}  // namespace samples
